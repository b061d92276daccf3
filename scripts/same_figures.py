"""Holds the figures of a rebuilt package against those of an earlier one: demo, grasp and reproduce, seed 0.

    python scripts/same_figures.py record FOLDER    # with the earlier package
    python scripts/same_figures.py compare FOLDER   # with the later one

Every number of the three summaries must agree within 1e-12 (relative above 1), every text and truth value exactly.
What only one of the two has is printed and fails the comparison, unless `--new-keys` allows additions.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

TOLERANCE = 1e-12
UNTIMED = {"seconds", "version", "dmpcpp", "created"}  # differ from run to run, or with the release

COMMANDS = {
    "demo": ["demo", "--seed", "0", "--no-report", "--json", "--out", "{out}"],
    "grasp": ["grasp", "--seed", "0", "--json"],
    "reproduce": ["reproduce", "--seed", "0", "--repeat", "3", "--json", "--out", "{out}"],
}


def summary(name: str) -> Any:
    """Return what a command prints with --json."""
    with tempfile.TemporaryDirectory() as out:
        command = [part.format(out=Path(out) / name) for part in COMMANDS[name]]
        run = subprocess.run([sys.executable, "-m", "dmpcpp", *command], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        raise SystemExit(f"{name} ended with {run.returncode}:\n{run.stderr}")
    return json.loads(run.stdout)


def leaves(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Yield every leaf of a JSON value with its path; entries of a list by their name where they have one."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in UNTIMED:
                yield from leaves(item, f"{path}/{key}")
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from leaves(item, f"{path}/{item.get('name', index) if isinstance(item, dict) else index}")
    else:
        yield path, value


def differs(before: Any, after: Any) -> bool:
    """Return whether two leaves differ by more than the tolerance."""
    if isinstance(before, bool) or not isinstance(before, int | float) or not isinstance(after, int | float):
        return bool(before != after)
    return abs(before - after) > TOLERANCE * max(1.0, abs(before))


def differences(before: Any, after: Any) -> list[str]:
    """Return one line for every leaf that differs or that only one of the two has."""
    old, new = dict(leaves(before)), dict(leaves(after))
    lines = [f"{path}: gone, was {old[path]!r}" for path in old.keys() - new.keys()]
    if "--new-keys" not in sys.argv:
        lines += [f"{path}: new, {new[path]!r}" for path in new.keys() - old.keys()]
    shared = [path for path in old if path in new]
    lines += [f"{path}: {old[path]!r} -> {new[path]!r}" for path in shared if differs(old[path], new[path])]
    return sorted(lines)


def main() -> None:
    """Record or compare."""
    if len(sys.argv) < 3 or sys.argv[1] not in ("record", "compare"):
        raise SystemExit(__doc__)
    folder, failed = Path(sys.argv[2]), False
    for name in COMMANDS:
        file, found = folder / f"{name}.json", summary(name)
        if sys.argv[1] == "record":
            folder.mkdir(parents=True, exist_ok=True)
            file.write_text(json.dumps(found, indent=1))
            continue
        before = json.loads(file.read_text())
        lines = differences(before, found)
        failed = failed or bool(lines)
        print(f"{name}: {len(dict(leaves(before)))} leaves, {len(lines)} differ", *lines, sep="\n  ")
    raise SystemExit(failed)


if __name__ == "__main__":
    main()
