"""What the commands share: the program itself, its exit status and how errors reach the user."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from dmpcpp import __version__
from dmpcpp.cli._flags import flagged, flags_of, in_flags
from dmpcpp.errors import InvalidArgument, MissingDependency

WRONG_INPUT, FAILED, INTERRUPTED, TERMINATED = 2, 3, 130, 143


class _Terminated(BaseException):
    """SIGTERM came."""


@contextmanager
def ended_by_sigterm() -> Iterator[None]:
    """Let SIGTERM end a command as Ctrl-C does, so that the processes that it began end too."""
    if threading.current_thread() is not threading.main_thread():
        yield  # only the main thread is sent signals
        return

    def end(*_: object) -> None:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)  # a second one ends it at once
        raise _Terminated

    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


class _Group(click.Group):
    """Turns errors that a user can fix into one line and an exit status, without a traceback."""

    def invoke(self, ctx: click.Context) -> Any:
        try:
            return super().invoke(ctx)
        except BrokenPipeError:  # whoever reads the output has enough (`| head`); click ends without a word
            raise
        except (InvalidArgument, MissingDependency, OSError) as error:
            click.echo(f"dmpcpp: {self._shown(ctx, error)}", err=True)
            ctx.exit(WRONG_INPUT)
        except KeyboardInterrupt:
            click.echo("dmpcpp: interrupted.", err=True)
            ctx.exit(INTERRUPTED)
        except _Terminated:
            click.echo("dmpcpp: terminated.", err=True)
            ctx.exit(TERMINATED)

    def _shown(self, ctx: click.Context, error: Exception) -> str:
        """Return the message in the words of the command that ran."""
        command = self.get_command(ctx, ctx.invoked_subcommand or "")
        flags = flags_of(command) if command else {}
        return flagged(error, flags) if isinstance(error, InvalidArgument) else in_flags(_message(error), flags)


def _message(error: Exception) -> str:
    """Return a message of the library as it is, and one of the system with the file first and without its number."""
    if isinstance(error, OSError) and error.filename is not None and error.strerror:
        return f"{error.filename}: {error.strerror}."
    return str(error)


@click.group(cls=_Group, context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="dmpcpp")
def main() -> None:
    """Learn a recorded hand motion as a dynamic movement primitive and execute it on a simulated robot arm."""


def refuse_file(out: Path) -> None:
    """Raise InvalidArgument where the results could not be written to a folder, before anything runs."""
    if out.exists() and not out.is_dir():
        raise InvalidArgument(f"--out: '{out}' is a file, expected a folder.")
    nearest = next(folder for folder in (out, *out.absolute().parents) if folder.exists())
    if not nearest.is_dir():
        raise InvalidArgument(f"--out: '{nearest}' is a file, expected a folder.")
    import tempfile  # not for --help

    try:
        tempfile.TemporaryFile(dir=nearest).close()  # not all that permits it can do it: /proc
    except OSError as error:
        raise InvalidArgument(f"--out: '{out}' cannot be written: {error.strerror} in '{nearest}'.") from None
