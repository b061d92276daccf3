"""The teaching page: what a choice leads to, by the session; and the page itself, in Chromium."""

import threading
from dataclasses import replace

import dmpcpp
import numpy as np
import pytest
from dmpcpp import arms
from dmpcpp.errors import InvalidArgument
from dmpcpp.view import Session

pytest.importorskip("pybullet_data")


@pytest.fixture(scope="module")
def model():
    """A motion in front of the Panda."""
    panda, time = arms.find("panda"), np.linspace(0.0, 3.0, 200)
    middle = np.array([0.0, 0.2, 0.0, -1.9, 0.0, 2.1, 0.8])
    swing = np.array([0.3, 0.2, 0.1, 0.25, -0.2, 0.2, 0.3])
    poses = panda.forward_kinematics(middle + np.sin(np.c_[time]) * swing)
    return dmpcpp.PoseDmp.fit(dmpcpp.PoseDemonstration(time, poses), basis_count=60)


@pytest.fixture(scope="module")
def session(model):
    return Session(model, arms.find("panda"))


def test_the_demonstrated_choice_shows_the_model_and_is_feasible(session, model):
    shown = session.update(session.demonstrated)
    assert shown.feasible and shown.joints.report.complete
    assert np.abs(shown.pose - model.rollout_at(shown.time).pose).max() < 1e-9
    assert np.abs(arms.find("panda").forward_kinematics(shown.joints.position) - shown.pose).max() < 1e-5


def test_a_goal_that_is_dragged_is_where_the_motion_ends(session, model):
    goal = model.goal.copy()
    goal[:3, 3] += [0.04, -0.05, 0.03]
    shown = session.update(replace(session.demonstrated, goal=goal))
    assert np.abs(shown.pose[-1] - goal).max() < 5e-3 and shown.feasible


def test_a_start_that_is_dragged_is_where_the_motion_begins(session, model):
    start = model.start.copy()
    start[:3, 3] += [0.02, 0.02, 0.02]
    shown = session.update(replace(session.demonstrated, start=start))
    assert np.abs(shown.pose[0] - start).max() < 1e-12
    assert np.abs(shown.pose[-1] - model.goal).max() < 5e-3
    assert np.abs(arms.find("panda").forward_kinematics(shown.joints.position[0]) - start).max() < 1e-5


def test_half_the_time_is_twice_the_speed(session):
    begin = session.demonstrated
    slow, fast = session.update(begin), session.update(replace(begin, duration=0.5 * begin.duration))
    assert np.allclose(fast.velocity_share, 2 * slow.velocity_share, rtol=1e-6)
    assert fast.shortest == pytest.approx(slow.shortest, rel=1e-6)


def test_too_fast_and_out_of_reach_are_not_feasible(session, model):
    begin = session.demonstrated
    assert not session.update(replace(begin, duration=0.1)).feasible
    far = model.goal.copy()
    far[0, 3] += 2.0
    shown = session.update(replace(begin, goal=far))
    assert not shown.feasible and not shown.joints.report.complete


def test_other_kernels_and_gains_learn_the_same_motion(session, model):
    begin = session.demonstrated
    few = session.update(replace(begin, basis_count=5))
    many = session.update(replace(begin, basis_count=90, alpha=2 * begin.alpha))
    misses = [np.abs(s.pose - model.rollout_at(s.time).pose).max() for s in (few, many)]
    assert misses[1] < 2e-3 and misses[1] < misses[0]


@pytest.mark.parametrize("duration", [0.0, -1.0, np.nan, np.inf])
def test_a_time_that_is_none_is_refused(session, duration):
    with pytest.raises(InvalidArgument, match="duration"):
        session.update(replace(session.demonstrated, duration=duration))


def test_a_model_of_positions_is_refused():
    time = np.linspace(0.0, 1.0, 50)
    with pytest.raises(InvalidArgument, match="Dmp, expected a PoseDmp"):
        Session(dmpcpp.Dmp.fit(dmpcpp.Demonstration(time, time)), arms.find("panda"))


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_what_is_changed_on_the_page_is_shown_and_the_button_takes_it_back(session, model):
    pytest.importorskip("viser")
    pytest.importorskip("yourdfpy")
    from dmpcpp.scene import serving
    from dmpcpp.show.view._page import Page

    goal = model.goal.copy()
    goal[:3, 3] += [0.03, 0.03, 0.0]
    with serving() as server:
        page = Page(server, session, arms.find("panda"))
        page.tick()
        assert "**feasible**" in page._said.content
        page.change(goal=goal, duration=1.5)
        page.tick()
        assert np.abs(page._shown.pose[-1] - goal).max() < 5e-3 and page._shown.time[-1] == 1.5
        page.change(duration=0.0)
        page.tick()
        assert "refused" in page._said.content and "duration" in page._said.content
        page._reset()
        page.tick()
        assert np.abs(page._shown.pose[-1] - model.goal).max() < 5e-3
        assert np.allclose(page._goal_handle.position, model.goal[:3, 3])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_the_page_opens_without_a_complaint(model, tmp_path):
    pytest.importorskip("viser")
    pytest.importorskip("yourdfpy")
    from dmpcpp import view

    from tests.python.browser import look

    addresses, told, stop = [], threading.Event(), threading.Event()

    def ready(address):
        addresses.append(address)
        told.set()

    thread = threading.Thread(
        target=view.serve, args=(model, arms.find("panda")), kwargs={"ready": ready, "stop": stop}
    )
    thread.start()
    try:
        assert told.wait(60)
        text = {"text": "document.body.innerText"}
        shown = lambda seen: "feasible" in str(seen.values["text"])  # noqa: E731
        seen = look(addresses[0], tmp_path, until=shown, scripts=text, size="1200,800")
    finally:
        stop.set()
        thread.join()
    assert seen.complaints == []
    assert "feasible" in seen.values["text"] and "panda_joint4" in seen.values["text"]
    assert all(url.startswith((addresses[0], addresses[0].replace("http", "ws"))) for url in seen.requests)
    (tmp_path / "page.png").write_bytes(seen.picture)
