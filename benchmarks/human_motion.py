"""What real recordings of people ask of the library, figure by figure; DMPCPP_RECORDINGS names their folder.

Each function measures one recording and yields its figures, so that tests and `python -m benchmarks.recordings` ask the
same code.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import dmpcpp
import numpy as np
from dmpcpp import metrics, motion, recordings
from dmpcpp.recordings import Recording
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.signal import butter, find_peaks, sosfiltfilt
from scipy.spatial.transform import Rotation

from benchmarks.figures import Figure

Array = NDArray[np.float64]

_CYCLES = 20

LEARNED = 15
"""Of the reaches; the others are predicted."""

_SHAKE = 3.0  # Hz; a hand-held camera moves more slowly, what is faster is the tracker's noise
_RATE = 30.0  # Hz, of the tracker
_PLATE = ("hand_top", "hand_left", "hand_right")


# ---- one reach-and-grasp, twenty times: Qualisys --------------------------------------------------------


def grasping(folder: Path) -> tuple[Recording, Array]:
    """Return the hand's motion, and its distance (T,) [m] to the marker on the pillow that it grasps."""
    path = folder / "qualisys_dfki" / "recording.tsv"
    hand = recordings.load(path, markers=_PLATE, body="hand", up_axis="z")
    pillow = recordings.markers(path, up_axis="z").chosen(["pillow_top"])
    return hand, np.linalg.norm(hand.position - pillow.position[:, 0], axis=1)


def starts(parts: list[Recording]) -> list[float]:
    """Return when [s] each part begins in the recording that it was cut from."""
    return [float(part.history[-1].split(": ")[1].split(" ..")[0]) for part in parts]


def reaches(cycles: list[Recording], rest: float = 0.05) -> list[Recording]:
    """Return the way out of each cycle: up to its first rest, by the speed of the hand alone, in shares of its peak."""
    return [motion.segments(cycle, rest=rest, pause=0.0, angle_weight=0.0)[0] for cycle in cycles]


def repetitions(folder: Path) -> Iterator[Figure]:
    """Find the repetitions, and hold each against the hand's one approach to the pillow."""
    hand, distance = grasping(folder)
    cycles = motion.cycles(hand)
    yield Figure("reach and grasp: repetitions missed of 20", abs(len(cycles) - _CYCLES), 0, "")
    grasps = hand.time[find_peaks(-distance, prominence=0.1)[0]]
    spans = [(begin, begin + cycle.duration) for begin, cycle in zip(starts(cycles), cycles, strict=True)]
    odd = [(begin, end) for begin, end in spans if ((begin < grasps) & (grasps < end)).sum() != 1]
    yield Figure("reach and grasp: repetitions without exactly one approach to the pillow", len(odd), 0, "")


def prediction(folder: Path) -> Iterator[Figure]:
    """Predict reaches from their start, goal and duration: five by the fifteen before them, and each by all others,
    learned together, beside the single ones.
    """
    hand, _ = grasping(folder)
    parts = reaches(motion.cycles(hand))
    lessons = [motion.demonstration(part) for part in parts]
    single = singly(parts)
    together = float(np.mean(_predicted(lessons[:LEARNED], parts[LEARNED:])))
    alone = single[:LEARNED, LEARNED:].mean(axis=1)
    yield Figure("reaches 16-20 predicted by 1-15 together; goal: the best single reach", together, alone.min(), "mm")
    yield Figure("the same; goal: the mean of the single reaches", together, alone.mean(), "mm")
    others = [_predicted(lessons[:k] + lessons[k + 1 :], [part])[0] for k, part in enumerate(parts)]
    each = float(np.mean(others))
    alone = np.nanmean(single, axis=1)
    yield Figure("each of the 20 by the 19 others together; goal: the best single one of all", each, alone.min(), "mm")
    yield Figure("the same; goal: the mean of the single reaches", each, alone.mean(), "mm")


def singly(parts: list[Recording]) -> Array:
    """Return the RMSE [mm] with which each reach alone (row) predicts each other one (column); NaN for itself."""
    errors = np.array([_predicted([motion.demonstration(lesson)], parts) for lesson in parts])
    np.fill_diagonal(errors, np.nan)
    return errors


def _predicted(lessons: list[dmpcpp.PoseDemonstration], asked: list[Recording]) -> list[float]:
    """Return the RMSE [mm] of positions of each reach asked for."""
    model = dmpcpp.PoseDmp.fit(lessons, scaling="rotation_dilation")
    return [prediction_error(model, part) for part in asked]


def prediction_error(model: dmpcpp.PoseDmp, part: Recording) -> float:
    """Return the RMSE [mm] of the positions of a reach, predicted from its start, goal and duration."""
    run = dmpcpp.PoseRun(model)
    poses = motion.poses(part)
    run.duration = part.duration
    run.goal = poses[-1]
    run.start_from(poses[0], np.zeros(6))
    reached = [run.position]
    for dt in np.diff(part.time):
        run.step(dt)
        reached.append(run.position)
    return 1e3 * _rms(np.array(reached) - part.position)


# ---- one motion, by motion capture and by SLAM: TUM -----------------------------------------------------


def tracking(folder: Path) -> tuple[Recording, Callable[[Array], tuple[float, float]]]:
    """Return the tracker's recording; and what tells of positions (T, 3) at its times how far they are from the motion
    capture [mm]: in all, and above 3 Hz.
    """
    truth = np.loadtxt(folder / "tum_evo" / "freiburg1_xyz-groundtruth.txt")
    tracked = recordings.load(folder / "tum_evo" / "freiburg1_xyz-rgbdslam.txt")
    at = np.loadtxt(folder / "tum_evo" / "freiburg1_xyz-rgbdslam.txt")[:, 0]
    both = (at >= truth[0, 0]) & (at <= truth[-1, 0])
    there = CubicSpline(truth[:, 0], truth[:, 1:4])(at[both])

    def errors(position: Array) -> tuple[float, float]:
        return _total_and_shake(_onto(position[both], there) - there, at[both])

    return tracked, errors


def learned_calmly(tracked: Recording, cutoff: float, basis_count: int) -> Array:
    """Return the positions (T, 3) at the recording's times of what is learned from it after a low-pass [Hz]."""
    calm = motion.prepare(tracked, motion.Preparation(resample=_RATE, low_pass=cutoff))
    model = dmpcpp.PoseDmp.fit(motion.demonstration(calm), basis_count=basis_count)
    return np.asarray(model.rollout_at(np.minimum(tracked.time, calm.duration)).pose[:, :3, 3])


def tracking_noise(folder: Path) -> Iterator[Figure]:
    """Hold what was learned from a noisy tracker against the motion capture of the same motion."""
    tracked, errors = tracking(folder)
    total, shake = errors(tracked.position)
    yield Figure("SLAM recording against motion capture", total, 13.6, "mm")
    yield Figure("SLAM recording above 3 Hz", shake, 3.7, "mm")
    raw = dmpcpp.PoseDmp.fit(motion.demonstration(tracked), basis_count=400, derivatives="smooth")
    kept = errors(raw.rollout_at(tracked.time).pose[:, :3, 3])[1]
    yield Figure("learned from it without a low-pass, N = 400, above 3 Hz; goal: the recording's", kept, shake, "mm")
    for count in (100, 400):
        learned, left = errors(learned_calmly(tracked, _SHAKE, count))
        yield Figure(
            f"learned from it, N = {count}, above 3 Hz; goal: a third of the recording's", left, shake / 3, "mm"
        )
        yield Figure(f"learned from it, N = {count}, in all; goal: the recording's", learned, total, "mm")


def _onto(position: Array, truth: Array) -> Array:
    """Return positions (T, 3) after the rigid motion that brings them closest to the truth."""
    offset, middle = position.mean(axis=0), truth.mean(axis=0)
    turn, _ = Rotation.align_vectors(truth - middle, position - offset)
    return turn.apply(position - offset) + middle


def _total_and_shake(error: Array, at: Array) -> tuple[float, float]:
    """Return the RMSE [mm] of errors (T, 3), and what of it is faster than 3 Hz (zero-phase Butterworth, order 2)."""
    even = np.arange(at[0], at[-1], 1 / _RATE)
    fast = sosfiltfilt(butter(2, _SHAKE, "high", fs=_RATE, output="sos"), CubicSpline(at, error)(even), axis=0)
    return 1e3 * _rms(error), 1e3 * _rms(fast)


# ---- nine pourings --------------------------------------------------------------------------------------


def pourings(folder: Path) -> list[Recording]:
    """Return the nine demonstrations of pouring; they came without times: 100 Hz."""
    path = folder / "robotasks_clfd" / "pouring.npy"
    return [
        recordings.load(path, rate=100, quat_order="wxyz", unit="cm", up_axis="z", index=index) for index in range(9)
    ]


def spread_of_demonstrations(folder: Path) -> Iterator[Figure]:
    """Measure the spread of the demonstrations about their mean, as they came and aligned."""
    apart = pourings(folder)
    yield Figure("nine pourings about their mean, as they came", 1e3 * motion.spread(apart).position, 34.9, "mm")
    together = motion.aligned(apart)
    yield Figure("nine pourings about their mean, aligned", 1e3 * motion.spread(together).position, 25.0, "mm")


def mean_executed(folder: Path, arm: str = "panda") -> Iterator[Figure]:
    """Carry the mean of the demonstrations out on a simulated arm."""
    from dmpcpp import arms, imitation

    run = imitation.imitate(motion.mean(motion.aligned(pourings(folder))), arms.find(arm))
    failed = [check.name for check in run.checks if not check.ok]
    yield Figure(f"mean of nine pourings on {arm}: checks that fail", len(failed), 0, "")
    tracked = run.stages["ik_to_executed"].position_rmse
    yield Figure(f"mean of nine pourings on {arm}: tracking RMSE", 1e3 * tracked, 0.5, "mm")


# ---- time -----------------------------------------------------------------------------------------------


def alignment_time() -> Iterator[Figure]:
    """Time the warping of 1000 on 1000 poses, and both distances of 300 and 300 points, in one thread."""
    share = np.linspace(0.0, 1.0, 1000)
    a, b = _gesture(share), _gesture(share**1.2)
    yield Figure("align 1000 x 1000 poses", _milliseconds(lambda: dmpcpp.align(a, b)), 20.0, "ms")
    p, q = a[:900:3, :3, 3], b[:900:3, :3, 3]
    for measure in (metrics.dtw, metrics.frechet):
        yield Figure(f"{measure.__name__} 300 x 300 points", _milliseconds(partial(measure, p, q)), 3.0, "ms")


def _gesture(share: Array) -> Array:
    poses = np.tile(np.eye(4), (len(share), 1, 1))
    poses[:, :3, 3] = np.c_[np.sin(5 * share), np.cos(3 * share), share]
    poses[:, :3, :3] = Rotation.from_rotvec(np.outer(share, [2.0, 1.0, 1.0])).as_matrix()
    return poses


def _milliseconds(work: Callable[[], object]) -> float:
    taken = []
    for _ in range(9):
        begin = time.thread_time()
        work()
        taken.append(time.thread_time() - begin)
    return 1e3 * float(np.median(taken))


def _rms(offset: Array) -> float:
    return float(np.sqrt(np.mean(np.sum(offset**2, axis=1))))
