"""A motion that repeats, as the one cycle that all its repetitions are."""

from __future__ import annotations

from dmpcpp._core import find_cycle
from dmpcpp.motion._poses import demonstration
from dmpcpp.recordings import Recording

__all__ = ["one_cycle"]


def one_cycle(recording: Recording, minimum_period: float = 0.0) -> Recording:
    """Return one cycle of a recording that repeats, its last sample the first one again.

    The history says what was found.

    Parameters
    ----------
    recording : Recording
        Two cycles or more; what at its ends is no part of them is found and left out.
    minimum_period : float
        s. Half the true period may pass for it where a motion is the same on its way there and back.

    Raises
    ------
    InvalidArgument
        There is no period, or fewer than two cycles are alike.
    """
    found = find_cycle(demonstration(recording), minimum_period)
    poses = found.demonstration.pose
    lengths = found.lengths
    spread = f", {lengths.min():.3g} to {lengths.max():.3g} s long" if len(lengths) else ""
    left_out = recording.duration - (found.ends - found.begins)
    note = (
        f"one cycle of {found.period:.4g} s of {len(lengths)} whole ones{spread}; it leaves "
        f"{100 * found.unexplained:.2g} % of their motion unexplained"
    )
    if left_out > 1e-9:
        note += f"; {found.begins:.3g} s before and {recording.duration - found.ends:.3g} s behind are no part of them"
    return recording.with_(
        note,
        time=found.demonstration.time,
        position=poses[:, :3, 3],
        rotation=poses[:, :3, :3],
        channels={},
    )
