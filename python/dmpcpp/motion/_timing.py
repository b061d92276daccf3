"""Other times for the same motion: cropped, resampled, refined."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation, RotationSpline

from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._cleaning import check_made_up
from dmpcpp.motion._poses import complete, continuous, positive, turn_angles
from dmpcpp.recordings import MADE_UP_IN_ALL, MIN_SAMPLES, Recording

__all__ = ["crop", "evaluated", "refine", "resample"]


def crop(recording: Recording, start: float = 0.0, end: float | None = None) -> Recording:
    """Keep the samples from `start` to `end` [s], both included; time counts from the first of them.

    Raises
    ------
    InvalidArgument
        An empty or reversed span, or fewer than 8 samples in it.
    """
    end = recording.duration if end is None else end
    if not (np.isfinite(start) and np.isfinite(end) and start < end):
        raise InvalidArgument(f"start, end: {start:g} .. {end:g} s, expected a start before the end.")
    slack = 1e-9 * recording.duration  # times are sums of steps: 0.2 s may stand as 0.20000000000000001
    kept = (recording.time >= start - slack) & (recording.time <= end + slack)
    if kept.sum() < MIN_SAMPLES:
        raise InvalidArgument(
            f"start, end: {kept.sum()} samples within {start:g} .. {end:g} s, expected at least "
            f"{MIN_SAMPLES}; the recording lasts {recording.duration:g} s with {len(recording)} samples."
        )
    return recording.part(kept, f"cropped to {start:g} .. {end:g} s")


def resample(recording: Recording, rate: float) -> Recording:
    """Resample at a uniform `rate` [Hz] by interpolating C2 splines.

    Positions by a cubic spline (not-a-knot), orientations by scipy's RotationSpline, whose angular velocity
    and acceleration are continuous. Nothing is smoothed; a rate below the recording's drops what it cannot
    show, so low-pass first.

    Raises
    ------
    InvalidArgument
        A rate that is not positive or leaves fewer than 8 samples; a turn too large to interpolate.
    """
    positive("rate", rate)
    count = int(np.floor(recording.duration * rate + 1e-6)) + 1
    if not MIN_SAMPLES <= count <= 10_000_000:
        raise InvalidArgument(
            f"rate: {rate:g} Hz gives {count} samples over {recording.duration:g} s, expected at least "
            f"{MIN_SAMPLES} and at most 1e7."
        )
    check_made_up(count - len(recording), MADE_UP_IN_ALL)  # of a rate that was asked for: the bound on all
    time = np.minimum(np.arange(count) / rate, recording.duration)
    return evaluated(recording, time, f"resampled from {recording.rate:.4g} to {rate:g} Hz")


def refine(recording: Recording, distance: float, angle: float) -> Recording:
    """Put samples between those that lie far apart; the recorded ones stay.

    Parameters
    ----------
    recording : Recording
    distance : float
        m, between consecutive samples of the result, about; each gap is cut into equal spans of time.
    angle : float
        rad, likewise.

    Raises
    ------
    InvalidArgument
        A distance or angle that is not positive; a turn too large to interpolate.
    """
    positive("distance", distance)
    positive("angle", angle)
    complete(recording)
    moved = np.linalg.norm(np.diff(recording.position, axis=0), axis=1)
    parts = np.ceil(np.maximum(moved / distance, turn_angles(recording) / angle)).astype(int)
    check_made_up(
        float(np.maximum(parts, 1).sum()) - len(recording), MADE_UP_IN_ALL
    )  # of one line: no data are made up
    spans = zip(recording.time[:-1], recording.time[1:], np.maximum(parts, 1), strict=True)
    inner = [np.linspace(a, b, n, endpoint=False) for a, b, n in spans]
    time = np.concatenate([*inner, recording.time[-1:]])
    return evaluated(recording, time, f"refined from {len(recording)} to {len(time)} samples")


def evaluated(recording: Recording, at: Array, note: str, time: Array | None = None) -> Recording:
    """Return the motion at the times `at` [s] of the recording: positions on a cubic spline (not-a-knot),
    orientations on scipy's RotationSpline, channels on straight lines; what lies nearest to a sample that was filled in
    counts as filled in. Times of the result are `time`, `at` unless
    given.
    """
    continuous(recording, np.radians(179.0))
    turning = RotationSpline(recording.time, Rotation.from_matrix(recording.rotation))
    return recording.with_(
        note,
        time=at if time is None else time,
        position=CubicSpline(recording.time, recording.position)(at),
        rotation=turning(at).as_matrix(),
        channels={name: np.interp(at, recording.time, values) for name, values in recording.channels.items()},
        measured=np.interp(at, recording.time, recording.measured) >= 0.5,  # as the sample that is nearest
    )
