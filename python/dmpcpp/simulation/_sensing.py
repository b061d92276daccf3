"""What a controller sees of an arm: late and noisy, if the disturbance says so."""

from __future__ import annotations

from collections import deque

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.robot import Disturbance

JointState = tuple[Array, Array]


class Sensors:
    """Joint states as they reach the controller; one per run.

    Parameters
    ----------
    disturbance : Disturbance
        Its delay, its noise and its seed.
    time_step : float
        [s] between two calls of ``see``.
    """

    def __init__(self, disturbance: Disturbance, time_step: float) -> None:
        """Start with nothing seen."""
        self._line: deque[JointState] = deque(maxlen=1 + round(disturbance.sensor_delay / time_step))
        self._noise = disturbance.position_noise, disturbance.velocity_noise
        self._noisy = any(self._noise)
        self._random = np.random.default_rng([disturbance.seed, 1])  # not the stream that draws the masses

    def see(self, state: JointState) -> JointState:
        """Take in the state of now, give out that of ``sensor_delay`` ago: at first the oldest there is."""
        self._line.append(self._disturbed(state) if self._noisy else state)
        return self._line[0]

    def _disturbed(self, state: JointState) -> JointState:
        position, velocity = (
            true + size * self._random.standard_normal(true.shape)
            for true, size in zip(state, self._noise, strict=True)
        )
        return position, velocity
