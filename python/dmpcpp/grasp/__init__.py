"""A person's reach, led by its goal to a bottle: grasp it, lift it and hold it up under physics.

>>> from dmpcpp import arms, grasp
>>> planner = grasp.Planner(grasp.default_reach(), arms.find("panda"))       # doctest: +SKIP
>>> run = grasp.grasp(planner, grasp.Bottle(x=0.45, y=0.1))                  # doctest: +SKIP
>>> run.ok, run["rise"].value, run["slip"].value                             # doctest: +SKIP

The reach is learned once as a `PoseDmp`; for every bottle its goal is moved to 12 cm before the bottle, from
where the hand goes on straight along its own axis. Nothing but friction holds the bottle.
"""

from dmpcpp.grasp._attempt import CAVEAT, Grasp, grasp, write
from dmpcpp.grasp._execution import GraspLog, carry_out
from dmpcpp.grasp._film import film
from dmpcpp.grasp._film import refuse_format as refuse_format
from dmpcpp.grasp._planning import GraspPlan, Planner
from dmpcpp.grasp._reach import default_reach, longest_reach
from dmpcpp.grasp._task import Bottle, clutter, random_bottle
from dmpcpp.grasp._timing import PHASES
from dmpcpp.grasp._verdict import GraspTolerances, judge

__all__ = [
    "CAVEAT",
    "PHASES",
    "Bottle",
    "Grasp",
    "GraspLog",
    "GraspPlan",
    "GraspTolerances",
    "Planner",
    "carry_out",
    "clutter",
    "default_reach",
    "film",
    "grasp",
    "judge",
    "longest_reach",
    "random_bottle",
    "write",
]
