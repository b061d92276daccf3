"""The motion-captured clips that ship inside the installed pybullet package, by short name."""

from __future__ import annotations

from pathlib import Path

from dmpcpp import _pybullet_data
from dmpcpp.errors import InvalidArgument, MissingDependency

__all__ = ["clip_names", "clip_path"]

_PREFIX = "humanoid3d_"


def clip_names() -> tuple[str, ...]:
    """Return the short names of the clips, "dance_b" among them.

    Raises
    ------
    MissingDependency
        pybullet_data is not installed.
    """
    return tuple(sorted(p.stem.removeprefix(_PREFIX) for p in _folder().glob(f"{_PREFIX}*.txt")))


def clip_path(name: str) -> Path:
    """Return the file of a clip.

    Raises
    ------
    MissingDependency
        pybullet_data is not installed.
    InvalidArgument
        There is no such clip; the message lists those that exist.
    """
    names = clip_names()
    if name not in names:
        raise InvalidArgument(f"clip: no clip {name!r}. There are: {', '.join(names)}.")
    return _folder() / f"{_PREFIX}{name}.txt"


def _folder() -> Path:
    found = _pybullet_data.find()
    if found is None:
        raise MissingDependency(
            "The clips ship with PyBullet, in pybullet_data, which is not installed. Run `dmpcpp fetch`, or install "
            'PyBullet: pip install "dmpcpp[bullet]".'
        )
    return found / "data" / "motions"
