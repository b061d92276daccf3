"""The figures of execution under physics, held to their goals by the code that prints them."""

import json

import pytest

pytest.importorskip("pybullet", reason="the extra `sim`")
pytest.importorskip("mujoco", reason="the extra `mujoco`")

from click.testing import CliRunner
from dmpcpp.simulation import Bullet, MuJoCo

from benchmarks import physics
from benchmarks.figures import Figure


def missed(figures):
    return [figure for figure in figures if not figure.ok]


@pytest.mark.parametrize("name", ["panda", "iiwa", "xarm6"])
def test_an_arm_that_is_known_is_driven_as_exactly_as_promised(name):
    assert missed(physics.nominal(name, MuJoCo)) == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["panda", "iiwa", "xarm6"])
def test_so_it_is_in_bullet(name):
    assert missed(physics.nominal(name, Bullet)) == []


@pytest.mark.slow
@pytest.mark.parametrize("engine", [Bullet, MuJoCo])
@pytest.mark.parametrize("name", ["panda", "iiwa"])
def test_twenty_wrong_models_cost_no_more_than_promised(name, engine):
    assert missed(physics.disturbed(name, engine)) == []


@pytest.mark.parametrize("name", ["panda", "iiwa"])
def test_two_engines_agree_as_closely_as_promised(name):
    assert missed(physics.two_engines(name)) == []


@pytest.mark.parametrize("value, status", [(0.5, 0), (2.0, 3)])
def test_a_goal_that_is_missed_is_exit_status_3(monkeypatch, value, status):
    monkeypatch.setattr(physics, "measure", lambda seeds: iter([Figure("a", value, 1.0, "mm")]))
    assert CliRunner().invoke(physics.main, []).exit_code == status
    done = CliRunner().invoke(physics.main, ["--json"])
    assert json.loads(done.stdout)["figures"][0]["ok"] is (status == 0)
