"""Ordinary cameras as a measuring instrument: videos of a hand, or of a printed tag, to poses.

Two cameras measure to millimetres; one camera gives a sketch, which is marked as one. `cv2` and the nets' runtime are
imported where a video is opened, not before: the geometry works without them.
"""

from dmpcpp.cameras._accuracy import Accuracy, accuracy_of
from dmpcpp.cameras._band import band_of, even_times, smoothed
from dmpcpp.cameras._boards import Board, board_of, charuco, stand_of_board
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._fit import Motion
from dmpcpp.cameras._frames import Video, open_video
from dmpcpp.cameras._hand_model import GET, net_files
from dmpcpp.cameras._hand_model import get as get_hand_model
from dmpcpp.cameras._landmarks import CHAIN, PALM, Landmarks, chain_length
from dmpcpp.cameras._one_view import Quality, fit_one_view
from dmpcpp.cameras._palm import kabsch, palm_frame
from dmpcpp.cameras._poses import HandSetup, Poses, hand_poses, poses_of_views
from dmpcpp.cameras._relation import Relation, relate
from dmpcpp.cameras._setup import camera_from_file, hand_length, relation_from_file
from dmpcpp.cameras._sheet import print_board, print_tags
from dmpcpp.cameras._synchronise import Shift, paired_rays, synchronise
from dmpcpp.cameras._tag_poses import TagSetup, tag_poses
from dmpcpp.cameras._tags import Tag, TagFinder, body_of_tags
from dmpcpp.cameras._tracker import Seen, Tracker
from dmpcpp.cameras._two_views import fit_two_views, triangulate
from dmpcpp.cameras._units import angle
from dmpcpp.cameras._viewfinder import Viewfinder
from dmpcpp.cameras._watch import Watched, watch_hand

__all__ = [
    "CHAIN",
    "GET",
    "PALM",
    "Accuracy",
    "Board",
    "Camera",
    "HandSetup",
    "Landmarks",
    "Motion",
    "Poses",
    "Quality",
    "Relation",
    "Seen",
    "Shift",
    "Tag",
    "TagFinder",
    "TagSetup",
    "Tracker",
    "Video",
    "Viewfinder",
    "Watched",
    "accuracy_of",
    "angle",
    "band_of",
    "board_of",
    "body_of_tags",
    "camera_from_file",
    "chain_length",
    "charuco",
    "even_times",
    "fit_one_view",
    "fit_two_views",
    "get_hand_model",
    "hand_length",
    "hand_poses",
    "kabsch",
    "net_files",
    "open_video",
    "paired_rays",
    "palm_frame",
    "poses_of_views",
    "print_board",
    "print_tags",
    "relate",
    "relation_from_file",
    "smoothed",
    "stand_of_board",
    "synchronise",
    "tag_poses",
    "triangulate",
    "watch_hand",
]
