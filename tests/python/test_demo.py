"""The command line from end to end: a human motion in, a verified execution out; and what goes wrong on the way."""

import json
import re
import subprocess
import sys
from pathlib import Path

import dmpcpp
import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import arms, export, metrics, recordings
from dmpcpp.cli import main
from dmpcpp.cli._config import save_config

pytest.importorskip("pybullet_data")

FILES = {"model.json", "plan.npz", "joints.csv", "execution.npz", "picture.png", "summary.json", "config.toml"}


def run(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run the command as a user does."""
    command = [sys.executable, "-m", "dmpcpp", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=cwd, timeout=300)
    assert "Traceback" not in done.stderr + done.stdout
    return done


def hand_path(count: int = 200, scale: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """A hand that draws an arc while it turns: times and rows x y z qx qy qz qw."""
    time = np.linspace(0.0, 2.0, count)
    turn = 0.4 * np.sin(np.pi * time / 2)
    position = scale * np.c_[0.2 * np.sin(time), 0.15 * np.cos(time), 0.1 * time]
    return time, np.c_[position, 0 * turn, np.sin(turn / 2), 0 * turn, np.cos(turn / 2)]


@pytest.mark.parametrize("arm", ["panda", "iiwa", "xarm6"])
def test_demo_is_verified(arm, tmp_path):
    done = run("demo", "--arm", arm, "--out", "out", "--no-report", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    out = tmp_path / "out"
    assert {path.name for path in out.iterdir()} == FILES
    summary = json.loads((out / "summary.json").read_text())
    assert summary["verdict"] == "pass" and all(check["ok"] for check in summary["checks"])
    demonstrated, solved, executed = (
        summary["stages"][stage] for stage in ("demonstration_to_dmp", "dmp_to_ik", "ik_to_executed")
    )
    assert demonstrated["position_rmse"] <= 1e-3 and demonstrated["angle_rmse"] <= np.radians(0.5)
    assert solved["position_max"] <= 1e-5 and solved["angle_max"] <= 1e-5
    assert executed["position_rmse"] <= 0.5e-3
    for check in summary["checks"]:
        assert set(check) >= {"name", "ok", "value", "limit", "unit"}

    # What was written is what was judged, seen by other means.
    from dmpcpp import arms

    plan, joints = export.read_plan(out / "plan.npz"), export.read_joints(out / "joints.csv").of_motion()
    robot = arms.find(arm)
    assert np.abs(robot.forward_kinematics(joints.position) - plan.pose).max() <= 1e-5
    assert (joints.position >= robot.lower).all() and (joints.position <= robot.upper).all()
    assert (np.abs(joints.velocity) <= robot.velocity_limit).all()
    model = dmpcpp.load(out / "model.json")
    again = model.rollout_at(plan.wanted_time, duration=plan.wanted_time[-1])
    assert metrics.position_errors(again.pose, plan.pose).max() <= 1e-3
    assert metrics.angle_errors(again.pose, plan.pose).max() <= np.radians(0.5)
    assert summary["tempo"]["slowdown"] == pytest.approx(plan.time[-1] / plan.wanted_time[-1])
    assert (out / "picture.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("stated", "folder"),
    [
        ((), "dmpcpp-demo"),
        (("--arm", "iiwa"), "dmpcpp-demo-iiwa"),
        (("--clip", "punch", "--body", "left_wrist"), "dmpcpp-demo-punch-left_wrist"),
        (("--arm", "my/panda.urdf", "--base", "a", "--tip", "b"), "dmpcpp-demo-panda.urdf-a-b"),
        (("--clip", "punch", "--out", "mine"), "mine"),
    ],
)
def test_every_demo_has_a_folder_of_its_own_and_its_config_says_which(stated, folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(recordings, "clip", lambda *_: None)
    monkeypatch.setattr(arms, "load", lambda *_, **__: None)

    def carried_out(recording, arm, *, out, **_):
        out.mkdir()
        save_config(out / "config.toml")

    monkeypatch.setattr("dmpcpp.cli._imitation._carry_out", carried_out)
    done = CliRunner().invoke(main, ["demo", *stated])
    assert done.exit_code == 0, done.output
    assert [path.name for path in tmp_path.iterdir()] == [folder]
    assert f'out = "{tmp_path / folder}"' in (tmp_path / folder / "config.toml").read_text()


@pytest.mark.parametrize("simulator, arm", [("both", "panda"), ("mujoco", "iiwa")])
def test_a_motion_is_executed_by_the_engine_that_was_asked_for(simulator, arm, tmp_path):
    pytest.importorskip("mujoco")
    time, rows = hand_path()
    np.savez(tmp_path / "hand.npz", time=time, pose=rows)
    stated = ("imitate", "hand.npz", "--quat-order", "xyzw", "--arm", arm, "--simulator", simulator, "--no-report")
    done = run(*stated, "--json", "--out", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    summary = json.loads(done.stdout)
    engines = {check["name"] for check in summary["checks"] if check["name"].startswith("engines_")}
    if simulator == "both":
        assert engines == {f"engines_{name}" for name in ("position_max", "angle_max", "torque_rms", "verdicts")}
        assert "PyBullet" in summary["simulator"] and "MuJoCo" in summary["second_simulator"]
    else:
        assert not engines
        assert "MuJoCo" in summary["simulator"] and summary["second_simulator"] is None
    verified = run("verify", "out", "out/joints.csv", "--arm", arm, "--simulator", "mujoco", cwd=tmp_path)
    assert verified.returncode == 0, verified.stdout + verified.stderr


def test_the_same_seed_gives_the_same_files(tmp_path):
    time, rows = hand_path()
    np.savez(tmp_path / "hand.npz", time=time, pose=rows)
    texts = []
    for out in ("a", "b"):
        done = run("imitate", "hand.npz", "--quat-order", "xyzw", "--out", out, "--json", "--no-report", cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        assert json.loads(done.stdout)["verdict"] == "pass"
        texts.append([(tmp_path / out / name).read_bytes() for name in ("model.json", "joints.csv", "summary.json")])
    assert texts[0] == texts[1]


def write_csv(path: Path, time: np.ndarray, rows: np.ndarray) -> None:
    lines = ["t,px,py,pz,a,b,c,d", *(",".join(map(repr, map(float, row))) for row in np.c_[time, rows])]
    path.write_text("\n".join(lines) + "\n")


COLUMNS = "time=t,x=px,y=py,z=pz,qx=a,qy=b,qz=c,qw=d"


@pytest.mark.parametrize("kind", ["csv", "tum", "npy"])
def test_a_users_own_file_goes_the_same_way(kind, tmp_path):
    time, rows = hand_path()
    if kind == "csv":
        write_csv(tmp_path / "hand.csv", time, rows * [1000, 1000, 1000, 1, 1, 1, 1])
        stated = ["hand.csv", "--columns", COLUMNS, "--unit", "mm", "--up-axis", "z"]
    elif kind == "tum":
        np.savetxt(tmp_path / "hand.tum", np.c_[time, rows])
        stated = ["hand.tum", "--format", "tum"]
    else:
        poses = np.tile(np.eye(4), (len(time), 1, 1))
        poses[:, :3, 3] = rows[:, :3]
        np.save(tmp_path / "hand.npy", poses)
        stated = ["hand.npy", "--rate", "100"]
    done = run("imitate", *stated, "--arm", "iiwa", "--out", "out", "--no-report", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == FILES


def changed(index: tuple[int, int], value: float, count: int = 60) -> np.ndarray:
    time, rows = hand_path(count)
    table = np.c_[time, rows]
    table[index] = value
    return table


BAD_TABLES = {
    "nan": (changed((17, 2), np.nan), r"17|19"),
    "quaternion": (changed((17, 7), 3.0), r"quaternion\[17\]"),
    "backwards": (changed((17, 0), 0.0), "time"),
    "short": (changed((0, 0), 0.0, count=7), "8"),
    "millimetres": (np.c_[hand_path(60)[0], hand_path(60)[1] * [500, 500, 500, 1, 1, 1, 1]], "unit"),
}


@pytest.mark.parametrize("name", BAD_TABLES)
def test_a_damaged_recording_is_refused_with_the_place(name, tmp_path):
    table, message = BAD_TABLES[name]
    write_csv(tmp_path / "hand.csv", table[:, 0], table[:, 1:])
    done = run("imitate", "hand.csv", "--columns", COLUMNS, "--out", "out", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("dmpcpp: hand.csv")

    assert re.search(message, done.stderr), done.stderr
    assert not (tmp_path / "out").exists()


def test_a_reflection_is_refused_with_the_index(tmp_path):
    poses = np.tile(np.eye(4), (60, 1, 1))
    poses[:, 0, 3] = np.linspace(0, 0.3, 60)
    poses[23, 2, 2] = -1.0
    np.save(tmp_path / "hand.npy", poses)
    done = run("imitate", "hand.npy", "--rate", "30", "--out", "out", cwd=tmp_path)
    assert done.returncode == 2 and "23" in done.stderr and "reflection" in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["imitate", "nowhere.csv"], "nowhere.csv"),
        (["demo", "--clip", "tango"], "dance_b"),
        (["demo", "--body", "tail"], "right_hand"),
        (["demo", "--arm", "ur99"], "'ur99' is not known. Nearest are "),
        (["demo", "--arm", "missing.urdf"], "missing.urdf"),
        (["demo", "--basis-count", "0"], "basis-count"),
        (["demo", "--simulator", "gazebo"], "'bullet', 'mujoco', 'both'"),
        (["verify", "nowhere.csv", "log.csv"], "nowhere.csv"),
        (["demo", "--no-such-option"], "No such option"),
        (["dance"], "No such command"),
    ],
)
def test_wrong_usage_is_one_clear_error_and_status_2(arguments, message, tmp_path):
    done = run(*arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert message in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_a_file_is_refused_before_anything_runs(tmp_path):
    (tmp_path / "out").write_text("mine")
    done = run("demo", "--out", "out", cwd=tmp_path)
    assert done.returncode == 2 and "'out' is a file" in done.stderr
    assert (tmp_path / "out").read_text() == "mine"


def test_an_unreachable_path_fails_its_checks_and_says_where(tmp_path):
    poses = np.tile(np.eye(4), (60, 1, 1))
    poses[:, :3, 3] = np.c_[np.linspace(0.4, 2.0, 60), np.zeros(60), np.full(60, 0.5)]
    np.save(tmp_path / "far.npy", poses)
    done = run("imitate", "far.npy", "--rate", "30", "--no-place", "--no-report", "--out", "out", cwd=tmp_path)
    assert done.returncode == 3, done.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    failed = {check["name"] for check in summary["checks"] if not check["ok"]}
    assert summary["verdict"] == "fail" and "ik_position_residual" in failed
    assert "not verified: " in done.stdout and "for the robot: nothing, as it is not verified" in done.stdout
    assert not (tmp_path / "out" / "joints.csv").exists()
