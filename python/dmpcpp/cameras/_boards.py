"""A printed board (ChArUco) that lies still in the pictures of both cameras: how they stand, in metres."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._frames import Video
from dmpcpp.cameras._opencv import opencv
from dmpcpp.cameras._units import length
from dmpcpp.errors import InvalidArgument

__all__ = ["MARKER_SHARE", "Board", "board_of", "charuco", "stand_of_board"]

MARKER_SHARE = 0.75  # of a square, its marker
_LOOKS, _EVERY = 10, 5  # frames looked at, every how many
_LEAST_CORNERS = 6


@dataclass(frozen=True)
class Board:
    """A board of columns x rows squares, each of a size [m]."""

    columns: int
    rows: int
    square: float


def board_of(said: str) -> Board:
    """Return the board that "5x7:30mm" says: columns x rows of squares, and the side of one.

    Raises
    ------
    InvalidArgument
        Something else.
    """
    found = re.fullmatch(r"(\d+)x(\d+):(.+)", said.strip())
    if found is None or not (3 <= int(found[1]) <= 30 and 3 <= int(found[2]) <= 30):
        raise InvalidArgument(f"board: {said!r}, expected COLUMNSxROWS:SQUARE, such as 5x7:30mm.")
    return Board(int(found[1]), int(found[2]), length("board", found[3]))


def charuco(board: Board) -> Any:
    """Return OpenCV's board."""
    aruco = opencv().aruco
    dictionary = aruco.getPredefinedDictionary(aruco.DICT_5X5_250)
    return aruco.CharucoBoard((board.columns, board.rows), board.square, MARKER_SHARE * board.square, dictionary)


def stand_of_board(video: Video, camera: Camera, board: Board) -> tuple[Array, Array]:
    """Return rotation (3, 3) and position (3,) [m] of a board that lies still, in the camera's axes.

    Raises
    ------
    InvalidArgument
        It is not seen, or it moves.
    """
    cv2 = opencv()
    printed = charuco(board)
    detector = cv2.aruco.CharucoDetector(printed)
    poses: list[tuple[Array, Array]] = []
    for k, (_, picture) in enumerate(video.frames()):
        if k % _EVERY:
            continue
        corners, ids, _, _ = detector.detectBoard(picture)
        if ids is not None and len(ids) >= _LEAST_CORNERS:
            points = printed.getChessboardCorners()[np.ravel(ids)]
            rays = camera.rays(np.asarray(corners, dtype=float).reshape(-1, 2))
            good, turn, move = cv2.solvePnP(points.astype(float), rays, np.eye(3), None, flags=cv2.SOLVEPNP_IPPE)
            if good:
                poses.append((Rotation.from_rotvec(np.ravel(turn)).as_matrix(), np.ravel(move)))
        if len(poses) >= _LOOKS:
            break
    if len(poses) < 2:
        raise InvalidArgument(
            f"board: {video.path.name} does not show the whole board of {board.columns} x {board.rows} squares. Lay it "
            "where both cameras see it (`dmpcpp tag --print FILE --board ..` prints one)."
        )
    positions = np.array([move for _, move in poses])
    if np.linalg.norm(np.ptp(positions, axis=0)) > 0.02 * float(np.linalg.norm(positions.mean(axis=0))):
        raise InvalidArgument(f"board: it moves in {video.path.name}. Lay it down where it stays.")
    mean = Rotation.from_matrix([turn for turn, _ in poses]).mean().as_matrix()
    return np.asarray(mean), np.asarray(np.median(positions, axis=0))
