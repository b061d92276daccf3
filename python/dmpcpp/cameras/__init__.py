"""Ordinary cameras as a measuring instrument: videos of a hand, or of a printed tag, to poses.

Two cameras measure to millimetres; one camera gives a sketch, which is marked as one. `cv2` and the nets' runtime are
imported where a video is opened, not before: the geometry works without them.
"""

from dmpcpp.cameras._accuracy import Accuracy, accuracy_of
from dmpcpp.cameras._band import band_of, even_times, smoothed
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._fit import Motion
from dmpcpp.cameras._landmarks import CHAIN, PALM, Landmarks, chain_length
from dmpcpp.cameras._one_view import Quality, fit_one_view
from dmpcpp.cameras._palm import kabsch, palm_frame
from dmpcpp.cameras._relation import Relation, relate
from dmpcpp.cameras._synchronise import Shift, paired_rays, synchronise
from dmpcpp.cameras._two_views import fit_two_views, triangulate

__all__ = [
    "CHAIN",
    "PALM",
    "Accuracy",
    "Camera",
    "Landmarks",
    "Motion",
    "Quality",
    "Relation",
    "Shift",
    "accuracy_of",
    "band_of",
    "chain_length",
    "even_times",
    "fit_one_view",
    "fit_two_views",
    "kabsch",
    "paired_rays",
    "palm_frame",
    "relate",
    "smoothed",
    "synchronise",
    "triangulate",
]
