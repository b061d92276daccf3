"""One recording of many: what shall be done with it, and what came of it."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from os import PathLike
from pathlib import Path
from typing import Any

from dmpcpp import __version__
from dmpcpp._atomic import write_text
from dmpcpp.errors import FileError, InvalidArgument

__all__ = ["OUTCOME_FILE", "Outcome", "Task", "carry_out", "kept", "tasks"]

OUTCOME_FILE = "outcome.json"


@dataclass(frozen=True)
class Task:
    """One recording, to be carried out by an arm.

    Attributes
    ----------
    file : str
        Path of the recording.
    folder : str
        Where its results go.
    arm : str
        Name or URDF, as `arms.load` takes it; `base`, `tip`, `tool`, `package_path` and `limits` with it.
    reading, preparation, options : mapping
        What `recordings.load`, `motion.Preparation` and `imitation.imitate` take by keyword.
    """

    file: str
    folder: str
    arm: str = "panda"
    base: str | None = None
    tip: str | None = None
    tool: Sequence[float] | None = None
    package_path: Sequence[str] = ()
    limits: Mapping[str, Any] = field(default_factory=dict)
    reading: Mapping[str, Any] = field(default_factory=dict)
    preparation: Mapping[str, Any] = field(default_factory=dict)
    options: Mapping[str, Any] = field(default_factory=dict)

    def fingerprint(self) -> str:
        """Return what changes when the task, the recording's size or time, or the version of dmpcpp does."""
        found = Path(self.file).stat() if Path(self.file).is_file() else None
        parts = [__version__, asdict(self), found and (found.st_size, found.st_mtime_ns)]
        return hashlib.sha256(json.dumps(parts, sort_keys=True, default=str).encode()).hexdigest()


@dataclass(frozen=True)
class Outcome:
    """What came of a task.

    Attributes
    ----------
    file, folder, arm : str
    verdict : str
        "pass", "fail" (a check did not hold), "not judged" (there was no limit for one) or "error" (it could not be
        carried out).
    cause : str
        The checks that failed or were not judged, or the error; empty for a pass.
    errors : dict
        Position and angle errors of every stage [m, rad], as in summary.json; empty after an error.
    slowdown, seconds : float
        Duration over the recorded one; how long the work took [s].
    fingerprint : str
        Of the task.
    """

    file: str
    folder: str
    arm: str
    verdict: str
    cause: str
    errors: dict[str, dict[str, float]]
    slowdown: float
    seconds: float
    fingerprint: str

    @property
    def ok(self) -> bool:
        """Whether it was verified."""
        return self.verdict == "pass"


def tasks(recordings: str | PathLike[str], out: str | PathLike[str], *, pattern: str = "*", **how: Any) -> list[Task]:
    """Return a task for every file of a folder whose name fits `pattern`, in the order of their names.

    Parameters
    ----------
    recordings : path
        A folder; files in folders below it are found by a pattern such as `**/*.bvh`.
    out : path
        Results go into a folder here named as the file is.
    pattern : str
    **how
        The other fields of `Task`.

    Raises
    ------
    FileError
        There is no such folder.
    InvalidArgument
        No file in it fits.
    """
    folder = Path(recordings)
    if not folder.is_dir():
        raise FileError(f"{folder}: the folder does not exist; expected a folder of recordings.")
    files = sorted(path for path in folder.glob(pattern) if path.is_file() and not path.name.startswith("."))
    if not files:
        raise InvalidArgument(f"pattern: no file in '{folder}' fits '{pattern}', expected recordings such as *.bvh.")
    names = ["__".join(path.relative_to(folder).parts) for path in files]
    return [Task(str(path), str(Path(out) / name), **how) for path, name in zip(files, names, strict=True)]


def kept(task: Task) -> Outcome | None:
    """Return the outcome of this very task where its folder holds one."""
    try:
        outcome = Outcome(**json.loads((Path(task.folder) / OUTCOME_FILE).read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):
        return None
    return outcome if outcome.fingerprint == task.fingerprint() else None


def carry_out(task: Task) -> Outcome:
    """Imitate one recording and keep results and outcome in its folder; whatever goes wrong is the outcome.

    Raises
    ------
    FileError
        The outcome cannot be written.
    """
    began = time.monotonic()
    found: dict[str, Any] = {"errors": {}, "slowdown": 1.0}
    folder = Path(task.folder)
    try:
        found |= _imitated(task)
    except Exception as error:  # one bad file must not stop the others
        known = isinstance(error, InvalidArgument | OSError | ImportError)
        found |= {"verdict": "error", "cause": str(error) if known else f"{type(error).__name__}: {error}"}
    outcome = Outcome(
        file=task.file,
        folder=task.folder,
        arm=task.arm,
        seconds=time.monotonic() - began,
        fingerprint=task.fingerprint(),
        **found,
    )
    folder.mkdir(parents=True, exist_ok=True)
    write_text(folder / OUTCOME_FILE, json.dumps(asdict(outcome), indent=2, allow_nan=False) + "\n")
    return outcome


def _imitated(task: Task) -> dict[str, Any]:
    from dmpcpp import imitation, motion, recordings
    from dmpcpp.robot import Surroundings, arms
    from dmpcpp.show import report

    options = dict(task.options)
    wants_report = options.pop("report", False)
    around = Surroundings.of(options.pop("surroundings", None))
    recording = recordings.load(task.file, **task.reading)
    recording = motion.prepare(recording, motion.Preparation(**task.preparation))
    run = imitation.imitate(
        recording,
        arms.load(
            task.arm,
            task.base,
            task.tip,
            tool=task.tool,
            package_path=task.package_path,
            limits=task.limits,
        ),
        surroundings=around,
        **options,
    )
    imitation.write(run, task.folder)
    if wants_report:
        report.write(task.folder)
    unjudged = [f"not judged: {check.name}: {check.detail}" for check in run.open]
    return {
        "verdict": run.judged()["verdict"],
        "cause": ", ".join([*(check.name for check in run.failed), *unjudged]),
        "errors": {name: errors.to_dict() for name, errors in run.stages.items()},
        "slowdown": run.slowdown,
    }
