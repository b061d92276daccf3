"""Joint states from a ROS bag, read by the package rosbags without ROS."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp.errors import FileError, InvalidArgument, MissingDependency, within
from dmpcpp.verification._joint_log import JointLog

Stamped = tuple[int, Any]
"""Time [ns] and message."""

_TYPE = "sensor_msgs/msg/JointState"


def read_bag(path: Path, topic: str | None, joints: Sequence[str] | None = None) -> JointLog:
    """Joint states of one topic, counted from the first; duplicate time stamps are dropped.

    The time is the stamp of the header, or where no header has one the time at which the bag got the message.
    Messages without one of ``joints`` are left out, if any has them all.
    """
    stamped, notes = _stamped(path, topic)
    stamped, left_out = _with(stamped, joints or ())
    if left_out:
        notes.append(f"{left_out} messages of other joints left out")
    once = {(stamp, frozenset(message.name)): message for stamp, message in stamped}
    ordered = [once[key] for key in sorted(once, key=lambda key: key[0])]
    stamps = sorted(stamp for stamp, _ in once)
    names = tuple(str(name) for name in ordered[0].name)
    notes.append(f"time counted from the first stamp at {stamps[0]} ns")
    if len(stamps) < len(stamped):
        notes.append(f"{len(stamped) - len(stamps)} messages with the stamp of another left out")
    return JointLog(
        time=np.array([1e-9 * (stamp - stamps[0]) for stamp in stamps]),
        position=_rows(ordered, "position", names),
        velocity=_rows(ordered, "velocity", names) if len(ordered[0].velocity) else None,
        torque=_rows(ordered, "effort", names) if len(ordered[0].effort) else None,
        joint_names=names,
        source=path.name,
        notes=tuple(notes),
    )


def _stamped(path: Path, topic: str | None) -> tuple[list[Stamped], list[str]]:
    """Messages with their times, and what is to be said of these."""
    with _opened(path) as reader:
        connections = _of_topic([c for c in reader.connections if c.msgtype == _TYPE], topic)
        got = [(when, reader.deserialize(raw, c.msgtype)) for c, when, raw in reader.messages(connections=connections)]
        if not got:
            raise InvalidArgument(f"no messages on '{connections[0].topic}'.")
    stamped = [(_nanoseconds(message), message) for _, message in got]
    if any(stamp for stamp, _ in stamped):
        return stamped, []
    return got, ["no message has a stamp: timed by when the bag got it"]


def _with(stamped: list[Stamped], joints: Sequence[str]) -> tuple[list[Stamped], int]:
    """Those that hold all joints, and how many do not."""
    whole = [(stamp, message) for stamp, message in stamped if set(joints) <= {str(name) for name in message.name}]
    return (whole, len(stamped) - len(whole)) if whole else (stamped, 0)


def _of_topic(connections: list[Any], topic: str | None) -> list[Any]:
    topics = sorted({connection.topic for connection in connections})
    if not topics:
        raise InvalidArgument(f"the bag has no topic of {_TYPE}.")
    if topic is None and len(topics) > 1:
        raise InvalidArgument(f"topic: not given, and joint states are on {', '.join(topics)}. Choose one.")
    if topic is not None and topic not in topics:
        raise InvalidArgument(f"topic: '{topic}' has no joint states; they are on {', '.join(topics)}.")
    return [connection for connection in connections if connection.topic == (topic or topics[0])]


def _nanoseconds(message: Any) -> int:
    return int(message.header.stamp.sec) * 1_000_000_000 + int(message.header.stamp.nanosec)


def _rows(messages: list[Any], what: str, names: tuple[str, ...]) -> np.ndarray:
    """(T, n), every message's values in the order of the first message's names."""
    rows = []
    for k, message in enumerate(messages):
        values = dict(zip((str(name) for name in message.name), getattr(message, what), strict=False))
        if set(values) != set(names):
            raise InvalidArgument(f"message {k}: {what} of {sorted(values)}, expected of {sorted(names)}.")
        rows.append([float(values[name]) for name in names])
    return np.array(rows)


@contextmanager
def _opened(path: Path) -> Iterator[Any]:
    """Open a bag; whatever the package raises at a damaged one becomes InvalidArgument."""
    try:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        raise MissingDependency('Bags are read by rosbags. Install it: pip install "dmpcpp[formats]".') from None
    try:
        with AnyReader([path], default_typestore=get_typestore(Stores.LATEST)) as reader:
            yield reader
    except InvalidArgument as error:
        raise within(path.name, error) from None
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    except Exception as error:  # the package meets a damaged bag with many types of exception
        raise InvalidArgument(
            f"{path.name}: not a readable bag ({type(error).__name__}: {str(error)[:200]})."
        ) from None
