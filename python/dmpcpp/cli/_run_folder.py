"""What `dmpcpp run` takes of a folder that `imitate` or `plan` wrote."""

from __future__ import annotations

import json
from pathlib import Path

from dmpcpp.errors import InvalidArgument

__all__ = ["joints_of", "require_verified"]


def joints_of(plan: Path) -> Path:
    """Return the joints of a folder, or the file itself."""
    path = plan / "joints.csv" if plan.is_dir() else plan
    if plan.is_dir() and not path.exists():
        raise InvalidArgument(f"{plan}: no joints.csv. A run that is not verified, and a plan that fails, leave none.")
    return path


def require_verified(plan: Path) -> None:
    """Refuse a folder, or a file in one, whose summary is not of a run that passed."""
    folder = plan if plan.is_dir() else plan.absolute().parent
    try:
        summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        if plan.is_dir():
            raise InvalidArgument(f"{plan}: no summary.json: not the folder of a whole run or plan.") from None
        return
    except (OSError, ValueError) as error:
        raise InvalidArgument(f"{folder / 'summary.json'}: cannot be read ({error}).") from None
    verdict = summary.get("verdict") if isinstance(summary, dict) else None
    if verdict != "pass" and not (isinstance(summary, dict) and summary.get("ok") is True):
        raise InvalidArgument(f"{folder}: its verdict is '{verdict}'; no robot gets a motion that is not verified.")
