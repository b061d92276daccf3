"""The public address of `dmpcpp.robot.arms`."""

from dmpcpp._address import share
from dmpcpp.robot.arms import *  # noqa: F403

share(__name__, "dmpcpp.robot.arms")
