"""Public addresses of modules that live in a room: ``dmpcpp.plot`` is ``dmpcpp.show.plot``, the same module."""

import importlib
import sys


def share(address: str, room: str) -> None:
    """Let `address` name the module `room`, and each submodule that it has loaded likewise."""
    importlib.import_module(room)
    for name in [name for name in sys.modules if name == room or name.startswith(f"{room}.")]:
        sys.modules[address + name.removeprefix(room)] = sys.modules[name]
