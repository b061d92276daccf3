"""What is stated about a video: the camera, how far away things are, where up is."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp._text import read_text
from dmpcpp._typing import Array
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._relation import Relation
from dmpcpp.cameras._units import angle, length
from dmpcpp.errors import InvalidArgument

__all__ = ["camera_from_file", "hand_length", "level_world", "relation_from_file", "require_up", "tags_from_file"]

_HANDS = (0.12, 0.26)  # m, from a child's to the longest


def hand_length(said: str | float) -> float:
    """Return a hand's length [m], wrist crease to tip of the middle finger.

    Raises
    ------
    InvalidArgument
        No hand is as short or as long.
    """
    found = length("hand_length", said)
    if not _HANDS[0] <= found <= _HANDS[1]:
        raise InvalidArgument(
            f"hand_length: {1e3 * found:.4g} mm, expected 120 to 260 mm: measure from the crease of the wrist to the "
            "tip of the middle finger."
        )
    return found


def camera_from_file(path: str | Path, size: tuple[int, int], which: int = 0) -> Camera:
    """Return the camera of a calibration file (TOML or JSON) for pictures of a size [px].

    The file holds `matrix` (3, 3), `size` (width, height) [px] and, where the lens is not ideal, `distortion` (k1, k2,
    p1, p2, k3); or a list `cameras` of such tables, one for each video.

    Raises
    ------
    FileError, InvalidArgument
        It cannot be read, or is no such file.
    """
    table = _table("camera", path)
    cameras = table.get("cameras")
    if isinstance(cameras, list) and cameras:
        table = cameras[min(which, len(cameras) - 1)]
    matrix, distortion = _numbers("camera", table, "matrix", (3, 3)), np.zeros(5)
    given = np.ravel(table.get("distortion", []))
    distortion[: min(len(given), 5)] = given[:5]
    width, height = (int(each) for each in _numbers("camera", table, "size", (2,)))
    if abs(width / height / (size[0] / size[1]) - 1.0) > 0.01:
        raise InvalidArgument(
            f"camera: calibrated for {width} x {height}, the video has {size[0]} x {size[1]}. Record in the same "
            "format."
        )
    return Camera(matrix, (width, height), distortion).resized(size)


def relation_from_file(path: str | Path) -> Relation:
    """Return x_2 = rotation x_1 + translation of a file (TOML or JSON) with these two entries, in m.

    Raises
    ------
    FileError, InvalidArgument
        It cannot be read, or is no such file.
    """
    table = _table("extrinsics", path)
    rotation, translation = (
        _numbers("extrinsics", table, "rotation", (3, 3)),
        _numbers("extrinsics", table, "translation", (3,)),
    )
    if np.abs(rotation @ rotation.T - np.eye(3)).max() > 1e-3 or np.linalg.det(rotation) < 0.0:
        raise InvalidArgument("extrinsics: rotation: no rotation matrix. Expected x_2 = rotation x_1 + translation.")
    u, _, vt = np.linalg.svd(rotation)
    if not 1e-3 < np.linalg.norm(translation) < 20.0:
        raise InvalidArgument("extrinsics: translation: expected 1 mm to 20 m, in m.")
    return Relation(u @ vt, translation)


def level_world(said: str, pitch: str | float | None, normal: Array | None = None) -> tuple[Array, str, str]:
    """Return the rotation (3, 3) from the first camera's axes to the recording's, its up axis, and a word on it.

    Parameters
    ----------
    said : str
        "image": the camera stands level, pitched down by `pitch`; "x", "y", "z": axes of the camera as they are; else
        what lies on the table, whose `normal` (3,) in camera axes points up.
    pitch : str, float or None
    normal : array (3,), optional

    Raises
    ------
    InvalidArgument
        Something else.
    """
    if said in ("x", "y", "z"):
        return np.eye(3), said, f"up is the first camera's {said} axis"
    if said == "image":
        down = angle("pitch", pitch) if pitch is not None else 0.0
        up = np.array([0.0, -np.cos(down), -np.sin(down)])
        words = f"up is up in the first camera's picture, pitched down by {np.degrees(down):.3g} deg"
    elif normal is not None:
        up, words = normal, f"up is the normal of the {said} on the table"
    else:
        raise InvalidArgument(f"up_axis: {said!r}, expected image, board, tag:ID, x, y or z.")
    forward = np.array([0.0, 0.0, 1.0]) - up[2] * up
    if np.linalg.norm(forward) < 1e-3:
        forward = np.array([0.0, -1.0, 0.0]) + up[1] * up
    x = forward / np.linalg.norm(forward)
    return np.stack([x, np.cross(up, x), up]), "z", words


def require_up(said: str) -> None:
    """Refuse what `level_world` cannot take, before a video is read.

    Raises
    ------
    InvalidArgument
        It is none of the words.
    """
    if said not in ("x", "y", "z", "image", "board") and not re.fullmatch(r"tag:\d+", said):
        raise InvalidArgument(f"up_axis: {said!r}, expected image, board, tag:ID, x, y or z.")


def _table(name: str, path: str | Path) -> dict[str, Any]:
    text = read_text(Path(path))
    try:
        found = json.loads(text) if text.lstrip()[:1] == "{" else tomllib.loads(text)
    except (json.JSONDecodeError, tomllib.TOMLDecodeError) as error:
        raise InvalidArgument(f"{name}: {path}: neither TOML nor JSON ({error}).") from None
    return dict(found)


def _numbers(name: str, table: dict[str, Any], key: str, shape: tuple[int, ...]) -> Array:
    try:
        found = np.array(table[key], dtype=float)
    except (KeyError, TypeError, ValueError):
        raise InvalidArgument(f"{name}: the file has no {key}, expected numbers {shape}.") from None
    if found.shape != shape or not np.isfinite(found).all():
        raise InvalidArgument(f"{name}: {key}: shape {found.shape}, expected {shape}.")
    return found


def tags_from_file(path: Path) -> list[tuple[int, float, Array, Array]]:
    """Return id, size [m], rotation (3, 3) and position (3,) [m] of each `[[tag]]` of a file.

    Raises
    ------
    FileError, InvalidArgument
        It cannot be read, or is no such file.
    """
    tables = _table("tag", path).get("tag")
    if not isinstance(tables, list) or not tables:
        raise InvalidArgument(f"tag: {path}: holds no [[tag]], expected tables with id, size, rotation and position.")
    found = []
    for table in tables:
        rotation, position = _numbers("tag", table, "rotation", (3, 3)), _numbers("tag", table, "position", (3,))
        found.append((int(table.get("id", -1)), length("tag", table.get("size", 0.0)), rotation, position))
    return found
