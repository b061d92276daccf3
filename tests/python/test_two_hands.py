"""Two hands that hold one thing: the grasp stays as it was shown whatever goal, start and tempo."""

import dmpcpp
import numpy as np
import pytest
from dmpcpp import InvalidArgument, PoseDemonstration, recordings, so3
from dmpcpp.two_hands import TwoHands, TwoHandsRun, hands, held, load_two_hands

TIME = np.linspace(0, 2, 150)
GRIP = np.eye(4)
GRIP[:3, :3], GRIP[:3, 3] = so3.exp([0.2, 3.0, 0.1]), [0.05, 0.4, -0.02]  # palms that face each other


def shown(loosens=0.0):
    left = np.tile(np.eye(4), (len(TIME), 1, 1))
    left[:, :3, :3] = [so3.exp([0.5 * t, 0.3 * np.sin(t), 0.8 * t]) for t in TIME]
    left[:, :3, 3] = np.c_[0.3 * np.sin(TIME), 0.2 * TIME, 0.1 * np.cos(2 * TIME)]
    grips = np.tile(GRIP, (len(TIME), 1, 1))
    grips[:, 1, 3] += loosens * np.sin(TIME)
    return PoseDemonstration(TIME, left), PoseDemonstration(TIME, left @ grips)


def grasps(motion):
    return np.linalg.inv(motion.left) @ motion.right


def off(grasp, other):
    angles = [so3.distance(a[:3, :3], b[:3, :3]) for a, b in zip(grasp, other, strict=True)]
    return np.abs(grasp - other)[:, :3, 3].max(), np.degrees(np.max(angles))


def test_hands_and_what_they_hold_say_the_same():
    left, right = shown(0.1)
    again = hands(held(left.pose, right.pose), np.linalg.inv(left.pose) @ right.pose)
    assert np.allclose(again[0], left.pose, atol=1e-14) and np.allclose(again[1], right.pose, atol=1e-14)


def test_a_rigid_grasp_stays_exact_for_new_goals_starts_and_tempi():
    model = TwoHands.fit(*shown())
    goal = model.held.goal.copy()
    goal[:3, 3] += [0.2, -0.1, 0.15]
    goal[:3, :3] = so3.exp([0.4, -0.6, 0.3]) @ goal[:3, :3]
    for duration in (0.7, 2.0, 5.0):
        moved = model.rollout(goal, duration, 0.01)
        position, angle = off(grasps(moved), np.tile(GRIP, (len(moved.time), 1, 1)))
        assert position < 1e-9 and angle < 1e-6
        assert np.allclose(moved.held[-1, :3, 3], goal[:3, 3], atol=1e-3)
    run = TwoHandsRun(model)
    away = model.held.start.copy()
    away[:3, 3] += 0.05
    run.held.start_from(away, np.zeros(6), 0.3)
    run.held.goal = goal
    while run.step(0.013):
        run.held.duration = 3.0
        position, angle = off((np.linalg.inv(run.left) @ run.right)[None], GRIP[None])
        assert position < 1e-9 and angle < 1e-6
    assert np.allclose(held(run.left, run.right)[:3, 3], run.held.pose[:3, 3])


def test_a_grasp_that_changes_goes_with_the_phase_alone():
    model = TwoHands.fit(*shown(0.1))
    plain = model.rollout(dt=0.02)
    assert off(plain.left, shown(0.1)[0].pose[[0, -1]][[0] * len(plain.time)])[0] > 0.1  # it moves
    for number, demonstration in enumerate(shown(0.1)):
        again = (model.rollout(dt=2 / 149).left, model.rollout(dt=2 / 149).right)[number]
        assert np.abs(again - demonstration.pose).max() < 1e-3
    goal = model.held.goal.copy()
    goal[:3, 3] += 0.1
    moved = model.rollout(goal, 4.0, 0.04)
    assert off(grasps(moved), grasps(plain))[0] < 1e-8
    run = TwoHandsRun(model)
    for _ in range(50):
        run.step(0.02)
    at = np.argmin(np.abs(plain.time - run.held.phase * 2.0))
    assert np.abs(run.right - plain.right[at]).max() < 1e-6


def test_it_is_saved_as_two_model_files(tmp_path):
    model = TwoHands.fit(*shown(0.1), basis_count=20)
    model.save(tmp_path / "box")
    again = load_two_hands(tmp_path / "box")
    assert np.array_equal(again.rollout(dt=0.1).right, model.rollout(dt=0.1).right)
    dmpcpp.save(
        TwoHands.fit(*(PoseDemonstration(2 * TIME, one.pose) for one in shown())).held, tmp_path / "box/held.json"
    )
    with pytest.raises(InvalidArgument, match="different durations"):
        load_two_hands(tmp_path / "box")


def recorded(one, every, last=150):
    return recordings.Recording(
        time=TIME[:last:every],
        position=one.pose[:last:every, :3, 3],
        rotation=one.pose[:last:every, :3, :3],
        body="hand",
    )


def test_both_hands_of_a_recording_are_taken_at_one_time():
    left, right = shown()
    model = TwoHands.from_recordings(recorded(left, 2), recorded(right, 1, 120))
    assert model.duration == pytest.approx(TIME[118])
    moved = model.rollout(dt=0.05)
    position, angle = off(grasps(moved), np.tile(GRIP, (len(moved.time), 1, 1)))
    assert position < 1e-4 and angle < 0.01


def test_hands_that_were_not_seen_together_are_refused():
    left, right = shown()
    with pytest.raises(InvalidArgument, match="right: recorded at other times"):
        TwoHands.fit(left, PoseDemonstration(2 * TIME, right.pose))
    with pytest.raises(InvalidArgument, match=r"right: recorded for 0.09\d* s, of which the left hand has 1 samples"):
        TwoHands.from_recordings(recorded(left, 8), recorded(right, 1, 8))
