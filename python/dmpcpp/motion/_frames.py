"""A motion seen from another frame: the chest, the shoulder, an object."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._poses import complete
from dmpcpp.recordings._recording import Recording

__all__ = ["relative_to", "relative_to_pose"]


def relative_to(recording: Recording, reference: Recording) -> Recording:
    """Express the motion in the moving frame of another body of the same recording, the chest for instance.

    Raises
    ------
    InvalidArgument
        The two do not have the same times.
    """
    if recording.time.shape != reference.time.shape or not np.array_equal(recording.time, reference.time):
        raise InvalidArgument("reference: its times are not those of the recording. Resample both alike.")
    complete(recording)
    complete(reference)
    inverse = np.swapaxes(reference.rotation, 1, 2)
    offset = recording.position - reference.position
    rotation = Rotation.from_matrix(inverse @ recording.rotation)  # rounding of the product taken out
    return recording.with_(
        f"relative to {reference.body}",
        position=np.einsum("kij,kj->ki", inverse, offset),
        rotation=rotation.as_matrix(),
    )


def relative_to_pose(recording: Recording, pose: ArrayLike, name: str = "a fixed frame") -> Recording:
    """Express the motion in a frame that stands still: an object, or the shoulder of someone who sits.

    Parameters
    ----------
    pose : array_like (4, 4)
        [R p; 0 1], frame -> the recording's world, m.
    name : str
        Of the frame, for the history.

    Raises
    ------
    InvalidArgument
        A pose that is none, or missing samples.
    """
    pose = np.asarray(pose, dtype=np.float64)
    if pose.shape != (4, 4) or not np.isfinite(pose).all():
        raise InvalidArgument(f"pose: shape {pose.shape}, expected (4, 4) finite numbers.")
    turn = pose[:3, :3]
    if np.abs(turn.T @ turn - np.eye(3)).max() > 1e-6 or np.linalg.det(turn) < 0.0:
        raise InvalidArgument("pose: its rotation is not proper, expected R^T R = I and det(R) = +1.")
    complete(recording)
    up = recording.up_axis
    stays_up = up is not None and turn["xyz".index(up), "xyz".index(up)] > 1.0 - 1e-9
    return recording.with_(
        f"relative to {name}",
        position=(recording.position - pose[:3, 3]) @ turn,
        rotation=Rotation.from_matrix(turn.T @ recording.rotation).as_matrix(),
        up_axis=up if stays_up else None,
    )
