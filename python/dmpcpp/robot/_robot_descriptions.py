"""The descriptions of the package robot_descriptions, as far as they are in its cache: nothing is fetched unasked.

Importing one of its modules clones a repository. What a module says of paths is read with a stand-in for the clone,
which answers with the cached folder alone.
"""

from __future__ import annotations

import ast
import importlib
import importlib.util
import os
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

from dmpcpp.errors import FileError, MissingDependency

__all__ = ["Cached", "cached", "fetch", "licence_of", "module_of"]

_ENDS = ("_description", "_official_description")


@dataclass(frozen=True)
class Cached:
    """A description in the cache.

    Attributes
    ----------
    path : Path
        Of the URDF, or of the xacro that makes it.
    packages : dict of str to Path
        That its `package://` paths and xacro includes are about.
    arguments : dict of str to str
        Of the xacro.
    """

    path: Path
    packages: dict[str, Path] = field(default_factory=dict)
    arguments: dict[str, str] = field(default_factory=dict)


def module_of(key: str) -> str | None:
    """Return the module of an arm, by its name without case, dashes and underscores; None where there is none."""
    folder = _folder()
    if folder is None:
        return None
    names = {path.stem for path in folder.glob("*_description.py") if not path.stem.endswith("_mj_description")}
    plain = {
        name.removesuffix(end).replace("_", ""): name for end in reversed(_ENDS) for name in names if name.endswith(end)
    }
    return plain.get(key) or plain.get(key.removesuffix("description"))


def licence_of(module: str) -> str:
    """Return the licence that robot_descriptions states for a description, "see its repository" without one."""
    try:
        table: Any = importlib.import_module("robot_descriptions._descriptions")
    except ImportError:
        return "see its repository"
    return str(getattr(table.DESCRIPTIONS.get(module), "license_spdx", None) or "see its repository")


def cached(module: str) -> Cached | None:
    """Return where a description is in the cache of robot_descriptions; None where it is not there."""
    folder = _folder()
    if folder is None or not (folder / f"{module}.py").is_file():
        return None
    text = (folder / f"{module}.py").read_text(encoding="utf-8")
    repository = _repository(text)
    clone = _clone(folder, repository) if repository else None
    if clone is None or not clone.is_dir():
        return None
    says = _run(text, module, clone)
    path = says.get("URDF_PATH") or says.get("XACRO_PATH")
    if path is None or not Path(path).is_file():
        return None
    packages = {name: Path(place) for name, place in says.get("XACRO_PACKAGE_PATHS", {}).items()}
    packages.setdefault(Path(says.get("PACKAGE_PATH", clone)).name, Path(says.get("PACKAGE_PATH", clone)))
    packages.setdefault(clone.name, clone)
    return Cached(Path(path), packages, dict(says.get("XACRO_ARGS", {})))


def fetch(module: str) -> Path:
    """Clone what a description needs into the cache of robot_descriptions, as that package does; return its path.

    What the cache holds already is not cloned again.

    Raises
    ------
    MissingDependency
        robot_descriptions is not installed.
    FileError
        The repository cannot be cloned: there is no network, or no git.
    """
    found = cached(module)
    if found is not None:
        return found.path
    try:
        importlib.import_module(f"robot_descriptions.{module}")
    except ImportError as error:
        raise MissingDependency(
            f'robot_descriptions has no {module}, or is not installed ({error}): pip install "dmpcpp[arms]".'
        ) from None
    except Exception as error:  # git and the network have errors of their own
        raise FileError(f"{module}: cannot be cloned into '{_cache()}' ({_short(error)}).") from None
    found = cached(module)
    if found is None:
        raise MissingDependency(f"robot_descriptions: {module} was fetched and holds no URDF.")
    return found.path


def _short(error: Exception) -> str:
    """Return the line of an error that says what happened: of git the one that begins with fatal."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip()] or [type(error).__name__]
    fatal = next((line[line.index("fatal: ") :] for line in lines if "fatal: " in line), lines[-1])
    return fatal.strip("'")


def _folder() -> Path | None:
    spec = importlib.util.find_spec("robot_descriptions")
    return Path(spec.origin).parent if spec and spec.origin else None


def _cache() -> Path:
    return Path(os.environ.get("ROBOT_DESCRIPTIONS_CACHE") or "~/.cache/robot_descriptions").expanduser()


def _repository(text: str) -> str | None:
    """Return the name with which a module asks for its clone."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "_clone_to_cache" and node.args:
            first = node.args[0]
            return first.value if isinstance(first, ast.Constant) and isinstance(first.value, str) else None
    return None


def _clone(folder: Path, repository: str) -> Path:
    """Return where a repository is cloned to; that of another commit (ROBOT_DESCRIPTION_COMMIT) lies beside it."""
    name, commit = _cache_path(folder, repository), os.environ.get("ROBOT_DESCRIPTION_COMMIT")
    return _cache() / (f"{name}-{commit}/{name}" if commit else name)


def _cache_path(folder: Path, repository: str) -> str:
    """Return the folder of a repository in the cache, as the package's table has it."""
    for node in ast.walk(ast.parse((folder / "_repositories.py").read_text(encoding="utf-8"))):
        if not isinstance(node, ast.Dict):
            continue
        for name, value in zip(node.keys, node.values, strict=True):
            if isinstance(name, ast.Constant) and name.value == repository and isinstance(value, ast.Call):
                words = {word.arg: word.value for word in value.keywords}
                place = words.get("cache_path")
                return str(place.value) if isinstance(place, ast.Constant) else repository
    return repository


def _run(text: str, module: str, clone: Path) -> dict[str, Any]:
    """Return what a module's paths are, its clone being this folder."""
    tree = ast.parse(text)
    tree.body = [node for node in tree.body if not (isinstance(node, ast.ImportFrom) and node.level)]
    space = ModuleType(module)
    space.__dict__["_clone_to_cache"] = lambda *_, **__: str(clone)
    exec(compile(tree, module, "exec"), space.__dict__)  # the installed package's own lines
    return space.__dict__
