"""ROS 1 bags, ROS 2 bags and MCAP files: poses that were published, s and m by REP 103.

Messages: PoseStamped, PoseWithCovarianceStamped and Odometry (the body is the topic), TransformStamped and TFMessage
(the body is the child frame), PoseArray (the body is `topic[k]`), and Pose, which has no stamp, by the times at which
it was received. Read by the package rosbags, without ROS; z is up by REP 103 in fixed frames, but not in those of a
camera, so the caller states it. MCAP files of other encodings are read by `mcap_messages`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency, NotStated
from dmpcpp.recordings._formats import mcap_messages
from dmpcpp.recordings._orientation import from_quaternions
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "is_bag_folder"]

_MAGICS = (b"#ROSBAG V2.0", b"\x89MCAP0\r\n", b"SQLite format 3\x00")
_LARGEST_VALUE = 1e300  # what overflows when it is squared
_NO_STAMP = -1


@dataclass
class _Track:
    """What was published of one body; stamps and times of receipt in ns."""

    stamps: list[int] = field(default_factory=list)
    received: list[int] = field(default_factory=list)
    values: list[tuple[float, ...]] = field(default_factory=list)  # x y z qx qy qz qw
    frames: set[str] = field(default_factory=set)  # the world frames that messages name
    frameless: int = 0  # messages that name none

    def add(self, stamp: int, received: int, frame: str, position: Any, orientation: Any) -> None:
        self.stamps.append(stamp)
        self.received.append(received)
        if frame:
            self.frames.add(frame)
        else:
            self.frameless += 1
        turn = (orientation.x, orientation.y, orientation.z, orientation.w)
        self.values.append((position.x, position.y, position.z, *turn))

    def by_receipt(self) -> None:
        self.stamps = list(self.received)

    def check_stamps(self) -> None:
        """Refuse stamps that tell no times; the times of receipt may.

        Raises
        ------
        NotStated
            There are none, or they are all equal.
        """
        if _NO_STAMP in self.stamps:
            raise NotStated(
                "times", "times: the messages have no stamps. Specify times='received' to use those of receipt."
            )
        if len(self.stamps) > 1 and len(set(self.stamps)) == 1:
            raise NotStated(
                "times",
                f"times: all {len(self.stamps)} header stamps are {self.stamps[0]} ns. Specify times='received' to "
                f"use the "
                "times at which the messages were received.",
            )

    def frame(self, body: str) -> list[str]:
        """Return what to tell of the world frame."""
        if len(self.frames) > 1:
            raise InvalidArgument(
                f"{body}: poses in several frames: {', '.join(sorted(self.frames))}. Record one of them."
            )
        called = next(iter(self.frames), "")
        note = f"in the frame {called!r}"
        if self.frameless and called:
            note += (
                f"; {self.frameless} of {len(self.stamps)} messages have an empty frame_id and are taken to be in it"
            )
        return [note]


def is_bag_folder(path: Path) -> bool:
    """Return whether a path is the folder of a ROS 2 bag."""
    return (path / "metadata.yaml").is_file()


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the topics and child frames with poses; static transforms are left out."""
    return tuple(_tracks(path))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses of one body at the stamps of their headers, or when they were received."""
    tracks = _tracks(path)
    body = pick_body(body, tuple(tracks))
    track = tracks[body]
    if stated.times not in (None, "header", "received", "log"):
        raise InvalidArgument(f"times: {stated.times!r}, expected 'header' or 'received'.")
    if stated.times in ("received", "log"):
        track.by_receipt()
    elif stated.rate is None:
        track.check_stamps()
    stamps, values, notes = _ordered(track, by_stamps=stated.rate is None)
    rotation, corrections = from_quaternions(values[:, 3:], stated.quat_order or "xyzw")
    time = np.array([float(stamp - stamps[0]) for stamp in stamps])
    start = f"time counted from the first stamp at {stamps[0]} ns"
    if stated.times in ("received", "log"):
        start = f"times of receipt, counted from the first at {stamps[0]} ns"
    return stated.recording(
        time=time,
        position=values[:, :3],
        rotation=rotation,
        body=body,
        source=path.name,
        notes=[*track.frame(body), start, *notes, *corrections],
        world=World(unit="m", time_unit="ns"),
    )


def _ordered(track: _Track, by_stamps: bool) -> tuple[list[int], np.ndarray, list[str]]:
    """Return stamps and values in the order of time; a pose that was published twice counts once."""
    order = sorted(range(len(track.stamps)), key=track.stamps.__getitem__) if by_stamps else [*range(len(track.stamps))]
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
    if mcap_messages.is_other_mcap(path):
        for found in mcap_messages.poses(path):
            track = tracks.setdefault(found.body, _Track())
            track.add(found.stamp, found.received, found.frame, found.position, found.orientation)
        return tracks
    with _opened(path) as reader:
        wanted = [c for c in reader.connections if c.msgtype in _POSES and not c.topic.endswith("tf_static")]
        types = sorted({connection.msgtype for connection in reader.connections})
        for connection, received, raw in reader.messages(connections=wanted) if wanted else ():
            message = reader.deserialize(raw, connection.msgtype)
            for body, header, position, orientation in _POSES[connection.msgtype](connection.topic, message):
                stamp, frame = _stamp(header)
                tracks.setdefault(body, _Track()).add(stamp, int(received), frame, position, orientation)
    if not tracks:
        raise InvalidArgument(f"no messages with poses. The bag holds: {', '.join(types) or 'nothing'}.")
    return tracks


def _stamp(header: Any) -> tuple[int, str]:
    """Return the stamp [ns] and frame of a header; none where there is no header."""
    if header is None:
        return _NO_STAMP, ""
    return int(header.stamp.sec) * 1_000_000_000 + int(header.stamp.nanosec), str(header.frame_id)


_Pose = tuple[str, Any, Any, Any]  # body, header or None, position, orientation


def _pose(topic: str, message: Any) -> list[_Pose]:
    return [(topic, message.header, message.pose.position, message.pose.orientation)]


def _plain_pose(topic: str, message: Any) -> list[_Pose]:
    return [(topic, None, message.position, message.orientation)]


def _pose_array(topic: str, message: Any) -> list[_Pose]:
    return [(f"{topic}[{k}]", message.header, each.position, each.orientation) for k, each in enumerate(message.poses)]


def _pose_with_covariance(topic: str, message: Any) -> list[_Pose]:
    return [(topic, message.header, message.pose.pose.position, message.pose.pose.orientation)]


def _transform(topic: str, message: Any) -> list[_Pose]:
    return [(str(message.child_frame_id), message.header, message.transform.translation, message.transform.rotation)]


def _transforms(topic: str, message: Any) -> list[_Pose]:
    return [pose for transform in message.transforms for pose in _transform(topic, transform)]


_POSES: dict[str, Callable[[str, Any], list[_Pose]]] = {
    "geometry_msgs/msg/Pose": _plain_pose,
    "geometry_msgs/msg/PoseArray": _pose_array,
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
        raise FileError(f"{path}: cannot be read ({error.strerror or error}).") from None
    except Exception as error:  # the package meets a damaged bag with a dozen types of exception, MemoryError too
        raise InvalidArgument(f"not a readable bag ({type(error).__name__}: {str(error)[:200]}).") from None


def _recognises(path: Path, head: bytes) -> bool:
    return is_bag_folder(path) or head.startswith(_MAGICS) or path.suffix.lower() in (".bag", ".mcap", ".db3")


READER = Reader(
    name="ros",
    summary="a ROS 1 bag, ROS 2 bag folder or MCAP of poses, transforms or odometry",
    takes=("times", "quat_order", "rotation", *COMMON),
    recognises=_recognises,
    bodies=bodies,
    read=read,
)
