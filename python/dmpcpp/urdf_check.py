"""The public address of `dmpcpp.robot.urdf_check`."""

from dmpcpp._address import share
from dmpcpp.robot.urdf_check import *  # noqa: F403

share(__name__, "dmpcpp.robot.urdf_check")
