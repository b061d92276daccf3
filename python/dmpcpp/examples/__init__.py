"""Small recordings to type along with: made here by formulas and seeds, so that nobody's data comes with the package.

`dmpcpp example NAME` writes one; tutorial, README and help use only these.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

from dmpcpp._atomic import write_text
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.examples import _bvh, _markers, _motions, _robot, _robot_log
from dmpcpp.examples._motions import HandMotion

__all__ = ["EXAMPLES", "Example", "write"]


@dataclasses.dataclass(frozen=True)
class Example:
    """A recording that can be written.

    Attributes
    ----------
    what : str
        What is in it.
    files : tuple of str
        The files that are written, relative to the folder.
    texts : callable
        Returns the files' contents.
    """

    what: str
    files: tuple[str, ...]
    texts: Callable[[], tuple[str, ...]] = dataclasses.field(repr=False)


def write(
    name: str, folder: str | Path = ".", *, run: str | Path | None = None, overwrite: bool = False
) -> tuple[Path, ...]:
    """Write an example's files; the same bytes each time.

    Parameters
    ----------
    name : str
        One of `EXAMPLES`.
    folder : path, optional
        Where to write; made if it is missing.
    run : path, optional
        For "log": the folder of the run that the robot followed.
    overwrite : bool, optional
        Replace files that are there with other contents.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    InvalidArgument
        The name is unknown, `run` does not go with it, or a file is there with other contents.
    FileError
        A folder cannot be written, or the run has no joints.
    """
    if name not in EXAMPLES:
        raise InvalidArgument(f"name: '{name}', expected one of {', '.join(EXAMPLES)}.")
    if (name == "log") != (run is not None):
        given = "missing, expected the folder of a run" if run is None else f"{run}, expected only with 'log'"
        raise InvalidArgument(f"run: {given}. A log belongs to the run that the robot followed.")
    example = EXAMPLES[name]
    texts = (_robot_log.robot_log(run),) if run is not None else example.texts()
    paths = tuple(Path(folder) / file for file in example.files)
    for path, text in zip(paths, texts, strict=True):
        if path.exists() and not overwrite and (path.is_dir() or path.read_bytes() != text.encode()):
            raise InvalidArgument(f"{path}: is there already with other contents. Replace it with overwrite=True.")
    for path, text in zip(paths, texts, strict=True):
        _make(path.parent)
        write_text(path, text)
    return paths


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"{folder}: cannot be made ({error.strerror or error}).") from error


def _table(motion: HandMotion, *, time: str = "time", scale: float = 1.0) -> str:
    """Return a CSV with a position and a quaternion for each time; `scale` is what 1 s becomes."""
    lines = [f"{time},x,y,z,qx,qy,qz,qw"]
    for t, p, q in zip(motion.time, motion.position, motion.quaternions(), strict=True):
        cells = [f"{scale * t:.3f}", *(f"{value:.4f}" for value in p), *(f"{value:.6f}" for value in q)]
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


def _takes() -> tuple[str, ...]:
    return tuple(_table(_motions.take(k)) for k in (1, 2, 3))


EXAMPLES: dict[str, Example] = {
    "reach": Example(
        "a reach of a right arm, motion capture, lengths in cm",
        ("reach.bvh",),
        lambda: (_bvh.reach(),),
    ),
    "takes": Example(
        "three takes of one reach",
        ("takes/reach_1.csv", "takes/reach_2.csv", "takes/reach_3.csv"),
        _takes,
    ),
    "session": Example(
        "five reaches with rests between them",
        ("session.csv",),
        lambda: (_table(_motions.session()),),
    ),
    "stir": Example(
        "a hand that goes to a pot, stirs six rounds and stops",
        ("stir.csv",),
        lambda: (_table(_motions.stir()),),
    ),
    "screw": Example(
        "a hand that turns a lid by one and a half turns",
        ("screw.csv",),
        lambda: (_table(_motions.screw()),),
    ),
    "phone": Example(
        "the log of a phone: stamps in ms that jitter, samples lost",
        ("phone.csv",),
        lambda: (_table(_motions.phone(), time="timestamp_ms", scale=1e3),),
    ),
    "lift": Example(
        "three markers on a wrist, motion capture, z up",
        ("lift.trc",),
        lambda: (_markers.lift(),),
    ),
    "robot": Example(
        "an arm of your own: six joints, as a URDF",
        ("my_robot.urdf",),
        lambda: (_robot.my_robot(),),
    ),
    "log": Example(
        "what a robot would have recorded of a run",
        ("log.csv",),
        lambda: (),
    ),
}
