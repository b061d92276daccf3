"""Via-points and joins from Python: passed exactly, with nothing changed outside their reach."""

import copy
import pickle

import dmpcpp
import numpy as np
import pytest
from dmpcpp import InvalidArgument, Status, Via, so3

TIME = np.linspace(0, 2, 120)
POSITION = np.c_[0.3 * np.sin(TIME), 0.1 * np.cos(2 * TIME), 0.2 * TIME]
ROTATION = np.array([so3.exp([0.2 * t, 0.5 * np.sin(t), 0.3 * t]) for t in TIME])
POSES = np.tile(np.eye(4), (len(TIME), 1, 1))
POSES[:, :3, :3], POSES[:, :3, 3] = ROTATION, POSITION
OPENING = 0.04 * (1 + np.cos(3 * TIME))
PLACE = np.eye(4)
PLACE[:3, :3], PLACE[:3, 3] = so3.exp([0.2, 0.6, 0.1]), [0.25, 0.1, 0.3]

MODELS = {
    "Dmp": dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, POSITION), basis_count=20),
    "OrientationDmp": dmpcpp.OrientationDmp.fit(dmpcpp.OrientationDemonstration(TIME, ROTATION), basis_count=20),
    "PoseDmp": dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(TIME, POSES), basis_count=20),
    "PoseGripperDmp": dmpcpp.PoseGripperDmp.fit(dmpcpp.PoseGripperDemonstration(TIME, POSES, OPENING), basis_count=20),
}
RUNS = {
    "Dmp": dmpcpp.Run,
    "OrientationDmp": dmpcpp.OrientationRun,
    "PoseDmp": dmpcpp.PoseRun,
    "PoseGripperDmp": dmpcpp.PoseGripperRun,
}
POINTS = {
    "Dmp": PLACE[:3, 3],
    "OrientationDmp": PLACE[:3, :3],
    "PoseDmp": PLACE,
    "PoseGripperDmp": (PLACE, [0.05]),
}
every_kind = pytest.mark.parametrize("kind", MODELS)


def parts(value):
    return value if isinstance(value, tuple) else (value,)


def assert_same(a, b, tolerance=1e-9):
    for one, other in zip(parts(a), parts(b), strict=True):
        np.testing.assert_allclose(one, other, atol=tolerance)


@every_kind
def test_a_run_passes_a_via_point_that_is_set_on_the_way(kind):
    run = RUNS[kind](MODELS[kind])
    run.step(0.5)
    assert run.via(0.6, POINTS[kind]) is Status.running
    run.step(0.7)
    assert_same(run.state.point, POINTS[kind])
    assert run.via(0.5, POINTS[kind]) is Status.too_late
    assert run.move_via(0.6, POINTS[kind]) is Status.too_late
    run.clear_vias()


@every_kind
def test_a_via_point_has_its_velocity_and_moves(kind):
    run = RUNS[kind](MODELS[kind])
    rate = np.linspace(-0.1, 0.2, MODELS[kind].dimension)
    run.via(0.6, MODELS[kind].goal, velocity=rate, reach=(0.3, 0.1))
    run.step(1.0)
    assert run.move_via(0.6, POINTS[kind]) is Status.running
    run.step(0.2)
    assert_same(run.state.point, POINTS[kind], 1e-8)
    np.testing.assert_allclose(run.state.velocity, rate, atol=1e-7)


@every_kind
def test_ahead_is_where_the_run_will_be(kind):
    run = RUNS[kind](MODELS[kind])
    run.via(0.7, POINTS[kind])
    run.step(0.3)
    seen = run.ahead(0.8)
    run.step(1.3)
    assert_same(seen.point, run.state.point)
    assert seen.phase == pytest.approx(0.8) and run.state.phase == pytest.approx(0.8)
    with pytest.raises(InvalidArgument, match="phase: 0.5"):
        run.ahead(0.5)


def test_a_rollout_passes_its_via_points_and_keeps_the_rest():
    model = MODELS["PoseDmp"]
    times = np.linspace(0, 2, 201)
    plain = model.rollout_at(times)
    past = model.rollout_at(times, via=[Via(0.3, PLACE, reach=0.1), Via(0.6, PLACE, np.zeros(6), (0.2, 0.1))])
    np.testing.assert_allclose(past.pose[[60, 120]], [PLACE, PLACE], atol=1e-9)
    np.testing.assert_allclose(past.twist[120], 0, atol=1e-8)
    np.testing.assert_array_equal(past.pose[:20], plain.pose[:20])
    np.testing.assert_array_equal(past.pose[141:], plain.pose[141:])
    same = model.rollout(via=[Via(0.3, PLACE)])
    assert np.abs(same.pose - PLACE).reshape(len(same.time), -1).max(axis=1).min() < 1e-9


@pytest.mark.parametrize(
    ("via", "words"),
    [
        ([Via(1.5, PLACE)], r"via\[0\].phase: 1.5"),
        ([Via(0.5, PLACE), Via(0.4, PLACE)], r"via\[1\].phase: 0.4"),
        ([Via(0.5, np.eye(3))], r"via\[0\].point"),
        ([Via(0.5, "there")], r"via\[0\].point: of the wrong type, expected \(4, 4\)"),
        ([Via(0.5, PLACE, [1, 2])], r"via\[0\].velocity: 2 numbers, expected 6"),
        ([Via(0.5, PLACE, reach=0.0)], r"via\[0\].reach"),
    ],
)
def test_via_points_that_cannot_be_passed_are_refused_by_name(via, words):
    with pytest.raises(InvalidArgument, match=words):
        MODELS["PoseDmp"].rollout(via=via)


def test_what_can_be_no_via_point_raises_in_a_run_and_changes_nothing():
    run = dmpcpp.Run(MODELS["Dmp"])
    for phase, point, options in [
        (2.0, [0, 0, 0], {}),
        (np.nan, [0, 0, 0], {}),
        (0.5, [0, 0], {}),
        (0.5, [0, 0, np.inf], {}),
        (0.5, [0, 0, 0], {"velocity": [0, np.nan, 0]}),
        (0.5, [0, 0, 0], {"reach": 3.0}),
    ]:
        with pytest.raises(InvalidArgument):
            run.via(phase, point, **options)
    with pytest.raises(InvalidArgument, match="move_via"):
        run.move_via(0.5, [0, 0, 0])
    plain = dmpcpp.Run(MODELS["Dmp"])
    run.step(1.0)
    plain.step(1.0)
    np.testing.assert_array_equal(run.position, plain.position)


@every_kind
def test_a_join_goes_on_with_a_model_or_a_run_without_a_jump(kind):
    model = MODELS[kind]
    for following in (model, RUNS[kind](model)):
        run = RUNS[kind](model)
        run.step(0.9)
        before = run.state
        run.join(following, reach=0.4)
        assert run.phase == 0.0
        assert_same(run.state.point, before.point)
        np.testing.assert_allclose(run.state.velocity, before.velocity, atol=1e-9)
        run.step(2.0)
        alone = RUNS[kind](model)
        alone.step(2.0)
        assert_same(run.state.point, alone.state.point)


@every_kind
def test_a_soft_start_begins_anywhere(kind):
    run = RUNS[kind](MODELS[kind])
    run.start_from(POINTS[kind], np.zeros(MODELS[kind].dimension), 0.3)
    assert_same(run.state.point, POINTS[kind])
    np.testing.assert_allclose(run.state.velocity, 0, atol=1e-12)
    with pytest.raises(InvalidArgument, match="reach"):
        run.start_from(POINTS[kind], np.zeros(MODELS[kind].dimension), 7.0)


def test_joins_that_cannot_be_are_refused():
    run = dmpcpp.Run(MODELS["Dmp"])
    flat = dmpcpp.Dmp.fit(dmpcpp.Demonstration(TIME, POSITION[:, :2]), basis_count=20)
    with pytest.raises(InvalidArgument, match="another dimension"):
        run.join(flat)


@every_kind
def test_a_sequence_is_one_value(kind, tmp_path):
    model = MODELS[kind]
    sequence = getattr(dmpcpp, f"{kind}Sequence")([model, model], leave=[0.8, 1.0], reach=0.4)
    assert sequence.duration == pytest.approx(1.8 * model.duration)
    assert sequence.leave == [0.8, 1.0] and len(sequence.models) == 2
    assert_same(sequence.goal, model.goal)
    motion = sequence.rollout(dt=0.01)
    assert motion.time[-1] == pytest.approx(sequence.duration)
    for again in (pickle.loads(pickle.dumps(sequence)), copy.deepcopy(sequence)):
        assert dmpcpp.to_json(again) == dmpcpp.to_json(sequence)
    dmpcpp.save(sequence, tmp_path / "two.json")
    loaded = dmpcpp.load(tmp_path / "two.json")
    assert type(loaded) is type(sequence) and dmpcpp.to_json(loaded) == dmpcpp.to_json(sequence)
    run = getattr(dmpcpp, f"{kind}SequenceRun")(sequence)
    while run.step(0.01):
        pass
    assert run.part == 1
    assert_same(run.state.point, model.goal, 1e-3)


def test_a_sequence_passes_the_via_points_of_its_motions():
    model = MODELS["PoseDmp"]
    sequence = dmpcpp.PoseDmpSequence([model, model], via=[[], [Via(0.5, PLACE)]])
    motion = sequence.rollout_at([3.0])
    np.testing.assert_allclose(motion.pose[0], PLACE, atol=1e-8)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"leave": [1.0]}, "leave: 1 numbers"),
        ({"leave": 0.0}, r"parts\[0\].leave: 0"),
        ({"reach": 2.0}, r"parts\[0\].reach: 2"),
        ({"via": [[]]}, "via: 1 lists"),
        ({"via": [[], [Via(0.5, np.eye(3))]]}, r"via\[0\].point"),
    ],
)
def test_sequences_that_cannot_be_are_refused(options, words):
    with pytest.raises(InvalidArgument, match=words):
        dmpcpp.PoseDmpSequence([MODELS["PoseDmp"]] * 2, **options)
