"""The arm as the programs around it see it: known arms, defects of a URDF, its reach and its description for physics.

Users import ``dmpcpp.arms`` and ``dmpcpp.urdf_check``; the rest is for the rooms above.
"""

from dmpcpp.robot._description import RobotDescription, describe, find_mesh, is_physical, links_of
from dmpcpp.robot._disturbance import Disturbance
from dmpcpp.robot._limit_use import LimitUse
from dmpcpp.robot._reach import farthest_reach, require_within_reach

__all__ = [
    "Disturbance",
    "LimitUse",
    "RobotDescription",
    "describe",
    "farthest_reach",
    "find_mesh",
    "is_physical",
    "links_of",
    "require_within_reach",
]
