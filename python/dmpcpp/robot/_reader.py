"""The one reader of robot descriptions, for every command: any encoding, xacro expanded, other formats named."""

from __future__ import annotations

import codecs
import importlib
import re
from collections.abc import Mapping, Sequence
from contextlib import chdir
from pathlib import Path
from typing import Any

from dmpcpp._quiet import quiet
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.robot._packages import package_folder, packages_of, with_packages

__all__ = ["expanded", "read_description"]

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_DECLARED = re.compile(rb"^\s*<\?xml[^>]*encoding\s*=\s*[\"']([\w.-]+)[\"']")
_DECLARATION = re.compile(r"^\s*<\?xml[^>]*\?>")
_FIRST = re.compile(r"<([A-Za-z_][\w:.-]*)")
_MISSED = re.compile(r"Package not found: ([\w-]+)")
_COMMENT = re.compile(r"<!--.*?-->", re.S)

_OTHERS = {
    "mujoco": "an MJCF file of MuJoCo",
    "mujocoinclude": "an MJCF file of MuJoCo",
    "sdf": "an SDF file of Gazebo",
    "gazebo": "an SDF file of Gazebo",
    "COLLADA": "a COLLADA mesh",
}


def read_description(path: Path, packages: Sequence[str] = ()) -> str:
    """Return the URDF that a file holds, or that its xacro expands to; meshes of stated packages by absolute paths.

    Parameters
    ----------
    path : Path
    packages : sequence of str
        DIR or NAME=DIR, as --package-path takes them.

    Raises
    ------
    FileError
        The file cannot be read.
    InvalidArgument
        It is another format, or a xacro that cannot be expanded: the message has the command that does.
    """
    try:
        data = path.read_bytes()
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    found = packages_of(packages)
    text = _decoded(data, path)
    _refuse_other_formats(text, path)
    if _is_xacro(text):
        text = expanded(path, found.named)
    return with_packages(text, found)


def expanded(path: Path, packages: Mapping[str, Path] | None = None, arguments: Mapping[str, str] | None = None) -> str:
    """Return the URDF that a xacro expands to, with the pip package xacrodoc.

    Raises
    ------
    InvalidArgument
        xacrodoc is not installed, or the xacro cannot be expanded.
    """
    command = f"expand it: xacro {path.name} > {path.name.split('.')[0]}.urdf"
    try:
        xacrodoc: Any = importlib.import_module("xacrodoc")
    except ImportError:
        raise InvalidArgument(
            f"'{path}': a xacro, not a URDF; {command}, or install what does: pip install \"dmpcpp[xacro]\"."
        ) from None
    finder = importlib.import_module("xacrodoc.packages")
    finder.update_package_cache({name: str(folder) for name, folder in (packages or {}).items()})
    try:
        with quiet(), chdir(path.absolute().parent):  # where a xacro's own includes are
            return _expanded(xacrodoc, finder, path.absolute(), dict(arguments or {}))
    except Exception as error:  # whatever a xacro's expressions raise
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise InvalidArgument(
            f"'{path}': a xacro that cannot be expanded here ({reason}); {command}, "
            "or name its packages with package_path=NAME=DIR."
        ) from None


def _expanded(xacrodoc: Any, finder: Any, path: Path, arguments: dict[str, str]) -> str:
    """Expand, and name each package that is missed where it is found as a mesh's would be."""
    named: set[str] = set()
    while True:
        try:
            document = xacrodoc.XacroDoc.from_file(str(path), subargs=arguments, resolve_packages=False)
            return str(document.to_urdf_string())
        except Exception as error:
            missed = _MISSED.search(str(error))
            folder = package_folder(missed[1], str(path.parent)) if missed else None
            if missed is None or folder is None or missed[1] in named:
                raise
            named.add(missed[1])
            finder.update_package_cache({missed[1]: str(folder)})


def _decoded(data: bytes, path: Path) -> str:
    """Return the text, without its XML declaration: what comes after it is UTF-8 from here on."""
    if data[:8] == b"PXR-USDC" or data[:5] == b"#usda":
        raise InvalidArgument(f"'{path}': a USD file, expected a URDF. Export the robot as a URDF.")
    marked = next((encoding for mark, encoding in _MARKS if data.startswith(mark)), None)
    declared = _DECLARED.match(data)
    encodings = [marked, declared[1].decode() if declared else None, *_without_a_mark(data), "utf-8", "latin-1"]
    for encoding in filter(None, encodings):
        try:
            return _DECLARATION.sub("", data.decode(encoding).lstrip("\ufeff"), count=1)
        except (UnicodeDecodeError, LookupError):
            continue
    raise InvalidArgument(f"'{path}': not a text in an encoding that XML has. Save it as UTF-8.")


def _without_a_mark(data: bytes) -> list[str]:
    """UTF-16 without a byte order mark: every other byte of '<r' is zero."""
    return [name for name, start in (("utf-16-le", b"<\0"), ("utf-16-be", b"\0<")) if data.startswith(start)]


def _refuse_other_formats(text: str, path: Path) -> None:
    first = _FIRST.search(_COMMENT.sub("", text))
    what = _OTHERS.get(first[1]) if first else None
    if what:
        raise InvalidArgument(f"'{path}': {what}, expected a URDF (its outermost element is <robot>). Export one.")


def _is_xacro(text: str) -> bool:
    """Whether something is left to expand: an element but a property, or an expression."""
    bare = _COMMENT.sub("", text)
    if "xacro" not in bare:
        return False
    elements = set(re.findall(r"<(?:xacro:)(\w+)", bare))
    return bool(elements - {"property"}) or re.search(r"=\s*[\"'][^\"']*\$[({]", bare) is not None
