"""From a video of printed tags to the poses of what carries them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from dmpcpp._notes import Note
from dmpcpp.cameras._accuracy import Accuracy
from dmpcpp.cameras._camera import Camera
from dmpcpp.cameras._fit import Motion
from dmpcpp.cameras._frames import open_video
from dmpcpp.cameras._poses import Found, Poses, band_limited
from dmpcpp.cameras._setup import level_world, require_up
from dmpcpp.cameras._tags import TagFinder, body_of_tags, up_of_tag
from dmpcpp.cameras._two_views import frames_between
from dmpcpp.errors import InvalidArgument

__all__ = ["TagSetup", "tag_poses"]

_LEAST_FOUND = 12  # frames
_LEAST_SHARE = 0.3
_SHARP = 1.1  # px, width of an edge; beyond, the tag is blurred
_LOST = 10  # frames after which the last pose says nothing of the next
_WORTH_A_WARNING = 0.5  # px rms


@dataclass(frozen=True)
class TagSetup:
    """What is stated about a video of tags: camera for a size (width, height), tags, where up is, pitch."""

    camera: Callable[[tuple[int, int]], Camera]
    tags: str
    up: str
    pitch: str | float | None = None


def tag_poses(path: Path, setup: TagSetup) -> Poses:
    """Return the poses of a tag, or of a body of tags.

    Raises
    ------
    FileError, InvalidArgument
        The video cannot be read, or hardly shows the tags.
    MissingDependency
        OpenCV is missing.
    """
    require_up(setup.up)
    tags = body_of_tags(setup.tags)
    video = open_video(path)
    camera = setup.camera(video.size)
    normal = up_of_tag(video, camera, setup.up) if setup.up.startswith("tag:") else None
    finder = TagFinder(tags, camera)
    times, poses, residuals, blurs, lost = [], [], [], [], 0
    for time, picture in video.frames():
        pose = finder.find(picture)
        lost = 0 if pose is not None else lost + 1
        if lost == _LOST:
            finder.forget()
        times.append(time)
        poses.append(pose if pose is not None else (np.full((3, 3), np.nan), np.full(3, np.nan)))
        residuals.append(finder.residual if pose is not None else np.nan)
        blurs.append(finder.blur)
    rotation, position = (np.array(each) for each in zip(*poses, strict=True))
    seen = np.isfinite(position).all(axis=1)
    _require_seen(seen, [tag.id for tag in tags])
    inside = slice(*(np.flatnonzero(seen)[[0, -1]] + [0, 1]))
    time, seen = np.array(times)[inside], seen[inside]
    rotation, position = frames_between(time, rotation[inside], position[inside])
    depth = float(np.median(position[:, 2]))
    accuracy = _accuracy(finder, float(np.nanmedian(residuals)), depth)
    notes = [Note("changed", _words(seen, residuals, finder))]
    if (blur := float(np.nanmedian(blurs))) > _SHARP:
        said = f"the tag's edges are {blur:.2g} px wide: blurred. More light and a short exposure (1/250 s) help"
        notes.append(Note("warning", said))
    noise = np.random.default_rng(0).standard_normal((len(time), 12)) * accuracy.position / np.sqrt(3.0)
    motion = Motion(rotation, position, tags[0].corners, np.zeros((1, len(time), 1, 2)), np.zeros((len(time), 6)))
    turn, axis, words = level_world(setup.up, setup.pitch, normal)
    return band_limited(Found(time, motion, seen, noise, accuracy, notes, highest=10.0), turn, axis, words)


def _require_seen(seen: np.ndarray, ids: list[int]) -> None:
    count = int(seen.sum())
    if count < _LEAST_FOUND or count < _LEAST_SHARE * len(seen):
        named = ", ".join(map(str, ids))
        raise InvalidArgument(
            f"tag: {named} of the family 36h11 found in {count} of {len(seen)} frames, expected most of them. Show it "
            "to the camera, flat and well lit, with its white border; a blurred tag is not found: more light, 1/250 s."
        )


def _accuracy(finder: TagFinder, residual: float, depth: float) -> Accuracy:
    """Return what an error of the corners, as the fit shows it, makes of depth and turn of the largest tag."""
    size = max(tag.size for tag in finder.tags.values())
    corner = max(residual, 0.03) / finder.camera.focal
    along = corner * depth**2 / size
    return Accuracy(float(np.hypot(along, corner * depth)), float(3.0 * corner * depth / size))


def _words(seen: np.ndarray, residuals: list[float], finder: TagFinder) -> str:
    said = f"tag found in {int(seen.sum())} of {len(seen)} frames, corners miss by {np.nanmedian(residuals):.2g} px rms"
    return said + (f"; {finder.rejected} faces that did not fit left out" if finder.rejected else "")
