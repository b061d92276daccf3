"""Wrong input to the command line: each is refused with the argument, what came, what was expected and a way out."""

import subprocess
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp.cli import main

from tests.python.command import write_hand

pytest.importorskip("pybullet_data")

FIT = ("fit", "hand.npz", "--quat-order", "xyzw")
PLAN = ("plan", "model.json", "--simulator", "none")

# What is typed, the argument that is named, what came, what was expected or what to do.
WRONG = {
    "no such recording": (("fit", "nowhere.bvh"), "nowhere.bvh", "cannot be read", "No such file"),
    "no recording": (("fit", "text.bvh", "--unit", "cm"), "text.bvh", "format cannot be recognised", "State --format"),
    "quaternions in an order unheard of": (("fit", "hand.npz", "--quat-order", "abcd"), "--quat-order", "abcd", "wxyz"),
    "quaternions of no order": (("fit", "hand.npz"), "--quat-order", "hand.npz", "State"),
    "a unit unheard of": ((*FIT, "--unit", "ell"), "unit", "ell", "expected"),
    "an axis unheard of": ((*FIT, "--up-axis", "w"), "up", "w", "expected"),
    "a format unheard of": (("inspect", "hand.npz", "--format", "dance"), "format", "dance", "bvh"),
    "a column without a name": (("inspect", "hand.npz", "--columns", "x"), "--columns", "'x'", "NAME=COLUMN"),
    "a start behind the end": ((*FIT, "--start", "1.5", "--end", "0.5"), "end", "0.5", "expected"),
    "a part that is not there": ((*FIT, "--segment", "9"), "segment", "9", "expected"),
    "a rate that is none": ((*FIT, "--resample", "-5"), "--resample", "-5", "x>0"),
    "kernels that are none": ((*FIT, "--basis-count", "0"), "--basis-count", "0", "1<=x<=100000"),
    "kernels in words": ((*FIT, "--basis-count", "many"), "--basis-count", "many", "integer"),
    "a scale in words": ((*FIT, "--arm", "panda", "--scale", "big"), "--scale", "big", "such as 0.5"),
    "a scale for no arm": ((*FIT, "--scale", "0.5"), "--scale", "without --arm", "State --arm"),
    "a floor in words": (("demo", "--floor", "deep"), "--floor", "deep", "a height in m"),
    "a floor without end": (("demo", "--floor", "inf"), "--floor", "inf", "or none"),
    "an arm unheard of": ((*PLAN, "--arm", "ur99"), "arm", "ur99", "dmpcpp arms"),
    "an arm with links that it has": ((*PLAN, "--tip", "hand"), "tip", "panda", ".urdf"),
    "a URDF that is not there": ((*PLAN, "--arm", "no.urdf"), "no.urdf", "no.urdf", "cannot"),
    "a link that is not there": (("check-urdf", "arm.urdf", "--tip", "nose"), "nose", "nose", ""),
    "a goal of two numbers": ((*PLAN, "--goal", "1,2"), "--goal", "2 number(s)", "x,y,z"),
    "a goal in words": ((*PLAN, "--goal", "there"), "--goal", "there", "such as"),
    "a goal that is not finite": ((*PLAN, "--goal", "nan,0,0"), "--goal", "nan,0,0", "finite"),
    "a goal with no quaternion": ((*PLAN, "--goal", "0,0,0,1,1,1,1"), "--goal", "2.000", "expected 1"),
    "cycles of what does not repeat": (
        ("imitate", "hand.npz", "--cycles", "3"),
        "--cycles",
        "without --rhythmic",
        "State",
    ),
    "a via-point without a phase": ((*PLAN, "--via", "0.4,0,0.5"), "--via", "0.4,0,0.5", "such as 0.5:0.4,0.1,0.3"),
    "a via-point of two numbers": ((*PLAN, "--via", "0.5:1,2"), "--via", "2 number(s)", "x,y,z"),
    "a via-point at the end": ((*PLAN, "--via", "1:0.4,0,0.5"), "via[0].phase", "1, expected", "0.99"),
    "a via-point beyond the arm": ((*PLAN, "--via", "0.5:9,0,0"), "via[0]", "(9, 0, 0)", "long stretched out"),
    "a time that is none": ((*PLAN, "--duration", "-2"), "duration", "-2", "positive"),
    "joints that are too few": ((*PLAN, "--from-joints", "0,0"), "--from-joints", "2", "7"),
    "a model that is none": (("plan", "arm.urdf"), "arm.urdf", "", ""),
    "a model that is not there": (("plan", "none.json"), "none.json", "", ""),
    "a model of positions": (("plan", "positions.json", "--simulator", "none"), "MODEL", "Dmp", "PoseDmp"),
    "an engine unheard of": (("plan", "model.json", "--simulator", "ode"), "--simulator", "ode", "'bullet'"),
    "a goal beyond the arm": ((*PLAN, "--goal", "9,0,0"), "--goal", "(9, 0, 0)", "long stretched out"),
    "results where there can be none": (
        (*PLAN, "--out", "/proc/dmpcpp"),
        "--out",
        "/proc/dmpcpp",
        "cannot be written",
    ),
    "results into a file": ((*PLAN, "--out", "hand.npz"), "--out", "hand.npz", "file"),
    "a config that is not there": (("fit", "--config", "no.toml"), "--config", "no.toml", "cannot be read"),
    "a config that is none": (("fit", "--config", "text.bvh"), "--config", "text.bvh", "not TOML"),
    "a config of another command": (("plan", "--config", "fit.toml"), "--config", "[fit]", "[plan]"),
    "a config with a slip": (("fit", "--config", "fit.toml"), "--config", "basis-cuont", "Did you mean 'basis-count'"),
    "a report of no run": (("report", "empty"), "empty", "summary.json", "Run it again"),
    "a report of no folder": (("report", "nowhere"), "nowhere", "no such folder", "dmpcpp imitate"),
    "a batch of nothing": (("batch", "empty"), "pattern", "empty", "*.bvh"),
    "a batch of no folder": (("batch", "nowhere"), "nowhere", "does not exist", "expected"),
    "jobs that are none": (("batch", "empty", "--jobs", "0"), "--jobs", "0", "x>=1"),
    "a tolerance unheard of": (
        ("verify", "a", "b", "--check-limit", "speed=1"),
        "--check-limit",
        "speed=1",
        "position_max",
    ),
    "a port that is none": (("view", "model.json", "--port", "99999"), "--port", "99999", "65535"),
    "a view of positions": (("view", "positions.json"), "MODEL", "Dmp", "PoseDmp"),
}


@pytest.fixture(scope="module")
def desk(tmp_path_factory):
    """A folder with one good recording and model, and what is not one."""
    import dmpcpp
    from dmpcpp import arms

    folder = tmp_path_factory.mktemp("desk")
    write_hand(folder / "hand.npz")
    (folder / "text.bvh").write_text("once upon a time")
    (folder / "empty").mkdir()
    (folder / "fit.toml").write_text('[fit]\nfiles = ["hand.npz"]\nbasis-cuont = 3\n')
    (folder / "arm.urdf").write_text(arms.find("iiwa").urdf)
    time = np.linspace(0.0, 1.0, 50)
    dmpcpp.save(dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, time)), folder / "positions.json")
    poses = arms.find("panda").forward_kinematics(np.sin(np.c_[time]) * 0.2 + [0, 0.2, 0, -1.9, 0, 2.1, 0.8])
    dmpcpp.save(dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses)), folder / "model.json")
    return folder


@pytest.mark.parametrize("name", WRONG)
def test_wrong_input_is_one_error_that_says_what_to_do(name, desk, monkeypatch):
    typed, *words = WRONG[name]
    before = sorted(desk.rglob("*"))
    monkeypatch.chdir(desk)
    done = CliRunner().invoke(main, typed)
    assert isinstance(done.exception, SystemExit), done.exception
    assert done.exit_code == (3 if typed[0] == "check-urdf" else 2), done.output
    said = " ".join(done.output.split())
    for word in words:
        assert word in said, said
    assert sorted(desk.rglob("*")) == before, "something was written"


HELP = ("demo", "imitate", "inspect", "fit", "plan", "reproduce", "grasp", "generality", "verify", "view", "report")


@pytest.mark.parametrize("command", [*HELP, "batch", "check-urdf", "doctor"])
def test_every_command_explains_itself_with_an_example_and_takes_json_and_config(command):
    done = CliRunner().invoke(main, [command, "--help"])
    text = " ".join(done.output.split())
    assert done.exit_code == 0 and f"Example: dmpcpp {command}" in text
    assert "--json" in text and "--config" in text


def test_help_imports_nothing_heavy():
    """Measured in time by benchmarks/command_line.py; what takes the time is what is imported."""
    code = "import sys, dmpcpp.cli; print(*sorted({m.split('.')[0] for m in sys.modules}))"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"numpy", "scipy", "matplotlib", "rich", "pybullet", "viser"} & set(loaded)
