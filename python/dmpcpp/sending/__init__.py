"""What may leave for a robot: joints that begin and end at rest, within the limits of the arm.

``from_rest_to_rest(arm, joints)`` puts a lead-in before a motion and a lead-out behind it; ``check`` decides whether a
robot may get the result.
"""

from dmpcpp.sending._approach import (
    APPROACH_SHARE,
    Joints,
    approach,
    farthest,
    joined,
    nearest_turns,
    slowed_by,
    turned,
)
from dmpcpp.sending._between import INTERPOLATIONS as INTERPOLATIONS
from dmpcpp.sending._between import Interpolation as Interpolation
from dmpcpp.sending._between import JointMotion as JointMotion
from dmpcpp.sending._between import States as States
from dmpcpp.sending._between import interpolated as interpolated
from dmpcpp.sending._between import quintic_coefficients as quintic_coefficients
from dmpcpp.sending._between import states_at as states_at
from dmpcpp.sending._check import check, ready, require
from dmpcpp.sending._effort import effort as effort
from dmpcpp.sending._lead import Clear as Clear
from dmpcpp.sending._ramp import LEAD_ACCELERATION
from dmpcpp.sending._rest_to_rest import PHASES, RestToRest, from_rest_to_rest, phases_of

__all__ = [
    "APPROACH_SHARE",
    "LEAD_ACCELERATION",
    "PHASES",
    "Joints",
    "RestToRest",
    "approach",
    "check",
    "farthest",
    "from_rest_to_rest",
    "joined",
    "nearest_turns",
    "phases_of",
    "ready",
    "require",
    "slowed_by",
    "turned",
]
