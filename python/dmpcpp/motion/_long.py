"""Long recordings: fewer samples to look at, and the one motion to learn among hours of them."""

from __future__ import annotations

from dmpcpp._notes import Note
from dmpcpp.motion._cleaning import fill
from dmpcpp.motion._segmentation import spans_of_cycles, spans_of_segments
from dmpcpp.recordings import Recording

__all__ = ["LONG", "one_motion", "thinned"]

LONG = 50_000
"""Samples; no single motion of a hand has more, and what looks for parts needs no more."""

_MARGIN = 0.2  # s kept before and behind the part


def thinned(recording: Recording, most: int = LONG) -> Recording:
    """Keep every k-th sample so that at most `most` remain."""
    every = -(-len(recording) // most)
    if every <= 1:
        return recording
    return recording.part(slice(None, None, every), f"every {every}th of {len(recording)} samples")


def one_motion(recording: Recording, most: int = LONG) -> Recording:
    """Return the first whole cycle of a recording of more than `most` samples, or its first motion between rests.

    A primitive describes one motion. Where there is neither, the samples are thinned; the history warns of each.
    """
    if len(recording) <= most:
        return recording
    few = thinned(recording, most)
    whole = fill(few, longest=recording.duration)
    for spans, what, option in (
        (spans_of_cycles(whole), "cycles", "repetition"),
        (spans_of_segments(whole), "motions between rests", "segment"),
    ):
        if len(spans) > 1:
            return _part(
                recording, spans[0], f"the first of {len(spans)} {what}", f"{option}, start and end choose others"
            )
    said = f"{len(recording)} samples thinned to {len(few)}; start and end choose a part"
    return few.with_(Note("warning", said))


def _part(recording: Recording, span: tuple[float, float], what: str, how: str) -> Recording:
    begin, end = max(0.0, span[0] - _MARGIN), span[1] + _MARGIN
    kept = (recording.time >= begin) & (recording.time <= end)
    said = f"{len(recording)} samples are more than one motion: {what} used, {begin:.4g} .. {end:.4g} s; {how}"
    return recording.part(kept, Note("warning", said))
