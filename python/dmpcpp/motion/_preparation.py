"""From a recording as it was read to a motion to learn: the usual steps in their usual order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from dmpcpp._notes import Note
from dmpcpp.errors import InvalidArgument
from dmpcpp.motion._cleaning import LONGEST_GAP, fill, outliers
from dmpcpp.motion._ends import without_repeated_ends
from dmpcpp.motion._long import one_motion
from dmpcpp.motion._segmentation import cycles, segments
from dmpcpp.motion._smoothing import evenly_sampled, low_pass, smooth
from dmpcpp.motion._timing import crop, resample
from dmpcpp.recordings import Recording, SourceKind

__all__ = ["Preparation", "prepare", "prepare_all"]

_OUTLIER_WINDOW = 11  # samples; a shorter recording has no neighbours to ask
_WOBBLING = ("tracker", "video")
_WOBBLE = 4.0  # Hz
_FILTERED = 20  # samples that a filter needs


@dataclass(frozen=True)
class Preparation:
    """What shall be done to a recording before it is learned.

    Attributes
    ----------
    start, end : float
        s; use the motion from here to there.
    longest_gap : float
        s; longer gaps are refused, others filled.
    outliers : bool
        Replace outliers (`motion.outliers`).
    segment : int, optional
        Use this part of the motion only, counted from 1, of those between its rests (`motion.segments`).
    repetition : int or "all", optional
        Likewise of its whole cycles (`motion.cycles`); all of them are for `prepare_all`.
    resample : float, optional
        Hz; samples at an even rate.
    low_pass : float, optional
        Hz; take out what is faster. A recording with uneven steps is resampled at its own mean rate for it.
    smooth : bool
        Apply `motion.smooth`.
    kind : SourceKind, optional
        What recorded the motion, instead of what its file says. What a tracker or a video shows above 4 Hz is taken for
        its wobble and left out, unless `low_pass` or `keep_noise` says otherwise.
    keep_noise : bool
        Leave nothing out because of the kind.
    """

    start: float = 0.0
    end: float | None = None
    longest_gap: float = LONGEST_GAP
    outliers: bool = True
    segment: int | None = None
    repetition: int | Literal["all"] | None = None
    resample: float | None = None
    low_pass: float | None = None
    smooth: bool = False
    kind: SourceKind | None = None
    keep_noise: bool = False


def prepare(recording: Recording, how: Preparation | None = None) -> Recording:
    """Crop, take outliers out, fill gaps, choose a part, resample, low-pass and smooth, in this order.

    Each step is the function of its name in `dmpcpp.motion`; the history says what each did. By default outliers
    and short gaps are filled and nothing else changes.

    Raises
    ------
    InvalidArgument
        What the steps refuse; a part that is not there; a segment and a repetition at once.
    """
    how = how or Preparation()
    if how.repetition == "all":
        raise InvalidArgument(
            "repetition: 'all' is several recordings, which `fit` and `imitate` learn together (`motion.prepare_all`). "
            "Specify one of them: repetition=1."
        )
    return _finished(_part(_whole(recording, how), how), how)


def prepare_all(recording: Recording, how: Preparation | None = None) -> list[Recording]:
    """Return what `prepare` does, or with `repetition="all"` each whole cycle of the recording prepared like that.

    Raises
    ------
    InvalidArgument
        See `prepare`; a recording without a whole cycle.
    """
    how = how or Preparation()
    if how.repetition != "all":
        return [prepare(recording, how)]
    if how.segment is not None:
        raise InvalidArgument("segment, repetition: both are stated, expected one of them at most.")
    found = cycles(_whole(recording, how))
    if not found:
        raise InvalidArgument("repetition: 'all', but there is no whole cycle in this recording.")
    return [_finished(each, how) for each in found]


def _whole(recording: Recording, how: Preparation) -> Recording:
    """Return the recording cropped, its gaps filled and its outliers taken out."""
    if how.start or how.end is not None:
        recording = crop(recording, how.start, how.end)
    if how.segment is None and how.repetition is None:
        recording = one_motion(recording)
    return without_repeated_ends(_repaired(recording, how))


def _finished(recording: Recording, how: Preparation) -> Recording:
    """Return a part resampled and filtered."""
    if how.resample is not None:
        recording = resample(recording, how.resample)
    if how.low_pass is None and not how.keep_noise:
        recording = _without_wobble(recording, how.kind or recording.kind)
    if how.low_pass is not None:
        recording = recording if evenly_sampled(recording) else resample(recording, recording.rate)
        recording = low_pass(recording, how.low_pass)
    return smooth(recording) if how.smooth else recording


def _without_wobble(recording: Recording, kind: SourceKind) -> Recording:
    """Return what a tracker or a video recorded below 4 Hz: its wobble is not told from a motion without a rest."""
    if kind not in _WOBBLING or recording.rate <= 2.0 * _WOBBLE or len(recording) < _FILTERED:
        return recording
    even = recording if evenly_sampled(recording) else resample(recording, recording.rate)
    said = f"recorded by a {kind}: what is faster than {_WOBBLE:g} Hz is taken for its wobble"
    return low_pass(even.with_(Note("assumed", said, about="kind")), _WOBBLE)


def _repaired(recording: Recording, how: Preparation) -> Recording:
    filled = fill(recording, how.longest_gap)
    if not how.outliers or len(filled) < _OUTLIER_WINDOW:
        return filled
    return fill(outliers(filled), longest=filled.duration)  # all gaps that are left are a few samples long


def _part(recording: Recording, how: Preparation) -> Recording:
    if how.segment is not None and how.repetition is not None:
        raise InvalidArgument("segment, repetition: both are stated, expected one of them at most.")
    if how.segment is not None:
        return _chosen("segment", how.segment, segments(recording))
    if isinstance(how.repetition, int):
        return _chosen("repetition", how.repetition, cycles(recording))
    return recording


def _chosen(name: str, number: int, parts: list[Recording]) -> Recording:
    if not 1 <= number <= len(parts):
        found = f"1 to {len(parts)}" if parts else "none: there is not one in this recording"
        raise InvalidArgument(f"{name}: {number}, expected {found}.")
    return parts[number - 1]
