"""A program as a user writes it, for mypy --strict: see test_typing.py. Each `type: ignore` stands at a mistake."""

from pathlib import Path

import dmpcpp
import numpy as np
import numpy.typing as npt
from dmpcpp import export


def learned(time: npt.NDArray[np.float64], poses: npt.NDArray[np.float64]) -> dmpcpp.PoseDmp:
    demonstration = dmpcpp.PoseDemonstration(time, poses)
    return dmpcpp.PoseDmp.fit(demonstration, basis_count=50)


def stepped(model: dmpcpp.PoseDmp, goal: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    run = dmpcpp.PoseRun(model)
    run.goal = goal
    while run.step(1e-3):
        pass
    return run.pose


def followed(arm: dmpcpp.Arm, plan: dmpcpp.PoseTrajectory) -> dmpcpp.JointTrajectory:
    joints = dmpcpp.InverseKinematics(arm).follow(plan)
    factor: float = dmpcpp.duration_factor(joints, arm.velocity_limit, np.full(arm.joint_count, 5.0))
    solved: int = joints.report.solved
    return dmpcpp.stretched(joints, max(1.0, factor)) if solved else joints


def planned(path: Path) -> dmpcpp.PoseTrajectory:
    model = dmpcpp.load(str(path))
    assert isinstance(model, dmpcpp.PoseDmp)
    return model.rollout(duration=2.0, dt=0.01)


def written(path: Path, joints: dmpcpp.JointTrajectory, plan: dmpcpp.PoseTrajectory) -> None:
    export.write_joints(path / "joints.csv", joints)
    export.write_joints(path / "again.csv", export.read_joints(path / "joints.csv"))
    export.write_plan(path / "plan.npz", plan, base="base", tip="tip")


def chosen() -> dmpcpp.DmpOptions:
    options = dmpcpp.DmpOptions(regression="ridge")
    options.scaling = dmpcpp.Scaling.per_axis_relative
    return options if options == dmpcpp.DmpOptions() else dmpcpp.DmpOptions.source()


def mistaken(model: dmpcpp.PoseDmp) -> None:
    model.rollout(duration="two")  # type: ignore[arg-type]
    model.duration = 1.0  # type: ignore[misc]
    print(model.kernels)  # type: ignore[attr-defined]
    dmpcpp.PoseRun(model).step()  # type: ignore[call-arg]
