"""Where no random place carries a motion, those that nearly do are changed until one does."""

from types import SimpleNamespace

import numpy as np
import pytest
from dmpcpp import InverseKinematics, motion, planning
from dmpcpp.errors import InvalidArgument
from dmpcpp.planning._approach import approached, missed_by
from dmpcpp.planning._search import _Search
from dmpcpp.recordings import Recording
from dmpcpp.retarget import Placement
from scipy.spatial.transform import Rotation

from tests.python.small_arms import arm

NARROW = {
    f"j{k}": f'<limit lower="-{most}" upper="{most}" velocity="2" effort="80"/>' for k, most in ((4, 1.5), (5, 1.3))
}


def met(count, position=0.0, angle=0.0, solved=None):
    return SimpleNamespace(
        solved=count if solved is None else solved,
        position_error=np.full(count, position),
        angle_error=np.full(count, angle),
    )


def test_what_is_missed_is_counted_pose_by_pose_and_above_the_floor_alone():
    poses = np.tile(np.eye(4), (4, 1, 1))
    poses[:, 2, 3] = 0.3
    assert missed_by(met(4, 1e-7, 1e-7), poses, 0.3) == 0.0  # all of them are met
    assert missed_by(met(4, 0.02, 0.1, solved=0), poses, 0.3) == pytest.approx(4 * (0.2 + 0.1))
    assert missed_by(met(4, 5.0, 3.0, solved=0), poses, 0.3) == 4.0
    poses[1, 2, 3] = 0.25
    assert missed_by(met(4), poses, 0.3) == pytest.approx(0.5)


def test_changes_lead_to_less_and_end_where_nothing_is_missed():
    there, looks = np.array([0.5, -0.3, 0.4]), []

    def miss(placement):
        looks.append(max(0.0, float(np.linalg.norm(placement.position - there)) - 0.05))
        return looks[-1]

    found, least = approached(Placement(np.zeros(3)), miss, np.random.default_rng(0), (0.5, 1.0), 300)
    assert least == 0.0 and np.linalg.norm(found.position - there) <= 0.05
    assert len(looks) < 200 and looks[-1] == 0.0 and min(looks[:-1]) > 0.0
    again, _ = approached(Placement(np.zeros(3)), miss, np.random.default_rng(0), (0.5, 1.0), 300)
    assert (again.position == found.position).all() and 0.5 <= found.scale <= 1.0


def test_without_changes_the_placement_stays():
    start = Placement(np.ones(3))
    found, least = approached(start, lambda _: 1.5, np.random.default_rng(0), (0.5, 1.0), 0)
    assert found is start and least == 1.5


def twisting():
    """A hand that draws an arc and turns by 150 deg about an axis that moves."""
    time = np.linspace(0.0, 3.0, 90)
    s = time / 3.0
    position = np.c_[0.3 * np.sin(np.pi * s), 0.2 * s, 0.1 * np.cos(np.pi * s)]
    turn = np.c_[2.6 * s, 0.8 * np.sin(np.pi * s), 0.5 * s]
    return Recording(time, position, Rotation.from_rotvec(turn).as_matrix(), "hand", "twist", "z")


def test_an_arm_with_a_narrow_wrist_gets_a_place_that_random_ones_miss(monkeypatch):
    robot, recording = arm(limits=NARROW), twisting()
    found = planning.place(recording, robot, candidates=1)
    poses = found.apply(motion.poses(recording))
    assert InverseKinematics(robot).follow(poses, times=recording.time, start=found.start).report.complete
    monkeypatch.setattr(_Search, "near", lambda *_: [])
    with pytest.raises(InvalidArgument, match="no placement found"):
        planning.place(recording, robot, candidates=1)
