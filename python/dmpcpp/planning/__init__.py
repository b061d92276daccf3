"""From a motion to joints: where it is placed before the arm, and what the arm would do with a learned model.

A recorded motion is placed by one similarity transform (`place`, `anchor`); `plan` leads a model to a goal in a time.

>>> from dmpcpp import arms, planning
>>> found = planning.plan(model, arms.find("panda"), duration=4.0)        # doctest: +SKIP
>>> found.ok, found.joints.position.shape                                 # doctest: +SKIP
"""

from dmpcpp.planning._anchoring import Reach, anchor, anchor_within_reach, reach
from dmpcpp.planning._clearance import ClearOfItself, LookedAt, clear_of_itself, require_free_postures
from dmpcpp.planning._cycles import Cycles
from dmpcpp.planning._joints import Engine, Slowed, Solution, limit_factor, slowed, solve
from dmpcpp.planning._placement import Accept, Placement
from dmpcpp.planning._plan import JointPlan, at_phases, plan, write
from dmpcpp.planning._scaling import ChosenScaling, with_scaling
from dmpcpp.planning._search import place, placed

__all__ = [
    "Accept",
    "ChosenScaling",
    "ClearOfItself",
    "Cycles",
    "Engine",
    "JointPlan",
    "LookedAt",
    "Placement",
    "Reach",
    "Slowed",
    "Solution",
    "anchor",
    "anchor_within_reach",
    "at_phases",
    "clear_of_itself",
    "limit_factor",
    "place",
    "placed",
    "plan",
    "reach",
    "require_free_postures",
    "slowed",
    "solve",
    "with_scaling",
    "write",
]
