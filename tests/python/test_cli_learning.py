"""`dmpcpp fit` and `dmpcpp plan`: from a recording to a model file, and from it to joints."""

import json

import dmpcpp
import numpy as np
import pytest
from dmpcpp import arms, export

from tests.python.command import run, write_hand

pytest.importorskip("pybullet_data")


def names_in(folder):
    return {path.name for path in folder.iterdir()}


def test_a_recording_becomes_a_model_file_that_reproduces_it(tmp_path):
    write_hand(tmp_path / "hand.npz")
    done = run("fit", "hand.npz", "--quat-order", "xyzw", "--out", "reach.json", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    summary, model = json.loads(done.stdout), dmpcpp.load(tmp_path / "reach.json")
    recorded = np.load(tmp_path / "hand.npz")
    again = model.rollout_at(recorded["time"]).pose
    misses = np.linalg.norm(again[:, :3, 3] - recorded["pose"][:, :3], axis=1)
    assert np.sqrt(np.mean(misses**2)) < 1e-3
    assert summary["verdict"] == "pass" and summary["basis_count"] == model.options.basis_count
    assert np.linalg.norm(summary["fit"]["rmse"][:3]) == pytest.approx(np.sqrt(np.mean(misses**2)), rel=0.1)


def test_several_recordings_of_one_motion_make_one_model_between_them(tmp_path):
    write_hand(tmp_path / "low.npz", lift=0.1)
    write_hand(tmp_path / "high.npz", lift=0.14)
    done = run("fit", "low.npz", "high.npz", "--quat-order", "xyzw", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert len(json.loads(done.stdout)["recordings"]) == 2
    end = dmpcpp.load(tmp_path / "model.json").rollout().position[-1, 2]
    assert 0.2 < end < 0.28


def test_a_fitted_model_is_planned_for_the_arm_it_was_placed_for(tmp_path):
    write_hand(tmp_path / "hand.npz")
    stated = ("hand.npz", "--quat-order", "xyzw", "--arm", "panda", "--out", "reach.json")
    fitted = run("fit", *stated, cwd=tmp_path)
    assert fitted.returncode == 0
    model = dmpcpp.load(tmp_path / "reach.json")
    start, end = (",".join(f"{x:.3f}" for x in pose[:3, 3]) for pose in (model.start, model.goal))
    assert f"from {start} to {end} m" in fitted.stdout
    far = run("plan", "reach.json", "--goal", "5,0,0.3", "--out", "far", cwd=tmp_path)
    assert far.returncode == 2 and "goal" in far.stderr and "0.986 m long stretched out" in far.stderr
    assert not (tmp_path / "far").exists()
    goal = model.goal[:3, 3] + [0.02, -0.02, 0.02]
    text = ",".join(map(str, goal))
    done = run("plan", "reach.json", "--goal", text, "--duration", "3", "--out", "plan", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    panda, joints = arms.find("panda"), export.read_joints(tmp_path / "plan" / "joints.csv").of_motion()
    reached = panda.forward_kinematics(joints.position)
    assert np.abs(reached[-1, :3, 3] - goal).max() < 2e-3
    assert np.abs(reached - export.read_plan(tmp_path / "plan" / "plan.npz").pose).max() < 1e-4
    assert (np.abs(joints.velocity) <= panda.velocity_limit * (1 + 1e-6)).all()
    assert joints.time[-1] == pytest.approx(3.0 * json.loads(done.stdout)["slowdown"])


def test_a_time_that_the_joints_cannot_keep_is_stretched_or_refused_as_asked(tmp_path):
    write_hand(tmp_path / "hand.npz")
    assert run("fit", "hand.npz", "--quat-order", "xyzw", "--arm", "iiwa", cwd=tmp_path).returncode == 0
    hasty = ("plan", "model.json", "--arm", "iiwa", "--duration", "0.05", "--simulator", "none", "--json")
    stretched = run(*hasty, cwd=tmp_path)
    assert stretched.returncode == 0, stretched.stderr
    assert "joints.csv" in names_in(tmp_path / "dmpcpp-plan")
    assert json.loads(stretched.stdout)["slowdown"] > 1.0
    exact = run(*hasty, "--exact-duration", cwd=tmp_path)
    assert exact.returncode == 3
    failed = {check["name"] for check in json.loads(exact.stdout)["checks"] if not check["ok"]}
    assert failed & {"velocity_ratio", "acceleration_ratio"}
    assert names_in(tmp_path / "dmpcpp-plan") == {
        "config.toml",
        "plan.npz",
        "summary.json",
    }  # no older joints
    told = run(*hasty[:-1], "--exact-duration", cwd=tmp_path)
    assert "not feasible" in told.stdout and "without joints.csv: do not run this plan on a robot" in told.stdout
