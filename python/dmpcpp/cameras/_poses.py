"""From videos of a hand to its poses in a level world, band-limited, with what is known about their accuracy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.cameras._accuracy import Accuracy, accuracy_of, accuracy_of_one
from dmpcpp.cameras._band import band_of, even_times, smoothed
from dmpcpp.cameras._boards import Board, stand_of_board
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._fit import Motion
from dmpcpp.cameras._frames import Video, open_video
from dmpcpp.cameras._landmarks import Landmarks, chain_length
from dmpcpp.cameras._one_view import fit_one_view
from dmpcpp.cameras._palm import kabsch
from dmpcpp.cameras._relation import Relation, relate
from dmpcpp.cameras._setup import level_world, require_up
from dmpcpp.cameras._synchronise import Shift, paired_rays, synchronise
from dmpcpp.cameras._tags import up_of_tag
from dmpcpp.cameras._two_views import fit_two_views, triangulate
from dmpcpp.cameras._watch import Watched, watch_hand
from dmpcpp.errors import InvalidArgument, within

__all__ = ["Found", "HandSetup", "Poses", "band_limited", "hand_poses", "poses_of_views"]

_CHAIN = 0.94
"""The net's hand, wrist to fingertip, over the true one: found on rendered hands."""

_UNSURE_SCALE = 0.03  # relative, of a stated hand length and that factor
_SAME_MOTION = 3.0  # reprojection in deviations, above which two views do not show one hand
_MOST_MOVED = 0.006  # of the picture's width
_LONGEST_GAP = 0.25  # s; what is longer is missing
_LEAST_TOGETHER = 1.0  # s
_PARTS = 5  # of the time, left out one by one to see what the relation of the cameras hangs on


@dataclass(frozen=True, eq=False)
class Poses:
    """Poses of a body at even times.

    `time` (T,) [s] from 0, `rotation` (T, 3, 3), `position` (T, 3) [m], NaN where missing; `up_axis` of their world;
    `notes` what was done; `accuracy` what is known; `approximate` why they are a sketch, "" where they are not;
    `begin` [s] what the first video's clock shows at time 0.
    """

    time: Array
    rotation: Array
    position: Array
    up_axis: str
    notes: tuple[Note, ...]
    accuracy: Accuracy
    approximate: str = ""
    begin: float = 0.0


@dataclass(frozen=True)
class HandSetup:
    """What is stated about videos of a hand.

    Attributes
    ----------
    cameras : callable
        Returns the camera of the k-th video for a size (width, height).
    hand_length : float or None
        m; None only where a board or `relation` gives the scale.
    relation : Relation or None
        How the cameras stand, where that is stated.
    board : Board or None
        One that lies still in both pictures.
    up : str
        See `level_world`; "board" and "tag:ID" are looked for in the first video.
    pitch : str, float or None
    hand : "left", "right" or None
    mirrored : bool
    """

    cameras: Callable[[int, tuple[int, int]], Camera]
    hand_length: float | None
    up: str
    relation: Relation | None = None
    board: Board | None = None
    pitch: str | float | None = None
    hand: str | None = None
    mirrored: bool = False


def hand_poses(paths: list[Path], setup: HandSetup) -> Poses:
    """Return the poses of a hand from one video or two.

    Raises
    ------
    FileError, InvalidArgument
        A video cannot be read, shows no hand or another one, or the two do not show the same motion.
    MissingDependency
        OpenCV or the hand model is missing.
    """
    require_up(setup.up)
    videos = [open_video(path) for path in paths]
    relation, normal = _stand(videos, setup)
    watched = []
    for k, video in enumerate(videos):
        camera = setup.cameras(k, video.size)
        try:
            watched.append(watch_hand(video, camera, hand=setup.hand, mirrored=setup.mirrored))
        except InvalidArgument as error:
            raise within(video.path.name, error) if len(videos) > 1 else error from None
    left = setup.hand == "left"  # tracked as a right one, in a mirror
    relation = relation or setup.relation
    relation = _in_mirror(relation) if left and relation is not None else relation
    found = poses_of_views([each.landmarks for each in watched], setup, relation, normal)
    poses = _mirrored(found, setup) if left else found
    return _with_notes(poses, watched)


def poses_of_views(
    views: list[Landmarks], setup: HandSetup, relation: Relation | None = None, normal: Array | None = None
) -> Poses:
    """Return the poses from landmarks of one view or two; `relation` and `normal` (up) as a board showed them."""
    found = _two(views[0], views[1], setup, relation or setup.relation) if len(views) == 2 else _one(views[0], setup)
    turn, axis, words = level_world(setup.up, setup.pitch, normal)
    return band_limited(found, turn, axis, words)


@dataclass(frozen=True, eq=False)
class Found:
    """A fit with its times, which frames were seen, the noise of a position (T, N) [m], what is to tell, and
    the highest cutoff [Hz]."""

    time: Array
    motion: Motion
    seen: NDArray[np.bool_]
    noise: Array
    accuracy: Accuracy
    notes: list[Note]
    approximate: str = ""
    highest: float = 6.0


def _two(first: Landmarks, second: Landmarks, setup: HandSetup, relation: Relation | None) -> Found:
    shift = synchronise(first, second, relation)
    if shift is None:
        raise _different(first, second)
    notes = [Note("changed", _shift_words(shift, first, second))]
    unsure, bent = 0.0, 0.0
    if relation is None:
        relation, unsure = _related(first, second, shift, setup), _UNSURE_SCALE
        bent = _bent(first, second, shift, setup, relation)
        notes.append(
            Note(
                "changed",
                f"cameras related by the hand: {np.degrees(relation.angle):.3g} deg and "
                f"{1e3 * np.linalg.norm(relation.translation):.4g} mm apart; scale by the stated hand length",
            )
        )
    other = second.at(shift.second(first.time))
    inside = (other.time >= second.time[0]) & (other.time <= second.time[-1])
    first, other = first.part(inside), other.part(inside)
    if len(first.time) < 8 or first.time[-1] - first.time[0] < _LEAST_TOGETHER:
        raise InvalidArgument(
            f"{first.name} and {second.name} show the same time for {np.ptp(first.time) if len(first.time) else 0:.2g} "
            f"s, expected {_LEAST_TOGETHER:g} s at least. Start both before the motion."
        )
    seen = first.found | other.found
    motion = fit_two_views(first, other, relation)
    error = [float(np.sqrt(np.nanmean(each**2))) for each in motion.error]
    if max(error) > _SAME_MOTION:
        raise _different(first, second)
    chain = chain_length(triangulate(first.rays, other.rays, relation))
    notes.append(_two_words(first, other, motion, error))
    if unsure == 0.0 and setup.hand_length is not None:
        notes += _length_doubts(chain, setup.hand_length)
    accuracy = accuracy_of(motion, unsure)
    accuracy = Accuracy(float(np.hypot(accuracy.position, bent)), accuracy.angle)
    return Found(first.time, motion, seen, _position_noise(motion), accuracy, notes)


def _related(first: Landmarks, second: Landmarks, shift: Shift, setup: HandSetup) -> Relation:
    """Return the relation in m, by the hand's length."""
    a, b = paired_rays(first, second, shift)
    found = relate(a, b, second.deviation)
    if found is None or setup.hand_length is None:
        raise _different(first, second)
    other = second.at(shift.second(first.time))
    chain = chain_length(triangulate(first.rays, other.rays, found))
    return Relation(found.rotation, found.translation * _CHAIN * setup.hand_length / chain, found.error)


def _bent(first: Landmarks, second: Landmarks, shift: Shift, setup: HandSetup, relation: Relation) -> float:
    """Return how far the cameras' relation may bend the path [m rms]: a jackknife over parts of time.

    Source: B. Efron, The jackknife, the bootstrap and other resampling plans (1982). A part lasts longer than errors of
    landmarks do.
    """
    whole = _middles(first, second, shift, relation)
    squares = 0.0
    for part in np.array_split(np.arange(len(first.time)), _PARTS):
        pixels = first.pixels.copy()
        pixels[part] = np.nan
        try:
            other = _middles(first, second, shift, _related(replace(first, pixels=pixels), second, shift, setup))
        except InvalidArgument:
            return float(np.linalg.norm(np.ptp(whole, axis=0)))
        turn, place = kabsch(other, whole[None])
        squares += float(np.mean(np.sum((other @ turn[0].T + place[0] - whole) ** 2, axis=1)))
    return float(np.sqrt((_PARTS - 1) / _PARTS * squares))


def _middles(first: Landmarks, second: Landmarks, shift: Shift, relation: Relation) -> Array:
    """Return the knuckle of the middle finger (N, 3) in the frames that both saw."""
    path = triangulate(first.rays[:, 9], second.at(shift.second(first.time)).rays[:, 9], relation)
    return path[np.isfinite(path).all(axis=1)]


def _one(view: Landmarks, setup: HandSetup) -> Found:
    assert setup.hand_length is not None
    inside = np.flatnonzero(view.found)
    view = view.part(slice(inside[0], inside[-1] + 1))
    motion, quality = fit_one_view(view, setup.hand_length / chain_length(view.world))
    if not quality.ok:
        raise InvalidArgument(
            f"this camera does not see the hand well enough for one view: {quality.why}. Turn the open palm to the "
            "camera, add a second camera, or put a printed tag on the hand (tag='0:60mm')."
        )
    accuracy = accuracy_of_one(motion)
    said = (
        f"approximate: one camera is a sketch, its depth hangs on the hand's size in the picture; estimated "
        f"{1e3 * accuracy.position:.2g} mm and {np.degrees(accuracy.angle):.2g} deg rms. A second camera or a tag "
        "measures"
    )
    notes = [Note("changed", f"{view.name}: hand found in {int(view.found.sum())} of {len(view.time)} frames"),
             Note("warning", said, about="approximate")]  # fmt: skip
    return Found(view.time, motion, view.found, _position_noise(motion), accuracy, notes, said)


def band_limited(found: Found, turn: Array, axis: str, words: str) -> Poses:
    """Return fitted poses at even times in a level world, without what is faster than the motion."""
    cutoff = band_of(found.time, found.motion.position, found.noise, found.highest)
    wanted = even_times(found.time, cutoff)
    rotation, position = smoothed(found.time, found.motion.rotation, found.motion.position, cutoff, wanted)
    back = np.stack([np.interp(found.time, wanted, column) for column in position.T], axis=1)
    moved = np.sqrt(np.mean(np.sum((back - found.motion.position) ** 2, axis=1)))
    lost = _in_gaps(found.time, found.seen, wanted)
    rotation, position = turn @ rotation, position @ turn.T
    rotation[lost], position[lost] = np.nan, np.nan
    notes = [
        *found.notes,
        Note("changed", f"band-limited at {cutoff:.2g} Hz, samples moved by {1e3 * moved:.2g} mm rms, evenly sampled"),
        Note("changed", words),
    ]
    if not found.approximate:
        said = f"{1e3 * found.accuracy.position:.2g} mm and {np.degrees(found.accuracy.angle):.2g} deg rms"
        notes.append(Note("changed", f"estimated accuracy: {said}, but for a constant offset of the hand"))
    if lost.any():
        notes.append(Note("changed", f"{int(lost.sum())} of {len(lost)} samples are missing: no camera saw the hand"))
    return Poses(
        wanted - wanted[0], rotation, position, axis, tuple(notes), found.accuracy, found.approximate, float(wanted[0])
    )


def _in_gaps(time: Array, seen: NDArray[np.bool_], wanted: Array) -> NDArray[np.bool_]:
    """Return which wanted times lie in a gap between frames seen, where that is longer than 0.25 s."""
    known = time[seen]
    k = np.searchsorted(known, wanted)
    inside = (k > 0) & (k < len(known))
    before, behind = known[np.clip(k - 1, 0, len(known) - 1)], known[np.clip(k, 0, len(known) - 1)]
    exact = np.isclose(behind, wanted) | np.isclose(before, wanted)
    return np.asarray(((behind - before > _LONGEST_GAP) & inside | ~inside) & ~exact)


def _position_noise(motion: Motion) -> Array:
    """Return what the landmarks' errors are in a position (T, N) [m]."""
    scale = np.sqrt(np.median(motion.variance[:, 3:].mean(axis=1)))
    return np.asarray(scale * np.nan_to_num(motion.error).transpose(1, 0, 2, 3).reshape(len(motion.position), -1))


def _stand(videos: list[Video], setup: HandSetup) -> tuple[Relation | None, Array | None]:
    """Return how the cameras stand by a board, and which way is up by what lies on the table."""
    relation, normal = None, None
    if setup.board is not None:
        stands = [stand_of_board(video, setup.cameras(k, video.size), setup.board) for k, video in enumerate(videos)]
        if len(stands) == 2:
            (r1, t1), (r2, t2) = stands
            relation = Relation(r2 @ r1.T, t2 - r2 @ r1.T @ t1)
        normal = _towards_camera(stands[0][0][:, 2], stands[0][1])
    if setup.up == "board" and normal is None:
        raise InvalidArgument("up_axis: 'board', but no board is stated. State board='5x7:30mm'.")
    if setup.up.startswith("tag:"):
        normal = up_of_tag(videos[0], setup.cameras(0, videos[0].size), setup.up)
    return relation, normal


def _towards_camera(normal: Array, place: Array) -> Array:
    return -normal if normal @ place > 0.0 else normal


def _in_mirror(relation: Relation) -> Relation:
    flip = np.diag([-1.0, 1.0, 1.0])
    return Relation(flip @ relation.rotation @ flip, flip @ relation.translation, relation.error)


def _mirrored(poses: Poses, setup: HandSetup) -> Poses:
    """Return the poses of a left hand that was tracked in a mirror.

    The world is mirrored back sideways. A left hand's frame is the mirror image of a right one's, its y axis turned
    about, so that it is a rotation.
    """
    side = {"x": 0, "y": 0, "z": 1}[poses.up_axis] if setup.up not in ("x", "y", "z") else 0
    flip = np.ones(3)
    flip[side] = -1.0
    rotation = flip[:, None] * poses.rotation * np.array([1.0, -1.0, 1.0])
    return replace(poses, rotation=rotation, position=flip * poses.position)


def _with_notes(poses: Poses, watched: list[Watched]) -> Poses:
    notes = list(poses.notes)
    for each in watched:
        if each.moved > _MOST_MOVED:
            name = each.landmarks.name
            said = (
                f"{name}: the background moves by {100 * each.moved:.2g} % of the picture: the camera moved, or its "
                "stabilisation is on. Fix the camera and turn stabilisation off"
            )
            notes.append(Note("warning", said))
    return replace(poses, notes=tuple(notes))


def _shift_words(shift: Shift, first: Landmarks, second: Landmarks) -> str:
    start = shift.shift - (second.time[0] - first.time[0])
    later = f"{second.name} shows a moment {abs(start):.3f} s {'later' if start > 0 else 'earlier'} than {first.name}"
    return later + (f"; the clocks drift by {1e6 * shift.drift:.0f} us a second" if shift.drift else "")


def _two_words(first: Landmarks, second: Landmarks, motion: Motion, error: list[float]) -> Note:
    pixels = [e * view.deviation * view.camera.focal for e, view in zip(error, (first, second), strict=True)]
    counts = f"{int(first.found.sum())} and {int(second.found.sum())} of {len(first.time)}"
    return Note(
        "changed",
        f"{first.name}, {second.name}: hand found in {counts} frames; a rigid palm misses the landmarks by "
        f"{pixels[0]:.2g} and {pixels[1]:.2g} px rms",
    )


def _length_doubts(chain: float, stated: float) -> list[Note]:
    """Return a warning where the measured hand is not the stated one."""
    measured = chain / _CHAIN
    if abs(measured / stated - 1.0) <= 0.15:
        return []
    said = (
        f"the cameras measure a hand of {1e3 * measured:.0f} mm, stated are {1e3 * stated:.0f} mm: the measured counts"
    )
    return [Note("warning", said, about="hand_length")]


def _different(first: Landmarks, second: Landmarks) -> InvalidArgument:
    return InvalidArgument(
        f"second_view: {second.name} does not show the same hand motion as {first.name}: no shift within 10 s makes "
        "the two agree. Give two videos of one motion, from cameras that stand still 25 to 90 deg apart."
    )
