"""Other packages' inverse kinematics and timing, set up as well as their documentation allows; one that is not
installed is left out, and said so.
"""

from __future__ import annotations

import logging
import tempfile
import warnings
from collections.abc import Callable
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
from dmpcpp import Arm, IkBackend, InverseKinematics

from benchmarks.kinematics_arms import TOLERANCE, Array

Solver = Callable[[Array, Array], Array]
"""Takes a pose (4, 4) and a seed (n,), returns joints (n,)."""

PACKAGES = ("roboticstoolbox-python", "pytracik", "pin-pink", "toppra", "example-robot-data")


def installed() -> str:
    """Return the packages with their versions, in one line."""
    found = []
    for name in PACKAGES:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            found.append(f"{name} missing")
    return ", ".join(found)


def ours(arm: Arm, backend: IkBackend = IkBackend.bounded_lm, **options: float) -> Solver:
    """Return this library's search around one of its backends."""
    solver = InverseKinematics(
        arm,
        backend=backend,
        position_tolerance=0.5 * TOLERANCE,
        angle_tolerance=0.5 * TOLERANCE,
        diagnose=False,
        **options,
    )
    return lambda pose, seed: solver.solve(pose, seed).joints


def solvers(arm: Arm, urdf: str) -> dict[str, Solver]:
    """Return every peer for single poses, by name; KDL's LMA with restarts, windings and limits among them."""
    found = {
        "KDL LMA, restarts": ours(arm, IkBackend.kdl_lma),
        "roboticstoolbox ik_LM": _present(_roboticstoolbox, arm, urdf),
        "pytracik Speed": _present(_trac_ik, arm, urdf),
    }
    return {name: solver for name, solver in found.items() if solver is not None}


def trackers(arm: Arm, urdf: str, dt: float) -> dict[str, Solver]:
    """Return every peer for one pose after the other, each begun at the joints of the one before."""
    found = {
        "KDL LMA": ours(arm, IkBackend.kdl_lma),
        "KDL NR_JL": ours(arm, IkBackend.kdl_nr_jl),
        "roboticstoolbox ik_LM": _present(_roboticstoolbox, arm, urdf),
        "pytracik Speed": _present(_trac_ik, arm, urdf),
        "pink, daqp": _present(_pink, arm, urdf, dt),
    }
    return {name: solver for name, solver in found.items() if solver is not None}


def toppra_duration(times: Array, positions: Array, velocity: Array, acceleration: Array) -> float:
    """Seconds that toppra's timing of the spline through the positions takes."""
    import toppra
    from toppra.algorithm import TOPPRA
    from toppra.constraint import JointAccelerationConstraint, JointVelocityConstraint

    logging.getLogger("toppra").setLevel(logging.ERROR)
    limits = [
        JointVelocityConstraint(np.stack([-velocity, velocity], axis=1)),
        JointAccelerationConstraint(np.stack([-acceleration, acceleration], axis=1)),
    ]
    path = toppra.SplineInterpolator(times, positions)
    return float(TOPPRA(limits, path, solver_wrapper="seidel").compute_trajectory(0, 0).duration)


def _present(make: Callable[..., Solver], *arguments: Any) -> Solver | None:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return make(*arguments)
    except ImportError:
        return None


def _roboticstoolbox(arm: Arm, urdf: str) -> Solver:
    import roboticstoolbox

    with tempfile.TemporaryDirectory() as folder:
        bare = Path(folder) / "bare.urdf"
        bare.write_bytes(_without_meshes(urdf))
        chain = roboticstoolbox.Robot.URDF(str(bare)).ets(start=arm.base, end=arm.tip)
    energy = 0.5 * (0.5 * TOLERANCE) ** 2  # half the squared error, as its tolerance counts
    return lambda pose, seed: np.asarray(chain.ik_LM(pose, q0=seed, tol=energy, joint_limits=True).q)


def _without_meshes(urdf: str) -> bytes:
    """The links and joints alone: roboticstoolbox looks for the files of meshes and refuses some transmissions."""
    robot = ElementTree.parse(urdf).getroot()
    for element in list(robot):
        if element.tag not in ("link", "joint"):
            robot.remove(element)
    for link in robot.iter("link"):
        for part in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(part)
    return bytes(ElementTree.tostring(robot))


def _trac_ik(arm: Arm, urdf: str) -> Solver:
    from trac_ik import TracIK

    solver = TracIK(arm.base, arm.tip, urdf, timeout=0.005, epsilon=0.5 * TOLERANCE, solver_type="Speed")
    solver.joint_limits = arm.lower, arm.upper  # it reads those of a joint with a safety_controller as 0 to 0

    def solve(pose: Array, seed: Array) -> Array:
        joints = solver.ik(pose[:3, 3], pose[:3, :3], seed)
        return seed if joints is None or len(joints) == 0 else np.asarray(joints)

    return solve


def _pink(arm: Arm, urdf: str, dt: float) -> Solver:
    import daqp  # noqa: F401 (the solver that pink is told to use)
    import pink
    import pinocchio

    whole = pinocchio.buildModelFromUrdf(urdf)
    others = [i for i in range(1, whole.njoints) if whole.names[i] not in arm.joint_names]
    model = pinocchio.buildReducedModel(whole, others, pinocchio.neutral(whole))
    data = model.createData()
    task = pink.FrameTask(arm.tip, position_cost=1.0, orientation_cost=1.0)
    pinocchio.forwardKinematics(model, data, pinocchio.neutral(model))
    base = pinocchio.updateFramePlacement(model, data, model.getFrameId(arm.base))

    def solve(pose: Array, seed: Array) -> Array:
        configuration = pink.Configuration(model, data, seed)
        task.set_target(base * pinocchio.SE3(pose))
        for _ in range(5):
            velocity = pink.solve_ik(configuration, [task], dt, solver="daqp", safety_break=False)
            configuration.integrate_inplace(velocity, dt)
            if np.abs(task.compute_error(configuration)).max() < 0.5 * TOLERANCE:
                break
        return np.array(configuration.q)

    return solve
