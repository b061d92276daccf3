"""Tables as laboratories write them: names, units, delimiters, decimal commas, comments, lost samples, times."""

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import recordings
from dmpcpp.cli import main
from dmpcpp.cli._flags import in_flags
from dmpcpp.cli._recording_options import NAMES
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._columns import Column, column
from scipy.spatial.transform import Rotation

TIMES = np.arange(12) / 10
POSITIONS = np.column_stack([0.3 + 0.02 * np.arange(12), 0.1 + 0.1 * np.sin(TIMES), 0.2 * np.cos(TIMES)])
TURNS = Rotation.from_rotvec(np.outer(TIMES, [0.2, -0.1, 0.3]))
XYZW = TURNS.as_quat()
ROWS = np.column_stack([TIMES, POSITIONS, XYZW])
HEADER = ["time", "x", "y", "z", "qx", "qy", "qz", "qw"]


def write(path, rows=ROWS, header=HEADER, delimiter=",", end="\n", above=""):
    lines = [delimiter.join(header)] if header else []
    lines += [delimiter.join(repr(float(cell)) for cell in row) for row in rows]
    path.write_bytes((above + end.join(lines) + end).encode())
    return path


def assert_same_motion(recording):
    np.testing.assert_allclose(recording.time, TIMES, atol=1e-9)
    np.testing.assert_allclose(recording.position, POSITIONS, atol=1e-9)
    np.testing.assert_allclose(recording.rotation, TURNS.as_matrix(), atol=1e-9)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("Time (s)", Column("time", unit="s")),
        ("timestamp [ns]", Column("time", unit="ns")),
        ("time_ms", Column("time", unit="ms")),
        ("tx", Column("x")),
        ("Pos_Y", Column("y")),
        ("Position X (mm)", Column("x", unit="mm")),
        ("hand_z", Column("z", "hand")),
        ("RightHand.position.x", Column("x", "RightHand")),
        ("/hand/pose/orientation/w", Column("qw", "/hand/pose")),
        ("Quat W", Column("qw")),
        ("rot_x", Column("qx")),
        ("q_RS_w []", None),
        ("Yaw [deg]", Column("rz", unit="deg")),
        ("hand:ry", Column("ry", "hand")),
        ("手_qx", Column("qx", "手")),
        ("vx", None),
        ("Mean Marker Error", None),
        ("x" * 1000, None),
    ],
)
def test_a_columns_name_says_quantity_body_and_unit(name, said):
    assert column(name) == said or (said is None and column(name).body not in ("pose", "hand"))


@pytest.mark.parametrize(
    "header",
    [
        ["t", "pos_x", "pos_y", "pos_z", "q_x", "q_y", "q_z", "q_w"],
        ["Time", "Position X", "Position Y", "Position Z", "Rotation X", "Rotation Y", "Rotation Z", "Rotation W"],
        ["timestamp", "px", "py", "pz", "quat.x", "quat.y", "quat.z", "quat.w"],
        ["%time", *(f"field.pose.position.{a}" for a in "xyz"), *(f"field.pose.orientation.{a}" for a in "xyzw")],
    ],
)
def test_the_usual_names_of_columns_are_found(tmp_path, header):
    assert_same_motion(recordings.load(write(tmp_path / "a.csv", header=header)))


def test_a_unit_in_the_names_of_columns_is_taken_and_the_callers_word_wins(tmp_path):
    header = ["time [ms]", "x [mm]", "y [mm]", "z [mm]", *HEADER[4:]]
    path = write(tmp_path / "a.csv", ROWS * [1000.0, 1000.0, 1000.0, 1000.0, 1, 1, 1, 1], header)
    recording = recordings.load(path)
    assert_same_motion(recording)
    assert {"positions converted from mm to m", "times converted from ms to s"} <= set(recording.history)
    assert recordings.load(path, unit=0.01).position[0, 0] == pytest.approx(3.0)
    by_name = dict(zip(HEADER, header, strict=True))
    assert_same_motion(recordings.load(path, columns=by_name))
    mixed = write(tmp_path / "b.csv", header=["time", "x [mm]", "y [cm]", "z [mm]", *HEADER[4:]])
    with pytest.raises(NotStated, match="unit: the columns say cm and mm"):
        recordings.load(mixed)


def test_a_line_of_units_below_the_names_is_taken(tmp_path):
    path = write(tmp_path / "a.csv", ROWS * [1.0, 1000.0, 1000.0, 1000.0, 1, 1, 1, 1])
    lines = path.read_text().splitlines()
    path.write_text("\n".join([lines[0], "[s],[mm],[mm],[mm],,,,", *lines[1:]]))
    assert_same_motion(recordings.load(path))
    assert_same_motion(recordings.load(path, columns={name: name for name in HEADER}))


def test_angles_are_found_by_name_and_their_unit_in_it(tmp_path):
    angles = TURNS.as_euler("ZYX", degrees=True)[:, ::-1]
    header = ["time", "x", "y", "z", "roll (deg)", "pitch (deg)", "yaw (deg)"]
    path = write(tmp_path / "a.csv", np.column_stack([TIMES, POSITIONS, angles]), header)
    with pytest.raises(NotStated, match="euler_order"):
        recordings.load(path)
    assert_same_motion(recordings.load(path, euler_order="ZYX"))


def test_degrees_that_pass_for_radians_are_refused(tmp_path):
    angles = np.column_stack([5.0 * np.arange(12), 0.0 * TIMES, 0.0 * TIMES])
    path = write(tmp_path / "a.csv", np.column_stack([TIMES, POSITIONS, angles]), [*HEADER[:4], "rx", "ry", "rz"])
    with pytest.raises(InvalidArgument, match="rx ranges over 55 rad, more than four turns. Are these degrees"):
        recordings.load(path, euler_order="ZYX", angle_unit="rad")
    assert len(recordings.load(path, euler_order="ZYX", angle_unit="deg")) == 12


@pytest.mark.parametrize("delimiter", [";", "\t", " "])
def test_decimal_commas_are_read_where_the_comma_parts_no_cells(tmp_path, delimiter):
    path = write(tmp_path / "a.csv", delimiter=delimiter)
    path.write_text(path.read_text().replace(".", ","))
    recording = recordings.load(path)
    assert_same_motion(recording)
    assert "decimal commas read as points" in recording.history


def test_a_comma_between_thousands_is_no_decimal_comma(tmp_path):
    path = write(tmp_path / "a.csv", delimiter=";")
    lines = path.read_text().splitlines()
    lines[3] = lines[3].replace(repr(float(POSITIONS[2, 0])), "1,234.5")
    path.write_text("\n".join(lines))
    with pytest.raises(InvalidArgument, match="line 4, column 'x': '1,234.5', expected a number"):
        recordings.load(path)


@pytest.mark.parametrize("name", ["a.txt", "a.dat", "a"])
@pytest.mark.parametrize("delimiter", [",", ";", "\t", "  "])
def test_a_table_is_told_by_its_names_whatever_the_file_is_called(tmp_path, name, delimiter):
    assert_same_motion(recordings.load(write(tmp_path / name, delimiter=delimiter, end="\r\n", above="\ufeff")))


def test_names_in_a_comment_as_numpy_writes_them_count(tmp_path):
    wxyz = ROWS[:, [0, 1, 2, 3, 7, 4, 5, 6]]
    np.savetxt(tmp_path / "a.txt", wxyz, header="t x y z qw qx qy qz")  # would read as TUM without its names
    assert recordings.format_of(tmp_path / "a.txt") == "table"
    assert_same_motion(recordings.load(tmp_path / "a.txt"))
    np.savetxt(tmp_path / "b.csv", ROWS, delimiter=",", header="by hand\n" + ",".join(HEADER), comments="% ")
    assert_same_motion(recordings.load(tmp_path / "b.csv"))


def test_a_tum_file_stays_one_with_a_byte_order_mark_and_with_lost_samples(tmp_path):
    path = write(tmp_path / "a.txt", header=[], delimiter=" ", end="\r\n", above="\ufeff")
    assert recordings.format_of(path) == "tum"
    assert_same_motion(recordings.load(path))
    lost = ROWS.copy()
    lost[3, 1:] = np.nan
    path = write(tmp_path / "b.txt", lost, ["# timestamp tx ty tz qx qy qz qw"], " ")
    assert recordings.format_of(path) == "tum"
    with pytest.raises(InvalidArgument, match="line 5, tx: nan.*state missing='nan'"):
        recordings.load(path)
    assert np.flatnonzero(recordings.load(path, missing="nan").missing).tolist() == [3]


def test_numbers_without_names_are_to_be_named_by_number(tmp_path):
    rows = ROWS[:, [1, 2, 3, 4, 5, 6, 7, 0]]
    with pytest.raises(NotStated, match="line 1: 8 numbers and no line above that names them. Specify what each"):
        recordings.load(write(tmp_path / "a.csv", rows, header=[]))
    with pytest.raises(NotStated, match="cannot be recognised. It looks like a table of 8 columns: state columns="):
        recordings.load(write(tmp_path / "a.txt", rows, header=[]))
    columns = {name: (place + 7) % 8 for place, name in enumerate(HEADER)}
    assert_same_motion(recordings.load(tmp_path / "a.txt", columns=columns))
    assert_same_motion(recordings.load(tmp_path / "a.csv", layout="x,y,z,quat_xyzw,time"))


@pytest.mark.parametrize(("cell", "missing"), [("NA", "na"), ("null", "null"), ("", "empty"), ("nan", "nan")])
def test_an_error_about_a_cell_says_how_a_lost_sample_is_stated(tmp_path, cell, missing):
    path = write(tmp_path / "a.csv")
    lines = path.read_text().splitlines()
    lines[5] = ",".join([lines[5].split(",")[0], *[cell] * 7])
    path.write_text("\n".join(lines))
    with pytest.raises(InvalidArgument, match=f"line 6, column 'x': .*state missing='{missing}'"):
        recordings.load(path)
    assert np.flatnonzero(recordings.load(path, missing=missing).missing).tolist() == [4]


@pytest.mark.parametrize("mark", [0.0, -9999.0])
def test_a_number_in_all_of_a_pose_is_asked_about(tmp_path, mark):
    rows = ROWS.copy()
    rows[4, 1:] = mark
    path = write(tmp_path / "a.csv", rows)
    with pytest.raises(InvalidArgument, match=f"line 6: {mark:g} in every column of the pose.*state missing={mark:g}"):
        recordings.load(path)
    assert np.flatnonzero(recordings.load(path, missing=mark).missing).tolist() == [4]


def test_samples_at_the_very_origin_are_lost_and_a_motion_from_it_is_not(tmp_path):
    rows = ROWS.copy()
    rows[4:6, 1:] = [0, 0, 0, 0, 0, 0, 1]
    path = write(tmp_path / "a.csv", rows)
    found = recordings.load(path)
    assert np.flatnonzero(found.missing).tolist() == [4, 5]
    assert any("2 samples of exactly 0, 0, 0 taken as lost (samples 4 to 5)" in note for note in found.history)
    assert np.flatnonzero(recordings.load(path, missing=0).missing).tolist() == [4, 5]
    assert len(recordings.load(path, missing="nan").time) == 12  # it is where it was
    rows = ROWS.copy()
    rows[:, 1:4] -= rows[0, 1:4]
    assert len(recordings.load(write(tmp_path / "b.csv", rows))) == 12


def test_times_that_are_no_numbers_or_have_another_name_ask_for_the_rate(tmp_path):
    path = write(tmp_path / "a.csv", header=["Zeit", *HEADER[1:]])
    with pytest.raises(NotStated, match=r"no column of \[Zeit, .*is called time.*rate=100, or which it is: columns="):
        recordings.load(path)
    assert_same_motion(recordings.load(path, rate=10.0))
    path = write(tmp_path / "b.csv")
    lines = path.read_text().splitlines()
    path.write_text("\n".join([lines[0], "10:00:00.0" + lines[1][3:], *lines[2:]]))
    with pytest.raises(InvalidArgument, match="line 2, column 'time': '10:00:00.0'.*state the sampling rate in Hz"):
        recordings.load(path)


def test_a_sample_written_twice_counts_once(tmp_path):
    recording = recordings.load(write(tmp_path / "a.csv", np.repeat(ROWS, 2, axis=0)))
    assert_same_motion(recording)
    assert "12 samples that were written twice left out (the first: 1)" in recording.history


def test_times_that_do_not_increase_are_refused_unless_they_may_be_sorted(tmp_path):
    path = write(tmp_path / "a.csv", ROWS[::-1])
    with pytest.raises(InvalidArgument, match=r"time\[1\]: 1 after 1.1, expected strictly increasing.*sort_times=True"):
        recordings.load(path)
    recording = recordings.load(path, sort_times=True)
    assert_same_motion(recording)
    assert "samples sorted by their times, 11 steps back in time" in recording.history
    again = ROWS[:, :].copy()
    again[5, 0] = again[4, 0]  # another pose at the same time
    path = write(tmp_path / "b.csv", again)
    with pytest.raises(InvalidArgument, match=r"time\[5\]: 0.4 after 0.4"):
        recordings.load(path)
    corrected = recordings.load(path, sort_times=True)
    assert len(corrected) == 11
    np.testing.assert_allclose(corrected.position[4], POSITIONS[4])
    assert "1 samples at the time of another left out" in corrected.history


def test_times_whose_digits_were_cut_off_are_recognised(tmp_path):
    rows = ROWS.copy()
    rows[:, 0] = np.floor(rows[:, 0])
    path = write(tmp_path / "a.csv", rows)
    with pytest.raises(InvalidArgument, match="Were digits of the times cut off"):
        recordings.load(path)
    assert_same_motion(recordings.load(path, rate=10.0))


@pytest.mark.parametrize("factor", [1e3 / 100, 1 / 6.0])
def test_steps_that_no_recording_system_makes_are_refused(tmp_path, factor):
    rows = ROWS.copy()
    rows[:, 0] *= factor if factor > 1.0 else factor / 100  # 1 kHz in ms; 100 Hz in minutes
    with pytest.raises(InvalidArgument, match="s between samples, expected 0.0002 to 0.4 s"):
        recordings.load(write(tmp_path / "a.csv", rows))


def test_inches_are_a_unit(tmp_path):
    path = write(tmp_path / "a.csv", ROWS / [1, 0.0254, 0.0254, 0.0254, 1, 1, 1, 1])
    assert_same_motion(recordings.load(path, unit="in"))


def test_positions_without_orientations_are_taken_once_it_is_stated(tmp_path):
    path = write(tmp_path / "a.csv", ROWS[:, :4], HEADER[:4])
    with pytest.raises(NotStated, match="a position and no orientation.*fixed_orientation=True") as refused:
        recordings.load(path)
    assert refused.value.names == ("fixed_orientation", "columns")
    with pytest.raises(NotStated, match="fixed_orientation"):
        recordings.load(path, columns={name: name for name in HEADER[:4]})
    for stated in ({}, {"columns": {name: name for name in HEADER[:4]}}):
        recording = recordings.load(path, fixed_orientation=True, **stated)
        np.testing.assert_allclose(recording.position, POSITIONS, atol=1e-12)
        np.testing.assert_array_equal(recording.rotation, np.tile(np.eye(3), (12, 1, 1)))
        assert "no orientation recorded: held fixed, as stated" in recording.history


def test_utf_16_is_refused_with_what_to_do(tmp_path):
    (tmp_path / "a.csv").write_text(write(tmp_path / "b.csv").read_text(), encoding="utf-16")
    with pytest.raises(InvalidArgument, match="UTF-16 text, expected UTF-8. Save the file as UTF-8"):
        recordings.load(tmp_path / "a.csv")


# ---------------------------------------------------------------- arrays and markers


def test_a_npz_may_hold_positions_beside_orientations(tmp_path):
    np.savez(tmp_path / "a.npz", time=TIMES, position=POSITIONS, quaternion=XYZW)
    with pytest.raises(NotStated, match="quat_order"):
        recordings.load(tmp_path / "a.npz")
    assert_same_motion(recordings.load(tmp_path / "a.npz", quat_order="xyzw"))
    np.savez(tmp_path / "b.npz", timestamps=TIMES, positions=POSITIONS, rotations=TURNS.as_matrix())
    assert_same_motion(recordings.load(tmp_path / "b.npz"))


def test_an_array_of_positions_needs_the_word_that_the_orientation_is_fixed(tmp_path):
    np.save(tmp_path / "a.npy", POSITIONS)
    with pytest.raises(NotStated, match=r"an array of shape \(12, 3\): a position and no orientation"):
        recordings.load(tmp_path / "a.npy", rate=10.0)
    recording = recordings.load(tmp_path / "a.npy", rate=10.0, fixed_orientation=True)
    np.testing.assert_array_equal(recording.position, POSITIONS)


def vicon(path, names):
    """Write markers 3 cm apart on the moving body as Vicon Nexus does, in mm."""
    corners = 0.03 * np.eye(4)[: len(names), :3]
    points = 1e3 * (POSITIONS[:, None] + np.einsum("tij,mj->tmi", TURNS.as_matrix(), corners))
    lines = ["Trajectories", "10", ",," + "".join(f"{name},,," for name in names)]
    lines += ["Frame,Sub Frame" + ",X,Y,Z" * len(names), "," + ",mm,mm,mm" * len(names)]
    lines += [",".join([str(k + 1), "0", *map(repr, map(float, row.ravel()))]) for k, row in enumerate(points)]
    path.write_text("\n".join(lines) + "\n")
    return path


def test_a_marker_may_be_named_without_its_subject_where_one_ends_so(tmp_path):
    path = vicon(tmp_path / "a.csv", ["Anna:WRIST", "Anna:ELBOW", "Anna:HAND", "Ben:HAND"])
    recording = recordings.load(path, markers=["WRIST", "ELBOW", "Anna:HAND"])
    assert recording.body == "Anna:WRIST+Anna:ELBOW+Anna:HAND"
    with pytest.raises(InvalidArgument, match="no marker 'HAND'"):  # two end so
        recordings.load(path, markers=["WRIST", "ELBOW", "HAND"])


def test_one_marker_is_a_motion_once_its_orientation_is_stated_to_be_fixed(tmp_path):
    path = vicon(tmp_path / "a.csv", ["Anna:WRIST", "Anna:ELBOW", "Anna:HAND"])
    with pytest.raises(InvalidArgument, match="three or more that differ, or one with fixed_orientation=True"):
        recordings.load(path, markers=["WRIST"])
    recording = recordings.load(path, markers=["WRIST"], fixed_orientation=True)
    np.testing.assert_allclose(recording.position, POSITIONS + 0.03 * TURNS.as_matrix()[:, :, 0], atol=1e-12)
    np.testing.assert_array_equal(recording.rotation, np.tile(np.eye(3), (12, 1, 1)))


# ---------------------------------------------------------------- the command line


@pytest.mark.parametrize(
    ("library", "command"),
    [
        ("State unit='cm', 'm' or a number.", "State --unit cm, 'm' or a number."),
        ("state missing=-9999.", "state --missing -9999."),
        ("State sort_times=True to sort", "State --sort-times to sort"),
        ("columns={'time': 0, 'x': 1, ..., 'qw': 7}.", "--columns time=0,x=1,...,qw=7."),
        ("one rigid body, markers=['a', 'b'].", "one rigid body, --markers a,b."),
        ("other=3, rated=5", "other=3, rated=5"),
    ],
)
def test_messages_name_the_options_of_the_command_line(library, command):
    assert in_flags(library, NAMES) == command


def test_a_message_keeps_what_is_no_option_of_the_command():
    assert in_flags("State rate=100 or unit='m'", {"unit"}) == "State rate=100 or --unit m"


def test_the_commands_take_what_tables_need_stated(tmp_path):
    path = write(tmp_path / "a.csv", ROWS[::-1, :4], HEADER[:4])
    runner = CliRunner()
    refused = runner.invoke(main, ["inspect", str(path)])
    assert refused.exit_code == 3 and "--fixed-orientation" in refused.output
    refused = runner.invoke(main, ["inspect", str(path), "--fixed-orientation"])
    assert refused.exit_code == 2 and "Specify --sort-times" in refused.output
    assert runner.invoke(main, ["inspect", str(path), "--fixed-orientation", "--sort-times"]).exit_code == 0


def test_mend_times_is_the_old_name_of_sort_times(tmp_path):
    path = write(tmp_path / "a.csv", ROWS[::-1, :4], HEADER[:4])
    with pytest.warns(DeprecationWarning, match="sort_times now"):
        old = recordings.load(path, fixed_orientation=True, mend_times=True)
    new = recordings.load(path, fixed_orientation=True, sort_times=True)
    np.testing.assert_array_equal(old.position, new.position)
    done = CliRunner().invoke(main, ["inspect", str(path), "--fixed-orientation", "--mend-times"])
    assert "--mend-times is --sort-times now" in done.output
    assert "--mend-times" not in CliRunner().invoke(main, ["inspect", "--help"]).output


def test_a_number_in_all_of_a_position_is_asked_about_before_the_unit(tmp_path):
    rows = [[k / 50, 0.01 * k, 0.2, 0.9, 0, 0, 0, 1] for k in range(60)]
    for k in (20, 21, 22):
        rows[k][1:4] = [-9999.0] * 3
    path = tmp_path / "a.csv"
    lines = ["time,x,y,z,qx,qy,qz,qw", *(",".join(map(str, row)) for row in rows)]
    path.write_text("\n".join(lines))
    with pytest.raises(
        InvalidArgument, match=r"3 samples are -9999 in all three coordinates \(the first: 20\).*missing=-9999"
    ):
        recordings.load(path)
    assert np.flatnonzero(recordings.load(path, missing=-9999.0).missing).tolist() == [20, 21, 22]
    done = CliRunner().invoke(main, ["inspect", str(path)])
    assert "--missing -9999" in done.output.replace("\n", " ")
