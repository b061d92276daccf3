"""Pictures of printed tags, drawn with an exact camera: a plane's pattern, averaged over pixels, blurred, grained."""

from __future__ import annotations

import cv2
import numpy as np
from dmpcpp.cameras import Camera, Tag

_FINE = 4  # samples a pixel, each way
_CELLS = 8


def _pattern(number: int) -> np.ndarray:
    """Return the tag (10, 10) with its white border, from 0 to 1."""
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    inner = cv2.aruco.generateImageMarker(dictionary, number, _CELLS) / 255.0
    return np.pad(inner, 1, constant_values=1.0)


def draw_tags(
    camera: Camera,
    tags: list[Tag],
    rotation: np.ndarray,
    position: np.ndarray,
    *,
    seed: int = 0,
    grain: float = 2.0,
    blur: float = 0.0,
) -> np.ndarray:
    """Return a picture (H, W, 3) of tags on a body; `blur` [px] is how far it moves to the right meanwhile."""
    rng = np.random.default_rng([seed, 3])
    width, height = camera.size
    picture = np.full((height, width), 120.0)
    order = sorted(tags, key=lambda tag: -(rotation @ tag.position + position)[2])
    for tag in order:
        turn, place = rotation @ tag.rotation, rotation @ tag.position + position
        if turn[:, 2] @ place >= 0.0:
            continue
        picture = _drawn(picture, camera, tag, turn, place)
    if blur:
        count = int(np.ceil(4 * blur))
        kernel = np.zeros((1, 2 * int(np.ceil(blur)) + 1))
        for at in np.linspace(-blur / 2.0, blur / 2.0, count):
            k = int(np.floor(at))
            share = at - k
            kernel[0, kernel.shape[1] // 2 + k] += 1.0 - share
            kernel[0, min(kernel.shape[1] // 2 + k + 1, kernel.shape[1] - 1)] += share
        picture = cv2.filter2D(picture, -1, kernel / kernel.sum(), borderType=cv2.BORDER_REPLICATE)
    picture = cv2.GaussianBlur(picture, (0, 0), 0.5) + grain * rng.standard_normal(picture.shape)
    return np.repeat(np.clip(picture, 0, 255).astype(np.uint8)[:, :, None], 3, axis=2)


def _drawn(picture: np.ndarray, camera: Camera, tag: Tag, turn: np.ndarray, place: np.ndarray) -> np.ndarray:
    half = tag.size / 2.0 * (_CELLS + 2) / _CELLS
    corners = np.array([[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]]) @ turn.T + place
    pixels = camera.project(corners)
    low = np.maximum(np.floor(pixels.min(axis=0)).astype(int) - 1, 0)
    high = np.minimum(np.ceil(pixels.max(axis=0)).astype(int) + 2, camera.size)
    if (high <= low).any():
        return picture
    offsets = (np.arange(_FINE) + 0.5) / _FINE - 0.5
    x = (np.arange(low[0], high[0])[:, None] + offsets).ravel()
    y = (np.arange(low[1], high[1])[:, None] + offsets).ravel()
    grid = np.stack(np.meshgrid(x, y), axis=-1)
    rays = np.concatenate([camera.rays(grid), np.ones((*grid.shape[:2], 1))], axis=-1)
    depth = (turn[:, 2] @ place) / (rays @ turn[:, 2])
    own = (rays * depth[..., None] - place) @ turn[:, :2]
    cell = tag.size / _CELLS
    column, row = np.floor((own[..., 0] + half) / cell).astype(int), np.floor((half - own[..., 1]) / cell).astype(int)
    inside = (column >= 0) & (column < _CELLS + 2) & (row >= 0) & (row < _CELLS + 2)
    tone = 25.0 + 200.0 * _pattern(tag.id)[np.clip(row, 0, _CELLS + 1), np.clip(column, 0, _CELLS + 1)]
    shape = (high[1] - low[1], _FINE, high[0] - low[0], _FINE)
    covered = inside.reshape(shape).mean(axis=(1, 3))
    tone = np.where(inside, tone, 0.0).reshape(shape).mean(axis=(1, 3))
    picture = picture.copy()
    part = picture[low[1] : high[1], low[0] : high[0]]
    picture[low[1] : high[1], low[0] : high[0]] = part * (1.0 - covered) + tone
    return picture
