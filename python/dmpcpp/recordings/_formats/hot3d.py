"""HOT3D hand poses: a JSON object a line, the wrists of the left ("0") and the right ("1") hand in the world.

Source: facebookresearch/hot3d, mano_hand_pose_trajectory.jsonl: timestamp_ns, hand_poses, wrist_xform with t_xyz in m
and q_wxyz. A hand that was not seen is absent. Its tables of objects and of the headset are read as long tables.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from dmpcpp._notes import Note
from dmpcpp._text import data_lines, read_text
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._orientation import from_quaternions
from dmpcpp.recordings._reader import COMMON, Reader, pick_body
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated
from dmpcpp.recordings._world import World

__all__ = ["READER", "UP_OPEN"]

UP_OPEN = "taken: up_axis: z, which no file states; recordings of Quest 3 have y up"

_HANDS = {"0": "left", "1": "right"}
_Row = tuple[int, dict[str, list[float]]]  # stamp [ns], hand -> x y z qw qx qy qz


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the hands that were seen at least once."""
    return _hands(_rows(path))


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the wrist of one hand, "0" (or "left") or "1" (or "right")."""
    rows = _rows(path)
    number = next((key for key, side in _HANDS.items() if side == body), body)
    hand = pick_body(number, _hands(rows))
    values = np.array([hands.get(hand, [np.nan] * 7) for _, hands in rows])
    lost = np.isnan(values).any(axis=1)
    rotation, notes = from_quaternions(values[:, 3:], "wxyz", missing=lost)
    return stated.recording(
        time=np.array([float(stamp - rows[0][0]) for stamp, _ in rows]),
        position=values[:, :3],
        rotation=rotation,
        body=hand,
        source=path.name,
        notes=[*_told_up(stated), f"hand {hand}: the {_HANDS.get(hand, 'other')} wrist, in the world", *notes],
        world=World(unit="m", time_unit=None if stated.time_unit is not None else "ns"),
    )


def _told_up(stated: Stated) -> list[Note]:
    return [] if stated.up_axis else [Note("assumed", UP_OPEN, about="up_axis")]


def _hands(rows: list[_Row]) -> tuple[str, ...]:
    return tuple(sorted({hand for _, hands in rows for hand in hands}))


def _rows(path: Path) -> list[_Row]:
    rows = [_row(line, text) for line, text in data_lines(read_text(path))]
    if not any(hands for _, hands in rows):
        raise InvalidArgument("no line with a hand.")
    return rows


def _row(line: int, text: str) -> _Row:
    try:
        content = json.loads(text)
        hands = {str(key): _numbers(hand["wrist_xform"]) for key, hand in content["hand_poses"].items()}
        return _stamp(content["timestamp_ns"]), hands
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError, RecursionError) as error:
        what = "not JSON" if isinstance(error, json.JSONDecodeError) else f"no hand poses ({str(error)[:60]})"
        raise InvalidArgument(f"line {line}: {what}; expected timestamp_ns and hand_poses with wrist_xform.") from None


def _stamp(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or abs(value) >= 2**63:
        raise ValueError("a stamp that is no whole number of ns")
    return value


def _numbers(transform: dict[str, list[float]]) -> list[float]:
    values = [float(value) for value in (*transform["t_xyz"], *transform["q_wxyz"])]
    if len(values) != 7 or not np.isfinite(values).all():
        raise ValueError(f"{len(values)} numbers of a pose, expected 7 finite ones")
    return values


READER = Reader(
    name="hot3d",
    summary="HOT3D hand poses: a JSON object a line",
    takes=COMMON,
    recognises=lambda path, head: head.lstrip().startswith(b"{") and b'"hand_poses"' in head.split(b"\n", 1)[0],
    bodies=bodies,
    read=read,
)
