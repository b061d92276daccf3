"""Dialects of motion capture and ROS: what producers leave out, put beside, or write in another way."""

import struct

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.inspection import inspect
from scipy.spatial.transform import Rotation

from tests.python.test_c3d import made, parameter
from tests.python.test_ros import COUNT, POSITIONS, QUATERNIONS, STAMPS, Bag

# ---------------------------------------------------------------- ROS


def bag(path, message, received=None, topic="/hand"):
    writer = Bag(path, "sqlite3")
    with writer.writer:
        for k in range(COUNT):
            at = STAMPS[k] if received is None else received[k]
            writer.write(topic, message(writer, k), at)
    return path


def check(found, shift=0.0):
    np.testing.assert_allclose(found.position, POSITIONS + [0.0, shift, 0.0], atol=1e-12)
    turns = Rotation.from_quat(QUATERNIONS).as_matrix()
    np.testing.assert_allclose(found.rotation, turns, atol=1e-12)
    np.testing.assert_allclose(found.time, 1e-9 * (STAMPS - STAMPS[0]), atol=1e-9)


def test_header_stamps_that_are_all_equal_are_refused_with_those_of_receipt(tmp_path):
    def unstamped(writer, k):
        return writer.type("geometry_msgs/msg/PoseStamped")(header=writer.header(0), pose=writer.pose(k))

    path = bag(tmp_path / "a", unstamped)
    with pytest.raises(NotStated, match="all 12 header stamps are 0 ns. Specify times='received'"):
        recordings.load(path)
    check(recordings.load(path, times="received"))
    check(recordings.load(path, times="log"))
    assert recordings.load(path, rate=50.0).rate == pytest.approx(50.0)
    with pytest.raises(InvalidArgument, match="times: 'never'"):
        recordings.load(path, times="never")


def test_a_pose_without_a_stamp_is_read_by_its_receipt(tmp_path):
    path = bag(tmp_path / "a", lambda writer, k: writer.pose(k))
    with pytest.raises(NotStated, match="the messages have no stamps. Specify times='received'"):
        recordings.load(path)
    check(recordings.load(path, times="received"))


def test_poses_of_an_array_are_bodies(tmp_path):
    def several(writer, k):
        poses = [writer.pose(k) for _ in range(3)]
        for number, pose in enumerate(poses):
            pose.position.y += 0.1 * number
        return writer.type("geometry_msgs/msg/PoseArray")(header=writer.header(STAMPS[k]), poses=poses)

    path = bag(tmp_path / "a", several)
    assert recordings.bodies(path) == ("/hand[0]", "/hand[1]", "/hand[2]")
    check(recordings.load(path, "/hand[2]"), 0.2)


def test_an_empty_frame_is_that_of_the_other_messages_and_told(tmp_path):
    path = bag(tmp_path / "a", lambda writer, k: writer.pose_stamped(k, frame="" if k == 0 else "world"))
    found = recordings.load(path)
    check(found)
    assert any("1 of 12 messages have an empty frame_id" in note for note in found.history)
    two = bag(tmp_path / "b", lambda writer, k: writer.pose_stamped(k, frame="world" if k else "camera"))
    with pytest.raises(InvalidArgument, match="several frames: camera, world"):
        recordings.load(two)


# ---------------------------------------------------------------- C3D


def rewritten(path, points, names, extra=b"", analog=0, header_analog=None, frames=20, start=3):
    """Write floating point markers (T, M, 3) [mm] with more parameters, and analog values behind each frame."""
    order = "<"
    labels = "".join(name.ljust(8) for name in names).encode()
    section = bytes([1, 80, 2, 84]) + struct.pack("bb", 5, -1) + b"POINT" + struct.pack("<h", 3) + b"\0"
    section += parameter(1, "USED", 2, (), struct.pack("<h", len(names)), order)
    section += parameter(1, "RATE", 4, (), struct.pack("<f", 100.0), order)
    section += parameter(1, "UNITS", -1, (2,), b"mm", order)
    section += parameter(1, "DATA_START", 2, (), struct.pack("<h", start), order)
    section += parameter(1, "LABELS", -1, (8, len(names)), labels, order) + extra
    shown = analog if header_analog is None else header_analog
    header = bytes([2, 80]) + struct.pack("<5Hf", len(names), shown, 1, frames, 10, -1.0)
    header += struct.pack("<2Hf", 4, 5, 100.0)
    rows = np.concatenate([points, np.zeros((*points.shape[:2], 1))], axis=2).reshape(len(points), -1)
    rows = np.concatenate([rows, np.full((len(points), analog), 7.0)], axis=1)
    data = rows.astype("<f4").tobytes()
    path.write_bytes(header.ljust(512, b"\0") + section.ljust(1024, b"\0") + data)
    return path


def markers(count=20, number=3):
    time = 0.01 * np.arange(count)
    corners = np.array([[0, 0, 0], [80, 0, 0], [20, 60, 0], [40, 40, 40]])[:number]
    path = np.column_stack([300 + 100 * np.sin(3 * time), 200 * time, 900 + 0 * time])
    return path[:, None] + corners


ANALOG = (
    struct.pack("bb", 6, -2)
    + b"ANALOG"
    + struct.pack("<h", 3)
    + b"\0"
    + parameter(2, "USED", 2, (), struct.pack("<h", 2), "<")
    + parameter(2, "RATE", 4, (), struct.pack("<f", 500.0), "<")
)


def test_the_analog_count_is_the_one_that_fits_the_size_of_the_file(tmp_path):
    points = markers()
    right = recordings.markers(rewritten(tmp_path / "a.c3d", points, "abc", ANALOG, 10, start=4))
    found = recordings.markers(rewritten(tmp_path / "b.c3d", points, "abc", ANALOG, 10, header_analog=2, start=4))
    np.testing.assert_array_equal(found.position, right.position)
    np.testing.assert_allclose(found.position, 1e-3 * points, atol=1e-7)
    assert any("10 fits the file's size" in note for note in found.history)
    assert not any("analog" in note for note in right.history)


def test_a_data_start_of_zero_leaves_the_headers(tmp_path):
    found = recordings.markers(rewritten(tmp_path / "a.c3d", markers(), "abc", start=0))
    np.testing.assert_allclose(found.position, 1e-3 * markers(), atol=1e-7)


def test_model_outputs_among_the_points_are_no_markers(tmp_path):
    angles = parameter(1, "ANGLES", -1, (8, 1), b"knee    ", "<")
    found = recordings.markers(
        rewritten(tmp_path / "a.c3d", markers(number=4), ["a", "b", "c", "knee"], angles, start=4)
    )
    assert found.names == ("a", "b", "c")
    assert any("1 model outputs among the points left out: knee" in note for note in found.history)


def test_a_parameter_of_unknown_type_is_left_out(tmp_path):
    odd = parameter(1, "ODD", 9, (2,), b"xy", "<") + parameter(1, "DESC", -1, (1,), b"z", "<")
    found = recordings.markers(rewritten(tmp_path / "a.c3d", markers(), "abc", odd, start=4))
    assert found.names == ("a", "b", "c") and any("unknown type left out: ODD" in note for note in found.history)


def test_zeros_of_a_marker_are_lost_before_a_body_is_made_and_an_absent_one_is_left_out(tmp_path):
    points = markers(number=4)
    points[8:11, 1] = 0.0
    points[:, 3] = 0.0
    found = recordings.markers(rewritten(tmp_path / "a.c3d", points, "abcd", start=4))
    assert found.names == ("a", "b", "c")
    assert np.argwhere(found.missing).tolist() == [[8, 1], [9, 1], [10, 1]]
    body = recordings.load(tmp_path / "a.c3d", markers=["a", "b", "c"])
    assert np.flatnonzero(body.missing).tolist() == [8, 9, 10]


def test_a_person_who_walks_far_in_millimetres_is_not_asked_for_the_unit(tmp_path):
    points = markers() + np.linspace(0, 9000, 20)[:, None, None] * [1, 0, 0]
    np.testing.assert_allclose(
        recordings.markers(rewritten(tmp_path / "a.c3d", points, "abc", start=4)).position, 1e-3 * points, atol=1e-6
    )


def test_the_head_is_above_the_feet(tmp_path):
    points = markers(number=3)
    points[:, 0, 1] += 1700.0
    path = rewritten(tmp_path / "a.c3d", points, ["LFHD", "LTOE", "RANK"], start=4)
    assert recordings.markers(path).up_axis == "y"
    assert recordings.markers(path, up_axis="z").up_axis == "z"
    assert recordings.markers(made(tmp_path / "b.c3d")).up_axis == "z"


# ---------------------------------------------------------------- Vicon

TIME = 0.01 * np.arange(30)
TURN = Rotation.from_rotvec(np.column_stack([0.4 * np.sin(TIME), 0.3 + 0 * TIME, TIME]))
PLACE = np.column_stack([100 + 50 * np.sin(4 * TIME), 200 * TIME, 900 + 0 * TIME])


def vicon(path, unit="deg"):
    turn = np.degrees(TURN.as_rotvec()) if unit == "deg" else TURN.as_rotvec()
    lines = ["Segments", "100", ",,S:hand", "Frame,Sub Frame,RX,RY,RZ,TX,TY,TZ", f",,{unit},{unit},{unit},mm,mm,mm"]
    for k in range(len(TIME)):
        cells = [""] * 6 if k in (7, 8) else [repr(float(v)) for v in (*turn[k], *PLACE[k])]
        lines.append(",".join([str(k + 5), "0", *cells]))
    lines += ["", "Trajectories", "100", ",,S:a,,,S:b", "Frame,Sub Frame,X,Y,Z,X,Y,Z", ",,mm,mm,mm,mm,mm,mm"]
    lines += [f"{k + 5},0,{k},0,1,{k},50,1" for k in range(len(TIME))]
    path.write_text("\n".join(lines))
    return path


@pytest.mark.parametrize("unit", ["deg", "rad"])
def test_segments_of_vicon_are_bodies_once_their_rotation_is_named(tmp_path, unit):
    path = vicon(tmp_path / "a.csv", unit)
    assert recordings.bodies(path) == ("S:hand",)
    with pytest.raises(NotStated, match="rotation vector"):
        recordings.load(path)
    found = recordings.load(path, "hand", rotation="rotvec")
    there = ~found.missing
    assert np.flatnonzero(~there).tolist() == [7, 8]
    np.testing.assert_allclose(found.position[there], 1e-3 * PLACE[there], atol=1e-12)
    np.testing.assert_allclose(found.rotation[there], TURN.as_matrix()[there], atol=1e-12)
    assert inspect(path).markers_held == ("S:a", "S:b")


# ---------------------------------------------------------------- BVH

BVH = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 3 Xposition Yposition Zposition
  JOINT Head
  {
    OFFSET 0 60 0
    CHANNELS 1 Zrotation
    End Site
    {
      OFFSET 0 10 0
    }
  }
  JOINT LeftFoot
  {
    OFFSET 10 -90 0
    CHANNELS 1 Xrotation
    End Site
    {
      OFFSET 0 0 10
    }
  }
}
MOTION
Frames: 10
Frame Time: 0.01
"""
ROWS = np.column_stack([np.arange(10), 0.5 * np.arange(10), 2.0 * np.arange(10), 3.0 * np.arange(10), np.zeros(10)])


def bvh(path, text=BVH, wrap=0, end="\n"):
    rows = [[repr(float(v)) for v in row] for row in ROWS]
    lines = [" ".join(row) if not wrap else "\n".join((" ".join(row[:wrap]), " ".join(row[wrap:]))) for row in rows]
    path.write_bytes((text + "\n".join(lines) + "\n").replace("\n", end).encode())
    return path


@pytest.mark.parametrize(
    "how",
    [
        {"wrap": 2},
        {"end": "\r"},
        {"end": "\r\n"},
        {"text": BVH.replace("End Site", "END SITE")},
        {"text": BVH.replace("MOTION", "Motion").replace("HIERARCHY", "Hierarchy")},
    ],
)
def test_dialects_of_bvh_read_alike(tmp_path, how):
    plain = recordings.load(bvh(tmp_path / "a.bvh"), "Head", unit="cm")
    other = recordings.load(bvh(tmp_path / "b.bvh", **how), "Head", unit="cm")
    np.testing.assert_array_equal(plain.position, other.position)
    np.testing.assert_array_equal(plain.rotation, other.rotation)


def test_the_up_axis_of_a_bvh_is_found_from_head_and_feet_or_told(tmp_path):
    found = recordings.load(bvh(tmp_path / "a.bvh"), "Head", unit="cm")
    assert found.up_axis == "y" and any("the head is above the feet" in note for note in found.history)
    lifted = BVH.replace("0 60 0", "0 0 60").replace("10 -90 0", "10 0 -90")
    assert recordings.load(bvh(tmp_path / "b.bvh", lifted), "Head", unit="cm").up_axis == "z"
    nameless = BVH.replace("Head", "A").replace("LeftFoot", "B")
    report = inspect(bvh(tmp_path / "c.bvh", nameless), "A", unit="cm")
    assert report.assumed["up_axis"].startswith("y, as in most BVH files")
    assert recordings.load(tmp_path / "c.bvh", "A", unit="cm", up_axis="z").up_axis == "z"


# ---------------------------------------------------------------- Aria


def test_the_glasses_know_their_up_axis_by_gravity_and_not_the_globe(tmp_path):
    names = ["tracking_timestamp_us"]
    names += [
        f"{what}_{of}" for of in ("world_device", "ecef_device") for what in ("tx", "ty", "tz", "qx", "qy", "qz", "qw")
    ]
    names += [f"gravity_{axis}_world" for axis in "xyz"]
    rows = [
        [10_000 * k, 0.1 * np.sin(0.1 * k), 0.01 * k, 1.0, 0, 0, 0, 1, 6e6, 1e5, 1e6 + k, 0, 0, 0, 1, 0, 0, -9.81]
        for k in range(20)
    ]
    path = tmp_path / "a.csv"
    path.write_text("\n".join([",".join(names), *(",".join(map(str, row)) for row in rows)]))
    assert recordings.bodies(path) == ("device",)
    assert recordings.load(path).up_axis == "z"


def test_wrists_of_the_first_aria_format_are_positions(tmp_path):
    names = ["tracking_timestamp_us", "left_tracking_confidence", *(f"t{axis}_left_wrist_device" for axis in "xyz")]
    rows = [[20_000 * k, 0.9 if k != 5 else -1, 0.1 + 0.01 * k, 0.02 * k, 0.3] for k in range(20)]
    rows[5][2:] = [0, 0, 0]
    path = tmp_path / "a.csv"
    path.write_text("\n".join([",".join(names), *(",".join(map(str, row)) for row in rows)]))
    with pytest.raises(NotStated, match="fixed_orientation"):
        recordings.load(path)
    found = recordings.load(path, "left_wrist", fixed_orientation=True)
    assert np.flatnonzero(found.missing).tolist() == [5] and found.rate == pytest.approx(50.0)


# ---------------------------------------------------------------- DeepLabCut


def test_three_lines_of_names_are_one(tmp_path):
    lines = ["scorer" + 6 * ",net", "bodyparts" + 3 * ",wrist" + 3 * ",elbow", "coords,x,y,z,x,y,z"]
    rows = np.column_stack([np.arange(20), 0.01 * np.arange(120).reshape(20, 6)])
    path = tmp_path / "a.csv"
    path.write_text("\n".join([*lines, *(",".join(map(repr, map(float, row))) for row in rows)]))
    with pytest.raises(NotStated, match="DeepLabCut or Anipose"):
        recordings.load(path)
    found = recordings.markers(path, rate=30.0)
    assert found.names == ("wrist", "elbow")
    np.testing.assert_allclose(found.position[:, 1], rows[:, 4:7])


def test_a_table_of_hot3d_says_that_its_up_axis_is_open(tmp_path):
    axes = [f"t_wo_{axis}[m]" for axis in "xyz"] + [f"q_wo_{axis}" for axis in "wxyz"]
    rows = [f"1,{33_000_000 * k},{0.01 * k},0.2,1.1,1,0,0,0" for k in range(20)]
    path = tmp_path / "headset_trajectory.csv"
    path.write_text("\n".join([f"object_uid,timestamp[ns],{','.join(axes)}", *rows]))
    told = [note for note in recordings.load(path).history if note.about == "up_axis"]
    assert told == ["taken: up_axis: z, which no file states; recordings of Quest 3 have y up"]
    assert not [note for note in recordings.load(path, up_axis="y").history if note.about == "up_axis"]


def test_a_trc_whose_first_line_has_blanks_in_place_of_tabs_is_read(tmp_path):
    head = ["PathFileType    4   (X/Y/Z) a.trc", "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t\t"]
    head += ["100\t100\t20\t1\tmm\t\t", "Frame#\tTime\tWRIST\t\t\t", "\t\tX1\tY1\tZ1  "]
    rows = [f"{k}\t{0.01 * k}\t{10 * k}\t5\t7" for k in range(20)]
    path = tmp_path / "a.trc"
    path.write_text("\r\n".join([*head, *rows]))
    found = recordings.markers(path)
    np.testing.assert_allclose(found.position[:, 0, 0], [0.01 * k for k in range(20)], atol=1e-12)


def test_a_table_of_the_glasses_without_hands_says_so(tmp_path):
    path = tmp_path / "eye_gaze.csv"
    rows = [f"{100_000 * k},0.1,0.2,0.0315,0,0" for k in range(20)]
    path.write_text(
        "\n".join(["tracking_timestamp_us,yaw,pitch,tx_left_eye_cpf,ty_left_eye_cpf,tz_left_eye_cpf", *rows])
    )
    with pytest.raises(InvalidArgument, match="no landmarks, and no wrists: it is no trajectory of hands"):
        recordings.markers(path)
