"""Many trials, kept one a line in a file, so that a run that was stopped goes on where it was."""

from __future__ import annotations

import json
from collections.abc import Callable, Generator, Iterable, Mapping
from concurrent.futures import as_completed
from contextlib import closing
from itertools import product
from os import PathLike
from pathlib import Path
from typing import Any

from dmpcpp.checks import accepted_names
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.robot import Surroundings
from dmpcpp.trials._processes import workers
from dmpcpp.trials.generality._motions import NOISE
from dmpcpp.trials.generality._trial import Result, Trial, attempt

__all__ = ["kept", "run", "trials"]

_CHOICE = {"base": None, "tip": None, "tool": None, "package_path": [], "limits": {}}
_OPTIONS = {"follow": None, "dynamics": "full", "slowest": None, "surroundings": Surroundings().to_dict()}
_TEMPO = {"tempo": "person", "tolerance": "1mm,0.5deg"}  # unless stated


def trials(
    count: int,
    arms: Iterable[str],
    noises: Iterable[str] = tuple(NOISE),
    seed: int = 0,
    accept: Iterable[str] = (),
    choice: Mapping[str, Any] | None = None,
    options: Mapping[str, Any] | None = None,
) -> list[Trial]:
    """Return the trials of `count` motions with every arm at every level of noise, motion by motion.

    `accept`, `choice` and `options` are those of `Trial`.

    Raises
    ------
    InvalidArgument
        A count below 1, a seed below 0, no arm, a level of noise that is none of NOISE, or a check that is always
        judged.
    """
    arms, noises = tuple(dict.fromkeys(arms)), tuple(dict.fromkeys(noises))
    for name, value, least in (("count", count, 1), ("seed", seed, 0)):
        if value < least:
            raise InvalidArgument(f"{name}: {value}, expected {least} or more.")
    unknown = [noise for noise in noises if noise not in NOISE]
    if unknown or not noises:
        raise InvalidArgument(f"noises: {unknown or 'none'}, expected some of {', '.join(NOISE)}.")
    if not arms:
        raise InvalidArgument("arms: none, expected at least one.")
    accepted = accepted_names(accept)
    how = (accepted, _other_than(_CHOICE, choice), _other_than(_OPTIONS, {**_TEMPO, **(options or {})}))
    return [Trial(arm, noise, seed, index, *how) for index, arm, noise in product(range(count), arms, noises)]


def _other_than(usual: Mapping[str, Any], stated: Mapping[str, Any] | None) -> dict[str, Any]:
    """Leave out what is as usual: a trial is the same whether that was stated or not."""
    return {name: value for name, value in (stated or {}).items() if name not in usual or value != usual[name]}


def run(
    wanted: list[Trial],
    path: str | PathLike[str],
    jobs: int = 1,
    progress: Callable[[int, int, int], None] | None = None,
) -> list[Result]:
    """Make the trials that the file does not hold yet, and return the results of all that are wanted.

    Parameters
    ----------
    wanted : list of Trial
    path : path
        JSON lines; every result is appended when it is there. Results of other trials stay in it.
    jobs : int
        Processes at a time, 1 or more.
    progress : callable, optional
        Called as progress(done, failed among them, total).

    Raises
    ------
    InvalidArgument
        jobs below 1, or a line of the file that is no result (a truncated last line is ignored).
    FileError
        The file cannot be read or written.
    """
    if jobs < 1:
        raise InvalidArgument(f"jobs: {jobs}, expected 1 or more.")
    path = Path(path)
    results = {result.trial.key: result for result in kept(path)}
    missing = [trial for trial in wanted if trial.key not in results]
    _tell(progress, wanted, results)
    with closing(_made(missing, jobs)) as made:
        for result in made:
            _append(path, result)
            results[result.trial.key] = result
            _tell(progress, wanted, results)
    return [results[trial.key] for trial in wanted]


def kept(path: str | PathLike[str]) -> list[Result]:
    """Return the results in a file; none where there is no file. Errors are those of `run`."""
    try:
        lines = Path(path).read_text(encoding="utf-8").split("\n")
    except FileNotFoundError:
        return []
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(f"{path}: cannot be read ({error}).") from None
    return [_parsed(line, f"{path}, line {k}") for k, line in enumerate(lines[:-1], start=1)]  # the last is cut off


def _parsed(line: str, where: str) -> Result:
    try:
        return Result.from_dict(json.loads(line))
    except (ValueError, KeyError, TypeError):
        raise InvalidArgument(f"{where}: no result of a trial. Remove the file to begin anew.") from None


def _tell(progress: Callable[[int, int, int], None] | None, wanted: list[Trial], results: dict[str, Result]) -> None:
    if progress:
        done = [results[trial.key] for trial in wanted if trial.key in results]
        progress(len(done), sum(not result.ok for result in done), len(wanted))


def _made(missing: list[Trial], jobs: int) -> Generator[Result]:
    if jobs == 1 or len(missing) < 2:
        yield from map(attempt, missing)
        return
    with workers(jobs) as pool:
        futures = [pool.submit(attempt, trial) for trial in missing]
        yield from (future.result() for future in as_completed(futures))


def _append(path: Path, result: Result) -> None:
    """Add a line; what a stop in the middle of one left behind goes first."""
    line = json.dumps(result.to_dict(), allow_nan=False) + "\n"
    try:
        with path.open("ab+") as file:
            file.truncate(_end_of_last_line(path))
            file.write(line.encode())
    except OSError as error:
        raise FileError(f"{path}: cannot be written ({error.strerror or error}).") from error


def _end_of_last_line(path: Path) -> int:
    return path.read_bytes().rfind(b"\n") + 1
