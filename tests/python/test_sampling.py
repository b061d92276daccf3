"""A rate that is stated stands in place of what the file says, and the history says what was left aside."""

import numpy as np
import pytest
from dmpcpp import recordings

from tests.python.command import run
from tests.python.test_c3d import made
from tests.python.test_markers import qualisys, six_dof

COUNT = 51
NAMES = "x,y,z,qx,qy,qz,qw"


def poses():
    time = 0.04 * np.arange(COUNT)
    return np.c_[0.2 * np.sin(time), 0.1 * time, 0.0 * time, np.tile([0.0, 0.0, 0.0, 1.0], (COUNT, 1))]


def table(path, times=None, name="time"):
    """A table of 25 samples a second, or at the times given."""
    times = 0.04 * np.arange(COUNT) if times is None else times
    lines = [f"{time},{','.join(map(repr, map(float, pose)))}" for time, pose in zip(times, poses(), strict=True)]
    path.write_text("\n".join([f"{name},{NAMES}", *lines]))
    return path


def told(history):
    return [note for note in history if "left aside" in note]


def test_a_rate_in_place_of_a_tables_times_is_told_and_another_tempo_is_a_warning(tmp_path):
    path = table(tmp_path / "a.csv")
    assert told(recordings.load(path).history) == []
    found = recordings.load(path, rate=100.0)
    assert found.rate == pytest.approx(100.0)
    assert told(found.history) == [
        "WARNING: times of the file left aside: 100 Hz as stated; by its own times 25 Hz, so the motion is taken "
        "4 times as fast as the file says"
    ]
    assert told(recordings.load(path, rate=30.0).history) == [
        "times of the file left aside: 30 Hz as stated; by its own times 25 Hz"
    ]


@pytest.mark.parametrize(("name", "stated"), [("time_ms", {}), ("time", {"time_unit": "ms"})])
def test_the_files_own_rate_is_told_in_its_own_unit_and_the_stated_one_is_in_hz(name, stated, tmp_path):
    path = table(tmp_path / "a.csv", 40.0 * np.arange(COUNT), name)
    found = recordings.load(path, rate=100.0, **stated)
    assert found.duration == pytest.approx(0.5)
    assert "by its own times 25 Hz" in told(found.history)[0]


@pytest.mark.parametrize("times", [np.arange(COUNT), ["00:01"] * COUNT, [1.5] * COUNT])
def test_times_that_tell_no_rate_are_left_aside_without_one(times, tmp_path):
    found = recordings.load(table(tmp_path / "a.csv", times), rate=100.0)
    assert told(found.history) == ["times of the file left aside: 100 Hz as stated"]


@pytest.mark.parametrize("kind", ["beside", "column"])
def test_an_arrays_times_are_left_aside_likewise(kind, tmp_path):
    time = 0.04 * np.arange(COUNT)
    arrays = {"pose": poses(), "time": time} if kind == "beside" else {"pose": np.c_[time, poses()]}
    np.savez(tmp_path / "a.npz", **arrays)
    assert recordings.load(tmp_path / "a.npz", quat_order="xyzw").rate == pytest.approx(25.0)
    found = recordings.load(tmp_path / "a.npz", quat_order="xyzw", rate=50.0)
    assert found.rate == pytest.approx(50.0)
    assert "by its own times 25 Hz, so the motion is taken 2 times as fast" in told(found.history)[0]


def test_a_rate_that_the_file_states_is_left_aside_likewise(tmp_path):
    np.savez(tmp_path / "a.npz", pose=poses(), rate=25.0)
    assert told(recordings.load(tmp_path / "a.npz", quat_order="xyzw", rate=25.0).history) == []
    found = recordings.load(tmp_path / "a.npz", quat_order="xyzw", rate=100.0)
    assert told(found.history)[0].startswith(
        "WARNING: rate of the file left aside: 100 Hz as stated; by its own rate 25"
    )


def test_files_of_markers_and_bodies_say_it_too(tmp_path):
    six_dof(tmp_path / "a_6D.tsv")
    files = (
        recordings.markers(made(tmp_path / "a.c3d"), rate=7.0),
        recordings.markers(qualisys(tmp_path / "a.tsv"), rate=7.0),
        recordings.markers(qualisys(tmp_path / "b.tsv", columns=False, leading=0), rate=7.0),
        recordings.load(tmp_path / "a_6D.tsv", "cup", rate=7.0),
    )
    for found in files:
        assert found.rate == pytest.approx(7.0)
        assert len(told(found.history)) == 1 and told(found.history)[0].startswith("WARNING")


def test_the_command_prints_the_warning(tmp_path):
    done = run("inspect", table(tmp_path / "a.csv"), "--rate", 100, "--unit", "m", "--up", "z", cwd=tmp_path)
    assert "WARNING: times of the file left aside: 100 Hz as stated; by its own times 25 Hz" in done.stdout
