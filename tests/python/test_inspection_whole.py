"""Inspection asks for all that is to be stated at once, and counts every sample that a file lacks."""

import numpy as np
import pytest
from dmpcpp import inspection, motion

from tests.python.command import run
from tests.python.test_c3d import made
from tests.python.test_inspection import COUNT, TIMES, moving, table
from tests.python.test_markers import motive, motive_body, qualisys, six_dof, trc, vicon, with_gap


def poses(recording=None):
    recording = moving() if recording is None else recording
    return np.c_[recording.position, motion.quaternions(recording)[0]]


def angles(path):
    lines = [",".join(map(repr, map(float, row))) for row in poses()[:, :6]]
    path.write_text("\n".join(["x,y,z,rx,ry,rz", *lines]))
    return path


def array(path):
    np.save(path, np.stack([poses()] * 3))
    return path


@pytest.mark.parametrize(
    ("write", "name", "stated", "needed"),
    [
        (array, "a.npy", {}, {"index", "quat_order", "rate"}),
        (angles, "a.csv", {}, {"euler_order", "angle_unit", "rate"}),
        (angles, "a.csv", {"handedness": "left", "rate": 50.0}, {"euler_order", "angle_unit", "up_axis"}),
        (lambda path: made(path, unit=b"xx"), "a.c3d", {}, {"unit", "markers"}),
        (lambda path: trc(path, units="ft"), "a.trc", {}, {"unit", "markers"}),
    ],
)
def test_all_that_is_to_be_stated_is_asked_for_at_once(write, name, stated, needed, tmp_path):
    found = inspection.inspect(write(tmp_path / name), **stated)
    assert set(found.needed) == needed and not found.ok


def test_what_was_only_supposed_is_not_reported_as_found(tmp_path):
    found = inspection.inspect(array(tmp_path / "a.npy"))
    assert found.bodies == () and found.assumed.keys() == {"unit", "up_axis", "handedness"}
    assert inspection.inspect(tmp_path / "a.npy", index=1, quat_order="xyzw", rate=100.0).bodies[0].samples == COUNT


def test_what_else_is_wrong_is_said_beside_what_is_to_be_stated(tmp_path):
    np.save(tmp_path / "a.npy", 1000.0 * poses()[:, :3])
    found = inspection.inspect(tmp_path / "a.npy")
    assert set(found.needed) == {"fixed_orientation", "rate"}
    assert any("State unit='mm' or unit='cm'" in problem for problem in found.problems)


def test_the_command_lists_them_all_and_what_is_then_stated_is_enough(tmp_path):
    done = run("inspect", array(tmp_path / "a.npy"), cwd=tmp_path)
    asked = [line.split(":")[1].strip() for line in done.stdout.splitlines() if line.startswith("to state:")]
    assert done.returncode == 3 and asked == ["--index", "--quat-order", "--rate"]
    stated = ("--index", 0, "--quat-order", "xyzw", "--rate", 100)
    assert run("inspect", "a.npy", *stated, cwd=tmp_path).returncode == 0


# ---------------------------------------------------------------- samples that are not there

LOST = [20, 21, 22, 90]


def lost_in_table(path, cell):
    lines = [line.split(",") for line in table(path).read_text().splitlines()]
    for k in LOST:
        lines[k + 1][1:] = [cell] * 7
    path.write_text("\n".join(map(",".join, lines)))


def lost_in_array(path):
    values = poses()
    values[LOST] = np.nan
    np.savez(path, pose=values, time=TIMES)


def dropped_from_table(path):
    lines = table(path).read_text().splitlines()
    path.write_text("\n".join(line for k, line in enumerate(lines) if k - 1 not in LOST))


def dropped_from_tum(path):
    rows = np.c_[TIMES, poses()]
    np.savetxt(path, np.delete(rows, LOST, axis=0))


def dropped_and_lost(path):
    lost_in_table(path, "")
    lines = path.read_text().splitlines()
    path.write_text("\n".join(line for k, line in enumerate(lines) if k - 1 not in LOST[:2]))


@pytest.mark.parametrize(
    ("name", "write", "stated", "expected"),
    [
        ("a.csv", lambda path: lost_in_table(path, ""), {"missing": "empty"}, (4, 0)),
        ("a.csv", lambda path: lost_in_table(path, "NaN"), {"missing": "nan"}, (4, 0)),
        ("a.csv", lambda path: lost_in_table(path, "-9999"), {"missing": -9999.0}, (4, 0)),
        ("a.npz", lost_in_array, {"missing": "nan", "quat_order": "xyzw"}, (4, 0)),
        ("a.csv", dropped_from_table, {}, (0, 4)),
        ("a.txt", dropped_from_tum, {}, (0, 4)),
        ("a.csv", dropped_and_lost, {"missing": "empty"}, (2, 2)),
    ],
)
def test_lost_samples_are_counted_whether_marked_or_never_written(name, write, stated, expected, tmp_path):
    write(tmp_path / name)
    body = inspection.inspect(tmp_path / name, **stated).bodies[0]
    assert (body.missing, body.skipped) == expected
    assert body.samples + body.skipped == COUNT
    options = [part for key, value in stated.items() for part in (f"--{key.replace('_', '-')}", value)]
    row = next(line for line in run("inspect", name, *options, cwd=tmp_path).stdout.splitlines() if "pose" in line[:8])
    assert row.split()[4] == "4"  # name, samples, s, Hz, lost


def test_stamps_that_jitter_skip_nothing():
    jitter = np.random.default_rng(0).uniform(-3e-3, 3e-3, COUNT)
    assert motion.skipped(TIMES + jitter) == 0 and motion.skipped(TIMES) == 0


def test_lost_samples_of_motion_capture_files_are_counted(tmp_path):
    six_dof(tmp_path / "a_6D.tsv", lost=(4, 5))
    assert {body.missing for body in inspection.inspect(tmp_path / "a_6D.tsv").bodies} == {2}
    body, _ = motive_body()
    body[3] = np.nan
    assert inspection.inspect(motive(tmp_path / "m.csv", body)).bodies[0].missing == 1
    gap = with_gap()
    expected = int(np.isnan(gap).all(axis=2).sum())
    for found in (qualisys(tmp_path / "q.tsv", gap), trc(tmp_path / "t.trc", gap), vicon(tmp_path / "v.csv", gap)):
        assert sum(marker.missing for marker in inspection.inspect(found).markers) == expected > 0
    c3d = made(tmp_path / "a.c3d", lost=[(3, 1), (4, 1), (7, 2)])
    assert [marker.missing for marker in inspection.inspect(c3d).markers] == [0, 2, 1]
