"""`--config FILE.toml`: the options of a command from a file, and the effective ones into a file beside the results."""

from __future__ import annotations

import difflib
import json
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource

from dmpcpp import __version__
from dmpcpp._atomic import write_text
from dmpcpp.errors import FileError, InvalidArgument

__all__ = ["configurable", "options_of_run", "save_config"]

_RUNS = ("imitate", "demo", "plan")
_NOT_SAVED = frozenset({"as_json"})  # how a run is shown, not what it does


def configurable(command: click.Command) -> click.Command:
    """Add --config to a command; what stands on the command line goes before what stands in the file."""
    command.params.append(
        click.Option(
            ["--config"],
            type=click.Path(path_type=Path),
            metavar="FILE.toml",
            is_eager=True,
            expose_value=False,
            callback=_take,
            help="Read arguments and options from this file's table named after the command; options given here win.",
        )
    )
    return command


def save_config(path: Path) -> None:
    """Write what the running command works with; with absolute paths, so that it can be repeated from anywhere."""
    context = click.get_current_context()
    name = str(context.command.name)
    lines = [
        f"# dmpcpp {__version__}. To repeat: dmpcpp {name} --config {path.name}",
        f"[{name}]",
        *(
            f"{key} = {_toml(context.params[name])}"
            for key, name in _keys(context.command).items()
            if name in context.params and name not in _NOT_SAVED and context.params[name] not in (None, ())
        ),
    ]
    write_text(path, "\n".join(lines) + "\n")


def options_of_run(folder: Path, stated: Mapping[str, Any], same: str) -> dict[str, Any]:
    """Return options with which the run in a folder was made, where the running command was not given them.

    Parameters
    ----------
    folder : Path
        Of the run; without its config.toml nothing is returned.
    stated : mapping
        Options of the running command, with their values: those that are looked for.
    same : str
        One of them: where another value is given for it than the run had, its other options do not fit and are left.
    """
    path = folder / "config.toml"
    if not path.is_file():
        return {}
    context = click.get_current_context()
    tables = _tables(path)
    table = next((tables[name] for name in _RUNS if isinstance(tables.get(name), dict)), {})
    parameters, keys = {p.name: p for p in context.command.params}, _keys(context.command)
    known = {keys[key]: value for key, value in table.items() if keys.get(key) in stated}
    given = {name for name in stated if context.get_parameter_source(name) is not ParameterSource.DEFAULT}
    if same in given and known.get(same) not in (stated[same], json.loads(_toml(stated[same]))):
        return {}
    return {
        name: parameters[name].type_cast_value(context, value)
        for name, value in known.items()
        if name not in given and value != stated[name]
    }


def _take(context: click.Context, _: click.Parameter, path: Path | None) -> None:
    if path is None:
        return
    known, parameters = _keys(context.command), {p.name: p for p in context.command.params}
    taken = {}
    for key, value in _table(path, str(context.command.name)).items():
        name = known.get(key.replace("_", "-"))
        if name is None:
            near = difflib.get_close_matches(key, known, n=1)
            hint = f" Did you mean '{near[0]}'?" if near else ""
            raise InvalidArgument(f"--config: {path}: '{key}', expected one of {', '.join(sorted(known))}.{hint}")
        _require_type(context, parameters[name], value, f"--config: {path}: {key}")
        taken[name] = value
    context.default_map = taken


def _keys(command: click.Command) -> dict[str, str]:
    """Return the names of parameters by what they are called in a file: as on the command line, without the dashes."""
    keys = {}
    for parameter in command.params:
        flags = [flag for flag in parameter.opts if flag.startswith("--")]
        key = max(flags, key=len)[2:] if flags else str(parameter.name)
        if key not in ("config", "help"):
            keys[key.replace("_", "-")] = str(parameter.name)
    return keys


def _require_type(context: click.Context, parameter: click.Parameter, value: Any, where: str) -> None:
    """Refuse what click would fail on; what it refuses itself it says with the name of the option."""
    try:
        parameter.type_cast_value(context, value)
    except click.UsageError:
        return
    except (TypeError, ValueError):
        raise InvalidArgument(f"{where}: {value!r}, expected {parameter.type.name}: text stands in quotes.") from None


def _table(path: Path, command: str) -> dict[str, Any]:
    found = _tables(path)
    table = found.get(command)
    if not isinstance(table, dict):
        tables = ", ".join(f"[{name}]" for name in found) or "nothing"
        raise InvalidArgument(f"--config: {path}: holds {tables}, expected a table [{command}].")
    return table


def _tables(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise FileError(f"--config: {path}: cannot be read ({error.strerror or error}).") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InvalidArgument(f"--config: {path}: not TOML ({error}).") from None


def _toml(value: Any) -> str:
    if isinstance(value, tuple | list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, Path):
        return _toml(str(value.absolute()))
    if isinstance(value, str):
        absolute = (
            Path(value).absolute() if value.endswith((".urdf", ".xacro", ".xml")) and Path(value).is_file() else value
        )
        return json.dumps(str(absolute), ensure_ascii=False).replace("\x7f", "\\u007f")
    return json.dumps(value)  # true, false and numbers are written alike in both
