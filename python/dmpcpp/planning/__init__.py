"""From a motion to joints: where it is placed before the arm, and what the arm would do with a learned model.

A recorded motion is placed by one similarity transform (`place`, `anchor`); `plan` leads a model to a goal in a time.

>>> from dmpcpp import arms, planning
>>> found = planning.plan(model, arms.find("panda"), duration=4.0)        # doctest: +SKIP
>>> found.ok, found.joints.position.shape                                 # doctest: +SKIP
"""

from dmpcpp.planning._anchoring import Reach, anchor, anchor_within_reach, reach
from dmpcpp.planning._avoidance import Detour, clear_path, place_among, solve_around
from dmpcpp.planning._bound import Bound, arm_bound
from dmpcpp.planning._clearance import ClearOfItself, LookedAt, clear_of_itself, require_free_postures
from dmpcpp.planning._cycles import Cycles
from dmpcpp.planning._fit import DEFAULT_TOLERANCE, Fitted, Tolerance, fitted, taken_tolerance
from dmpcpp.planning._joints import Engine, Slowed, Solution, limit_factor, slowed, solve
from dmpcpp.planning._placement import Accept, Placement
from dmpcpp.planning._plan import JointPlan, at_phases, plan, write
from dmpcpp.planning._scaling import ChosenScaling, with_scaling
from dmpcpp.planning._search import place, placed
from dmpcpp.planning._tempo import POLICIES, Tempo, TempoPolicy, taken_policy, tempo_check

__all__ = [
    "DEFAULT_TOLERANCE",
    "POLICIES",
    "Accept",
    "Bound",
    "ChosenScaling",
    "ClearOfItself",
    "Cycles",
    "Detour",
    "Engine",
    "Fitted",
    "JointPlan",
    "LookedAt",
    "Placement",
    "Reach",
    "Slowed",
    "Solution",
    "Tempo",
    "TempoPolicy",
    "Tolerance",
    "anchor",
    "anchor_within_reach",
    "arm_bound",
    "at_phases",
    "clear_of_itself",
    "clear_path",
    "fitted",
    "limit_factor",
    "place",
    "place_among",
    "placed",
    "plan",
    "reach",
    "require_free_postures",
    "slowed",
    "solve",
    "solve_around",
    "taken_policy",
    "taken_tolerance",
    "tempo_check",
    "with_scaling",
    "write",
]
