"""Threads that share models and an arm answer as one thread does, bit for bit, and let the others run meanwhile."""

import sys
import threading
from collections.abc import Callable, Iterator

import dmpcpp
import numpy as np
import pytest

TIME = np.linspace(0.0, 2.0, 400)
POSES = np.tile(np.eye(4), (400, 1, 1))
POSES[:, :3, :3] = [dmpcpp.so3.exp([0.2 * t, 0.1, 0.3 * t]) for t in TIME]
POSES[:, :3, 3] = np.c_[0.1 * np.sin(TIME), 0.1 * np.cos(3 * TIME), 0.05 * TIME]
DEMONSTRATION = dmpcpp.PoseDemonstration(TIME, POSES)
MODEL = dmpcpp.PoseDmp.fit(DEMONSTRATION)
THREE_LINKS = '<robot name="three"><link name="l0"/>' + "".join(
    f"""<link name="l{i}"/><joint name="j{i}" type="revolute"><parent link="l{i - 1}"/><child link="l{i}"/>
    <origin xyz="0.3 0 0"/><axis xyz="{axis}"/><limit lower="-2" upper="2" velocity="2" effort="9"/></joint>"""
    for i, axis in enumerate(("0 0 1", "0 1 0", "0 0 1"), start=1)
) + "</robot>"  # fmt: skip
ARM = dmpcpp.Arm.from_urdf(THREE_LINKS)
JOINTS = np.c_[0.4 * np.sin(TIME), 0.5 + 0.3 * np.cos(TIME), 0.2 * TIME]
PATH = ARM.forward_kinematics(JOINTS)
TRAJECTORY = dmpcpp.JointTrajectory.through(TIME, JOINTS)

CALLS: dict[str, Callable[[], np.ndarray]] = {
    "fit": lambda: dmpcpp.PoseDmp.fit([DEMONSTRATION] * 40, basis_count=200).weights,
    "fit_each": lambda: dmpcpp.PoseDmp.fit_each(TIME, np.tile(POSES, (10, 1, 1, 1)))[9].weights,
    "rollout": lambda: MODEL.rollout(duration=20.0, dt=1e-3).pose,
    "rollout_each": lambda: MODEL.rollout_each(durations=np.linspace(1.0, 2.0, 10)).pose,
    "solve_many": lambda: dmpcpp.InverseKinematics(ARM).solve_many(np.tile(PATH, (20, 1, 1))).joints,
    "follow": lambda: dmpcpp.InverseKinematics(ARM).follow(PATH, TIME, thorough=False).position,
    "align": lambda: np.array(dmpcpp.align(POSES, POSES[::2]).path),
}


@pytest.mark.parametrize("name", CALLS)
def test_eight_threads_answer_as_one_does(name):
    call = CALLS[name]
    serial = call()
    start = threading.Barrier(8)
    answers: list[np.ndarray] = []

    def work() -> None:
        start.wait()
        answers.append(call())

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [answer.tobytes() for answer in answers] == [serial.tobytes()] * 8


@pytest.fixture
def only_who_waits_gives_way() -> Iterator[None]:
    """No thread is interrupted by the interpreter: another one runs only where this one lets go of the lock."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)
    yield
    sys.setswitchinterval(before)


def others_run_during(call: Callable[[], object]) -> bool:
    ran = threading.Event()
    ask = threading.Event()
    other = threading.Thread(target=lambda: (ask.wait(), ran.set()))
    other.start()
    ask.set()  # the other thread is awake now and waits for the interpreter
    call()
    seen = ran.is_set()
    other.join()
    return seen


@pytest.mark.usefixtures("only_who_waits_gives_way")
@pytest.mark.parametrize("name", CALLS)
def test_other_threads_run_meanwhile(name):
    """Asked several times: a call can be over before the machine wakes the other thread."""
    assert any(others_run_during(CALLS[name]) for _ in range(100))


@pytest.mark.usefixtures("only_who_waits_gives_way")
def test_a_call_that_keeps_the_interpreter_would_be_noticed():
    assert not any(others_run_during(lambda: sum(range(200_000))) for _ in range(20))
