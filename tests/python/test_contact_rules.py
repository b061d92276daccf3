"""Which contacts are the arm's business, how low the floor lies, and clearance along a whole path."""

from __future__ import annotations

import ast
import json
import re
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from dmpcpp import Arm, InvalidArgument, planning, simulation
from dmpcpp.robot import FLOOR, Surroundings, contact_rules

from tests.python.command import run
from tests.python.urdfs import INERTIAL, chain, joint, link, robot

CUBE = INERTIAL + '<collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>'
ENGINES = list(simulation.ENGINES.values())
TURN = '<limit lower="-0.1" upper="0.1" effort="5" velocity="1"/>'


def beside(name: str, xyz: str, parent: str = "base") -> str:
    """A link that hangs on a joint of its own: bellows, a wheel, a finger pad."""
    return link(name, CUBE) + joint(f"{name}_j", "revolute", parent, name, xyz=xyz, more=TURN)


BELLOWS = beside("side0", "-0.3 0 0.3") + beside("side1", "-0.3 0.05 0.3")
WHEEL = beside("wheel", "-0.3 0 -0.1")


@pytest.mark.parametrize("engine", ENGINES)
def test_links_that_the_arm_does_not_move_against_each_other_are_left_out(engine) -> None:
    arm = Arm.from_urdf(robot(chain(6), BELLOWS))
    with engine(arm, 1e-3) as world:
        assert world.contacts_at(np.zeros(6)) == []
        pairs = {frozenset((c.link, c.other)) for c in world.clearances_at(np.zeros(6), 1.0)}
    assert frozenset(("side0", "side1")) not in pairs
    assert frozenset(("side0", "l3")) in pairs
    rules = contact_rules(arm)
    assert ("side0", "side1") in rules.held
    assert "side0, side1, which the arm does not move against each other" in rules.describe()


def test_both_engines_look_at_the_same_pairs() -> None:
    arm = Arm.from_urdf(robot(chain(6), BELLOWS, WHEEL, beside("pad", "0.05 0 0", "l6")), tip="l6")
    seen = []
    for engine in ENGINES:
        with engine(arm, 1e-3) as world:
            seen.append({frozenset((c.link, c.other)) for c in world.clearances_at(np.full(6, 0.2), 5.0)})
    assert seen[0] == seen[1]
    assert frozenset(("pad", "l5")) in seen[0]  # no neighbour: a joint of the arm and one of its own lie between


@pytest.mark.parametrize("engine", ENGINES)
def test_the_floor_lies_below_what_the_arm_does_not_move(engine) -> None:
    arm = Arm.from_urdf(robot(chain(6), WHEEL))
    with engine(arm, 1e-3) as world:
        assert world.floor == pytest.approx(-0.15, abs=1e-6)
        assert world.contacts_at(np.zeros(6)) == []
    with engine(Arm.from_urdf(robot(chain(6))), 1e-3) as world:
        assert world.floor == 0.0  # the base's box begins above it
    with engine(arm, 1e-3, floor=None) as world:
        assert not any(c.other == FLOOR for c in world.clearances_at(np.zeros(6), 5.0))


@pytest.mark.parametrize("engine", ENGINES)
def test_stated_pairs_may_touch(engine) -> None:
    arm, down = Arm.from_urdf(robot(chain(6))), np.array([0.0, 2.4, 0.6, 0.0, 0.0, 0.0])
    with engine(arm, 1e-3, floor=0.1) as world:
        touching = {(c.link, c.other) for c in world.contacts_at(down)}
    low = [link for link, other in touching if other == FLOOR]
    assert low
    with engine(arm, 1e-3, floor=0.1, ignored=[(name, FLOOR) for name in low]) as world:
        assert not {c.link for c in world.contacts_at(down) if c.other == FLOOR}
        assert not {c.link for c in world.clearances_at(down, 1.0) if c.other == FLOOR} & set(low)
    near = [frozenset(("l6", "l1"))]
    with engine(arm, 1e-3, ignored=[("l1", "l6")]) as world:
        assert not [c for c in world.clearances_at(np.zeros(6), 5.0) if frozenset((c.link, c.other)) in near]
    with pytest.raises(InvalidArgument, match="no link 'nobody'"):
        engine(arm, 1e-3, ignored=[("l1", "nobody")])


def test_an_srdf_beside_the_urdf_is_read(tmp_path: Path) -> None:
    (tmp_path / "own.urdf").write_text(robot(chain(6)))
    pairs = '<disable_collisions link1="l1" link2="l4"/><disable_collisions link1="l1" link2="nobody"/>'
    (tmp_path / "any.srdf").write_text(f'<robot name="own">{pairs}</robot>')
    (tmp_path / "other.srdf").write_text('<robot name="other"><disable_collisions link1="l1" link2="l5"/></robot>')
    (tmp_path / "broken.srdf").write_text("<robot")
    rules = contact_rules(Arm.from_urdf_file(tmp_path / "own.urdf"))
    assert rules.by_srdf == {"any.srdf": 1}
    assert frozenset(("l1", "l4")) in rules.left_out
    assert frozenset(("l1", "l5")) not in rules.left_out


def overlapping(parent: str = "l2") -> Arm:
    """An arm with a part that reaches from l2 over to what turns with j3 and j4, whatever these do."""
    around = INERTIAL + '<collision><geometry><sphere radius="0.6"/></geometry></collision>'
    shell = link("shell", around) + joint("s", "fixed", parent, "shell", xyz="0 0 0.3")
    return Arm.from_urdf(robot(chain(6), shell))


def test_a_pair_that_always_touches_is_named_and_asked_for() -> None:
    arm = overlapping()
    engine = partial(simulation.Bullet, floor=None)
    with pytest.raises(InvalidArgument, match=r"'l4' and 'shell' in 40 of 40") as refused:
        planning.require_free_postures(arm, engine)
    stated = ast.literal_eval(re.search(r"ignored=(\[.*?\)\])", str(refused.value))[1])
    looked_at = planning.require_free_postures(arm, partial(engine, ignored=stated))
    assert looked_at.rules.stated == tuple(stated)
    assert looked_at.floor is None


def test_a_floor_that_always_touches_is_named_with_what_to_state() -> None:
    with pytest.raises(InvalidArgument, match=r"and 'floor' in .* floor=None"):
        planning.require_free_postures(Arm.from_urdf(robot(chain(6))), partial(simulation.Bullet, floor=2.0))


class Needle:
    """A world of one joint in which clearance is 5 mm less than the distance from 0.3015 rad."""

    levers = np.array([1.0])

    def __init__(self) -> None:
        self.looks = 0

    def clearances_at(self, position, within):
        self.looks += 1
        distance = abs(float(position[0]) - 0.3015) - 5e-3
        found = SimpleNamespace(link="a", other="b", distance=distance)
        return [found] if distance < within else []


def test_a_contact_between_two_samples_of_a_path_is_found() -> None:
    world, path = Needle(), np.linspace(0.0, 1.0, 11)[:, None]
    near = simulation.nearest_along(world, path, frozenset("ab"), 2e-3)
    assert near["self"].clearance.distance < 2e-3
    assert near["self"].sample == pytest.approx(3.015, abs=0.08)
    before = world.looks
    assert before < 60
    clear = simulation.nearest_along(world, path[:3], frozenset("ab"), 2e-3)
    assert all(one.clearance.distance >= 2e-3 for one in clear.values())


def test_a_path_is_refused_with_the_pair_and_how_often() -> None:
    arm = Arm.from_urdf(robot(chain(6)))
    clear = planning.clear_of_itself(arm, simulation.Bullet)
    there = np.linspace([0.0, 0.2, 0.2, 0, 0, 0], [0.0, 2.4, 1.5, 0, 0, 0], 50)
    assert not clear(SimpleNamespace(position=there))
    assert clear(SimpleNamespace(position=there[:3]))
    assert clear.refused.total() == 1 and clear.tested == 2
    assert "1 of the 2 paths" in clear.describe()
    assert "'floor' on 1" in clear.describe()


def test_surroundings_go_through_json() -> None:
    for around in (Surroundings(), Surroundings(None, (("a", "b"),)), Surroundings(-0.2)):
        assert Surroundings.of(json.loads(json.dumps(around.to_dict()))) == around
    assert Surroundings.of(None) == Surroundings()


def test_the_command_line_states_floor_and_pairs(tmp_path: Path) -> None:
    (tmp_path / "own.urdf").write_text(robot(chain(6)))
    for option, word in (
        (("--ignore-contact", "l1"), "--ignore-contact: 'l1', expected two links"),
        (("--floor", "low"), "--floor: 'low', expected a height in m such as -0.05, or none"),
        (("--ignore-contact", "l1,nobody"), "no link 'nobody'"),
    ):
        done = run("demo", "--arm", "own.urdf", *option, cwd=tmp_path)
        assert done.returncode == 2
        assert word in done.stderr


def test_what_touches_at_rest_is_named() -> None:
    arm = Arm.from_urdf(
        robot(chain(6), link("lid", CUBE) + joint("d", "fixed", "base", "lid", xyz="0 0 0.6")), tip="l6"
    )
    looked_at = planning.require_free_postures(arm, simulation.Bullet)
    assert ("l3", "lid") in looked_at.at_rest or ("l4", "lid") in looked_at.at_rest
    assert "touching with every joint at 0" in looked_at.describe()
    assert (
        "touching" not in planning.require_free_postures(Arm.from_urdf(robot(chain(6))), simulation.Bullet).describe()
    )
