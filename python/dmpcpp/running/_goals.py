"""Goals that arrive while a robot moves: lines or packets `t x y z [qx qy qz qw]`, from a file, stdin or UDP."""

from __future__ import annotations

import os
import socket
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument

__all__ = ["GoalSource", "goals_from"]

_UDP = "udp://"
_LOOPBACK = "127.0.0.1"
_LARGEST = 65536  # bytes of a packet, and of a line that is not ended
_FARTHEST = 1e3  # m, of a goal: no arm's base is that far away
_UNIT = 1e-2  # how far the norm of a quaternion may be from 1


@dataclass
class GoalSource:
    """Newest goal of a source, asked for once a cycle.

    Parameters
    ----------
    read : float -> list of str
        What has arrived by a time [s] since the motion began, without waiting.
    close : callable

    Attributes
    ----------
    taken, broken, late : int
        Goals that were taken; packets that are no finite pose; packets that are not newer than the last one.
    """

    read: Callable[[float], list[str]]
    close: Callable[[], None] = lambda: None
    taken: int = 0
    broken: int = 0
    late: int = 0
    _last: float = field(default=-np.inf, repr=False)

    def newest(self, time: float, present: Array) -> Array | None:
        """Return the newest goal (4, 4); the rotation of the present one where none was sent. None: nothing new."""
        found = None
        for line in self.read(time):
            stamp, pose = _parsed(line, present)
            if pose is None:
                self.broken += 1
            elif stamp <= self._last:
                self.late += 1
            else:
                self._last, found = stamp, pose
                self.taken += 1
        return found

    def describe(self) -> str:
        """Return one line for people."""
        text = f"goal: moved {self.taken} times"
        dropped = [(self.broken, "no finite pose"), (self.late, "not newer than the last")]
        left_out = ", ".join(f"{count} {why}" for count, why in dropped if count)
        return f"{text}; left out: {left_out}" if left_out else text


def goals_from(address: str) -> GoalSource:
    """Return the goals of "stdin", "udp://HOST:PORT" (without HOST: this machine alone) or a file.

    Times of a file are seconds after the motion's begin; those of a stream only have to rise.

    Raises
    ------
    InvalidArgument
        No such file, a file with a line that is no goal, or an address that cannot be listened at.
    """
    if address == "stdin":
        return _of_stream(sys.stdin.fileno())
    if address.startswith(_UDP):
        return _of_socket(address)
    return _of_file(Path(address))


def _parsed(line: str, present: Array) -> tuple[float, Array | None]:
    """Return time and pose; None for what is no finite pose."""
    try:
        numbers = np.array([float(part) for part in line.replace(",", " ").split()])
    except ValueError:
        return np.nan, None
    if len(numbers) not in (4, 8) or not np.isfinite(numbers).all() or np.abs(numbers[1:4]).max() > _FARTHEST:
        return np.nan, None
    pose = np.array(present)
    pose[:3, 3] = numbers[1:4]
    if len(numbers) == 8:
        if abs(np.linalg.norm(numbers[4:]) - 1.0) > _UNIT:
            return np.nan, None
        pose[:3, :3] = Rotation.from_quat(numbers[4:]).as_matrix()
    return float(numbers[0]), pose


def _of_file(path: Path) -> GoalSource:
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InvalidArgument(f"goals: {path}: cannot be read ({getattr(error, 'strerror', None) or error}).") from None
    waiting = []
    for k, line in enumerate(lines, 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        stamp, pose = _parsed(line, np.eye(4))
        if pose is None:
            raise InvalidArgument(f"goals: {path}, line {k}: '{line.strip()}', expected t x y z [qx qy qz qw].")
        waiting.append((stamp, line))
    waiting.sort(key=lambda each: -each[0])

    def due(time: float) -> list[str]:
        found = []
        while waiting and waiting[-1][0] <= time:
            found.append(waiting.pop()[1])
        return found

    return GoalSource(due)


def _of_socket(address: str) -> GoalSource:
    host, colon, port = address.removeprefix(_UDP).rpartition(":")
    if not colon or not port.isdigit() or not 0 < int(port) < 65536:
        raise InvalidArgument(f"goals: '{address}', expected udp://HOST:PORT, for instance udp://127.0.0.1:9000.")
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        receiver.bind((host or _LOOPBACK, int(port)))
    except OSError as error:
        receiver.close()
        raise InvalidArgument(f"goals: '{address}': cannot be listened at ({error.strerror}).") from None
    receiver.setblocking(False)

    def arrived(time: float) -> list[str]:
        found = []
        while True:
            try:
                found.append(receiver.recv(_LARGEST).decode("ascii", "replace"))
            except BlockingIOError:
                return found

    return GoalSource(arrived, receiver.close)


def _of_stream(descriptor: int) -> GoalSource:
    os.set_blocking(descriptor, False)
    rest = b""

    def arrived(time: float) -> list[str]:
        nonlocal rest
        try:
            rest += os.read(descriptor, _LARGEST)
        except BlockingIOError:
            return []
        *lines, rest = rest.split(b"\n")
        rest = rest[-_LARGEST:]
        return [line.decode("ascii", "replace") for line in lines if line.strip()]

    return GoalSource(arrived, lambda: os.set_blocking(descriptor, True))
