"""What makes samples doubtful in any format: zeros and held values in place of lost ones, jumps, mixed bodies.

Every reader asks these checks before anything is computed from its samples. Thresholds are in terms of the motion
itself, so that positions may be in any unit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import NotStated

__all__ = ["Jump", "check_one_body", "held_values", "jumps", "lost_zeros", "zero_note"]

Mask = NDArray[np.bool_]
Jump = tuple[int, float]
"""The sample before a jump, and how far it goes [m]."""

_ZERO_JUMP = 3.0  # times the largest other step: no one starts or stops that suddenly at the very origin
_HELD_POINTS, _HELD_POSES = 5, 3  # samples of one value that no moving hand gives
_HELD_JUMP = 5.0  # usual steps; what moves on after a longer one was hidden, not at rest
_FAST, _FAR, _SUDDEN, _ALONE = 30.0, 0.05, 10.0, 5.0  # m/s, m, times the 99th percentile, times the neighbours
_BACK_STEP, _BACK_COSINE, _BACK_SHARE, _BACK_COUNT = 0.005, -0.5, 0.1, 8  # m; see check_one_body
_BACK_NEAR = 4.0  # times closer than the next sample is one of the following ones


def lost_zeros(position: Array, known: Mask | None = None) -> Mask:
    """Return which samples (T,) of positions (T, 3) are exactly 0, 0, 0 where the others are far from it.

    Such samples stand for lost ones. A motion that passes through the origin, or starts there, keeps its zeros: there
    the step to them is like the other steps. A point that is 0 throughout is lost throughout only for markers, see
    `zero_note`.
    """
    known = np.asarray(~np.isnan(position).any(axis=1)) if known is None else known
    zero = known & (position == 0.0).all(axis=1)
    if not zero.any() or zero[known].all():
        return np.zeros(len(position), dtype=bool)
    steps = np.linalg.norm(np.diff(position, axis=0), axis=1)
    both = known[1:] & known[:-1]
    edges, within = both & (zero[1:] != zero[:-1]), both & ~zero[1:] & ~zero[:-1]
    largest = float(steps[within].max()) if within.any() else 0.0
    nearest = float(steps[edges].min()) if edges.any() else float(np.linalg.norm(position[known & ~zero], axis=1).min())
    return zero if nearest > _ZERO_JUMP * largest else np.zeros(len(position), dtype=bool)


def zero_note(lost: Mask, what: str = "samples") -> list[Note]:
    """Return what the history says of samples (T,) that `lost_zeros` found."""
    if not lost.any():
        return []
    first, last = int(np.argmax(lost)), len(lost) - 1 - int(np.argmax(lost[::-1]))
    said = f"{int(lost.sum())} {what} of exactly 0, 0, 0 taken as lost (samples {first} to {last})"
    return [Note("warning", f"{said}; missing='nan' keeps zeros", about="missing")]


def held_values(time: Array, position: Array, rotation: Array | None) -> tuple[Mask, list[str]]:
    """Return which samples (T,) repeat a value until the motion goes on with a jump, and a note.

    A tracker that loses its target often repeats the last value. The first of a run counts as recorded. A run without
    a jump behind it is a rest and stays.
    """
    lost = np.zeros(len(time), dtype=bool)
    flat = position if rotation is None else np.concatenate([position, rotation.reshape(len(time), -1)], axis=1)
    same = (np.diff(flat, axis=0) == 0.0).all(axis=1)
    if not same.any():
        return lost, []
    steps = np.linalg.norm(np.diff(position, axis=0), axis=1)
    moving = steps[steps > 0.0]  # NaN compares false
    usual = float(np.median(moving)) if len(moving) else np.inf
    least = _HELD_POINTS if rotation is None or (rotation == np.eye(3)).all() else _HELD_POSES
    notes = []
    for begin, end in _runs(same):
        after = steps[end] if end < len(steps) else 0.0
        if end - begin + 1 >= least and begin > 0 and after > _HELD_JUMP * usual:
            lost[begin + 1 : end + 1] = True
            notes.append((end - begin + 1, begin, end, after))
    return lost, _held_notes(time, notes)


def _held_notes(time: Array, held: list[tuple[int, int, int, float]]) -> list[str]:
    if not held:
        return []
    count, begin, end, jump = max(held)
    where = f"{time[begin]:.4g} to {time[end]:.4g} s"
    if len(held) == 1:
        said = f"{count} samples repeat one value ({where}) before a jump of {1e3 * jump:.3g} mm: taken as lost"
        return [Note("warning", said)]
    total = sum(run[0] for run in held)
    said = f"{total} samples in {len(held)} runs repeat one value before a jump: taken as lost"
    return [Note("warning", f"{said} (the longest, {count} samples, {where}, before {1e3 * jump:.3g} mm)")]


def _runs(flags: Mask) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8)))
    return [(int(b), int(e)) for b, e in edges.reshape(-1, 2)]


def jumps(time: Array, position: Array) -> list[Jump]:
    """Return the teleports among samples that are there (T,), (T, 3), in s and m.

    A teleport is a single step of more than 50 mm that is faster than 30 m/s or ten times the 99th percentile of all
    steps, and five times its neighbours. A single sample that lies elsewhere is an outlier, not a teleport.
    """
    if len(time) < 2 * _HELD_POINTS:
        return []
    calm = position.copy()
    calm[1:-1] = np.median(np.stack([position[:-2], position[1:-1], position[2:]]), axis=0)
    calm[0], calm[-1] = calm[1], calm[-2]
    moved = np.linalg.norm(np.diff(calm, axis=0), axis=1)
    pace = moved / np.diff(time)
    sudden = pace > min(_FAST, _SUDDEN * float(np.percentile(pace, 99)) + 1e-12)
    alone = moved > _ALONE * _largest_neighbour(moved)
    return [(int(k), float(moved[k])) for k in np.flatnonzero(sudden & alone & (moved > _FAR))]


def _largest_neighbour(moved: Array) -> Array:
    """Return the larger of the steps before and behind each (T,), the two steps beside it left aside."""
    padded = np.concatenate([np.zeros(2), moved, np.zeros(2)])
    return np.maximum(np.maximum(padded[:-4], padded[1:-3]), np.maximum(padded[3:-1], padded[4:]))


def check_one_body(position: Array) -> None:
    """Refuse positions (T, 3) [m] that jump to and fro between several bodies.

    Of the steps above 5 mm, the share that turn back (cosine to the step before below -0.5) is 1 for two hands in
    alternate rows and at most 0.01 for one hand. Noise turns back too, but there no later sample is much closer than
    the next.

    Raises
    ------
    NotStated
        More than a tenth turn back.
    """
    step = np.diff(position, axis=0)
    length = np.linalg.norm(step, axis=1)
    both = (length[1:] > _BACK_STEP) & (length[:-1] > _BACK_STEP)
    if both.sum() < _BACK_COUNT:
        return
    cosine = np.einsum("ij,ij->i", step[1:], step[:-1])[both] / (length[1:] * length[:-1])[both]
    share = float((cosine < _BACK_COSINE).mean())
    if share <= _BACK_SHARE or not _returns(position, length):
        return
    raise NotStated(
        "where",
        f"where: {100 * share:.0f} % of the steps turn back: rows of several bodies, hands or takes in one path? "
        f"Keep the "
        "rows of one of them: where='COLUMN=VALUE' by a column that tells them apart, or a file each.",
    )


def _returns(position: Array, length: Array) -> bool:
    """Return whether some later sample is usually much closer than the next one."""
    count = len(position) - 6
    if count < 1:
        return False
    later = np.stack([np.linalg.norm(position[k : count + k] - position[:count], axis=1) for k in range(2, 7)])
    return float(np.median(length[:count])) > _BACK_NEAR * float(np.median(later.min(axis=0)))
