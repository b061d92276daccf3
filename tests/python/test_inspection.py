"""Inspection: what is told of a recording is what is in it, and what is missing is asked for."""

import itertools
import json
import shlex
import subprocess
import sys

import numpy as np
import pytest
from dmpcpp import examples, motion
from dmpcpp.inspection import inspect
from dmpcpp.recordings import Recording
from scipy.spatial.transform import Rotation

COUNT = 400
TIMES = 0.01 * np.arange(COUNT)
HEADER = "time,x,y,z,qx,qy,qz,qw"

RIGHT = "right (logs of Unity and of most headsets are left-handed)"


def moving(position_noise=0.0, angle_noise=0.0) -> Recording:
    random = np.random.default_rng(4)
    position = np.column_stack([0.2 * np.sin(2 * TIMES), 0.1 * np.cos(3 * TIMES), 0.05 * TIMES])
    turning = Rotation.from_rotvec(np.column_stack([0.5 * np.sin(TIMES), 0.3 * TIMES, 0.2 * np.cos(2 * TIMES)]))
    turning = turning * Rotation.from_rotvec(angle_noise * random.normal(size=(COUNT, 3)))
    position = position + position_noise * random.normal(size=(COUNT, 3))
    return Recording(TIMES, position, turning.as_matrix())


def table(path, recording=None, header=HEADER, lost=(), swap=()):
    recording = moving() if recording is None else recording
    quaternion = Rotation.from_matrix(recording.rotation).as_quat()
    for k in swap:
        quaternion[k] = [0.0, 0.0, 1.0, 0.0] if k % 2 else [1.0, 0.0, 0.0, 0.0]
    rows = np.column_stack([recording.time, recording.position, quaternion])
    cells = [[repr(float(v)) for v in row] for row in rows]
    for k in lost:
        cells[k][1:] = [""] * 7
    path.write_text("\n".join([header, *(",".join(row) for row in cells)]))
    return path


@pytest.mark.parametrize(("position", "angle"), [(1e-4, 1e-3), (2e-3, 5e-3)])
def test_white_noise_is_found_to_a_tenth_of_it(position, angle):
    found = motion.noise(moving(position, angle))
    assert (found.position, found.angle) == pytest.approx((position, angle), rel=0.1)


def test_a_motion_without_noise_shows_none():
    found = motion.noise(moving())
    assert max(found.position, found.angle) < 1e-8


def test_noise_is_found_beside_gaps_and_nowhere_if_they_leave_too_little():
    recording = moving(1e-3, 1e-3)
    for every, expected in ((20, 1e-3), (5, 0.0)):
        lost = np.arange(COUNT) % every == 0
        position, rotation = recording.position.copy(), recording.rotation.copy()
        position[lost], rotation[lost] = np.nan, np.nan
        found = motion.noise(Recording(TIMES, position, rotation))
        assert found.position == pytest.approx(expected, rel=0.15)
        assert found.angle == pytest.approx(expected, rel=0.15)


def test_a_clean_recording_is_ready_and_its_figures_are_those_of_its_samples(tmp_path):
    found = inspect(table(tmp_path / "a.csv", moving(1e-3)), unit="m", up_axis="z", handedness="right")
    body = found.bodies[0]
    assert found.ok and not found.needed and not found.assumed
    assert (found.format, found.held, body.name, body.samples) == ("table", ("pose",), "pose", COUNT)
    assert (body.duration, body.rate) == (pytest.approx(3.99), pytest.approx(100.0))
    np.testing.assert_allclose(body.extent, np.ptp(moving(1e-3).position, axis=0))
    steps = np.linalg.norm(np.diff(moving(1e-3).position, axis=0), axis=1)
    assert body.peak_speed == pytest.approx(steps.max() / 0.01)
    assert (body.missing, body.longest_gap, body.jumps) == (0, 0.0, 0)


def test_what_was_taken_for_granted_is_told(tmp_path):
    assert inspect(table(tmp_path / "a.csv")).assumed == {"unit": "m", "up_axis": "z", "handedness": RIGHT}


@pytest.mark.parametrize(("lost", "gap", "ok"), [(range(50, 55), 0.06, True), (range(50, 80), 0.31, False)])
def test_gaps_are_measured_and_a_long_one_is_a_problem(tmp_path, lost, gap, ok):
    found = inspect(table(tmp_path / "a.csv", lost=lost), missing="empty", unit="m", up_axis="z")
    assert (found.bodies[0].missing, found.ok) == (len(lost), ok)
    assert found.bodies[0].longest_gap == pytest.approx(gap)
    assert any("a gap of 0.31 s" in problem for problem in found.problems) is not ok


def test_lost_ends_are_no_gap_as_they_are_cut_off(tmp_path):
    found = inspect(table(tmp_path / "a.csv", lost=range(50)), missing="empty", unit="m", up_axis="z")
    assert (found.bodies[0].missing, found.bodies[0].longest_gap, found.ok) == (50, 0.0, True)


def test_jumps_of_the_orientation_are_counted_and_are_a_problem(tmp_path):
    found = inspect(table(tmp_path / "a.csv", swap=(100, 201)), unit="m", up_axis="z")
    assert found.bodies[0].jumps == 4  # there and back
    assert not found.ok and "jumps by more than 90 deg 4 times" in found.problems[0]


def test_a_table_of_unknown_columns_asks_for_them(tmp_path):
    found = inspect(table(tmp_path / "a.csv", header="t0,a,b,c,d,e,f,g"))
    assert set(found.needed) == {"columns"} and not found.ok


def test_every_body_is_looked_at_and_one_is_to_be_named(tmp_path):
    header = ",".join(["time", *(f"{b}_{c}" for b in ("hand", "cup") for c in HEADER.split(",")[1:])])
    rows = [line.split(",") for line in table(tmp_path / "one.csv").read_text().splitlines()[1:]]
    (tmp_path / "two.csv").write_text("\n".join([header, *(",".join(row + row[1:]) for row in rows)]))
    found = inspect(tmp_path / "two.csv", unit="m", up_axis="z")
    assert [body.name for body in found.bodies] == ["hand", "cup"]
    assert found.needed == {"body": "the file holds several: hand, cup. Specify one: body='hand'"}
    assert inspect(tmp_path / "two.csv", "cup", unit="m", up_axis="z").ok


def test_recorded_files_are_told_with_their_gaps_and_needs(recorded):
    wheelchair = inspect(recorded / "c3d_ktk" / "sample_propulsion.c3d")
    assert set(wheelchair.needed) == {"markers"} and len(wheelchair.markers) == 41
    hand = inspect(recorded / "c3d_ktk" / "sample_propulsion.c3d", markers=["GloveR1", "GloveR2", "GloveR3"])
    assert hand.ok and hand.bodies[0].missing == 11
    assert set(inspect(recorded / "bvh_toolbox" / "walk01.bvh").needed) == {"unit", "body"}
    camera = inspect(recorded / "tum_evo" / "freiburg1_xyz-groundtruth.txt", up_axis="z")
    assert camera.ok and camera.bodies[0].longest_gap == pytest.approx(0.11, abs=0.01)
    assert not inspect(recorded / "aria_mps" / "hand_tracking_results_v2.csv", "left_wrist").ok


# ---------------------------------------------------------------- the command


def run(*arguments):
    command = [sys.executable, "-m", "dmpcpp", "inspect", *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert "Traceback" not in done.stdout + done.stderr
    return done


def test_the_command_says_ready_and_leaves_with_0(tmp_path):
    done = run(table(tmp_path / "a.csv"), "--unit", "m", "--up", "z")
    assert (done.returncode, done.stderr) == (0, "")
    assert "ready to be learned" in done.stdout and "not ready" not in done.stdout
    assert "moves over 400 200 200 mm in x, y, z" in done.stdout


def test_the_command_proposes_what_comes_next_with_what_was_stated(tmp_path):
    examples.write("reach", tmp_path)
    done = run(tmp_path / "reach.bvh", "--unit", "cm", "--body", "RightHand", "--keep-outliers")
    proposed = shlex.split(done.stdout.splitlines()[-1].removeprefix("next: "))
    assert proposed[:3] == ["dmpcpp", "imitate", str(tmp_path / "reach.bvh")]
    assert {"--unit cm", "--body RightHand", "--keep-outliers --arm", "--out reach"} <= {
        " ".join(pair) for pair in itertools.pairwise(proposed)
    }
    assert "next:" not in run(tmp_path / "reach.bvh").stdout  # not while something is to be stated


def test_the_command_leaves_with_3_while_something_is_to_be_stated(tmp_path):
    path = table(tmp_path / "a.csv", header="t0,a,b,c,d,e,f,g")
    done = run(path)
    assert done.returncode == 3
    assert "to state: --columns:" in done.stdout and "not ready to be learned" in done.stdout
    columns = "time=t0,x=a,y=b,z=c,qx=d,qy=e,qz=f,qw=g"
    assert run(path, "--columns", columns, "--unit", "1.0", "--delimiter", ",").returncode == 0


def test_the_command_leaves_with_2_and_one_line_where_the_file_cannot_be_read(tmp_path):
    path = table(tmp_path / "a.csv", lost=[7])
    done = run(path)
    assert done.returncode == 2
    assert done.stderr == (
        "dmpcpp: a.csv: line 9, column 'x': an empty cell, expected a number. If this marks a lost sample, state "
        "--missing empty.\n"
    )
    assert run(path, "--missing", "empty").returncode == 0
    assert run(path, "--body", "foot").returncode == 2
    assert run(tmp_path / "nix.csv").returncode == 2


def test_the_command_prints_json(tmp_path):
    report = json.loads(run(table(tmp_path / "a.csv"), "--json").stdout)
    assert report["ok"] and report["bodies"][0]["samples"] == COUNT
    assert report["assumed"] == {"unit": "m", "up_axis": "z", "handedness": RIGHT}


def test_stamps_that_jitter_are_shown_with_what_to_do(tmp_path):
    even = moving()
    jitter = np.random.default_rng(0).uniform(-4e-3, 4e-3, COUNT)
    jitter[0] = 0.0
    path = table(tmp_path / "a.csv", even.with_("jitter", time=TIMES + jitter))
    least, usual, largest = inspect(path).bodies[0].steps
    assert 2e-3 < least < 5e-3 and usual == pytest.approx(0.01, abs=1e-3) and 0.015 < largest < 0.018
    assert "where only the stamps jitter, a table is better read at an even --rate" in run(path).stdout
    assert "steps of" not in run(table(tmp_path / "b.csv", even)).stdout
    assert inspect(path, rate=100.0).bodies[0].noise_position < 1e-8
