"""Messages of the library in the words of the command line: a parameter is the option that gives it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import click

from dmpcpp.errors import InvalidArgument

__all__ = ["ALIASES", "as_typed", "flag", "flagged", "flags_of", "in_flags"]

ALIASES = {
    "arms": "arm",
    "at": "anchor_start",
    "cutoff": "low_pass",
    "export": "formats",
    "format": "format_",
    "joints": "plan",
    "longest": "longest_gap",
    "name": "arm",
    "noises": "noise",
    "others": "file",
    "goals": "goal_from",
    "poses": "file",
    "print": "print_",
    "recording": "file",
    "recordings": "files",
    "robot": "address",
    "check_limit": "stated",
}
"""Parameters of the library that have another name in a command."""

_VALUE = r"'[^']*'|\{[^}]*\}|\[\(.*?\)\]|\[[^\]]*\]|\.\.\.|-?[\w.+-]*\w"


def flag(parameter: str) -> str:
    """Return the option that gives a parameter of the library: up_axis is --up-axis."""
    return "--" + parameter.strip("_").replace("_", "-")


def flags_of(command: click.Command) -> dict[str, str]:
    """Return what a user types for each parameter of the library that a command passes on."""
    known = {parameter.name or "": _typed(parameter) for parameter in command.params}
    known |= {name: known[alias] for name, alias in ALIASES.items() if alias in known and name not in known}
    if command.name == "plan":
        known["start"] = known["from_joints"]
    if command.name in ("plan", "verify"):
        known["dynamics"] = known["simulator"]  # without an engine they judge by kinematics alone
    return known


def flagged(error: InvalidArgument, flags: Mapping[str, str]) -> str:
    """Return the message of an error, the argument that it carries written as the option or argument of the command."""
    message, argument = str(error), error.argument
    if argument in flags:
        message = re.sub(rf"(?<![\w-]){argument}(?=(\[[^\]]*\])?: )", flags[argument], message, count=1)
    return in_flags(message, flags)


def as_typed(message: str) -> str:
    """Return a message in the words of the command that runs."""
    context = click.get_current_context(silent=True)
    return in_flags(message, flags_of(context.command)) if context else message


def in_flags(message: str, flags: Mapping[str, str] | Iterable[str]) -> str:
    """Return a message with parameters as options of the command line: unit='cm' is --unit cm, and so is a call
    that sets it, f(x, unit='cm').

    `flags` maps the parameters of the command to what a user types; names alone stand for the usual options.
    """
    flags = flags if isinstance(flags, Mapping) else {name: flag(name) for name in flags}
    if not flags:
        return message
    names = "|".join(sorted(map(re.escape, flags), key=len, reverse=True))
    before, behind = r"(?<![\w\-/'\".])", r"(?![\w=(/'\"]|\.\w)"  # no part of a path, nothing that is quoted
    for stated in (rf"[\w.]+\((?:\w+, )?({names})=({_VALUE})\)", rf"({names})=({_VALUE})"):
        message = re.sub(before + stated, lambda m: _option(flags[m[1]], m[2]), message)
    words = "|".join(sorted((name for name in flags if "_" in name.strip("_")), key=len, reverse=True))
    return re.sub(rf"{before}({words}){behind}", lambda m: flags[m[1]], message) if words else message


def _typed(parameter: click.Parameter) -> str:
    if isinstance(parameter, click.Argument):
        return (parameter.name or "").upper().removesuffix("S")
    return next(option for option in parameter.opts if option.startswith("--"))


def _option(typed: str, value: str) -> str:
    if value == "True":
        return typed
    if pairs := re.findall(r"\('(.*?)', '(.*?)'\)", value):
        return " ".join(f"{typed} {','.join(pair)}" for pair in pairs)
    if value[0] in "{[":
        value = re.sub(r"[{}\[\]' ]", "", value).replace(":", "=")
    return f"{typed} {'none' if value == 'None' else value.strip(chr(39))}"
