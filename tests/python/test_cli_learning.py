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


def write_takes(folder, count=4):
    for k in range(count):
        write_hand(folder / f"take{k}.npz", lift=0.1 + 0.02 * k)
    return [f"take{k}.npz" for k in range(count)]


def test_takes_that_differ_are_learned_with_how_they_differ_and_planned_past_what_is_given(tmp_path):
    files = write_takes(tmp_path)
    stated = ("--quat-order", "xyzw", "--arm", "panda", "--distribution", "--out", "reach.json")
    done = run("fit", *files, *stated, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert names_in(tmp_path) >= {"reach.json", "reach.png", "reach.config.toml"}
    assert "4 takes, 14 control points" in done.stdout
    learned = dmpcpp.load(tmp_path / "reach.json")
    assert isinstance(learned, dmpcpp.PoseDistribution) and learned.demonstrations == 4
    sigma = np.sqrt(np.diag(learned.spread(3).covariance[1]))[:3]
    middle = learned.rollout(3).pose[1, :3, 3] + 0.5 * sigma
    given = "0.5:" + ",".join(map(str, middle))
    done = run("plan", "reach.json", "--given", given, "--out", "plan", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads(done.stdout)
    assert summary["given"][0]["phase"] == 0.5 and 0 < summary["given"][0]["deviations"] < 3
    planned = export.read_plan(tmp_path / "plan" / "plan.npz").pose[:, :3, 3]
    assert np.linalg.norm(planned - middle, axis=1).min() < 2e-3


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("fit", "take0.npz", "--distribution"), "--distribution: one take, expected at least 2"),
        (("fit", "take0.npz", "take1.npz", "--distribution", "--basis-count", "9"), "--basis-count: with --distrib"),
        (("plan", "one.json", "--arm", "panda", "--given", "0.5:0,0,1"), "--given: MODEL is no distribution"),
        (("plan", "all.json", "--arm", "panda", "--given", "1.5:0,0,1"), "--given[0].phase: 1.5"),
        (("plan", "all.json", "--arm", "panda", "--given", "nonsense"), "--given: 'nonsense', expected S:X,Y,Z"),
        (
            ("plan", "all.json", "--arm", "panda", "--given", "0.5:0,0,1", "--given", "0.5:0,0,1.1"),
            "--given[1]: nothing is left open at phase 0.5",
        ),
    ],
)
def test_what_cannot_be_given_is_refused_and_nothing_written(tmp_path, words, told):
    write_takes(tmp_path, 2)
    stated = ("--quat-order", "xyzw")
    if words[0] == "plan":
        assert run("fit", "take0.npz", *stated, "--out", "one.json", cwd=tmp_path).returncode == 0
        both = run("fit", "take0.npz", "take1.npz", *stated, "--distribution", "--out", "all.json", cwd=tmp_path)
        assert both.returncode == 0, both.stderr
    before = names_in(tmp_path)
    done = run(*words, *(stated if words[0] == "fit" else ()), cwd=tmp_path)
    assert done.returncode == 2, done.stdout + done.stderr
    assert told in done.stderr and "Traceback" not in done.stderr
    assert names_in(tmp_path) == before


def test_a_take_of_another_motion_makes_no_distribution(tmp_path):
    files = write_takes(tmp_path, 5)
    hand = dict(np.load(tmp_path / "take2.npz"))
    hand["pose"][:, :3] += np.outer(np.sin(np.linspace(0, 6, len(hand["time"]))), [0.2, 0.2, 0.0])
    np.savez(tmp_path / "take2.npz", **hand)
    done = run("fit", *files, "--quat-order", "xyzw", "--distribution", cwd=tmp_path)
    assert done.returncode == 3, done.stdout + done.stderr
    assert "--leave-out 3" in done.stdout
    assert "model.json" not in names_in(tmp_path)
