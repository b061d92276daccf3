"""Pictures: of a motion that an arm carried out, and of an experiment that was reproduced.

Functions draw into matplotlib axes that they are given and return them; `picture` composes a whole page into a file,
`figure` and `save` are there for pages of your own. Nothing here touches `matplotlib.pyplot` or its state. Colours are
those of Okabe and Ito ("Color Universal Design", 2008), told apart with every kind of colour vision; every series
differs in its stroke as well.
"""

from dmpcpp.show.plot._execution import ErrorCurve, angle_error, paths, picture, position_error
from dmpcpp.show.plot._learning import phase, spread
from dmpcpp.show.plot._page import INK as INK
from dmpcpp.show.plot._page import LEGEND as LEGEND
from dmpcpp.show.plot._page import figure, png, save, svg
from dmpcpp.show.plot._recorded import recorded
from dmpcpp.show.plot._robot import joint_shares, shape
from dmpcpp.show.plot._series import (
    activations,
    coordinates,
    errors_over_noise,
    path_3d,
    rotation_entries,
    series_errors,
)

__all__ = [
    "ErrorCurve",
    "activations",
    "angle_error",
    "coordinates",
    "errors_over_noise",
    "figure",
    "joint_shares",
    "path_3d",
    "paths",
    "phase",
    "picture",
    "png",
    "position_error",
    "recorded",
    "rotation_entries",
    "save",
    "series_errors",
    "shape",
    "spread",
    "svg",
]
