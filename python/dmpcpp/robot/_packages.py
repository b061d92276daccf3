"""Where meshes are: the packages of `package://` and `model://`, and plain paths.

Looked for in this order: packages that are stated (NAME=DIR, then DIR), ROS_PACKAGE_PATH, `share/NAME` of
AMENT_PREFIX_PATH (for `model://` GAZEBO_MODEL_PATH before both), and the folders above the URDF. A folder is the
package only by its name or its package.xml; a file of another package is never taken.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from xml.sax.saxutils import escape

from dmpcpp.errors import InvalidArgument

__all__ = ["Packages", "find_mesh", "package_folder", "packages_of", "with_packages"]

_SCHEME = re.compile(r"^(package|model)://([^/]+)/(.*)$")
_NAME = re.compile(rb"<name>\s*([^<\s]+)\s*</name>")


@dataclass(frozen=True)
class Packages:
    """Packages as somebody states them: by name, and folders in which packages are, or that are one."""

    named: dict[str, Path] = field(default_factory=dict)
    folders: tuple[Path, ...] = ()

    def folder_of(self, name: str) -> Path | None:
        """Return the folder of a package, or None."""
        if name in self.named:
            return self.named[name]
        return next((found for folder in self.folders for found in _packages_at(folder, name)), None)


def packages_of(stated: Sequence[str]) -> Packages:
    """Read DIR and NAME=DIR.

    Raises
    ------
    InvalidArgument
        There is no such folder.
    """
    named: dict[str, Path] = {}
    folders: list[Path] = []
    for text in stated:
        name, equals, folder = str(text).partition("=")
        path = Path(folder if equals else name).expanduser().absolute()
        if not path.is_dir():
            raise InvalidArgument(f"package_path: '{text}', expected a folder (DIR or NAME=DIR) that exists.")
        if equals:
            named[name] = path
        else:
            folders.append(path)
    return Packages(named, tuple(folders))


def with_packages(text: str, packages: Packages) -> str:
    """Return a URDF in which files of stated packages have absolute paths."""
    if not packages.named and not packages.folders:
        return text

    def absolute(match: re.Match[str]) -> str:
        folder = packages.folder_of(match[2])
        path = folder / match[3] if folder else None
        return f"{match[1]}{escape(str(path))}{match[4]}" if path else match[0]

    return re.sub(r"(filename\s*=\s*[\"'])(?:package|model)://([^/\"']+)/([^\"']*)([\"'])", absolute, text)


def package_folder(name: str, folder: str) -> Path | None:
    """Return the folder of a package that nobody states, as seen from a file in `folder`."""
    places = (*_stated_places("package"), *_above(folder))
    return next((found for place in places for found in _packages_at(place, name)), None)


def find_mesh(filename: str, folder: str, link: str = "") -> Path:
    """Where a mesh of a URDF in `folder` is; see the module for the order.

    Raises
    ------
    InvalidArgument
        Nowhere; the message says what to state.
    """
    name = filename.strip().replace("\\", "/")
    scheme = _SCHEME.match(name)
    candidates = _in_packages(scheme[1], scheme[2], scheme[3], folder) if scheme else _at_paths(name, folder)
    for candidate in candidates:
        found = _as_written(candidate)
        if found is not None:
            return found
    where = f"link '{link}': " if link else ""
    if scheme:
        holder = _without_manifest_holding(scheme[3], folder)
        raise InvalidArgument(
            f"arm.urdf: {where}no mesh '{filename}': no package '{scheme[2]}' that has it, by ROS_PACKAGE_PATH, "
            f"AMENT_PREFIX_PATH or above '{folder or '.'}'. "
            + (f"It is in '{holder}'; if that is the package, state" if holder else "State")
            + f" package_path={scheme[2]}={holder or 'DIR'}."
        )
    raise InvalidArgument(
        f"arm.urdf: {where}no mesh '{filename}' in '{Path(folder or '.').absolute()}'. "
        "Load the arm from the URDF's own folder."
    )


def _without_manifest_holding(inside: str, folder: str) -> Path | None:
    """Return the folder above the URDF that holds a file and does not say which package it is."""
    above = (place for place in _above(folder) if not (place / "package.xml").is_file())
    return next((place for place in above if _as_written(place / inside) is not None), None)


def _in_packages(kind: str, name: str, inside: str, folder: str) -> Iterator[Path]:
    for place in (*_stated_places(kind), *_above(folder)):
        for package in _packages_at(place, name):
            yield package / inside


def _stated_places(kind: str) -> Iterator[Path]:
    variables = [*(["GAZEBO_MODEL_PATH"] if kind == "model" else []), "ROS_PACKAGE_PATH"]
    for variable in variables:
        yield from (Path(entry) for entry in os.environ.get(variable, "").split(os.pathsep) if entry)
    yield from (Path(entry) / "share" for entry in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if entry)


def _above(folder: str) -> Iterator[Path]:
    start = Path(folder or ".").absolute()
    yield from (start, *start.parents)


def _packages_at(place: Path, name: str) -> Iterator[Path]:
    """Yield the package that a place is or holds."""
    if place.name == name or _declares(place, name):
        yield place
    if (place / name).is_dir():
        yield place / name


def _declares(folder: Path, name: str) -> bool:
    """Whether a package.xml there says that the folder is this package."""
    try:
        found = _NAME.search((folder / "package.xml").read_bytes())
    except OSError:
        return False
    return found is not None and found[1].decode(errors="replace") == name


def _at_paths(name: str, folder: str) -> Iterator[Path]:
    """Yield where a file without a package is: as written, below the URDF's folder, beside that, or in its package."""
    plain = re.sub(r"^file:(//)?(?=/)|^file://", "", name)
    start = Path(folder or ".").absolute()
    yield from (start / plain, start.parent / plain)
    root = next((place for place in start.parents if (place / "package.xml").is_file()), None)
    if root is not None:
        yield from (place / plain for place in start.parents if place == root or root in place.parents)


def _as_written(path: Path) -> Path | None:
    """Return the file, or one whose name differs in upper and lower case alone."""
    if path.is_file():
        return path
    if not path.parent.is_dir():
        return None
    same = [entry for entry in path.parent.iterdir() if entry.name.lower() == path.name.lower() and entry.is_file()]
    return same[0] if len(same) == 1 else None
