"""Everything that leaves for a robot, in one call: each file by itself, so that one that fails costs itself only."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from dmpcpp.errors import InvalidArgument, MissingDependency
from dmpcpp.export._files import write_joints
from dmpcpp.export._formats import FORMATS, Format
from dmpcpp.sending import RestToRest

if TYPE_CHECKING:
    from dmpcpp import Arm

__all__ = ["JOINTS", "Written", "remove_robot_files", "write_robot_files"]

JOINTS = "joints.csv"


class Written(tuple[str, ...]):
    """The names of the files that were written.

    Attributes
    ----------
    refused : dict of str to str
        The reason why a file was not written, by its name.
    """

    refused: dict[str, str]

    def __new__(cls, files: Iterable[str] = (), refused: dict[str, str] | None = None) -> Written:
        """Take the names and the reasons."""
        written = super().__new__(cls, files)
        written.refused = refused or {}
        return written


def remove_robot_files(folder: Path) -> None:
    """Remove what an earlier run left for a robot: it is of another motion."""
    (folder / JOINTS).unlink(missing_ok=True)
    for format_ in FORMATS.values():
        format_.remove(folder)


def write_robot_files(folder: Path, sent: RestToRest, arm: Arm, formats: Iterable[Format] = ()) -> Written:
    """Write joints.csv and the files of other formats.

    Parameters
    ----------
    folder : Path
    sent : RestToRest
    arm : Arm
        Whose limits hold; `sending.require` decides for each file as a robot will see it.
    formats : iterable of Format

    Returns
    -------
    Written
        What was written, and why another file was not.
    """
    files, refused = [], {}
    for file, write in ((JOINTS, write_joints), *((each.file, each.send) for each in formats)):
        try:
            write(folder / file, sent, arm)
            files.append(file)
        except (InvalidArgument, MissingDependency, OSError) as error:
            refused[file] = str(error)
    return Written(files, refused)
