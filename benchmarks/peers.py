"""Other packages on the same demonstration, as they are delivered; one that is not installed is left out.

movement_primitives starts at rest unless it is stepped by hand: `stepped` does that, for the best it can do.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from benchmarks.demonstrations import DT, TIME

Array = NDArray[np.float64]
Learner = Callable[[Array, int], Array]
"""Takes positions (1000, 3) or rotations (1000, 3, 3) and a number of kernels; returns them as reproduced."""

PACKAGES = {"movement_primitives": "movement-primitives", "pydmps": "pydmps"}
"""Names to import, and to install: pip install "dmpcpp[bench]"."""


def installed() -> dict[str, str | None]:
    """Return the version of every package, None where it is missing."""
    found: dict[str, str | None] = {}
    for name, distribution in PACKAGES.items():
        try:
            found[name] = version(distribution)
        except PackageNotFoundError:
            found[name] = None
    return found


def position_learners() -> dict[str, Learner]:
    """Return what there is for positions, by name."""
    return _present(
        {
            "movement_primitives": _mp_position,
            "movement_primitives, stepped": _mp_position_stepped,
            "pydmps": _pydmps_position,
        }
    )


def orientation_learners() -> dict[str, Learner]:
    """Return what there is for orientations, by name."""
    return _present({"movement_primitives": _mp_orientation, "movement_primitives, stepped": _mp_orientation_stepped})


def _present(learners: dict[str, Learner]) -> dict[str, Learner]:
    there = installed()
    return {name: learner for name, learner in learners.items() if there[name.split(",")[0]]}


def _mp_position(position: Array, basis_count: int) -> Array:
    dmp = _mp_dmp(position, basis_count)
    return np.asarray(dmp.open_loop()[1])[: len(TIME)]


def _mp_position_stepped(position: Array, basis_count: int) -> Array:
    dmp = _mp_dmp(position, basis_count)
    velocity = np.gradient(position, DT, axis=0, edge_order=2)[0]
    return _stepped(dmp, position[0], velocity)


def _mp_dmp(position: Array, basis_count: int) -> Any:
    from movement_primitives.dmp import DMP

    dmp = DMP(n_dims=3, execution_time=TIME[-1], dt=DT, n_weights_per_dim=basis_count)
    dmp.imitate(TIME, position)
    return dmp


def _mp_orientation(rotation: Array, basis_count: int) -> Array:
    dmp, _ = _mp_cartesian(rotation, basis_count)
    return _matrices(np.asarray(dmp.open_loop()[1])[: len(TIME), 3:])


def _mp_orientation_stepped(rotation: Array, basis_count: int) -> Array:
    dmp, poses = _mp_cartesian(rotation, basis_count)
    turn = Rotation.from_matrix(rotation[1] @ rotation[0].T).as_rotvec() / DT
    return _matrices(_stepped(dmp, poses[0], np.r_[np.zeros(3), turn])[:, 3:])


def _mp_cartesian(rotation: Array, basis_count: int) -> tuple[Any, Array]:
    from movement_primitives.dmp import CartesianDMP

    poses = np.c_[np.zeros((len(rotation), 3)), _quaternions(rotation)]
    dmp = CartesianDMP(execution_time=TIME[-1], dt=DT, n_weights_per_dim=basis_count)
    dmp.imitate(TIME, poses)
    return dmp, poses


def _stepped(dmp: Any, state: Array, velocity: Array) -> Array:
    """Roll out by hand from the demonstrated velocity, which open_loop ignores."""
    dmp.configure(start_yd=velocity)
    dmp.reset()
    states = [state]
    for _ in range(len(TIME) - 1):
        state, velocity = dmp.step(state, velocity)
        states.append(state.copy())
    return np.array(states)


def _pydmps_position(position: Array, basis_count: int) -> Array:
    from pydmps.dmp_discrete import DMPs_discrete

    dmp = DMPs_discrete(n_dmps=3, n_bfs=basis_count, dt=1.0 / len(position))
    dmp.imitate_path(y_des=position.T.copy())
    return np.asarray(dmp.rollout(timesteps=len(position))[0])


def _quaternions(rotation: Array) -> Array:
    """Quaternions (T, 4), w first, without changes of sign on the way."""
    q = Rotation.from_matrix(rotation).as_quat()[:, [3, 0, 1, 2]]
    flips = np.cumprod(np.r_[1.0, np.sign(np.sum(q[1:] * q[:-1], axis=1))])
    return np.asarray(q * flips[:, None])


def _matrices(quaternion: Array) -> Array:
    return Rotation.from_quat(quaternion[:, [1, 2, 3, 0]]).as_matrix()
