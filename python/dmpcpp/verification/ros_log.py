"""Joint states from a ROS bag, read by the package rosbags without ROS."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp.errors import FileError, InvalidArgument, MissingDependency
from dmpcpp.verification.joint_log import JointLog

_TYPE = "sensor_msgs/msg/JointState"


def read_bag(path: Path, topic: str | None) -> JointLog:
    """Joint states of one topic by the stamps of their headers, counted from the first; twice the same counts once."""
    messages = _messages(path, topic)
    stamped = {_nanoseconds(message): message for message in messages}
    stamps = sorted(stamped)
    ordered = [stamped[stamp] for stamp in stamps]
    names = tuple(str(name) for name in ordered[0].name)
    notes = [f"time counted from the first stamp at {stamps[0]} ns"]
    if len(stamps) < len(messages):
        notes.append(f"{len(messages) - len(stamps)} messages with the stamp of another left out")
    return JointLog(
        time=np.array([1e-9 * (stamp - stamps[0]) for stamp in stamps]),
        position=_rows(ordered, "position", names),
        velocity=_rows(ordered, "velocity", names) if len(ordered[0].velocity) else None,
        torque=_rows(ordered, "effort", names) if len(ordered[0].effort) else None,
        joint_names=names,
        source=path.name,
        notes=tuple(notes),
    )


def _messages(path: Path, topic: str | None) -> list[Any]:
    with _opened(path) as reader:
        connections = _of_topic([c for c in reader.connections if c.msgtype == _TYPE], topic)
        messages = [reader.deserialize(raw, c.msgtype) for c, _, raw in reader.messages(connections=connections)]
        if not messages:
            raise InvalidArgument(f"no messages on '{connections[0].topic}'.")
        return messages


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
        raise InvalidArgument(f"{path.name}: {error}") from None
    except OSError as error:
        raise FileError(f"{path}: can not be read ({error.strerror or error}).") from None
    except Exception as error:  # the package meets a damaged bag with many types of exception
        raise InvalidArgument(
            f"{path.name}: not a readable bag ({type(error).__name__}: {str(error)[:200]})."
        ) from None
