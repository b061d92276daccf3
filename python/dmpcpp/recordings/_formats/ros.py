"""ROS 1 bags, ROS 2 bags and MCAP files: poses that were published, s and m by REP 103.

Messages: PoseStamped, PoseWithCovarianceStamped and Odometry (the body is the topic), TransformStamped and TFMessage
(the body is the child frame). Read by the package rosbags, without ROS; z is up by REP 103 in fixed frames, but not
in those of a camera, so the caller states it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency
from dmpcpp.recordings._orientation import from_quaternions
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "is_bag_folder"]

_MAGICS = (b"#ROSBAG V2.0", b"\x89MCAP0\r\n", b"SQLite format 3\x00")
_LARGEST_VALUE = 1e300  # what overflows when it is squared


@dataclass
class _Track:
    """What was published of one body; stamps in ns."""

    stamps: list[int] = field(default_factory=list)
    values: list[tuple[float, ...]] = field(default_factory=list)  # x y z qx qy qz qw
    frames: set[str] = field(default_factory=set)  # the world frames that messages name

    def add(self, stamp: int, frame: str, position: Any, orientation: Any) -> None:
        self.stamps.append(stamp)
        self.frames.add(frame)
        turn = (orientation.x, orientation.y, orientation.z, orientation.w)
        self.values.append((position.x, position.y, position.z, *turn))


def is_bag_folder(path: Path) -> bool:
    """Return whether a path is the folder of a ROS 2 bag."""
    return (path / "metadata.yaml").is_file()


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the topics and child frames with poses; static transforms are left out."""
    return tuple(_tracks(path))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses of one body at the stamps of their headers."""
    tracks = _tracks(path)
    body = pick_body(body, tuple(tracks))
    track = tracks[body]
    if len(track.frames) > 1:
        raise InvalidArgument(
            f"{body}: poses in several frames: {', '.join(sorted(track.frames))}. Record one of them."
        )
    stamps, values, notes = _ordered(track)
    rotation, mended = from_quaternions(values[:, 3:], stated.quat_order or "xyzw")
    time = np.array([float(stamp - stamps[0]) for stamp in stamps])
    start = f"time counted from the first stamp at {stamps[0]} ns"
    return stated.recording(
        time=time,
        position=values[:, :3],
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[f"in the frame {next(iter(track.frames))!r}", start, *notes, *mended],
        world=World(unit="m", time_unit="ns"),
    )


def _ordered(track: _Track) -> tuple[list[int], np.ndarray, list[str]]:
    """Return stamps and values in the order of time; a pose that was published twice counts once."""
    order = sorted(range(len(track.stamps)), key=track.stamps.__getitem__)
    notes = [] if order == list(range(len(order))) else ["messages put in the order of their stamps"]
    kept = [k for n, k in enumerate(order) if n == 0 or not _same(track, k, order[n - 1])]
    if len(kept) < len(order):
        notes.append(f"{len(order) - len(kept)} poses that were published again left out")
    values = np.array([track.values[k] for k in kept])
    return [track.stamps[k] for k in kept], np.clip(values, -_LARGEST_VALUE, _LARGEST_VALUE), notes


def _same(track: _Track, a: int, b: int) -> bool:
    return track.stamps[a] == track.stamps[b] and track.values[a] == track.values[b]


def _tracks(path: Path) -> dict[str, _Track]:
    tracks: dict[str, _Track] = {}
    with _opened(path) as reader:
        wanted = [c for c in reader.connections if c.msgtype in _POSES and not c.topic.endswith("tf_static")]
        types = sorted({connection.msgtype for connection in reader.connections})
        for connection, _, raw in reader.messages(connections=wanted) if wanted else ():
            message = reader.deserialize(raw, connection.msgtype)
            for body, stamped, position, orientation in _POSES[connection.msgtype](connection.topic, message):
                stamp = stamped.header.stamp
                nanoseconds = int(stamp.sec) * 1_000_000_000 + int(stamp.nanosec)
                frame = str(stamped.header.frame_id)
                tracks.setdefault(body, _Track()).add(nanoseconds, frame, position, orientation)
    if not tracks:
        raise InvalidArgument(f"no messages with poses. The bag holds: {', '.join(types) or 'nothing'}.")
    return tracks


_Pose = tuple[str, Any, Any, Any]  # body, message with the header, position, orientation


def _pose(topic: str, message: Any) -> list[_Pose]:
    return [(topic, message, message.pose.position, message.pose.orientation)]


def _pose_with_covariance(topic: str, message: Any) -> list[_Pose]:
    return [(topic, message, message.pose.pose.position, message.pose.pose.orientation)]


def _transform(topic: str, message: Any) -> list[_Pose]:
    return [(str(message.child_frame_id), message, message.transform.translation, message.transform.rotation)]


def _transforms(topic: str, message: Any) -> list[_Pose]:
    return [pose for transform in message.transforms for pose in _transform(topic, transform)]


_POSES: dict[str, Callable[[str, Any], list[_Pose]]] = {
    "geometry_msgs/msg/PoseStamped": _pose,
    "geometry_msgs/msg/PoseWithCovarianceStamped": _pose_with_covariance,
    "geometry_msgs/msg/TransformStamped": _transform,
    "nav_msgs/msg/Odometry": _pose_with_covariance,
    "tf/msg/tfMessage": _transforms,
    "tf2_msgs/msg/TFMessage": _transforms,
}


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
    except InvalidArgument:
        raise
    except OSError as error:
        raise FileError(f"{path}: can not be read ({error.strerror or error}).") from None
    except Exception as error:  # the package meets a damaged bag with a dozen types of exception, MemoryError too
        raise InvalidArgument(f"not a readable bag ({type(error).__name__}: {str(error)[:200]}).") from None


def _recognises(path: Path, head: bytes) -> bool:
    return is_bag_folder(path) or head.startswith(_MAGICS) or path.suffix.lower() in (".bag", ".mcap", ".db3")


READER = Reader(
    name="ros",
    summary="a ROS 1 bag, ROS 2 bag folder or MCAP of poses, transforms or odometry",
    takes=("quat_order", "rotation", *COMMON),
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
