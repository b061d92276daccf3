"""The public address of what `dmpcpp.planning` does before anything is learned: a motion placed before an arm.

>>> from dmpcpp import recordings, retarget
>>> dance = recordings.clip("dance_b")                     # doctest: +SKIP
>>> placement = retarget.place(dance, arm)                 # doctest: +SKIP
>>> placed = placement.apply_to(dance)                     # doctest: +SKIP
"""

from dmpcpp.planning import Accept, Placement, Reach, anchor, anchor_within_reach, place, reach

__all__ = ["Accept", "Placement", "Reach", "anchor", "anchor_within_reach", "place", "reach"]
