"""A lift as a TRC file of three markers on a wrist: lengths in mm, z up."""

from __future__ import annotations

import numpy as np

from dmpcpp.examples._motions import take

__all__ = ["lift"]

_MARKERS = {"WRIST": (0.0, 0.0, 0.0), "STYLr": (0.05, 0.02, 0.0), "STYLu": (0.05, -0.03, 0.01)}  # in the hand, m


def lift() -> str:
    """Return the text of the file: the wrist's way at 50 Hz."""
    motion = take(2)
    seen = {name: motion.position + motion.turn.apply(place) for name, place in _MARKERS.items()}
    count, names = len(motion.time), list(seen)
    columns = "\t".join(f"{axis}{k}" for k in range(1, len(names) + 1) for axis in "XYZ")
    head = [
        "PathFileType\t4\t(X/Y/Z)\tlift.trc",
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames",
        f"50\t50\t{count}\t{len(names)}\tmm\t50\t1\t{count}",
        "Frame#\tTime\t" + "\t\t\t".join(names) + "\t\t",
        f"\t\t{columns}",
        "",
    ]
    places = 1e3 * np.concatenate(list(seen.values()), axis=1)
    rows = [
        "\t".join([str(k + 1), f"{time:.3f}", *(f"{value:.2f}" for value in row)])
        for k, (time, row) in enumerate(zip(motion.time, places, strict=True))
    ]
    return "\n".join([*head, *rows]) + "\n"
