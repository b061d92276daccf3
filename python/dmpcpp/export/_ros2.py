"""ROS 2 trajectory_msgs/msg/JointTrajectory, as YAML for `ros2 topic pub` and as a bag; no ROS is needed.

Points carry positions, velocities and accelerations: of positions alone a joint_trajectory_controller makes straight
lines. `time_from_start` counts from the moment the controller takes the message over and must be above 0, so all
times are moved by `lead`: in that time the controller brings the robot to the first point from wherever it stands.
"""

from __future__ import annotations

import re
import shutil
import tempfile
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from dmpcpp._atomic import write_text
from dmpcpp._text import read_text
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency
from dmpcpp.export._checks import JointSamples, checked, finite, strict_times
from dmpcpp.sending import JointMotion, farthest

if TYPE_CHECKING:
    from dmpcpp import Arm

__all__ = ["read_ros2_bag", "read_ros2_yaml", "write_ros2_bag", "write_ros2_goal", "write_ros2_yaml"]

_TYPE = "trajectory_msgs/msg/JointTrajectory"
_FIELDS = ("positions", "velocities", "accelerations")
_CONTROLLER = "/joint_trajectory_controller"
_PATH_TOLERANCE, _GOAL_TOLERANCE = 0.1, 0.01  # rad (m), of an action's goal
_GOAL_TIME = 1  # s


def write_ros2_yaml(
    path: str | PathLike[str], trajectory: JointMotion, arm: Arm | None = None, *, lead: float = 0.1
) -> None:
    """Write a JointTrajectory message as YAML: `ros2 topic pub --once TOPIC trajectory_msgs/msg/JointTrajectory
    "$(cat FILE)"`.

    Parameters
    ----------
    path : path
    trajectory : JointTrajectory
        Exactly at rest at its end. Numbers read back exactly, times to a nanosecond.
    arm : Arm, optional
        Whose limits it must hold.
    lead : float
        s, above 0; the `time_from_start` of the first point.

    Raises
    ------
    InvalidArgument
        What `checked` refuses, an end at speed, a lead that is not positive.
    FileError
        The file cannot be written; an older one is untouched.
    """
    samples = _at_rest(checked(trajectory, arm))
    send = f"ros2 topic pub --once {_CONTROLLER}/joint_trajectory {_TYPE}"
    write_text(path, "\n".join([*_first_lines(path, samples, arm, lead, send), *_lines(samples, lead)]) + "\n")


def write_ros2_goal(
    path: str | PathLike[str], trajectory: JointMotion, arm: Arm | None = None, *, lead: float = 0.1
) -> None:
    """Write the goal of the action control_msgs/action/FollowJointTrajectory as YAML, with tolerances.

    On the way every joint may be 0.1 rad (m) off, at the end 0.01 within 1 s; the controller ends it otherwise.
    Parameters, limits and errors are those of `write_ros2_yaml`.
    """
    samples = _at_rest(checked(trajectory, arm))
    send = f"ros2 action send_goal {_CONTROLLER}/follow_joint_trajectory control_msgs/action/FollowJointTrajectory"
    lines = [*_first_lines(path, samples, arm, lead, send), "trajectory:"]
    lines += [f"  {line}" for line in _lines(samples, lead)]
    for name, tolerance in (("path_tolerance", _PATH_TOLERANCE), ("goal_tolerance", _GOAL_TOLERANCE)):
        lines.append(f"{name}:")
        lines += [
            f"- {{name: {_quoted(joint)}, position: {tolerance}, velocity: 0.0, acceleration: 0.0}}"
            for joint in samples.joint_names
        ]
    write_text(path, "\n".join([*lines, f"goal_time_tolerance: {{sec: {_GOAL_TIME}, nanosec: 0}}"]) + "\n")


def _first_lines(
    path: str | PathLike[str], samples: JointSamples, arm: Arm | None, lead: float, send: str
) -> list[str]:
    """Comments: where the robot has to stand, and the command that sends the file."""
    place = ", ".join(f"{q:.4f}" for q in samples.position[0])
    far = "" if arm is None else f" The robot must stand within {farthest(arm, lead):.2g} rad of it."
    return [
        f"# The first point, [{place}] rad, is reached {lead:g} s after the controller gets this.{far}",
        f'# {send} "$(cat {Path(path).name})"',
    ]


def _lines(samples: JointSamples, lead: float) -> list[str]:
    lines = ["header:", "  stamp: {sec: 0, nanosec: 0}", "  frame_id: ''", "joint_names:"]
    lines += [f"- {_quoted(name)}" for name in samples.joint_names]
    lines.append("points:")
    for k, nanoseconds in enumerate(_nanoseconds(samples, lead)):
        rows = (samples.position[k], samples.velocity[k], samples.acceleration[k])
        lines += [
            f"{'- ' if name == 'positions' else '  '}{name}: {_list(row)}"
            for name, row in zip(_FIELDS, rows, strict=True)
        ]
        lines.append(f"  time_from_start: {{sec: {nanoseconds // 10**9}, nanosec: {nanoseconds % 10**9}}}")
    return lines


def read_ros2_yaml(path: str | PathLike[str]) -> JointSamples:
    """Read a YAML file that `write_ros2_yaml` wrote; times count from the first point.

    Raises
    ------
    FileError
        The file cannot be read.
    InvalidArgument
        A line that does not belong there, named by its number; non-finite values or non-increasing times.
    """
    path = Path(path)
    names: list[str] = []
    rows: dict[str, list[list[float]]] = {name: [] for name in _FIELDS}
    nanoseconds: list[int] = []
    for line, text in enumerate(read_text(path).splitlines(), start=1):
        if not _take(text, names, rows, nanoseconds):
            raise InvalidArgument(
                f"{path.name}: line {line}, {text!r}, expected a JointTrajectory as dmpcpp writes it."
            )
    shape = (len(nanoseconds), len(names))
    if any(len(row) != shape[1] for name in _FIELDS for row in rows[name]):
        raise InvalidArgument(f"{path.name}: points that do not have {shape[1]} numbers, one for each joint.")
    return _samples(nanoseconds, *(np.array(rows[name]).reshape(-1, shape[1]) for name in _FIELDS), names)


def write_ros2_bag(
    folder: str | PathLike[str],
    trajectory: JointMotion,
    arm: Arm | None = None,
    *,
    topic: str = "/joint_trajectory_controller/joint_trajectory",
    lead: float = 0.1,
) -> None:
    """Write a ROS 2 bag (rosbag2, sqlite3) with one JointTrajectory message; `ros2 bag play FOLDER` sends it.

    Parameters, limits and errors are those of `write_ros2_yaml`; the folder must not exist, and appears whole or not
    at all. Needs rosbags: pip install "dmpcpp[formats]".
    """
    rosbag2, store = _rosbags()
    samples = _at_rest(checked(trajectory, arm))
    folder = Path(folder)
    if folder.exists():
        raise FileError(f"{folder}: there already. Remove it, or choose another name.")
    message = _message(store, samples, lead)
    try:
        scratch = Path(tempfile.mkdtemp(prefix=".bag-", dir=folder.parent))
    except OSError as error:
        raise FileError(f"{folder}: cannot be written ({error.strerror or error}).") from None
    try:
        with rosbag2.Writer(scratch / folder.name, version=9) as writer:
            connection = writer.add_connection(topic, _TYPE, typestore=store)
            writer.write(connection, 0, store.serialize_cdr(message, _TYPE))
        (scratch / folder.name).rename(folder)
    except OSError as error:
        raise FileError(f"{folder}: cannot be written ({error.strerror or error}).") from None
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def can_write_bags(arm: Arm) -> None:
    """Raise MissingDependency where rosbags is not installed."""
    _rosbags()


def read_ros2_bag(folder: str | PathLike[str], topic: str | None = None) -> JointSamples:
    """Read the first JointTrajectory message of a ROS 2 bag; times count from its first point.

    Raises
    ------
    FileError
        There is no readable bag.
    InvalidArgument
        It holds no such message (on that topic), or non-finite values or non-increasing times.
    MissingDependency
        rosbags is not installed.
    """
    rosbag2, store = _rosbags()
    folder = Path(folder)
    try:
        with rosbag2.Reader(folder) as reader:
            found = [c for c in reader.connections if c.msgtype == _TYPE and topic in (None, c.topic)]
            data = next((raw for _, _, raw in reader.messages(found)), None) if found else None
            message = None if data is None else store.deserialize_cdr(data, _TYPE)
    except (rosbag2.ReaderError, OSError) as error:
        raise FileError(f"{folder}: cannot be read ({error}).") from None
    if message is None:
        raise InvalidArgument(f"{folder.name}: no message of type {_TYPE}{f' on {topic}' if topic else ''}.")
    return _from_message(message)


def _rosbags() -> tuple[Any, Any]:
    try:
        from rosbags import rosbag2
        from rosbags.typesys import Stores, get_typestore
    except ImportError:
        raise MissingDependency('ROS bags need rosbags. Install it: pip install "dmpcpp[formats]".') from None
    return rosbag2, get_typestore(Stores.ROS2_HUMBLE)


def _at_rest(samples: JointSamples) -> JointSamples:
    speed = np.abs(samples.velocity[-1])
    if speed.any():  # ros2_controllers refuse 1e-6 rad/s
        j = int(np.argmax(speed))
        raise InvalidArgument(
            f"velocity[{len(samples.time) - 1}, {j}]: {samples.velocity[-1, j]:.4g} rad/s of joint "
            f"{samples.joint_names[j]!r} at the end, expected 0: a controller refuses it. Let the motion come to rest."
        )
    return samples


def _nanoseconds(samples: JointSamples, lead: float) -> list[int]:
    if not 0.0 < lead < np.inf:
        raise InvalidArgument(f"lead: {lead}, expected a number of seconds above 0.")
    return [round(1e9 * (lead + t)) for t in (samples.time - samples.time[0]).tolist()]


def _samples(nanoseconds: list[int], *parts: Any) -> JointSamples:
    time = strict_times(np.array([n - nanoseconds[0] for n in nanoseconds]) / 1e9)
    *arrays, names = parts
    shape = (len(time), len(names))
    values = [finite(what, array, shape, names) for what, array in zip(_FIELDS, arrays, strict=True)]
    return JointSamples(time, *values, tuple(names))


def _message(store: Any, samples: JointSamples, lead: float) -> Any:
    types = store.types
    duration, point = types["builtin_interfaces/msg/Duration"], types["trajectory_msgs/msg/JointTrajectoryPoint"]
    stamp = types["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
    points = [
        point(
            positions=samples.position[k],
            velocities=samples.velocity[k],
            accelerations=samples.acceleration[k],
            effort=np.empty(0),
            time_from_start=duration(sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9),
        )
        for k, nanoseconds in enumerate(_nanoseconds(samples, lead))
    ]
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="")
    return types[_TYPE](header=header, joint_names=list(samples.joint_names), points=points)


def _from_message(message: Any) -> JointSamples:
    names = list(message.joint_names)
    nanoseconds = [p.time_from_start.sec * 10**9 + p.time_from_start.nanosec for p in message.points]
    arrays = [_stacked(message.points, name, len(names)) for name in _FIELDS]
    return _samples(nanoseconds, *arrays, names)


def _stacked(points: Any, name: str, count: int) -> np.ndarray:
    for k, point in enumerate(points):
        if len(getattr(point, name)) != count:
            raise InvalidArgument(
                f"points[{k}].{name}: {len(getattr(point, name))} numbers, expected {count}, one for each joint."
            )
    return np.array([getattr(point, name) for point in points], dtype=np.float64).reshape(-1, count)


def _quoted(name: str) -> str:
    return "'" + name.replace("'", "''") + "'"


def _list(row: np.ndarray) -> str:
    return "[" + ", ".join(map(_number, row.tolist())) + "]"


def _number(value: float) -> str:
    """YAML 1.1 takes 1e-05 for text: a number has a point."""
    text = repr(value)
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


_NAME = re.compile(r"- '(?P<name>(?:[^']|'')*)'")
_ROW = re.compile(r"[- ] (?P<what>positions|velocities|accelerations): \[(?P<row>[^\]]*)\]")
_STAMP = re.compile(r"  time_from_start: \{sec: (?P<sec>\d+), nanosec: (?P<nanosec>\d+)\}")
_FRAME = ("header:", "  stamp: {sec: 0, nanosec: 0}", "  frame_id: ''", "joint_names:", "points:")


def _take(text: str, names: list[str], rows: dict[str, list[list[float]]], nanoseconds: list[int]) -> bool:
    """Take one line of YAML in; whether it was one of those that are written."""
    if name := _NAME.fullmatch(text):
        names.append(name["name"].replace("''", "'"))
    elif row := _ROW.fullmatch(text):
        try:
            rows[row["what"]].append([float(cell) for cell in row["row"].split(",")])
        except ValueError:
            return False
    elif stamp := _STAMP.fullmatch(text):
        nanoseconds.append(int(stamp["sec"]) * 10**9 + int(stamp["nanosec"]))
    else:
        return text in _FRAME or text.startswith("#")
    return True
