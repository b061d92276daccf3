"""Every figure of accuracy: what is measured, what other packages reach, and what this library must reach.

Each function measures one demonstration and returns its figures, so that tests and the table ask the same code.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from dmpcpp import (
    Demonstration,
    Dmp,
    DmpOptions,
    OrientationDemonstration,
    OrientationDmp,
    PoseDemonstration,
    PoseDmp,
    reproduction,
)
from dmpcpp.metrics import rotation_angles
from dmpcpp.trials.reproduction._repetition import with_angle_noise, with_position_noise
from numpy.typing import NDArray

from benchmarks import demonstrations, peers
from benchmarks.demonstrations import TIME

Array = NDArray[np.float64]

SEEDS = 20
LWR: dict[str, Any] = {"basis_count": 100, "regression": "lwr", "derivatives": "interpolate"}
RIDGE: dict[str, Any] = {"basis_count": 100, "regression": "ridge", "derivatives": "interpolate"}
_MM, _DEG = 1e3, math.degrees(1.0)


@dataclass(frozen=True)
class Figure:
    """One number and what it must not exceed.

    Attributes
    ----------
    name, unit : str
    value, goal : float
    peers : dict of str to float
        What other packages reach on the same demonstration, by their name.
    """

    name: str
    value: float
    goal: float
    unit: str
    peers: dict[str, float] = field(default_factory=dict)

    @property
    def ok(self) -> bool:
        """Whether the goal is reached."""
        return self.value <= self.goal

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self) | {"ok": self.ok}


# ---- clean demonstrations: root mean square error over the 1000 samples ---------------------------------------------


def helix() -> list[Figure]:
    """Eight turns at full speed at both ends: as chosen, and both regressions with N = 100 [mm]."""
    return _position_figures("helix of 8 turns", demonstrations.helix(), default=0.06, ridge=1e-3)


def reach() -> list[Figure]:
    """A minimum-jerk reach of 540 mm, from rest to rest: as chosen, and both regressions with N = 100 [mm]."""
    return _position_figures("minimum-jerk reach", demonstrations.reach(), default=1.5e-3, ridge=1e-5)


def rotation() -> list[Figure]:
    """The rotation to t = 3: as chosen, and both regressions with N = 100 [deg]."""
    shown = demonstrations.turning(3.0)
    others = _peers(peers.orientation_learners(), shown, 100, angle_rmse)
    return [
        Figure("rotation t < 3", angle_rmse(shown, reproduced_rotation(shown)), 5e-4, "deg", others),
        Figure("rotation t < 3, lwr", angle_rmse(shown, reproduced_rotation(shown, **LWR)), 5e-4, "deg"),
        Figure("rotation t < 3, ridge", angle_rmse(shown, reproduced_rotation(shown, **RIDGE)), 1e-5, "deg"),
    ]


def rotation_through_pi() -> list[Figure]:
    """The rotation to t = 4.995, which passes 179.95 deg from its goal [deg]."""
    figures = []
    for rest in (False, True):
        shown = demonstrations.turning(TIME[-1], rest_to_rest=rest)
        for count, goal in ((50, 0.01), (100, 1e-3)):
            name = f"rotation t < 4.995 through pi, {'rest-to-rest' if rest else 'natural'}, N = {count}"
            others = _peers(peers.orientation_learners(), shown, count, angle_rmse)
            value = angle_rmse(shown, reproduced_rotation(shown, basis_count=count))
            figures.append(Figure(name, value, goal, "deg", others))
    return figures


def reach_rotations() -> list[Figure]:
    """Minimum-jerk rotations about one axis by pi to 2 pi, N = 100 [deg]."""
    figures = []
    for turns in (1.0, 1.2, 1.5, 2.0):
        shown = demonstrations.reach_rotation(turns * math.pi)
        others = _peers(peers.orientation_learners(), shown, 100, angle_rmse)
        value = angle_rmse(shown, reproduced_rotation(shown))
        figures.append(Figure(f"reach rotation by {turns:g} pi", value, 0.01, "deg", others))
    return figures


def recorded(folder: Path) -> list[Figure]:
    """Hand-guided poses, medians over the 18, in % of the bounding box's diagonal and in degrees."""
    shares: dict[int, list[float]] = {0: [], 100: [], 200: []}
    angles: dict[int, list[float]] = {0: [], 100: [], 200: []}
    for position, turned in demonstrations.recorded_poses(folder):
        demonstration = PoseDemonstration(TIME, poses(position, turned))
        for count in shares:
            again = PoseDmp.fit(demonstration, basis_count=count).rollout_at(TIME)
            shares[count].append(diagonal_share(position, again.position))
            angles[count].append(angle_rmse(turned, again.rotation))
    figures = []
    for count, share, angle in ((0, 6e-3, 0.12), (100, 6e-3, 0.12), (200, 6e-3, 0.07)):
        name = f"recorded poses, {f'N = {count}' if count else 'as chosen'}"
        of_others = count == 100
        positions = _recorded_positions(folder) if of_others else {}
        turns = _recorded_turns(folder) if of_others else {}
        figures.append(Figure(f"{name}, position, median", float(np.median(shares[count])), share, "%", positions))
        figures.append(Figure(f"{name}, orientation, median", float(np.median(angles[count])), angle, "deg", turns))
    return figures


def source() -> list[Figure]:
    """The source's helix: its largest errors by its own equations, and the default's share of them."""
    errors = reproduction.helix().errors
    found, ours = errors["source"].max, errors["default"].max
    figures = []
    for axis, value, default, known in zip("xyz", found, ours, reproduction.SOURCE_ERRORS, strict=True):
        off = float(100.0 * abs(value / known - 1.0))
        figures.append(Figure(f"source's helix, {axis}: its equations off {known:g}", off, 2.0, "%"))
        figures.append(Figure(f"source's helix, {axis}: default to source", float(default / value), 1e-3, "1"))
    return figures


# ---- noise: root mean square error per axis against the clean truth, mean of 20 seeds -------------------------------


def noise(duration: float) -> list[Figure]:
    """1 mm per axis and 1 deg per component at 200 Hz, smoothed: helix of 0.1 m radius, rotation to 3."""
    time, position, turned = _clean(duration)
    lengths, turns = [], []
    for seed in range(SEEDS):
        rng = np.random.default_rng([seed, round(duration)])
        shown = Demonstration(time, with_position_noise(position, 1e-3, rng))
        lengths.append(axis_rmse(position, Dmp.fit(shown).rollout_at(time).position))
        turning = OrientationDemonstration(time, with_angle_noise(turned, math.radians(1.0), rng))
        again = OrientationDmp.fit(turning).rollout_at(time).rotation
        turns.append(angle_rmse(turned, again) / math.sqrt(3.0))
    return [
        Figure(f"1 mm noise, helix, T = {duration:g} s, per axis", float(np.mean(lengths)), 0.33, "mm"),
        Figure(f"1 deg noise, rotation t < 3, T = {duration:g} s, per axis", float(np.mean(turns)), 0.2, "deg"),
    ]


def noise_together(duration: float) -> list[Figure]:
    """20 demonstrations of the helix with 1 mm noise per axis, learned together; mean of 5 such sets."""
    time, position, _ = _clean(duration)
    errors = []
    for group in range(5):
        rngs = [np.random.default_rng([seed, group, round(duration)]) for seed in range(SEEDS)]
        shown = [Demonstration(time, with_position_noise(position, 1e-3, rng)) for rng in rngs]
        errors.append(axis_rmse(position, Dmp.fit(shown).rollout_at(time).position))
    name = f"1 mm noise, helix, T = {duration:g} s, 20 demonstrations together, per axis"
    return [Figure(name, float(np.mean(errors)), 0.13, "mm")]


# ---- rates: rollouts at 20 Hz, 200 Hz and 1 kHz at common times -----------------------------------------------------


def rates() -> list[Figure]:
    """Largest disagreement, relative to the largest axis range, and in rad."""
    k = np.arange(201)
    spiral = Demonstration(0.005 * k, np.c_[np.sin(0.05 * k), np.cos(0.05 * k), 2.0 * k])
    figures = []
    for shown in (spiral, Demonstration(TIME, demonstrations.helix())):
        size = float(np.ptp(shown.position, axis=0).max())
        worst = _disagreement(Dmp.fit(shown, **LWR), lambda a, b: np.abs(a.position - b.position).max()) / size
        figures.append(Figure(f"helix, T = {shown.duration:g} s: 20 Hz, 200 Hz, 1 kHz agree", worst, 1e-6, "1"))
    turned = demonstrations.turning(3.0)
    model = OrientationDmp.fit(OrientationDemonstration(TIME, turned), **LWR)
    worst = _disagreement(model, lambda a, b: rotation_angles(a.rotation, b.rotation).max())
    figures.append(Figure("rotation t < 3: 20 Hz, 200 Hz, 1 kHz agree", worst, 1e-6, "rad"))
    return [*figures, *_in_phase(demonstrations.helix(), turned)]


def _in_phase(position: Array, turned: Array) -> list[Figure]:
    """A pose moves as its position and its orientation alone do, at every rate."""
    both = PoseDmp.fit(PoseDemonstration(TIME, poses(position, turned)), **LWR)
    turning = OrientationDmp.fit(OrientationDemonstration(TIME, turned), **LWR)
    alone = Dmp.fit(Demonstration(TIME, position), **LWR), turning
    apart, angle = 0.0, 0.0
    for dt in (0.05, 0.005, 0.001):
        pose = both.rollout(dt=dt)
        apart = max(apart, float(np.abs(pose.position - alone[0].rollout(dt=dt).position).max()))
        angle = max(angle, float(rotation_angles(pose.rotation, alone[1].rollout(dt=dt).rotation).max()))
    return [
        Figure("pose against position alone at every rate", apart / float(np.ptp(position, axis=0).max()), 1e-6, "1"),
        Figure("pose against orientation alone at every rate", angle, 1e-6, "rad"),
    ]


# ---- what they are made of ------------------------------------------------------------------------------------------


def reproduced_position(position: Array, **options: Any) -> Array:
    """Return `position` (1000, 3) after learning and rolling out at the same times."""
    return Dmp.fit(Demonstration(TIME, position), DmpOptions(**options)).rollout_at(TIME).position


def reproduced_rotation(turned: Array, **options: Any) -> Array:
    """Return `turned` (1000, 3, 3) after learning and rolling out at the same times."""
    return OrientationDmp.fit(OrientationDemonstration(TIME, turned), DmpOptions(**options)).rollout_at(TIME).rotation


def position_rmse(reference: Array, positions: Array) -> float:
    """Root mean square distance [mm] of positions (T, 3) [m]."""
    return _MM * float(np.sqrt(np.mean(np.sum((positions - reference) ** 2, axis=1))))


def axis_rmse(reference: Array, positions: Array) -> float:
    """The same per axis: 1 / sqrt(3) of it [mm]."""
    return position_rmse(reference, positions) / math.sqrt(3.0)


def angle_rmse(reference: Array, rotations: Array) -> float:
    """Root mean square geodesic angle [deg] of rotations (T, 3, 3)."""
    return _DEG * float(np.sqrt(np.mean(rotation_angles(reference, rotations) ** 2)))


def diagonal_share(reference: Array, positions: Array) -> float:
    """Root mean square distance in % of the diagonal of the reference's bounding box."""
    return 100.0 * position_rmse(reference, positions) / _MM / float(np.linalg.norm(np.ptp(reference, axis=0)))


def poses(position: Array, turned: Array) -> Array:
    """Both as matrices (T, 4, 4)."""
    pose = np.tile(np.eye(4), (len(position), 1, 1))
    pose[:, :3, :3], pose[:, :3, 3] = turned, position
    return pose


def _position_figures(name: str, shown: Array, *, default: float, ridge: float) -> list[Figure]:
    others = _peers(peers.position_learners(), shown, 100, position_rmse)
    return [
        Figure(name, position_rmse(shown, reproduced_position(shown)), default, "mm", others),
        Figure(f"{name}, lwr", position_rmse(shown, reproduced_position(shown, **LWR)), default, "mm"),
        Figure(f"{name}, ridge", position_rmse(shown, reproduced_position(shown, **RIDGE)), ridge, "mm"),
    ]


def _peers(
    learners: dict[str, peers.Learner], shown: Array, basis_count: int, error: Callable[[Array, Array], float]
) -> dict[str, float]:
    return {name: error(shown, learner(shown, basis_count)) for name, learner in learners.items()}


def _recorded_positions(folder: Path) -> dict[str, float]:
    return _medians(
        _peers(peers.position_learners(), position, 100, diagonal_share)
        for position, _ in demonstrations.recorded_poses(folder)
    )


def _recorded_turns(folder: Path) -> dict[str, float]:
    return _medians(
        _peers(peers.orientation_learners(), turned, 100, angle_rmse)
        for _, turned in demonstrations.recorded_poses(folder)
    )


def _medians(errors: Iterator[dict[str, float]]) -> dict[str, float]:
    rows = list(errors)
    return {name: float(np.median([row[name] for row in rows])) for name in rows[0]}


def _clean(duration: float) -> tuple[Array, Array, Array]:
    """Time, the source's helix scaled to 0.1 m radius (10 rad/s, 40 mm/s up), and the rotation to 3, at 200 Hz."""
    time = demonstrations.DT * np.arange(round(duration / demonstrations.DT) + 1)
    position = np.c_[0.1 * np.sin(10.0 * time), 0.1 * np.cos(10.0 * time), 0.04 * time]
    return time, position, demonstrations.euler_rotations(3.0 * time / time[-1])


def _disagreement(model: Any, distance: Callable[[Any, Any], float]) -> float:
    """Largest distance of rollouts at 20 and 200 Hz from the one at 1 kHz, at the times of the former."""
    worst = 0.0
    fine = model.rollout(dt=0.001)
    for every, dt in ((50, 0.05), (5, 0.005)):
        times = np.arange(int(model.duration / dt + 1e-6) + 1) * dt  # without the shorter step at the end
        coarse = model.rollout_at(times)
        worst = max(worst, float(distance(coarse, _Thinned(fine, every, len(coarse)))))
    return worst


class _Thinned:
    """Every n-th sample of a rollout."""

    def __init__(self, rollout: Any, every: int, count: int) -> None:
        self._rollout, self._every, self._count = rollout, every, count

    def __getattr__(self, name: str) -> Array:
        return np.asarray(getattr(self._rollout, name)[:: self._every][: self._count])
