"""Every representation of a rotation, for columns and arrays alike: what names say, what is asked, what is refused."""

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument, NotStated
from scipy.spatial.transform import Rotation

COUNT = 60
TIME = 0.02 * np.arange(COUNT)
POSITION = np.column_stack([0.3 + 0.1 * np.sin(TIME), 0.2 * TIME, 0.9 - 0.1 * TIME])
TURN = Rotation.from_rotvec(np.column_stack([0.3 * np.sin(TIME), 0.5 * TIME, 0.4 * np.cos(TIME)]))
MATRIX = TURN.as_matrix()
NUMBERS = {
    "quat_xyzw": TURN.as_quat(),
    "quat_wxyz": TURN.as_quat(scalar_first=True),
    "rotvec": TURN.as_rotvec(),
    "rot6d": MATRIX[:, :2].reshape(COUNT, 6),
    "rot6d_columns": np.swapaxes(MATRIX[:, :, :2], 1, 2).reshape(COUNT, 6),
    "mat9": MATRIX.reshape(COUNT, 9),
}


def check(found):
    np.testing.assert_allclose(found.position, POSITION, atol=1e-12)
    np.testing.assert_allclose(found.rotation, MATRIX, atol=1e-9)


def write(path, names, columns, delimiter=","):
    rows = [delimiter.join(repr(float(v)) for v in row) for row in np.column_stack(columns)]
    path.write_text("\n".join(([delimiter.join(names)] if names else []) + rows))
    return path


@pytest.mark.parametrize("kind", NUMBERS)
@pytest.mark.parametrize("suffix", [".csv", ".npy"])
def test_a_layout_says_what_columns_without_names_hold(tmp_path, kind, suffix):
    path = tmp_path / f"a{suffix}"
    columns = [POSITION, NUMBERS[kind], np.linspace(0, 1, COUNT)]
    if suffix == ".csv":
        write(path, [], columns)
    else:
        np.save(path, np.column_stack(columns))
    found = recordings.load(path, rate=50.0, layout=f"x,y,z,{kind},gripper")
    check(found)
    np.testing.assert_allclose(found.channels["gripper"], np.linspace(0, 1, COUNT))
    with pytest.raises(NotStated, match="layout"):
        recordings.load(path, rate=50.0)


def test_matrices_row_by_row_are_read_by_their_layout(tmp_path):
    poses = np.tile(np.eye(4), (COUNT, 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = MATRIX, POSITION
    flat = poses.reshape(COUNT, 16)
    check(recordings.load(write(tmp_path / "a.csv", [], [TIME, flat]), layout="time,mat16"))
    check(recordings.load(write(tmp_path / "b.txt", [], [flat[:, :12]], " "), rate=50.0))
    with pytest.raises(NotStated, match="4 x 4 matrix, row by row: layout='time,mat16'"):
        recordings.load(tmp_path / "a.csv")
    transposed = np.swapaxes(poses, 1, 2).reshape(COUNT, 16)
    with pytest.raises(InvalidArgument, match="last row"):
        recordings.load(write(tmp_path / "c.csv", [], [transposed]), layout="mat16", rate=50.0)


@pytest.mark.parametrize(
    ("names", "kind", "stated"),
    [
        (["q0", "q1", "q2", "q3"], "quat_wxyz", {"quat_order": "wxyz"}),
        (["q0", "q1", "q2", "q3"], "quat_xyzw", {"rotation": "quat_xyzw"}),
        (["rx", "ry", "rz"], "rotvec", {"euler_order": "rotvec"}),
        (["roll", "pitch", "yaw"], "rotvec", {"rotation": "rotvec", "angle_unit": "rad"}),
        (["axis_angle_x", "axis_angle_y", "axis_angle_z"], "rotvec", {}),
        (["rotvec_0", "rotvec_1", "rotvec_2"], "rotvec", {}),
        ([f"rot6d_{k}" for k in range(6)], "rot6d", {"rotation": "rot6d"}),
        ([f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)], "mat9", {}),
        ([f"m{i}{j}" for i in range(3) for j in range(3)], "mat9", {}),
    ],
)
def test_names_say_what_they_can_and_the_rest_is_asked(tmp_path, names, kind, stated):
    path = write(tmp_path / "a.csv", ["time", "x", "y", "z", *names], [TIME, POSITION, NUMBERS[kind]])
    check(recordings.load(path, **stated))
    if stated:
        with pytest.raises(NotStated) as error:
            recordings.load(path)
        assert "fixed_orientation" not in str(error.value)


def test_three_numbers_whose_length_stays_at_half_a_turn_are_called_a_rotation_vector(tmp_path):
    down = (TURN * Rotation.from_rotvec([3.0, 0.9, 0.0])).as_rotvec()
    down[np.linalg.norm(down, axis=1) < 0.1] = 0.0
    path = write(
        tmp_path / "a.csv",
        ["time", "x", "y", "z", "rx", "ry", "rz"],
        [TIME, POSITION, 0.1 * TURN.as_rotvec() + [0, np.pi, 0]],
    )
    found = recordings.load(path, euler_order="xyz", angle_unit="rad")
    assert any("look like a rotation vector" in note for note in found.history)
    plain = write(tmp_path / "b.csv", ["time", "x", "y", "z", "rx", "ry", "rz"], [TIME, POSITION, NUMBERS["rotvec"]])
    assert not any(
        "rotation vector" in note for note in recordings.load(plain, euler_order="xyz", angle_unit="rad").history
    )


def test_a_rotation_vector_of_more_than_a_turn_is_asked_about(tmp_path):
    path = write(
        tmp_path / "a.csv", ["time", "x", "y", "z", "rx", "ry", "rz"], [TIME, POSITION, np.degrees(NUMBERS["rotvec"])]
    )
    with pytest.raises(NotStated, match="angle_unit='deg'"):
        recordings.load(path, rotation="rotvec")
    check(recordings.load(path, rotation="rotvec", angle_unit="deg"))


@pytest.mark.parametrize("last", [1.0, 0.97])
def test_angles_and_a_gripper_are_no_quaternion(tmp_path, last):
    np.save(
        tmp_path / "a.npy", np.column_stack([POSITION, 0.3 * np.sin(np.outer(TIME, [1, 2, 3])), np.full(COUNT, last)])
    )
    with pytest.raises(InvalidArgument, match="norm ranges from .* gripper"):
        recordings.load(tmp_path / "a.npy", rate=50.0, quat_order="xyzw")


@pytest.mark.parametrize("decimals", [2, 3, 4])
def test_printed_decimals_are_no_spread_of_the_norm(tmp_path, decimals):
    write(
        tmp_path / "a.csv",
        ["time", *"xyz", "qx", "qy", "qz", "qw"],
        [TIME, POSITION, NUMBERS["quat_xyzw"].round(decimals)],
    )
    assert len(recordings.load(tmp_path / "a.csv")) == COUNT


def test_a_first_column_that_is_no_clock_is_not_taken_for_the_time(tmp_path):
    np.save(
        tmp_path / "a.npy", np.column_stack([POSITION[:, 2], POSITION[:, :2], NUMBERS["quat_xyzw"], np.ones(COUNT)])
    )
    with pytest.raises(NotStated, match="does not increase in even steps"):
        recordings.load(tmp_path / "a.npy", rate=50.0, quat_order="xyzw")


def test_named_arrays_are_bodies(tmp_path):
    poses = np.tile(np.eye(4), (COUNT, 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = MATRIX, POSITION
    other = poses.copy()
    other[:, 0, 3] += 0.5
    np.savez(tmp_path / "a.npz", right_wrist=poses[:, None], head=other, timestamps=TIME)
    assert recordings.bodies(tmp_path / "a.npz") == ("right_wrist", "head")
    check(recordings.load(tmp_path / "a.npz", "right_wrist"))
    check(recordings.load(tmp_path / "a.npz", dataset="right_wrist"))
    np.savez(
        tmp_path / "b.npz",
        robot0_eef_pos=POSITION,
        robot0_eef_rot_axis_angle=NUMBERS["rotvec"],
        timestamp=TIME,
        action=np.ones((COUNT, 7)),
    )
    check(recordings.load(tmp_path / "b.npz"))
    np.savez(tmp_path / "c.npz", where=POSITION, turn=NUMBERS["quat_wxyz"], time=TIME)
    check(recordings.load(tmp_path / "c.npz", dataset="where,turn", quat_order="wxyz"))
    with pytest.raises(InvalidArgument, match="dataset: no array 'foot'. The file holds: where"):
        recordings.load(tmp_path / "c.npz", dataset="foot")


def test_a_body_model_says_what_it_lacks(tmp_path):
    np.savez(tmp_path / "a.npz", trans=POSITION, poses=np.zeros((COUNT, 156)), mocap_framerate=60.0)
    with pytest.raises(InvalidArgument, match="AMASS.*rest joints"):
        recordings.load(tmp_path / "a.npz")


def test_a_rotation_that_contradicts_itself_or_is_none_is_refused(tmp_path):
    path = write(tmp_path / "a.csv", ["time", "x", "y", "z", "rx", "ry", "rz"], [TIME, POSITION, NUMBERS["rotvec"]])
    with pytest.raises(InvalidArgument, match="rotation: 'upside'"):
        recordings.load(path, rotation="upside")
    with pytest.raises(InvalidArgument, match="rotation, euler_order"):
        recordings.load(path, rotation="rotvec", euler_order="ZYX")
    with pytest.raises(InvalidArgument, match="stands twice"):
        recordings.load(path, layout="x,y,x")
