"""Printed tags (AprilTag 36h11): one, or several on a rigid body such as a cube, to poses.

Sub-pixel refinement pulls corners inwards by 0.2 px, which is nearly the whole error of a tag's depth. Here each side's
edge is found at many places on its normal and fitted with a line; corners are where the lines cross.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from dmpcpp._typing import Array
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._frames import Picture, Video
from dmpcpp.cameras._opencv import opencv
from dmpcpp.cameras._setup import tags_from_file
from dmpcpp.cameras._units import length
from dmpcpp.errors import InvalidArgument

__all__ = ["Tag", "TagFinder", "body_of_tags", "edge_corners", "up_of_tag"]

_IDS = 587  # of 36h11
_STATIONS = np.linspace(0.12, 0.88, 24)  # along a side
_ACROSS = np.arange(-2.5, 2.51, 0.25)  # px, along its normal
_ROUNDS = 2
_STEEP = np.cos(np.radians(70.0))
_OUTLIER = 1.0  # px rms, of a face under the pose of the others
_LOOKS = 12  # frames that are looked at for a tag on the table


@dataclass(frozen=True, eq=False)
class Tag:
    """A tag on a body: its id, the length of its black side [m], and its pose in the body's frame.

    The tag's own axes: x along the rows of its pattern, y up in it, z towards who looks at it.
    """

    id: int
    size: float
    rotation: Array
    position: Array

    @property
    def corners(self) -> Array:
        """Corners (4, 3) [m] in the body's frame, in the detector's order: clockwise from the upper left."""
        half = self.size / 2.0
        own = np.array([[-half, half, 0.0], [half, half, 0.0], [half, -half, 0.0], [-half, -half, 0.0]])
        return own @ self.rotation.T + self.position


def body_of_tags(said: str) -> list[Tag]:
    """Return the tags of a body.

    Parameters
    ----------
    said : str
        "ID:SIZE" (a tag; the body's frame is its own), "A-B:SIZE,cube:EDGE" (up to six on the faces of a cube, in the
        order +z, +x, +y, -x, -y, -z, the body's origin in its middle), or a TOML file with `[[tag]]` tables: id, size,
        rotation (3, 3), position.

    Raises
    ------
    InvalidArgument
        Something else.
    """
    if said.endswith((".toml", ".json")):
        return [Tag(*each) for each in tags_from_file(Path(said))]
    found = re.fullmatch(r"(\d+)(?:-(\d+))?:([^,]+)(?:,cube:(.+))?", said.strip())
    if found is None:
        raise InvalidArgument(
            f"tag: {said!r}, expected ID:SIZE (0:60mm), A-B:SIZE,cube:EDGE (0-4:40mm,cube:50mm) or a TOML file."
        )
    first, last = int(found[1]), int(found[2] or found[1])
    size = length("tag", found[3])
    if not 0 <= first <= last < _IDS or not 0.005 <= size <= 1.0:
        raise InvalidArgument(f"tag: {said!r}, expected ids 0 to {_IDS - 1} of the family 36h11 and 5 mm to 1 m.")
    if found[4] is None:
        if last > first:
            raise InvalidArgument(
                f"tag: {said!r}: several tags, but not where they are: add cube:EDGE, or give a TOML file."
            )
        return [Tag(first, size, np.eye(3), np.zeros(3))]
    edge = length("tag", found[4])
    if last - first >= 6 or size > edge:
        raise InvalidArgument(f"tag: {said!r}, expected at most six tags, none wider than the cube.")
    return [Tag(first + k, size, *_face(k, edge)) for k in range(last - first + 1)]


def _face(k: int, edge: float) -> tuple[Array, Array]:
    """Return the pose of a cube's k-th face: z outwards; on the sides y up."""
    normals = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, -1]], dtype=float)
    z = normals[k]
    y = np.array([0.0, 0.0, 1.0]) if z[2] == 0.0 else np.array([0.0, 1.0, 0.0])
    return np.stack([np.cross(y, z), y, z], axis=1), edge / 2.0 * z


class TagFinder:
    """Finds the pose of a body of tags in pictures, one after another: the last pose decides between two."""

    def __init__(self, tags: list[Tag], camera: Camera) -> None:
        """Take the tags and the camera."""
        cv2 = opencv()
        self.tags = {tag.id: tag for tag in tags}
        self.camera = camera
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_NONE
        dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
        self._detector = cv2.aruco.ArucoDetector(dictionary, parameters)
        self._last: tuple[Array, Array] | None = None
        self.residual = np.nan  # px rms of the last pose
        self.blur = np.nan  # px, width of the edges of the last pose
        self.rejected = 0

    def corners(self, picture: Picture) -> dict[int, Array]:
        """Return the corners (4, 2) [px] of each known tag in a picture."""
        cv2 = opencv()
        grey = cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY) if picture.ndim == 3 else picture
        found, ids, _ = self._detector.detectMarkers(grey)
        known: dict[int, Array] = {}
        widths = []
        for quad, each in zip(found, [] if ids is None else np.ravel(ids), strict=True):
            if int(each) in self.tags:
                refined, width = edge_corners(grey, quad[0].astype(float), self.camera)
                known[int(each)] = refined
                widths.append(width)
        self.blur = float(np.median(widths)) if widths else np.nan
        return known

    def find(self, picture: Picture) -> tuple[Array, Array] | None:
        """Return rotation (3, 3) and position (3,) of the body in the camera's axes; None where no tag is seen."""
        seen = self.corners(picture)
        if not seen:
            return None
        pose = self._start(seen)
        kept = self._agreeing(seen, *pose)
        self.rejected += len(seen) - len(kept)
        pose, self.residual = self._solved({each: seen[each] for each in kept}, *pose)
        self._last = pose
        return pose

    def forget(self) -> None:
        """Begin anew: the next pose does not follow the last."""
        self._last = None

    def _start(self, seen: dict[int, Array]) -> tuple[Array, Array]:
        """Return the pose that the largest face shows; of its two the one near the last, else the better."""
        cv2 = opencv()
        largest = max(seen, key=lambda each: float(cv2.contourArea(seen[each].astype(np.float32))))
        tag, rays = self.tags[largest], self.camera.rays(seen[largest])
        half = tag.size / 2.0
        own = np.array([[-half, half, 0.0], [half, half, 0.0], [half, -half, 0.0], [-half, -half, 0.0]])
        flags = cv2.SOLVEPNP_IPPE_SQUARE
        _, turns, moves, errors = cv2.solvePnPGeneric(own, rays[:, None], np.eye(3), None, flags=flags)
        poses = []
        for turn, move in zip(turns, moves, strict=True):
            rotation = Rotation.from_rotvec(np.ravel(turn)).as_matrix() @ tag.rotation.T
            poses.append((rotation, np.ravel(move) - rotation @ tag.position))
        if len(seen) > 1:
            return min(poses, key=lambda pose: self._misses(seen, *pose))
        if self._last is None or len(poses) < 2 or errors[1] > 3.0 * errors[0]:
            return poses[0]
        last = self._last[0]
        return min(poses, key=lambda pose: float(Rotation.from_matrix(last.T @ pose[0]).magnitude()))

    def _misses(self, seen: dict[int, Array], rotation: Array, position: Array) -> float:
        return float(np.median([self._error(each, seen[each], rotation, position) for each in seen]))

    def _error(self, each: int, pixels: Array, rotation: Array, position: Array) -> float:
        seen = self.tags[each].corners @ rotation.T + position
        if (seen[:, 2] <= 0.01).any():
            return 1e6
        return float(np.sqrt(np.mean(np.sum((self.camera.project(seen) - pixels) ** 2, axis=1))))

    def _agreeing(self, seen: dict[int, Array], rotation: Array, position: Array) -> list[int]:
        """Return the faces that agree with one pose and are not too steep; the largest one at least."""
        kept = list(seen)
        for _ in range(len(seen)):
            (rotation, position), _ = self._solved({each: seen[each] for each in kept}, rotation, position)
            errors = {each: self._error(each, seen[each], rotation, position) for each in kept}
            worst = max(errors, key=lambda each: errors[each] + 10.0 * self._steep(each, rotation, position))
            if len(kept) == 1 or (errors[worst] < _OUTLIER and not self._steep(worst, rotation, position)):
                break
            kept.remove(worst)
        return kept

    def _steep(self, each: int, rotation: Array, position: Array) -> bool:
        tag = self.tags[each]
        normal, place = rotation @ tag.rotation[:, 2], rotation @ tag.position + position
        return bool(-normal @ place / np.linalg.norm(place) < _STEEP)

    def _solved(self, seen: dict[int, Array], rotation: Array, position: Array) -> tuple[tuple[Array, Array], float]:
        """Return the pose of the least reprojection error, and that [px rms]."""
        points = np.concatenate([self.tags[each].corners for each in seen])
        pixels = np.concatenate([seen[each] for each in seen])

        def errors(x: Array) -> Array:
            turned = rotation @ Rotation.from_rotvec(x[:3]).as_matrix()
            inside = points @ turned.T + position + x[3:]
            inside[:, 2] = np.maximum(inside[:, 2], 0.01)
            return np.asarray((self.camera.project(inside) - pixels).ravel())

        found = least_squares(errors, np.zeros(6), method="lm", max_nfev=200)
        pose = rotation @ Rotation.from_rotvec(found.x[:3]).as_matrix(), position + found.x[3:]
        return pose, float(np.sqrt(2.0 * np.mean(found.fun**2)))


def edge_corners(grey: Any, corners: Array, camera: Camera | None = None) -> tuple[Array, float]:
    """Return the corners (4, 2) [px] where lines along the sides' edges cross, and the width [px] of the widest edge.

    Along each side the picture is sampled across at 24 stations; an edge lies at the mean of the places weighted by
    how much brighter it gets there, outwards. Lines are fitted by total least squares, without the distortion of a
    lens.
    """
    picture = np.asarray(grey, dtype=np.float32)
    width = np.nan
    for _ in range(_ROUNDS):
        lines, widths = [], []
        for k in range(4):
            edge, spread = _edge(picture, corners[k], corners[(k + 1) % 4])
            if edge is None:
                return corners, width
            lines.append(_line(_straight(edge, camera)))
            widths.append(spread)
        crossed = np.array([_crossing(lines[k - 1], lines[k]) for k in range(4)])
        crossed = _bent(crossed, camera)
        if not np.isfinite(crossed).all() or np.abs(crossed - corners).max() > 4.0:
            return corners, width
        corners, width = crossed, float(max(widths))
    return corners, width


def _edge(picture: Array, start: Array, end: Array) -> tuple[Array | None, float]:
    """Return where a side's edge lies (S, 2) [px] and how wide it is; the tag is black and on the right of it."""
    along = end - start
    size = float(np.linalg.norm(along))
    if size < 8.0:
        return None, np.nan
    along = along / size
    outwards = np.array([along[1], -along[0]])
    stations = start + _STATIONS[:, None] * size * along
    places = stations[:, None] + _ACROSS[:, None] * outwards
    brighter = np.maximum(np.diff(_sampled(picture, places), axis=1), 0.0)
    middle = (_ACROSS[1:] + _ACROSS[:-1]) / 2.0
    weight = brighter.sum(axis=1)
    kept = weight >= 0.3 * np.median(weight)
    if kept.sum() < 6 or np.median(weight) < 5.0:
        return None, np.nan
    share = brighter[kept] / weight[kept, None]
    where = share @ middle
    width = np.sqrt(np.maximum(share @ middle**2 - where**2, 0.0))
    return stations[kept] + where[:, None] * outwards, float(np.median(width))


def _sampled(picture: Array, places: Array) -> Array:
    """Return bilinear samples (..,) at places (.., 2) [px]."""
    height, width = picture.shape
    x = np.clip(places[..., 0], 0.0, width - 1.001)
    y = np.clip(places[..., 1], 0.0, height - 1.001)
    i, j = x.astype(int), y.astype(int)
    u, v = x - i, y - j
    above = (1.0 - u) * picture[j, i] + u * picture[j, i + 1]
    below = (1.0 - u) * picture[j + 1, i] + u * picture[j + 1, i + 1]
    return np.asarray((1.0 - v) * above + v * below)


def _straight(points: Array, camera: Camera | None) -> Array:
    """Return pixels as an ideal lens would have them."""
    if camera is None or not camera.distortion.any():
        return points
    ideal = Camera(camera.matrix, camera.size, np.zeros(5))
    rays = camera.rays(points)
    return ideal.project(np.concatenate([rays, np.ones((len(rays), 1))], axis=1))


def _bent(points: Array, camera: Camera | None) -> Array:
    """Return the pixels of this lens, of those of an ideal one."""
    if camera is None or not camera.distortion.any():
        return points
    rays = Camera(camera.matrix, camera.size, np.zeros(5)).rays(points)
    return camera.project(np.concatenate([rays, np.ones((len(rays), 1))], axis=1))


def _line(points: Array) -> tuple[Array, float]:
    """Return normal and offset of the line of total least squares through points (N, 2)."""
    centre = points.mean(axis=0)
    normal = np.linalg.svd(points - centre, full_matrices=False)[2][1]
    return normal, float(normal @ centre)


def _crossing(a: tuple[Array, float], b: tuple[Array, float]) -> Array:
    matrix = np.stack([a[0], b[0]])
    if abs(np.linalg.det(matrix)) < 1e-6:
        return np.full(2, np.nan)
    return np.asarray(np.linalg.solve(matrix, [a[1], b[1]]))


def up_of_tag(video: Video, camera: Camera, said: str) -> Array:
    """Return the normal (3,) in camera axes of a tag that lies on the table: "tag:ID".

    Raises
    ------
    InvalidArgument
        It is no id, or not seen.
    """
    number = said.removeprefix("tag:")
    if not number.isdigit() or int(number) >= _IDS:
        raise InvalidArgument(f"up_axis: {said!r}, expected tag:ID with an id from 0 to {_IDS - 1}.")
    finder = TagFinder([Tag(int(number), 0.1, np.eye(3), np.zeros(3))], camera)
    normals: list[Array] = []
    for k, (_, picture) in enumerate(video.frames()):
        if k % 5 == 0 and (pose := finder.find(picture)) is not None:
            normals.append(pose[0][:, 2])
        if len(normals) >= _LOOKS:
            break
    if not normals:
        raise InvalidArgument(f"up_axis: {said!r}: no tag {number} of the family 36h11 is seen in the first video.")
    normal = np.median(normals, axis=0)
    return np.asarray(normal / np.linalg.norm(normal))
