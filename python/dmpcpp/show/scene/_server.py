"""The viser server that every scene lives in."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from typing import TYPE_CHECKING

from dmpcpp.errors import MissingDependency

if TYPE_CHECKING:
    from viser import ViserServer

__all__ = ["serving"]


@contextmanager
def serving(host: str = "127.0.0.1", port: int = 8080) -> Iterator[ViserServer]:
    """Serve an empty scene, z up, with a grid for a floor, as long as the body of the `with` runs.

    Parameters
    ----------
    host : str
        Who may look: by default this machine alone.
    port : int
        The first that is tried; the next free one is taken.

    Raises
    ------
    MissingDependency
        viser is not installed.
    """
    try:
        import viser
    except ImportError:
        raise MissingDependency('viser is not installed. Install the extra: pip install "dmpcpp[view]".') from None
    with redirect_stdout(io.StringIO()):  # it announces itself; who called us decides what is said
        server = viser.ViserServer(host=host, port=port, verbose=False)
    try:
        server.scene.set_up_direction("+z")
        server.scene.add_grid("/floor", width=2.0, height=2.0, cell_size=0.1, section_size=0.5)
        server.initial_camera.position = (1.5, -1.3, 1.1)
        server.initial_camera.look_at = (0.25, 0.0, 0.4)
        yield server
    finally:
        with redirect_stdout(io.StringIO()):
            server.stop()
