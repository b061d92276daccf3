"""A plan run on a robot: looked at first, streamed at the robot's own rate, stopped along its path, recorded.

``brief(robot, arm, joints)`` says what would happen and moves nothing; ``execute(robot, briefing)`` moves. A ``Robot``
is a small protocol that others implement: `SimulatedRobot` is the library's own physics in real time, `FrankaRobot` an
FR3.
"""

from dmpcpp.running._drivers import SCHEMES, is_simulated, robot_at
from dmpcpp.running._files import as_joint_log, write_log
from dmpcpp.running._follower import Follower
from dmpcpp.running._franka import FrankaRobot
from dmpcpp.running._franka import velocity_range as velocity_range
from dmpcpp.running._robot import CycleLog, End, Robot, RobotError, RobotInfo, RobotState, Sample, Targets
from dmpcpp.running._session import Briefing, Run, brief, execute
from dmpcpp.running._simulated import SimulatedRobot

__all__ = [
    "SCHEMES",
    "Briefing",
    "CycleLog",
    "End",
    "Follower",
    "FrankaRobot",
    "Robot",
    "RobotError",
    "RobotInfo",
    "RobotState",
    "Run",
    "Sample",
    "SimulatedRobot",
    "Targets",
    "as_joint_log",
    "brief",
    "execute",
    "is_simulated",
    "robot_at",
    "write_log",
]
