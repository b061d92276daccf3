"""Files out and back in: exact round trips, nothing half-written, nothing that is not finite."""

from types import SimpleNamespace

import numpy as np
import pytest
from dmpcpp import _atomic as atomic
from dmpcpp import export, recordings
from dmpcpp.errors import FileError, InvalidArgument
from scipy.spatial.transform import Rotation

TIME = np.linspace(0.0, 1.0, 21)


def names_in(folder) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def joints(count=7) -> SimpleNamespace:
    angle = np.outer(TIME, np.arange(1.0, count + 1.0) / 3.0)
    return SimpleNamespace(
        time=TIME,
        position=np.sin(angle),
        velocity=np.cos(angle),
        acceleration=-np.sin(angle) / 7.0,
        joint_names=[f"joint_{k}" for k in range(count)],
    )


def plan() -> SimpleNamespace:
    pose = np.tile(np.eye(4), (21, 1, 1))
    pose[:, :3, :3] = Rotation.from_rotvec(np.outer(TIME, [1.0, 4.0, -2.0])).as_matrix()
    pose[:, :3, 3] = np.outer(TIME, [0.1, 0.2, 0.3])
    return SimpleNamespace(time=TIME, pose=pose, twist=np.tile([0.1, 0.2, 0.3, 1.0, 4.0, -2.0], (21, 1)))


def test_joints_read_back_exactly(tmp_path):
    written = joints()
    export.write_joints(tmp_path / "joints.csv", written)
    read = export.read_joints(tmp_path / "joints.csv")
    assert read.joint_names == tuple(written.joint_names)
    for what in ("time", "position", "velocity", "acceleration"):
        np.testing.assert_array_equal(getattr(read, what), getattr(written, what))


def test_the_header_names_time_joints_velocities_and_accelerations(tmp_path):
    export.write_joints(tmp_path / "joints.csv", joints(2))
    first, second = (tmp_path / "joints.csv").read_text().splitlines()[:2]
    assert first == "time,joint_0,joint_1,joint_0_vel,joint_1_vel,joint_0_acc,joint_1_acc"
    assert second == "0.0,0.0,0.0,1.0,1.0,-0.0,-0.0"


def test_joint_names_with_commas_and_quotes_survive(tmp_path):
    written = joints(2)
    written.joint_names = ['a,b "c"', "left arm/1"]
    export.write_joints(tmp_path / "joints.csv", written)
    assert export.read_joints(tmp_path / "joints.csv").joint_names == ('a,b "c"', "left arm/1")


@pytest.mark.parametrize(
    ("what", "index", "value", "message"),
    [
        ("position", (3, 2), np.nan, r"position\[3, 2\]: nan of joint 'joint_2', expected a finite number"),
        ("velocity", (0, 6), np.inf, r"velocity\[0, 6\]: inf"),
        ("acceleration", (20, 0), -np.inf, r"acceleration\[20, 0\]: -inf"),
        ("time", 5, 0.0, r"time\[5\]: .* strictly increasing"),
        ("time", 0, np.nan, r"time\[0\]: nan"),
    ],
)
def test_joints_that_no_robot_should_get_are_refused_and_leave_the_old_file(tmp_path, what, index, value, message):
    path = tmp_path / "joints.csv"
    export.write_joints(path, joints())
    before = path.read_bytes()
    broken = joints()
    changed = np.array(getattr(broken, what))
    changed[index] = value
    setattr(broken, what, changed)
    with pytest.raises(InvalidArgument, match=message):
        export.write_joints(path, broken)
    assert path.read_bytes() == before
    assert names_in(tmp_path) == ["joints.csv"]


def test_sizes_and_names_that_do_not_fit_are_refused(tmp_path):
    broken = joints()
    broken.velocity = broken.velocity[:, :6]
    with pytest.raises(InvalidArgument, match=r"velocity: shape \(21, 6\), expected \(21, 7\)"):
        export.write_joints(tmp_path / "a.csv", broken)
    broken = joints()
    broken.joint_names = ["a"] * 7
    with pytest.raises(InvalidArgument, match="expected a different name for each joint"):
        export.write_joints(tmp_path / "a.csv", broken)
    assert names_in(tmp_path) == []


def test_a_damaged_joint_file_is_refused_with_its_line(tmp_path):
    path = tmp_path / "joints.csv"
    export.write_joints(path, joints(1))
    lines = path.read_text().splitlines()
    for bad, message in {
        "0.1,2,3": "line 4, 3 cells, expected 4",
        "0.1,2,x,4": "line 4, joint_0_vel: 'x', expected a number",
    }.items():
        path.write_text("\n".join([*lines[:3], bad, *lines[4:]]))
        with pytest.raises(InvalidArgument, match=message):
            export.read_joints(path)
    path.write_text("time,a,b,c\n")
    with pytest.raises(InvalidArgument, match="line 1, expected time,<joints>"):
        export.read_joints(path)
    path.write_text("")
    with pytest.raises(InvalidArgument, match="line 1"):
        export.read_joints(path)
    with pytest.raises(FileError, match=r"no\.csv: cannot be read"):
        export.read_joints(tmp_path / "no.csv")


def test_a_plan_reads_back_exactly_with_its_frames(tmp_path):
    written = plan()
    export.write_plan(tmp_path / "plan.npz", written, base="panda_link0", tip="panda_hand")
    read = export.read_plan(tmp_path / "plan.npz")
    for what in ("time", "pose", "twist"):
        np.testing.assert_array_equal(getattr(read, what), getattr(written, what))
    assert (read.base, read.tip) == ("panda_link0", "panda_hand")
    with np.load(tmp_path / "plan.npz") as arrays:
        assert "m/s and rad/s" in str(arrays["units"])


def test_a_plan_is_a_recording_too(tmp_path):
    export.write_plan(tmp_path / "plan.npz", plan())
    np.testing.assert_array_equal(recordings.load(tmp_path / "plan.npz").position, plan().pose[:, :3, 3])


def test_a_plan_with_nan_or_of_another_size_is_refused(tmp_path):
    broken = plan()
    broken.pose[4, 0, 3] = np.nan
    with pytest.raises(InvalidArgument, match=r"pose\[4, 0, 3\]: nan"):
        export.write_plan(tmp_path / "plan.npz", broken)
    broken = plan()
    broken.twist = broken.twist[1:]
    with pytest.raises(InvalidArgument, match=r"twist: shape \(20, 6\), expected \(21, 6\)"):
        export.write_plan(tmp_path / "plan.npz", broken)
    np.savez(tmp_path / "other.npz", time=TIME)
    with pytest.raises(InvalidArgument, match="no array 'pose'; it holds: time"):
        export.read_plan(tmp_path / "other.npz")
    assert names_in(tmp_path) == ["other.npz"]


def test_tum_poses_read_back(tmp_path):
    export.write_tum(tmp_path / "poses.tum", plan().time, plan().pose)
    read = recordings.load(tmp_path / "poses.tum")
    np.testing.assert_array_equal(read.time, TIME)
    np.testing.assert_array_equal(read.position, plan().pose[:, :3, 3])
    np.testing.assert_allclose(read.rotation, plan().pose[:, :3, :3], atol=1e-15)


def test_a_reflection_is_not_written_as_a_quaternion(tmp_path):
    pose = plan().pose
    pose[9, :3, :3] *= -1.0
    with pytest.raises(InvalidArgument, match=r"pose\[9\]: det\(R\) = -1\.000"):
        export.write_tum(tmp_path / "poses.tum", TIME, pose)


# ---------------------------------------------------------------- whole or not at all


def test_a_file_is_replaced_only_when_the_writer_ends_well(tmp_path):
    path = tmp_path / "a.txt"
    path.write_text("old")
    with pytest.raises(RuntimeError, match="half way"), atomic.replacing(path) as beside:
        beside.write_text("new, but only ha")
        raise RuntimeError("half way")
    assert path.read_text() == "old"
    assert names_in(tmp_path) == ["a.txt"]
    with atomic.replacing(path) as beside:
        assert beside.suffix == ".txt"
        beside.write_text("new")
    assert path.read_text() == "new"
    assert names_in(tmp_path) == ["a.txt"]


def test_a_new_file_gets_the_permissions_of_any_new_file(tmp_path):
    (tmp_path / "plain").write_text("")
    atomic.write_text(tmp_path / "atomic", "")
    assert (tmp_path / "atomic").stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("where", ["missing/a.csv", "file/a.csv", "folder"])
def test_a_place_that_cannot_be_written_is_a_file_error(tmp_path, where):
    (tmp_path / "file").write_text("")
    (tmp_path / "folder").mkdir()
    with pytest.raises(FileError, match="cannot be written"):
        atomic.write_text(tmp_path / where, "text")
    assert names_in(tmp_path) == ["file", "folder"]
