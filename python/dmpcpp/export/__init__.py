"""Trajectories out, in the files that robot engineers use, and back in; each written whole or not at all.

- Joint CSV: `time,<joints>,<joints>_vel,<joints>_acc`, and `phase` (lead-in, motion, lead-out); the same as .npz.
- Plan: a .npz with `time`, `pose`, `twist`, and the names of units and frames.
- TUM: `t tx ty tz qx qy qz qw`; read it, or a plan, with `recordings.load`.
- ROS 2 trajectory_msgs/JointTrajectory, as YAML, a bag or an action's goal: always with velocities and accelerations.
- URScript: servoj, one command a period.

All in s, m and rad (m for a sliding joint). Numbers that are not finite are refused with index and joint; so are joints
outside an arm's limits where the arm is given.
"""

from dmpcpp.export._checks import JointSamples, check_limits
from dmpcpp.export._files import Plan, read_joints, read_plan, write_joint_arrays, write_joints, write_plan, write_tum
from dmpcpp.export._formats import FORMATS, SENT_RATE, Format, chosen
from dmpcpp.export._robot_files import JOINTS, Written, remove_robot_files, write_robot_files
from dmpcpp.export._ros2 import read_ros2_bag, read_ros2_yaml, write_ros2_bag, write_ros2_goal, write_ros2_yaml
from dmpcpp.export._urscript import read_urscript, write_urscript

__all__ = [
    "FORMATS",
    "JOINTS",
    "SENT_RATE",
    "Format",
    "JointSamples",
    "Plan",
    "Written",
    "check_limits",
    "chosen",
    "read_joints",
    "read_plan",
    "read_ros2_bag",
    "read_ros2_yaml",
    "read_urscript",
    "remove_robot_files",
    "write_joint_arrays",
    "write_joints",
    "write_plan",
    "write_robot_files",
    "write_ros2_bag",
    "write_ros2_goal",
    "write_ros2_yaml",
    "write_tum",
    "write_urscript",
]
