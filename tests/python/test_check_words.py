"""Checks in words and units of people; the four figures of a run."""

import ast
import math
import re
from pathlib import Path

import pytest
from dmpcpp._check_words import GROUPS, figure, figures_of, group_of, words_of

PACKAGE = Path(__file__).resolve().parents[2] / "python" / "dmpcpp"


@pytest.mark.parametrize(
    ("value", "unit", "name", "shown"),
    [
        (0.0015, "m", "", "1.5 mm"),
        (math.pi / 2, "rad", "", "90 deg"),
        (0.36, "1", "velocity_ratio", "36 %"),
        (1.5e-16, "1", "dynamics_mismatch", "< 0.001"),
        (-2e-8, "m", "", "> -0.001 mm"),
        (0, "steps", "", "0"),
        (0.0123, "m/s", "tool_speed", "0.012 m/s"),
        (0.25, "s", "", "0.25 s"),
        (1234.6, "m", "", "1234600 mm"),
        (None, "m", "", "-"),
        (math.nan, "m", "", "-"),
        (math.inf, "rad", "", "-"),
    ],
)
def test_a_figure_has_the_unit_that_people_use(value, unit, name, shown):
    assert figure(value, unit, name) == shown


def test_every_check_that_the_package_makes_has_words():
    made = set()
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Call) and node.args and isinstance(node.args[0], ast.Constant):
                called = ast.unparse(node.func).rsplit(".", 1)[-1]
                if called in {"Check", "at_most", "at_least", "not_judged"} and isinstance(node.args[0].value, str):
                    made.add(node.args[0].value)
    assert {"finite", "joint_margin", "torque_ratio"} <= made
    grasp = {"rise", "tracking"}  # of a grasp, which has its own table
    both = {name for name in made if name.startswith("engines_")}
    assert {name for name in made - grasp - both if name not in _known()} == set()


def _known():
    return {name for names in GROUPS.values() for name in names}


def test_a_check_of_another_name_is_said_by_its_name():
    assert group_of("something_new") == "Others"
    assert words_of("something_new") == "something new"
    assert words_of("settle_error") == "tool off the goal at the end"


SUMMARY = {
    "stages": {
        "demonstration_to_dmp": {"position_max": 0.001, "angle_max": 0.01},
        "ik_to_executed": {"position_max": 0.0005, "angle_max": 0.0},
    },
    "recording": {"duration": 2.0, "evidence": {"smoothed": True}},
    "duration": 5.0,
    "slowdown": 2.5,
    "checks": [
        {"name": "velocity_ratio", "value": 0.4, "detail": "joint1"},
        {"name": "torque_ratio", "value": 0.75, "detail": "joint2"},
        {"name": "acceleration_ratio", "value": None, "detail": "nobody states it"},
        {"name": "settle_error", "value": 3.0, "detail": ""},
    ],
    "changed": ["joint1 brought back by 0.1 deg"],
}


def test_the_four_figures_of_a_run():
    close, fast, near, changed = figures_of(SUMMARY)
    assert close.number == "1.5 mm, 0.573°" and "learning, execution together" in close.line
    assert fast.number == "2.50 x the time" and fast.line == "2.00 s recorded, 5.00 s carried out"
    assert near.number == "75 %" and near.line == "torque of joint2"
    assert changed.number == "3"
    assert changed.line == "noise smoothed out; joint1 brought back by 0.1 deg; slowed for the arm's limits"


def test_a_run_without_limits_or_changes_says_so():
    plain = {**SUMMARY, "checks": [], "changed": [], "slowdown": 1.0, "recording": {"duration": 2.0}}
    *_, near, changed = figures_of(plain)
    assert near.number == "-" and "no limit" in near.line
    assert (changed.number, changed.line) == ("nothing", "the motion is as recorded")


def test_numbers_are_plain():
    assert not any(re.search(r"\de[+-]?\d", figure(10.0**k, "m")) for k in range(-12, 6))
