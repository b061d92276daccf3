"""The formats that robots are sent, by name."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from dmpcpp.errors import InvalidArgument
from dmpcpp.export._files import write_joint_arrays
from dmpcpp.export._ros2 import can_write_bags, write_ros2_bag, write_ros2_goal, write_ros2_yaml
from dmpcpp.export._urscript import understands_urscript, write_urscript
from dmpcpp.sending import JointMotion, RestToRest

if TYPE_CHECKING:
    from dmpcpp import Arm

__all__ = ["FORMATS", "ROS2_LEAD", "SENT_RATE", "Format", "chosen"]

SENT_RATE = 125.0
"""Hz: one sample a servoj command; a ROS 2 controller fills in by quintics."""
ROS2_LEAD = 3.0
"""s in which a ROS 2 controller brings the robot to the first point."""


@dataclass(frozen=True)
class Format:
    """How joints are written for a robot.

    Attributes
    ----------
    file : str
        The name of the file, or of the folder that a bag is.
    write : callable
        (path, trajectory, arm): limits are those of the arm.
    check : callable
        (arm): raises what keeps it from being written for this arm, before there is a trajectory.
    rate : float or None
        Samples a second; None: those of the motion.
    """

    file: str
    write: Callable[[Path, JointMotion, Arm], None]
    check: Callable[[Arm], None] = lambda arm: None
    rate: float | None = SENT_RATE

    def send(self, path: Path, sent: RestToRest, arm: Arm) -> None:
        """Write joints as a robot may get them, at the rate of the format."""
        self.write(path, sent if self.rate is None else sent.at_rate(self.rate), arm)

    def remove(self, folder: Path) -> None:
        """Remove what was written to a folder earlier; anything else of that name stays."""
        path = folder / self.file
        if (path / "metadata.yaml").is_file():
            shutil.rmtree(path)
        elif path.is_file():
            path.unlink()


FORMATS = {
    "ros2": Format("joints.yaml", partial(write_ros2_yaml, lead=ROS2_LEAD)),
    "ros2-bag": Format("joints_bag", partial(write_ros2_bag, lead=ROS2_LEAD), can_write_bags),
    "urscript": Format("joints.script", write_urscript, understands_urscript),
    "ros2-goal": Format("joints_goal.yaml", partial(write_ros2_goal, lead=ROS2_LEAD)),
    "npz": Format("joints.npz", write_joint_arrays, rate=None),
}
"""By the names of the command line."""


def chosen(names: Iterable[str], arm: Arm) -> tuple[Format, ...]:
    """Return the formats of these names, each once, if they can be written for an arm.

    Raises
    ------
    InvalidArgument
        There is no such format, or the arm does not take it.
    MissingDependency
        What it needs is not installed.
    """
    names = tuple(dict.fromkeys(names))
    for name in names:
        if name not in FORMATS:
            raise InvalidArgument(f"export: '{name}', expected one of {', '.join(FORMATS)}.")
        FORMATS[name].check(arm)
    return tuple(FORMATS[name] for name in names)
