"""A rigid body's pose from three or more markers that sit on it: least squares over rotations, frame by frame.

Source: W. Kabsch, A solution for the best rotation to relate two sets of vectors, Acta Cryst. A32 (1976); the
determinant of S. Umeyama, IEEE PAMI 13 (1991), keeps mirror images out. The body's shape is the mean of its frames
after alignment (generalised Procrustes analysis, J. C. Gower, Psychometrika 40 (1975)).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from dmpcpp._notes import Note
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.recordings._markers import Markers
from dmpcpp.recordings._orientation import HELD_FIXED, held_fixed
from dmpcpp.recordings._recording import Recording

__all__ = ["fit_poses", "of_markers", "rigid_body", "single_marker"]

_LEAST_HEIGHT = 0.05  # of the triangle's longest side: what is flatter gives no turn about that side
_ROUNDS = 5  # of alignment and mean; the shape settles by orders of magnitude in each
_FARTHEST = 1e6  # m
_WORTH_A_WARNING = 0.005  # m rms; optical systems leave 0.1 mm on a plate, skin some millimetres


def rigid_body(
    markers: Markers, names: Sequence[str], body: str | None = None, max_residual: float | None = None
) -> Recording:
    """Return the motion of the rigid body that carries some markers.

    The body's origin is the mean of its markers; x points from the first marker to the second, z along the normal
    of the first three, y completes them. Where a marker is missing, the others count as long as there are three.

    Parameters
    ----------
    markers : Markers
    names : sequence of str
        Three or more markers that keep their distances, not in one line; the first three say where the axes point.
    body : str, optional
        What the body is called; the names joined by "+" unless given.
    max_residual : float, optional
        m. Frames whose markers lie further from the rigid shape, root mean square, are taken as missing: markers
        that were mistaken for one another.

    Returns
    -------
    Recording
        NaN where fewer than three markers, or three in one line, are left; its history says the residual.

    Raises
    ------
    InvalidArgument
        Fewer than three markers, an unknown one, markers in one line, or no frame that shows them all.
    """
    names = tuple(names) if not isinstance(names, str) else (names,)
    if len(set(names)) < 3 or len(set(names)) < len(names):
        raise InvalidArgument(
            f"markers: {', '.join(names) or 'none'}; expected three or more that differ, or one with "
            "fixed_orientation=True."
        )
    if max_residual is not None and not 0.0 < max_residual < np.inf:
        raise InvalidArgument(f"max_residual: {max_residual}, expected a positive length in m.")
    chosen = markers.chosen(names)
    names = chosen.names
    _require_near(chosen)
    shape = _shape(chosen)
    rotation, position, residual = fit_poses(shape, chosen.position)
    notes = [*markers.history, f"rigid body of {', '.join(names)}"]
    if max_residual is not None:
        strayed = residual > max_residual
        rotation[strayed], position[strayed], residual[strayed] = np.nan, np.nan, np.nan
        notes.append(f"{int(strayed.sum())} frames with residuals above {1e3 * max_residual:g} mm taken as missing")
    return Recording(
        time=markers.time,
        position=position,
        rotation=rotation,
        body=body if body is not None else "+".join(names),
        source=markers.source,
        up_axis=markers.up_axis,
        history=(*notes, *_found(residual)),
    )


def of_markers(
    markers: Markers, names: Sequence[str], body: str | None = None, fixed_orientation: bool | None = None
) -> Recording:
    """Return the `rigid_body` of markers, or where the orientation may be held fixed the `single_marker`.

    Errors are those of the two.
    """
    if fixed_orientation and not isinstance(names, str) and len(names) == 1:
        return single_marker(markers, names[0], body)
    return rigid_body(markers, names, body)


def single_marker(markers: Markers, name: str, body: str | None = None) -> Recording:
    """Return the motion of one marker, its orientation held fixed (the identity): a point does not turn.

    Raises
    ------
    InvalidArgument
        The marker is unknown, or hardly ever seen.
    """
    chosen = markers.chosen([name])
    missing = chosen.missing[:, 0]
    lost = f"{int(missing.sum())} of {len(missing)} samples are missing: the marker not seen"
    return Recording(
        time=markers.time,
        position=chosen.position[:, 0],
        rotation=held_fixed(missing),
        body=body if body is not None else chosen.names[0],
        source=markers.source,
        up_axis=markers.up_axis,
        history=(*markers.history, HELD_FIXED, *([lost] if missing.any() else [])),
    )


def fit_poses(shape: Array, position: Array) -> tuple[Array, Array, Array]:
    """Return the poses that lay a shape over measured points with the least squared distance.

    Parameters
    ----------
    shape : array (M, 3)
        The points in the body's frame [m].
    position : array (T, M, 3)
        The points in the world [m]; NaN where not seen.

    Returns
    -------
    rotation : array (T, 3, 3), position : array (T, 3), residual : array (T,)
        Body -> world; root mean square distance [m]. NaN where the points seen do not determine a pose.
    """
    seen = ~np.isnan(position).any(axis=2)
    enough = _determined(shape, seen)
    weight = np.where(enough[:, None], seen, True) / np.where(enough, seen.sum(axis=1), len(shape))[:, None]
    points = np.where((seen & enough[:, None])[:, :, None], position, 0.0)
    points_mean = np.einsum("tm,tmi->ti", weight, points)
    shape_mean = np.einsum("tm,mi->ti", weight, shape)
    spread = np.einsum("tm,tmi,tmj->tij", weight, points - points_mean[:, None], shape[None] - shape_mean[:, None])
    rotation = _nearest_rotation(spread)
    origin = points_mean - np.einsum("tij,tj->ti", rotation, shape_mean)
    laid = np.einsum("tij,mj->tmi", rotation, shape) + origin[:, None]
    residual = np.sqrt(np.einsum("tm,tmi->t", weight, np.square(laid - points)))
    rotation[~enough], origin[~enough], residual[~enough] = np.nan, np.nan, np.nan
    return rotation, origin, residual


def _nearest_rotation(spread: Array) -> Array:
    """Return the rotations (T, 3, 3) that maximise the trace of R^T spread."""
    u, _, vt = np.linalg.svd(spread)
    u[:, :, 2] *= np.sign(np.linalg.det(u) * np.linalg.det(vt))[:, None]
    return np.asarray(u @ vt)


def _determined(shape: Array, seen: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return in which frames (T,) the points seen span a plane."""
    enough = np.zeros(len(seen), dtype=bool)
    patterns, which = np.unique(seen, axis=0, return_inverse=True)
    for k, pattern in enumerate(patterns):
        enough[which.reshape(-1) == k] = pattern.sum() >= 3 and _flatness(shape[pattern]) >= _LEAST_HEIGHT
    return enough


def _flatness(points: Array) -> float:
    """Return the second extent of points over their first, 0 for a line."""
    extents = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return float(extents[1] / extents[0]) if extents[0] > 0.0 else 0.0


def _shape(chosen: Markers) -> Array:
    """Return the markers (M, 3) in the body's frame."""
    whole = ~chosen.missing.any(axis=1)
    if not whole.any():
        rates = ", ".join(
            f"{n} {100 * m:.0f} %" for n, m in zip(chosen.names, chosen.missing.mean(axis=0), strict=True)
        )
        raise InvalidArgument(f"markers: no frame shows all of them. Missing: {rates}. Leave some out.")
    frames = chosen.position[whole]
    shape = frames[0]
    if min(_flatness(shape), _flatness(shape[:3])) < _LEAST_HEIGHT:
        raise InvalidArgument(
            f"markers: {', '.join(chosen.names)} lie on one line; the rotation about it is undefined."
        )
    for _ in range(_ROUNDS):
        rotation, origin, _ = fit_poses(shape, frames)
        shape = np.einsum("tji,tmj->mi", rotation, frames - origin[:, None]) / len(frames)
        if min(_flatness(shape), _flatness(shape[:3])) < _LEAST_HEIGHT:
            raise InvalidArgument(
                f"markers: {', '.join(chosen.names)} do not keep their distances: in the mean of all frames they "
                "lie in one line. Choose markers that sit on one rigid body."
            )
    return _in_own_axes(shape)


def _require_near(chosen: Markers) -> None:
    """Refuse markers so far away that the squares of their distances overflow, or leave no digits for the body."""
    farthest = float(np.abs(chosen.position[~chosen.missing]).max(initial=0.0))
    if farthest > _FARTHEST:
        raise InvalidArgument(
            f"markers: one is {farthest:.3g} m from the origin, expected at most {_FARTHEST:g} m. State the unit, or "
            "crop such frames out."
        )


def _in_own_axes(shape: Array) -> Array:
    x = shape[1] - shape[0]
    z = np.cross(x, shape[2] - shape[0])
    axes = np.array([x, np.cross(z, x), z])
    return (shape - shape.mean(axis=0)) @ (axes / np.linalg.norm(axes, axis=1)[:, None]).T


def _found(residual: Array) -> list[str]:
    known = residual[~np.isnan(residual)]
    notes = []
    if len(known) < len(residual):
        notes.append(f"{len(residual) - len(known)} of {len(residual)} samples are missing: too few markers seen")
    if len(known):
        rms = float(np.sqrt(np.mean(known**2)))
        text = f"markers lie {1e3 * rms:.3g} mm rms from the rigid body, at most {1e3 * known.max():.3g} mm"
        doubtful = rms > _WORTH_A_WARNING
        notes.append(Note("warning", f"{text}: do they sit on one body?") if doubtful else Note("changed", text))
    return notes
