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
from dmpcpp.robot import FLOOR, Levers, Surroundings, contact_rules, parsed

from tests.python.command import run
from tests.python.urdfs import INERTIAL, chain, joint, link, robot, slide

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

    levers = SimpleNamespace(all=np.array([1.0]), between=lambda *_: np.array([1.0]))

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


def test_levers_bound_how_far_two_links_move_against_each_other() -> None:
    text = robot(chain(6), beside("pad", "0.05 0 0", "l6"))
    arm, levers = Arm.from_urdf(text, tip="l6"), Levers(parsed(text), [f"j{k}" for k in range(1, 7)])
    parts = {name: Arm.from_urdf(text, tip=name) for name in ("l1", "l3", "l4", "l6")}
    corners = np.array([[x, y, z] for x in (-0.025, 0.025) for y in (-0.025, 0.025) for z in (0.01, 0.09)])
    random = np.random.default_rng(0)

    def seen(link: str, other: str, q: np.ndarray) -> np.ndarray:
        """Corners of a link in the frame of another."""
        one, two = (parts[name].forward_kinematics(q[: parts[name].joint_count]) for name in (link, other))
        placed = corners @ one[:3, :3].T + one[:3, 3]
        return (placed - two[:3, 3]) @ two[:3, :3]

    tightest = 0.0
    for link_, other in (("l3", "l1"), ("l6", "l3"), ("l6", "l4"), ("l4", "l3")):
        for _ in range(200):
            q, way = random.uniform(arm.lower, arm.upper), random.uniform(-0.05, 0.05, 6)
            moved = np.linalg.norm(seen(link_, other, q + way) - seen(link_, other, q), axis=1).max()
            bound = np.abs(way) @ levers.between(link_, other)
            assert moved <= bound + 1e-12
            tightest = max(tightest, moved / bound)
    assert tightest > 0.9
    assert np.flatnonzero(levers.between("l3", "l1")).tolist() == [1, 2]
    assert np.flatnonzero(levers.between("l4", "floor")).tolist() == [0, 1, 2, 3]
    assert (levers.between("pad", "l6") == 0.0).all() and (levers.all >= levers.between("l6", "base")).all()
    assert levers.between("l4", "l3")[3] == pytest.approx(np.linalg.norm([0.025, 0.025, 0.09]))
    assert (Levers(parsed(text), ["j4"], {"four": "l4"}).between("four", "l3") == levers.between("l4", "l3")[3]).all()


def test_a_sliding_joint_has_a_lever_of_one() -> None:
    text = robot(chain(2), link("slide", CUBE), slide("s", "l2", "slide", stroke=0.3), root="base")
    found = Levers(parsed(text), ["j1", "j2", "s"]).between("slide", "base")
    assert found[2] == 1.0
    assert found[1] == pytest.approx(np.linalg.norm([0.05, 0.05, 0.05]) + 0.3)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(("gap", "clear"), [(1e-3, True), (4e-3, True), (-1e-3, False)])
def test_of_what_is_built_close_to_each_other_only_contact_counts(engine, gap: float, clear: bool) -> None:
    """The box of l1 turns above the floor, its lower side at 0.11 m."""
    arm = Arm.from_urdf(robot(chain(6)))
    on_floor = partial(engine, floor=0.11 - gap)
    path = SimpleNamespace(position=np.linspace([0.0] * 6, [0.5, 0.2, 0.2, 0.3, 0.2, 0.1], 30))
    assert planning.clear_of_itself(arm, on_floor)(path) == clear
    if clear:
        looked_at = planning.require_free_postures(arm, partial(on_floor, ignored=OFF_FLOOR))
        assert looked_at.tight == (("l1", "floor"),)
        assert "within 5 mm of each other, so that only contact counts: l1, floor" in looked_at.describe()
        high = planning.require_free_postures(arm, partial(engine, floor=0.1, ignored=OFF_FLOOR))
        assert high.tight == () and "only contact counts" not in high.describe()


OFF_FLOOR = [(f"l{k}", "floor") for k in range(2, 7)]


def test_what_lies_beside_a_tight_pair_still_keeps_its_distance() -> None:
    arm = Arm.from_urdf(robot(chain(6)))
    clear = planning.clear_of_itself(arm, partial(simulation.Bullet, floor=0.109))
    low = np.array([0.0, 2.4, 1.5, 0.0, 0.0, 0.0])  # the arm in the floor
    assert not clear(SimpleNamespace(position=np.linspace(0.0 * low, low, 50)))
    assert "l1" not in clear.refused.most_common(1)[0][0]


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
