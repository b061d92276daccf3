"""The public address of `dmpcpp.learning.teach` and `dmpcpp.planning.placed`: from recordings to one model.

>>> from dmpcpp import recordings, teaching
>>> lesson = teaching.teach([recordings.clip("dance_b")])                 # doctest: +SKIP
>>> lesson.model, lesson.fit.rmse                                         # doctest: +SKIP
"""

from dmpcpp.learning import Lesson, teach
from dmpcpp.planning import placed

__all__ = ["Lesson", "placed", "teach"]
