"""The whole flow in one call: a recorded motion, placed, learned, solved, slowed to the limits and executed.

>>> from dmpcpp import arms, imitation, recordings
>>> run = imitation.imitate(recordings.clip("dance_b"), arms.find("panda"))   # doctest: +SKIP
>>> run.ok, run.stages["ik_to_executed"].position_rmse                        # doctest: +SKIP

Every stage is a value that can be looked at on its own; each step here is one call into the module that does it.
"""

from dmpcpp.imitation._files import write
from dmpcpp.imitation._flow import STAGES, Imitation, PlacementPolicy, Progress, clear_of_itself, imitate
from dmpcpp.learning import learn

__all__ = ["STAGES", "Imitation", "PlacementPolicy", "Progress", "clear_of_itself", "imitate", "learn", "write"]
