"""Joint motions made by hand, shared by benchmarks and tests of the simulation."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from dmpcpp import Arm
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]

HOME = {
    "panda": [0.0, -0.3, 0.0, -2.0, 0.0, 1.8, 0.8],
    "iiwa": [0.0, 0.5, 0.0, -1.2, 0.0, 0.9, 0.0],
    "xarm6": [0.0, -0.4, -1.0, 0.0, 1.0, 0.0],
}
_OF_TIP = {"panda_hand": "panda", "lbr_iiwa_link_7": "iiwa", "link6": "xarm6"}
PENDULUM = """<robot name="pendulum"><link name="base"/>
  <link name="rod"><inertial><origin xyz="0.4 0 0"/><mass value="2"/>
    <inertia ixx="{ixx}" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.03"/></inertial></link>
  <joint name="hinge" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" velocity="5" effort="50"/><dynamics damping="0.7"/></joint></robot>"""


@dataclass(frozen=True)
class Joints:
    """A joint trajectory made by hand, with the fields of ``dmpcpp.JointTrajectory``."""

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    joint_names: list[str]
    report: object = None


def home_of(arm: Arm) -> Array:
    """A bent posture, (n,) rad."""
    return np.array(HOME.get(_OF_TIP.get(arm.tip), [0.0] * arm.joint_count))


def trajectory(arm: Arm, time: Array, position: Array) -> Joints:
    """Through positions (T, n) at times (T,), with the derivatives of their cubic spline."""
    spline = CubicSpline(time, position)
    return Joints(time, np.asarray(position), spline(time, 1), spline(time, 2), list(arm.joint_names))


def reach(arm: Arm, target: ArrayLike, seconds: float = 1.0, home: ArrayLike | None = None) -> Joints:
    """A minimum-jerk motion from home: rest to rest."""
    time = np.linspace(0.0, seconds, round(100 * seconds) + 1)
    u = time / seconds
    blend = 10 * u**3 - 15 * u**4 + 6 * u**5
    home = home_of(arm) if home is None else np.asarray(home)
    return trajectory(arm, time, home + blend[:, None] * (np.asarray(target) - home))


def swing(arm: Arm, seconds: float = 1.0, centre: ArrayLike | None = None) -> Joints:
    """A motion cut out of a swing: it starts and ends at speed."""
    time = np.linspace(0.0, seconds, round(100 * seconds) + 1)
    phase = np.arange(arm.joint_count)
    centre = home_of(arm) if centre is None else np.asarray(centre)
    return trajectory(arm, time, centre + 0.3 * np.sin(2.0 * time[:, None] + phase))
