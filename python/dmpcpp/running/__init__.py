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
from dmpcpp.running._goals import GoalSource, goals_from
from dmpcpp.running._joint_limiter import JointLimiter
from dmpcpp.running._online import OnlineMotion, Reached, online_checks
from dmpcpp.running._robot import CycleLog, End, Robot, RobotError, RobotInfo, RobotState, Sample, Targets
from dmpcpp.running._session import Briefing, Run, Stoppable, brief, execute
from dmpcpp.running._simulated import SimulatedRobot

__all__ = [
    "SCHEMES",
    "Briefing",
    "CycleLog",
    "End",
    "Follower",
    "FrankaRobot",
    "GoalSource",
    "JointLimiter",
    "OnlineMotion",
    "Reached",
    "Robot",
    "RobotError",
    "RobotInfo",
    "RobotState",
    "Run",
    "Sample",
    "SimulatedRobot",
    "Stoppable",
    "Targets",
    "as_joint_log",
    "brief",
    "execute",
    "goals_from",
    "is_simulated",
    "online_checks",
    "robot_at",
    "write_log",
]
