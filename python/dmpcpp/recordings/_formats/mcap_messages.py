"""MCAP files whose messages are JSON or protobuf: poses and transforms by the schemas of Foxglove.

Source: MCAP specification; Foxglove schemas PoseInFrame, PosesInFrame, FrameTransform and FrameTransforms (m, unit
quaternions x y z w, `timestamp` {sec, nsec}). Read by the packages mcap and, for protobuf, mcap-protobuf-support.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from dmpcpp.errors import FileError, InvalidArgument, MissingDependency

__all__ = ["Found", "is_other_mcap", "poses"]

_MAGIC = b"\x89MCAP0\r\n"
_HEAD = 4096  # bytes in which the header names its profile
_READ = ("json", "protobuf")
_MOST_POSES = 100  # of one message


@dataclass(frozen=True)
class Found:
    """One pose of a message; stamps in ns, -1 where the message has none."""

    body: str
    stamp: int
    received: int
    frame: str
    position: Any
    orientation: Any


def is_other_mcap(path: Path) -> bool:
    """Return whether a path is an MCAP file that no ROS system wrote, by the profile in its header."""
    if not path.is_file():
        return False
    with path.open("rb") as file:
        head = file.read(_HEAD)
    if not head.startswith(_MAGIC) or len(head) < 21:
        return False
    length = int.from_bytes(head[17:21], "little")  # of the profile, behind magic, opcode and length of the record
    return not head[21 : 21 + min(length, 20)].startswith(b"ros")


def poses(path: Path) -> list[Found]:
    """Return the poses of all messages, in the order of the file.

    Raises
    ------
    MissingDependency
        The package mcap is not installed.
    InvalidArgument
        The file is damaged, or no message holds a pose; the error lists the channels.
    """
    try:
        from mcap.reader import make_reader
    except ImportError:
        raise MissingDependency('MCAP files are read by mcap. Install it: pip install "dmpcpp[datasets]".') from None
    channels: set[str] = set()
    try:
        with path.open("rb") as file:
            found = list(_poses(make_reader(file), channels))
    except (InvalidArgument, MissingDependency):
        raise
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    except Exception as error:  # of a damaged file the packages raise anything, MemoryError too
        raise InvalidArgument(f"not a readable MCAP ({type(error).__name__}: {str(error)[:200]}).") from None
    if not found:
        raise InvalidArgument(
            "no messages with poses (foxglove.PoseInFrame, PosesInFrame, FrameTransform or FrameTransforms as JSON or "
            f"protobuf). The file holds: {', '.join(sorted(channels)) or 'nothing'}."
        )
    return found


def _poses(reader: Any, channels: set[str]) -> Iterator[Found]:
    decoders: dict[int, Any] = {}
    for schema, channel, message in reader.iter_messages():
        name = schema.name if schema is not None else "no schema"
        channels.add(f"{channel.topic} ({name}, {channel.message_encoding})")
        kind = name.rsplit(".", 1)[-1]
        if channel.message_encoding in _READ and kind in _KINDS:
            content = _content(decoders, schema, channel, message)
            yield from _KINDS[kind](channel.topic, int(message.log_time), content)


def _content(decoders: dict[int, Any], schema: Any, channel: Any, message: Any) -> Any:
    """Return a message as an object with attributes."""
    if channel.message_encoding == "json":
        return json.loads(message.data, object_hook=lambda fields: SimpleNamespace(**fields))
    if channel.id not in decoders:
        try:
            from mcap_protobuf.decoder import DecoderFactory
        except ImportError:
            raise MissingDependency(
                'Protobuf messages are read by mcap-protobuf-support. Install it: pip install "dmpcpp[datasets]".'
            ) from None
        decoders[channel.id] = DecoderFactory().decoder_for("protobuf", schema)
    return decoders[channel.id](message.data)


def _stamp(message: Any) -> int:
    """Return the time stamp [ns] of a message: sec and nsec as JSON, seconds and nanos as protobuf."""
    stamp = getattr(message, "timestamp", None)
    if stamp is None:
        return -1
    whole = getattr(stamp, "sec", getattr(stamp, "seconds", None))
    part = getattr(stamp, "nsec", getattr(stamp, "nanos", 0))
    nanoseconds = -1 if whole is None else int(whole) * 1_000_000_000 + int(part)
    if abs(nanoseconds) >= 2**63:
        raise ValueError(f"a stamp of {nanoseconds} ns")
    return nanoseconds


def _pose_in_frame(topic: str, received: int, message: Any) -> Iterator[Found]:
    pose = message.pose
    yield _found(topic, _stamp(message), received, message.frame_id, pose.position, pose.orientation)


def _found(body: str, stamp: int, received: int, frame: Any, position: Any, orientation: Any) -> Found:
    """Return a pose whose numbers are numbers; what is none raises TypeError, ValueError or AttributeError."""
    xyz = SimpleNamespace(**{name: float(getattr(position, name)) for name in "xyz"})
    xyzw = SimpleNamespace(**{name: float(getattr(orientation, name)) for name in "xyzw"})
    return Found(body, stamp, received, str(frame), xyz, xyzw)


def _poses_in_frame(topic: str, received: int, message: Any) -> Iterator[Found]:
    for k, pose in enumerate(list(message.poses)[:_MOST_POSES]):
        yield _found(f"{topic}[{k}]", _stamp(message), received, message.frame_id, pose.position, pose.orientation)


def _transform(topic: str, received: int, message: Any) -> Iterator[Found]:
    child, parent = str(message.child_frame_id), message.parent_frame_id
    yield _found(child, _stamp(message), received, parent, message.translation, message.rotation)


def _transforms(topic: str, received: int, message: Any) -> Iterator[Found]:
    for transform in message.transforms:
        yield from _transform(topic, received, transform)


_KINDS = {
    "PoseInFrame": _pose_in_frame,
    "PosesInFrame": _poses_in_frame,
    "FrameTransform": _transform,
    "FrameTransforms": _transforms,
}
