"""Links without a mass: from their shapes by a density, by kinematics alone, or not at all."""

import json

import numpy as np
import pytest
from dmpcpp import Arm, arms
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import assumptions, links_by_density, without_dynamics
from dmpcpp.robot._solids import solid
from scipy.spatial.transform import Rotation

from tests.python.command import run
from tests.python.small_arms import arm, write

NONE = {f"l{k}": "" for k in range(1, 7)}


def test_a_turned_box_has_the_moments_of_a_box_about_its_centre():
    sides, centre = np.array([0.3, 0.2, 0.5]), np.array([1.0, -2.0, 0.4])
    turn = Rotation.from_euler("xyz", [0.3, -0.7, 1.1]).as_matrix()
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * sides
    volume, middle, moment = solid(corners @ turn.T + centre)
    assert volume == pytest.approx(0.03) and middle == pytest.approx(centre)
    about_centre = turn.T @ (moment - volume * np.outer(middle, middle)) @ turn
    assert about_centre == pytest.approx(np.diag(volume * sides**2 / 12), abs=1e-12)


SHAPES = {
    '<box size="0.2 0.1 0.3"/>': (0.006, 1e-9),
    '<sphere radius="0.1"/>': (4 / 3 * np.pi * 1e-3, 1e-9),
    '<cylinder radius="0.1" length="0.2"/>': (np.pi * 2e-3, 0.01),  # of a prism with 32 sides
}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_density_gives_mass_centre_and_inertia_of_the_shape(shape):
    volume, off = SHAPES[shape]
    text = f'<collision><origin xyz="0.01 0.02 0.04"/><geometry>{shape}</geometry></collision>'
    heavy = arms.with_density(arm(inertials=NONE, shape=text), 1000.0)
    hanging = np.array([0.0, np.pi / 2, 0.0, 0.0, 0.0, 0.0])
    levers = np.cumsum([0.0, 0.3, 0.15, 0.2, 0.12]) + 0.04
    assert heavy.gravity_effort(hanging)[1] == pytest.approx(-9.81 * 1000.0 * volume * levers.sum(), rel=max(off, 1e-9))


def test_only_links_that_state_no_mass_get_one_and_that_is_said():
    some = arms.with_density(arm(inertials={"l5": ""}), 2700.0)
    assert links_by_density(some) == ("l5",)
    assert assumptions(some)[-1] == "mass and inertia of l5, from their shapes"
    with pytest.raises(InvalidArgument, match="no moved link lacks a mass"):
        arms.with_density(arm(), 2700.0)
    with pytest.raises(InvalidArgument, match="density: -1"):
        arms.with_density(arm(inertials=NONE), -1.0)


def test_an_arm_without_dynamics_has_no_effort_limits_and_keeps_its_kinematics():
    bare = arm(inertials=NONE)
    free = without_dynamics(bare)
    assert np.isinf(free.effort_limit).all() and free.velocity_limit.tolist() == bare.velocity_limit.tolist()
    q = np.full(6, 0.3)
    assert (free.forward_kinematics(q) == bare.forward_kinematics(q)).all()
    assert isinstance(free, Arm)


def test_a_run_without_inertias_is_refused_with_the_ways_out_and_verified_by_kinematics_alone(tmp_path):
    pytest.importorskip("pybullet")
    write(tmp_path, inertials=NONE)
    demo = ("demo", "--arm", "six.urdf", "--no-report", "--out", "out")
    done = run(*demo, cwd=tmp_path)
    assert done.returncode == 2 and "--density" in done.stderr and "--dynamics none" in done.stderr
    done = run(*demo, "--dynamics", "none", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "verified, not judged: torque_ratio, inertia" in done.stdout
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["not_judged"] == ["torque_ratio", "inertia"]
    assert not {"torque_clipped", "dynamics_mismatch"} & {check["name"] for check in summary["checks"]}
    done = run(*demo, "--density", "1000", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads(done.stdout)
    assert summary["not_judged"] == [] and "from their shapes" in summary["assumed"][-1]
