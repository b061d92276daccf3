"""Behind the filter limits are kept and obstacles not touched, as Python has it."""

import copy

import dmpcpp
import numpy as np
import pytest
from dmpcpp import Box, Capsule, Dmp, InvalidArgument, Plane, Run, SafetyFilter, Sphere, Status

TIME = np.linspace(0.0, 1.0, 101)
SHAPE = TIME**3 * (10 - 15 * TIME + 6 * TIME**2)
REACH = Dmp.fit(dmpcpp.Demonstration(TIME, np.c_[0.6 * SHAPE, 0 * TIME, 0 * TIME]))


def passed(model, safe, seconds=3.0, dt=0.002):
    run, clearances = Run(model), []
    for _ in range(round(seconds / dt)):
        run.step(dt, filter=safe)
        clearances.append(safe.clearance)
    return run, min(clearances)


@pytest.mark.parametrize(
    "obstacle",
    [
        Sphere([0.3, 0, 0], 0.08),
        Box(np.block([[np.eye(3), np.array([[0.3], [0.01], [0]])], [0, 0, 0, 1]]), [0.02, 0.1, 0.1]),
        Capsule([0.3, -0.1, 0.02], [0.3, 0.1, 0.02], 0.05),
        Plane([0, 0, -0.01], [0, 0, 1]),
    ],
    ids=lambda obstacle: type(obstacle).__name__,
)
def test_what_is_in_the_way_is_passed_and_the_goal_reached(obstacle):
    run, clearance = passed(REACH, SafetyFilter([obstacle]))
    assert clearance > 0.0095
    np.testing.assert_allclose(run.position, REACH.goal, atol=1e-3)


def test_a_step_says_whether_the_motion_runs_and_the_status_that_it_is_blocked():
    run, safe = Run(REACH), SafetyFilter([Plane([0.3, 0, 0], [-1, 0, 0])])
    steps = 1
    while run.step(0.002, filter=safe):
        steps += 1
    assert steps == 500
    for _ in range(500):
        assert not run.step(0.002, filter=safe)
    assert run.status == Status.blocked
    assert run.position[0] == pytest.approx(0.29, abs=1e-3)
    safe.clear()
    for _ in range(1000):
        run.step(0.002, filter=safe)
    assert run.status == Status.finished
    np.testing.assert_allclose(run.position, REACH.goal, atol=1e-3)


def test_limits_hold_and_infinite_ones_are_none():
    safe = SafetyFilter(velocity=[0.4, np.inf, np.inf], acceleration=[2.0, 2.0, np.inf])
    run = Run(REACH)
    for _ in range(1500):
        run.step(0.002, filter=safe)
        assert abs(run.velocity[0]) <= 0.4
        assert np.abs(run.acceleration[:2]).max() <= 2.0
    assert safe.clearance == np.inf
    np.testing.assert_allclose(run.position, REACH.goal, atol=1e-3)


def test_a_velocity_carries_an_obstacle_on():
    safe = SafetyFilter([Sphere([0.3, 0.3, 0], 0.05, velocity=[0, -0.5, 0])], margin=0.02)
    _, clearance = passed(REACH, safe, 1.0)
    assert clearance > 0.019
    np.testing.assert_allclose(safe.obstacles[0].center, [0.3, -0.2, 0], atol=1e-12)
    assert safe.obstacles[1:] == [None] * (safe.room - 1)


def test_a_coupling_that_raises_leaves_run_and_filter_as_they_were():
    run, safe = Run(REACH), SafetyFilter([Sphere([0.3, 0.3, 0], 0.05, velocity=[0, -0.5, 0])])

    def fails(state):
        raise KeyError("stop")

    with pytest.raises(KeyError):
        run.step(0.01, fails, filter=safe)
    assert run.time == 0.0
    np.testing.assert_array_equal(safe.obstacles[0].center, [0.3, 0.3, 0])
    run.step(0.01, lambda state: np.zeros(3), filter=safe)
    assert run.time == 0.01


def test_copies_are_independent():
    safe = SafetyFilter([Sphere([1, 0, 0], 0.1)])
    other = copy.deepcopy(safe)
    other.remove(0)
    assert safe.obstacles[0] is not None
    assert other.obstacles[0] is None


@pytest.mark.parametrize(
    ("make", "named"),
    [
        (lambda: Sphere([0, 0], 0.1), "center: 2 numbers, expected 3"),
        (lambda: Sphere([0, 0, 0], -0.1), "radius: expected a length"),
        (lambda: Plane([0, 0, 0], [0, 0, 0]), "normal: expected a direction"),
        (lambda: SafetyFilter(velocity=[1, 0, 1]), r"velocity\[1\]: 0, expected a limit above 0"),
        (lambda: SafetyFilter(margin=0), "margin: 0, expected a length"),
        (lambda: SafetyFilter().set(8, Sphere([0, 0, 0], 1)), "index: 8, expected 0 to 7"),
        (
            lambda: Run(REACH).step(0.01, filter=SafetyFilter(velocity=[1, 1])),
            "step: dt .* or the filter is for another",
        ),
    ],
)
def test_what_cannot_be_is_refused_by_name(make, named):
    with pytest.raises(InvalidArgument, match=named):
        make()


def test_distances_of_many_points():
    box = Box(np.eye(4), [0.1, 0.2, 0.3])
    np.testing.assert_allclose(box.distance([[0.2, 0, 0], [0, 0, 0], [0.1, 0.2, 0.4]]), [0.1, -0.1, 0.1])
    assert box.distance([0.2, 0, 0]) == pytest.approx(0.1)
    np.testing.assert_allclose(box.gradient([0.2, 0, 0]), [1, 0, 0])
