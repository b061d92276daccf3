"""Choices that are what the library registers: engines and exports. They are loaded when they are looked at."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import click

__all__ = ["Registered", "engines", "exports", "scaling_option"]


class Registered(click.Choice):  # type: ignore[type-arg]
    """One of the names of a registry."""

    def __init__(self, names: Callable[[], Iterable[str]]) -> None:
        """Keep where the names come from; nothing is loaded yet."""
        self._names = names
        self.case_sensitive = True

    @property
    def choices(self) -> tuple[str, ...]:  # type: ignore[override]
        """The names."""
        return tuple(self._names())


def engines(*others: str) -> Registered:
    """Return the choice of a physics engine, or of one of the words beside them ("both", "none")."""

    def names() -> tuple[str, ...]:
        from dmpcpp import simulation

        return (*simulation.ENGINES, *others)

    return Registered(names)


def scaling_option(command: Callable[..., None]) -> Callable[..., None]:
    """Add --scaling to a command."""

    def names() -> tuple[str, ...]:
        from dmpcpp import Scaling

        return tuple(Scaling.__members__)

    return click.option(
        "--scaling",
        default="automatic",
        show_default=True,
        type=Registered(names),
        help="How the motion follows a new start and goal (automatic: as it was learned).",
    )(command)


def exports() -> Registered:
    """Return the choice of a format that robots are sent."""

    def names() -> tuple[str, ...]:
        from dmpcpp import export

        return tuple(export.FORMATS)

    return Registered(names)
