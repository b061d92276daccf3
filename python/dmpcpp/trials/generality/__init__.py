"""Does it work in general? Random motions, goals, tempi, arms and noise: learned, solved and executed.

>>> from dmpcpp import generality
>>> wanted = generality.trials(20, ["panda", "iiwa"])                      # doctest: +SKIP
>>> results = generality.run(wanted, "trials.jsonl", jobs=2)               # doctest: +SKIP
>>> generality.summary(results)["share_passed"]                           # doctest: +SKIP
"""

from dmpcpp.trials.generality._motions import NOISE, Change, Noise, noisy, random_change, random_motion
from dmpcpp.trials.generality._series import kept, run, trials
from dmpcpp.trials.generality._table import GOAL, Distribution, Row, rows, summary
from dmpcpp.trials.generality._trial import Result, Trial, attempt

__all__ = [
    "GOAL",
    "NOISE",
    "Change",
    "Distribution",
    "Noise",
    "Result",
    "Row",
    "Trial",
    "attempt",
    "kept",
    "noisy",
    "random_change",
    "random_motion",
    "rows",
    "run",
    "summary",
    "trials",
]
