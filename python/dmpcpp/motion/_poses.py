"""A recording as poses, quaternions and demonstrations; and what must hold for it to be one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings import Recording

if TYPE_CHECKING:
    from dmpcpp import PoseDemonstration
from numpy.typing import ArrayLike

__all__ = [
    "complete",
    "continuous",
    "demonstration",
    "known_quaternions",
    "poses",
    "positive",
    "quaternions",
    "relative_to",
    "relative_to_pose",
    "same_times",
    "turn_angles",
]


def complete(recording: Recording) -> Recording:
    """Return the recording if no sample of it is missing.

    Raises
    ------
    InvalidArgument
        Naming the first missing sample and how many there are.
    """
    missing = recording.missing
    if missing.any():
        k = int(np.argmax(missing))
        raise InvalidArgument(
            f"position[{k}]: missing at {recording.time[k]:.4g} s, one of {missing.sum()} of {len(recording)} samples; "
            "expected all of them. Fill or split the recording first: motion.fill, motion.split."
        )
    return recording


def poses(recording: Recording) -> Array:
    """Return the recording as poses (T, 4, 4): [R p; 0 1], body -> world, m; every sample must be there."""
    complete(recording)
    pose = np.tile(np.eye(4), (len(recording), 1, 1))
    pose[:, :3, :3] = recording.rotation
    pose[:, :3, 3] = recording.position
    return pose


def demonstration(recording: Recording) -> PoseDemonstration:
    """Return the recording as what `PoseDmp.fit` learns from; times in s, poses (T, 4, 4) in m.

    Samples that were filled in show the way, but count for nothing where noise is estimated.
    """
    from dmpcpp._core import PoseDemonstration

    whole = PoseDemonstration(recording.time, poses(recording))
    return whole if recording.measured.all() else whole.with_measured(recording.measured)


def turn_angles(recording: Recording) -> Array:
    """Return the angles (T-1,) in rad, 0 to pi, between consecutive orientations."""
    rotation = Rotation.from_matrix(complete(recording).rotation)
    return (rotation[:-1].inv() * rotation[1:]).magnitude()


def continuous(recording: Recording, limit: float = np.pi / 2) -> Recording:
    """Check that the orientation never jumps: between two samples a half turn cannot be told from its
    reverse.

    Parameters
    ----------
    recording : Recording
    limit : float
        Largest angle between consecutive samples [rad], 0 to pi.

    Returns
    -------
    Recording
        The same motion, its history with the largest angle.

    Raises
    ------
    InvalidArgument
        Naming the first sample that turns further from the one before.
    """
    positive("limit", limit)
    angles = turn_angles(recording)
    if angles.max() > limit:
        k = int(np.argmax(angles > limit)) + 1
        raise InvalidArgument(
            f"rotation[{k}]: turned by {np.degrees(angles[k - 1]):.1f} deg in "
            f"{recording.time[k] - recording.time[k - 1]:.4g} s at {recording.time[k]:.4g} s, expected at "
            f"most {np.degrees(limit):.1f} deg. Record at a higher rate, or cut the jump out."
        )
    return recording.with_(f"orientation continuous: at most {np.degrees(angles.max()):.1f} deg a sample")


def quaternions(*recordings: Recording) -> list[Array]:
    """Return the orientations as unit quaternions (T, 4), xyzw, of one sign within and across recordings.

    q and -q are one rotation: each quaternion lies in the hemisphere of the one before, and each recording starts
    in the hemisphere in which the first one starts. So they may be filtered, averaged and compared as numbers.
    """
    followed = [known_quaternions(complete(recording)) for recording in recordings]
    return [q if q[0] @ followed[0][0] >= 0.0 else -q for q in followed]


def known_quaternions(recording: Recording) -> Array:
    """Return the orientations as unit quaternions (T, 4), xyzw, NaN where missing, each in the hemisphere of the known
    one before."""
    known = ~recording.missing
    quaternion = np.full((len(recording), 4), np.nan)
    quaternion[known] = _followed(Rotation.from_matrix(recording.rotation[known]).as_quat())
    return quaternion


def positive(name: str, value: float) -> None:
    """Refuse what is not a positive finite number."""
    if not 0.0 < value < np.inf:
        raise InvalidArgument(f"{name}: {value}, expected a positive number.")


def same_times(recordings: Sequence[Recording], name: str = "recordings") -> None:
    """Refuse recordings whose times differ."""
    for k, recording in enumerate(recordings):
        if not np.array_equal(recording.time, recordings[0].time):
            raise InvalidArgument(f"{name}[{k}]: its times are not those of {name}[0]. Align or resample them first.")


def _followed(quaternion: Array) -> Array:
    """Return quaternions (T, 4), each in the hemisphere of the one before."""
    turns = np.einsum("ij,ij->i", quaternion[1:], quaternion[:-1]) < 0.0
    sign = np.concatenate(([1.0], np.where(np.cumsum(turns) % 2 == 1, -1.0, 1.0)))
    return quaternion * sign[:, None]


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
