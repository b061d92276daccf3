"""The arm as the programs around it see it: known arms, defects of a URDF, its reach and its description for physics.

Users import ``dmpcpp.arms`` and ``dmpcpp.urdf_check``; the rest is for the rooms above.
"""

from dmpcpp.robot._body_inertia import links_by_density, with_density, without_dynamics
from dmpcpp.robot._contact_rules import (
    FLOOR,
    OBSTACLE_MARGIN,
    ContactRules,
    Surroundings,
    base_in_root,
    contact_rules,
    floor_height,
)
from dmpcpp.robot._description import RobotDescription, describe, links_beyond, links_of
from dmpcpp.robot._dimensions import dimension_checks, dimension_doubts
from dmpcpp.robot._disturbance import Disturbance
from dmpcpp.robot._follow import POSE, Follow, following
from dmpcpp.robot._gravity import Overload, overloads, random_postures, require_holdable
from dmpcpp.robot._inertia import InertiaRepair, is_physical, moment_change, nearest_physical, repaired_links
from dmpcpp.robot._levers import Levers
from dmpcpp.robot._limit_sources import assumptions, limits_summary
from dmpcpp.robot._limit_use import LimitUse, judged_by_limits
from dmpcpp.robot._makers import MAKERS as MAKERS
from dmpcpp.robot._obstacles import Obstacle, obstacles_of
from dmpcpp.robot._packages import find_mesh
from dmpcpp.robot._payload import payload_of, with_description, with_payload
from dmpcpp.robot._plausible_limits import LimitDoubt, joint_types, limit_doubts, unjudged, why
from dmpcpp.robot._reach import farthest_reach, require_within_reach
from dmpcpp.robot._stated_limits import with_limits_file, with_stated
from dmpcpp.robot._stated_use import jerk_check, stated_duration_factor, tool_speed_check
from dmpcpp.robot._xml import parsed

__all__ = [
    "FLOOR",
    "OBSTACLE_MARGIN",
    "POSE",
    "ContactRules",
    "Disturbance",
    "Follow",
    "InertiaRepair",
    "Levers",
    "LimitDoubt",
    "LimitUse",
    "Obstacle",
    "Overload",
    "RobotDescription",
    "Surroundings",
    "assumptions",
    "base_in_root",
    "contact_rules",
    "describe",
    "dimension_checks",
    "dimension_doubts",
    "farthest_reach",
    "find_mesh",
    "floor_height",
    "following",
    "is_physical",
    "jerk_check",
    "joint_types",
    "judged_by_limits",
    "limit_doubts",
    "limits_summary",
    "links_beyond",
    "links_by_density",
    "links_of",
    "moment_change",
    "nearest_physical",
    "obstacles_of",
    "overloads",
    "parsed",
    "payload_of",
    "random_postures",
    "repaired_links",
    "require_holdable",
    "require_within_reach",
    "stated_duration_factor",
    "tool_speed_check",
    "unjudged",
    "why",
    "with_density",
    "with_description",
    "with_limits_file",
    "with_payload",
    "with_stated",
    "without_dynamics",
]
