"""A folder that `dmpcpp imitate` or `dmpcpp demo` wrote, read back for its report."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from dmpcpp import export
from dmpcpp._core import PoseDmp, load
from dmpcpp.checks import SUMMARY_VERSION
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.show.report._record import RunRecord, read_record

__all__ = ["RunFolder", "read_run", "result_of"]


@dataclass(frozen=True, eq=False)
class RunFolder:
    """What a run left behind; `config` is the text of config.toml, empty where there is none."""

    path: Path
    summary: dict[str, Any]
    model: PoseDmp
    plan: export.Plan
    record: RunRecord
    config: str

    @property
    def ok(self) -> bool:
        """Whether the run was verified."""
        return bool(self.summary["verdict"] == "pass")

    def named(self, result: str) -> list[str]:
        """Return the names of the checks with a result: "holds", "fails", "not judged"."""
        return list(dict.fromkeys(check["name"] for check in self.summary["checks"] if result_of(check) == result))


def result_of(check: dict[str, Any]) -> str:
    """Return the result of a check of a summary; those of 0.1 were all judged."""
    return "holds" if check["ok"] else "not judged" if check.get("result") == "not judged" else "fails"


def read_run(folder: Path) -> RunFolder:
    """Read a run's folder.

    Raises
    ------
    FileError
        The folder is not there, or a file of it cannot be read.
    InvalidArgument
        A file of it is not what the run wrote.
    """
    if not folder.is_dir():
        raise FileError(f"{folder}: no such folder; expected one that `dmpcpp imitate` or `dmpcpp demo` wrote.")
    missing = [
        name for name in ("summary.json", "model.json", "plan.npz", "execution.npz") if not (folder / name).is_file()
    ]
    if missing:
        raise FileError(
            f"{folder}: has no {', '.join(missing)}; expected the folder of a whole run of `dmpcpp imitate` or "
            "`dmpcpp demo`. Run it again."
        )
    config = folder / "config.toml"
    return RunFolder(
        folder,
        _summary(folder / "summary.json"),
        load(folder / "model.json"),
        export.read_plan(folder / "plan.npz"),
        read_record(folder / "execution.npz"),
        config.read_text(encoding="utf-8") if config.is_file() else "",
    )


def _summary(path: Path) -> dict[str, Any]:
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise InvalidArgument(f"{path}: not JSON ({error}). Run the imitation again.") from None
    needed = {"verdict", "stages", "checks", "arm", "recording", "slowdown", "duration", "simulator", "mode", "caveat"}
    missing = sorted(needed - set(summary)) if isinstance(summary, dict) else sorted(needed)
    if missing:
        raise InvalidArgument(f"{path}: has no {', '.join(missing)}; expected the summary of an imitation.")
    version = summary.get("version", 1)
    if not isinstance(version, int) or version > SUMMARY_VERSION:
        raise InvalidArgument(f"{path}: version {version}, expected {SUMMARY_VERSION} or less. Install a newer dmpcpp.")
    return dict(summary)
