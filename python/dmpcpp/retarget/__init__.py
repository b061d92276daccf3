"""A person's workspace onto a robot's: one similarity transform for the whole motion, and the search for it.

>>> from dmpcpp import recordings, retarget
>>> dance = recordings.clip("dance_b")                     # doctest: +SKIP
>>> placement = retarget.place(dance, arm)                 # doctest: +SKIP
>>> placed = placement.apply_to(dance)                     # doctest: +SKIP
"""

from dmpcpp.retarget.anchoring import Reach, anchor, anchor_within_reach, reach
from dmpcpp.retarget.following import Accept
from dmpcpp.retarget.placement import Placement
from dmpcpp.retarget.search import place

__all__ = ["Accept", "Placement", "Reach", "anchor", "anchor_within_reach", "place", "reach"]
