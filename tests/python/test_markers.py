"""Marker files: what Qualisys, Motive, Vicon, TRC, C3D and Aria files yield, and what is refused."""

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings import Markers
from dmpcpp.recordings._markers import distinct
from scipy.spatial.transform import Rotation

COUNT = 12
TIMES = 0.01 * np.arange(COUNT)
POINTS = np.random.default_rng(3).normal(size=(COUNT, 2, 3)).round(4) * 100.0  # mm


def text(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.4f}"


def qualisys(path, points=POINTS, names=("a", "b"), columns=True, leading=2, lost="0.000"):
    lines = ["NO_OF_FRAMES\t12", "FREQUENCY\t100", "DATA_INCLUDED\t3D", "MARKER_NAMES\t" + "\t".join(names)]
    if columns:
        lines.append("\t".join([*("Frame", "Time")[:leading], *(f"{n} {axis}" for n in names for axis in "XYZ")]))
    for k, row in enumerate(points.reshape(len(points), -1)):
        head = [str(k + 1), f"{TIMES[k]:.5f}"][:leading]
        lines.append("\t".join([*head, *(text(v) or lost for v in row)]))
    path.write_text("\n".join(lines) + "\n")
    return path


def motive(path, body=None, unit="Millimeters", **facts):
    """Write markers a and b, and a rigid body if its poses (T, 7) `qx qy qz qw x y z` are given."""
    known = {
        "Format Version": "1.23",
        "Rotation Type": "Quaternion",
        "Length Units": unit,
        "Coordinate Space": "Global",
    }
    columns = [("Marker", n, n, "Position", axis) for n in "ab" for axis in "XYZ"]
    table = POINTS.reshape(COUNT, 6)
    if body is not None:
        turn = [("Rigid Body", "hand", "7", "Rotation", axis) for axis in "XYZW"]
        columns += [*turn, *(("Rigid Body", "hand", "7", "Position", axis) for axis in "XYZ")]
        columns.append(("Rigid Body", "hand", "7", "Mean Marker Error", ""))
        table = np.column_stack([table, body, np.zeros(COUNT)])
    heads = [["", label, *(c[k] for c in columns)] for k, label in enumerate(["Type", "Name", "ID"])]
    heads += [["", "", *(c[3] for c in columns)], ["Frame", "Time (Seconds)", *(c[4] for c in columns)]]
    lines = [",".join(f"{name},{value}" for name, value in {**known, **facts}.items()), ""]
    lines += [",".join(head) for head in heads]
    lines += [",".join([str(k), f"{TIMES[k]:.6f}", *map(text, row)]) for k, row in enumerate(table)]
    path.write_text("\n".join(lines) + "\n")
    return path


def vicon(path, points=POINTS, units="mm", head="Trajectories"):
    lines = [head, "100", ",,S:a,,,S:b", "Frame,Sub Frame,X,Y,Z,X,Y,Z", f",,{','.join([units] * 6)}"]
    lines += [",".join([str(k + 5), "0", *map(text, row)]) for k, row in enumerate(points.reshape(len(points), -1))]
    path.write_text(
        "Devices\n1000\n,,x\nFrame,Sub Frame,V\n,,V\n1,0,3.5\n\n" + "\r\n".join(lines) + "\r\n\r\nEvents\r\n"
    )
    return path


def trc(path, points=POINTS, units="mm", separator="\t", announced=COUNT):
    lines = [
        ["PathFileType", "4", "(X/Y/Z)", "a.trc"],
        ["DataRate", "CameraRate", "NumFrames", "NumMarkers", "Units"],
        ["100", "100", str(announced), "2", units],
        ["Frame#", "Time", "a", "", "", "b", "", ""],
        ["", "", "X1", "Y1", "Z1", "X2", "Y2", "Z2"],
        [""],
    ]
    lines += [[str(k + 1), f"{TIMES[k]:.3f}", *map(text, row)] for k, row in enumerate(points.reshape(len(points), -1))]
    path.write_text("\n".join(separator.join(line) for line in lines) + "\n")
    return path


def with_gap(points=POINTS):
    points = points.copy()
    points[3:5, 1] = np.nan
    return points


def assert_read(found: Markers, points=POINTS, names=("a", "b")):
    assert found.names == names
    np.testing.assert_allclose(found.time, TIMES, atol=1e-9)
    np.testing.assert_allclose(found.position, 1e-3 * points, atol=1e-12)


# ---------------------------------------------------------------- Qualisys


@pytest.mark.parametrize(("columns", "leading"), [(True, 2), (False, 2), (False, 0)])
def test_qualisys_markers_read_with_and_without_column_names_frame_and_time(tmp_path, columns, leading):
    path = qualisys(tmp_path / "a.tsv", columns=columns, leading=leading)
    assert recordings.format_of(path) == "qualisys"
    assert recordings.bodies(path) == ()
    assert_read(recordings.markers(path))


@pytest.mark.parametrize("lost", ["0.000", "", "NaN"])
def test_qualisys_markers_that_were_not_seen_are_gaps(tmp_path, lost):
    found = recordings.markers(qualisys(tmp_path / "a.tsv", with_gap(), lost=lost))
    assert_read(found, with_gap())
    assert found.missing.sum() == 2


def test_a_body_asked_of_markers_is_refused_with_their_names(tmp_path):
    with pytest.raises(NotStated, match=r"a\.tsv: markers: .*Name three or more.*It holds: a, b") as refused:
        recordings.load(qualisys(tmp_path / "a.tsv"))
    assert refused.value.names == ("markers",)


def test_a_qualisys_line_with_a_bad_cell_or_too_few_is_named(tmp_path):
    path = qualisys(tmp_path / "a.tsv")
    lines = path.read_text().splitlines()
    lines[8] = lines[8].replace("\t", "\tx", 2)
    path.write_text("\n".join(lines))
    with pytest.raises(InvalidArgument, match=r"line 9, .*'x0?.*expected a number"):
        recordings.markers(path)
    path.write_text("\n".join(lines[:3]))
    with pytest.raises(InvalidArgument, match="without lines of data"):
        recordings.markers(path)


def test_a_qualisys_header_without_what_it_holds_is_refused(tmp_path):
    path = qualisys(tmp_path / "a.tsv")
    path.write_text(path.read_text().replace("DATA_INCLUDED\t3D", "DATA_INCLUDED"))
    with pytest.raises(InvalidArgument, match=r"DATA_INCLUDED is '', expected 3D \(markers\) or 6D"):
        recordings.markers(path)
    nameless = qualisys(tmp_path / "b.tsv", columns=False, leading=0)
    nameless.write_text(nameless.read_text().replace("FREQUENCY\t100", "FREQUENCY"))
    with pytest.raises(NotStated, match="rate: the file holds no times"):
        recordings.markers(nameless)
    assert_read(recordings.markers(nameless, rate=100.0))


def six_dof(path, order="F", lost=()):
    turns = Rotation.from_euler("XYZ", np.linspace([0, 0, 0], [80, -30, 50], COUNT), degrees=True)
    lines = ["NO_OF_FRAMES\t12", "NO_OF_BODIES\t2", "FREQUENCY\t100", "DATA_INCLUDED\t6D", "BODY_NAMES\thand\tcup"]
    one = ["X", "Y", "Z", "Roll", "Pitch", "Yaw", "Residual", *(f"Rot[{k}]" for k in range(9))]
    lines.append("\t".join(["Frame", "Time", "hand X", *one[1:], "cup X", *one[1:], ""]))
    for k, (point, matrix) in enumerate(zip(POINTS[:, 0], turns.as_matrix(), strict=True)):
        angles = turns[k].as_euler("XYZ", degrees=True)
        hand = [*point, *angles, 0.1, *matrix.flatten(order)]
        hand = [0.0] * 16 if k in lost else hand
        lines.append("\t".join([str(k + 1), f"{TIMES[k]:.5f}", *(f"{v:.9f}" for v in [*hand, *hand]), ""]))
    path.write_text("\n".join(lines) + "\n")
    return turns


def test_qualisys_bodies_read_with_their_matrices_column_by_column(tmp_path):
    turns = six_dof(tmp_path / "a_6D.tsv")
    assert recordings.bodies(tmp_path / "a_6D.tsv") == ("hand", "cup")
    found = recordings.load(tmp_path / "a_6D.tsv", "cup", up_axis="z")
    np.testing.assert_allclose(found.position, 1e-3 * POINTS[:, 0], atol=1e-9)
    np.testing.assert_allclose(found.rotation, turns.as_matrix(), atol=1e-8)
    assert found.rate == pytest.approx(100.0)


def test_a_qualisys_body_that_was_lost_is_a_gap(tmp_path):
    six_dof(tmp_path / "a_6D.tsv", lost=(4, 5))
    found = recordings.load(tmp_path / "a_6D.tsv", "hand")
    assert np.flatnonzero(found.missing).tolist() == [4, 5]
    assert "2 of 12 samples are missing (the first: 4)" in found.history


def test_the_recorded_reaches_read_with_their_gaps(recorded):
    found = recordings.markers(recorded / "qualisys_dfki" / "recording.tsv", up_axis="z")
    assert (len(found), len(found.names), found.rate) == (6000, 21, pytest.approx(100.0))
    gaps = dict(zip(found.names, found.missing.sum(axis=0), strict=True))
    assert {name for name, count in gaps.items() if count} == {"thumb_tip", "ring_tip", "middle_tip"}
    np.testing.assert_allclose(found.position[0, 0], [0.110406, 0.135075, 0.460584])


# ---------------------------------------------------------------- Motive


def motive_body():
    turns = Rotation.from_euler("XYZ", np.linspace([0, 0, 0], [80, -30, 50], COUNT), degrees=True)
    return np.column_stack([turns.as_quat(), POINTS[:, 0]]), turns


def test_motive_bodies_have_their_rotation_before_their_position(tmp_path):
    body, turns = motive_body()
    path = motive(tmp_path / "a.csv", body)
    assert (recordings.format_of(path), recordings.bodies(path)) == ("motive", ("hand",))
    found = recordings.load(path, up_axis="y")
    np.testing.assert_allclose(found.position, 1e-3 * POINTS[:, 0], atol=1e-9)
    np.testing.assert_allclose(found.rotation, turns.as_matrix(), atol=2e-4)  # four decimals in the file
    assert_read(recordings.markers(path))


def test_motive_cells_that_are_empty_are_gaps(tmp_path):
    body, _ = motive_body()
    body[6:8] = np.nan
    found = recordings.load(motive(tmp_path / "a.csv", body), up_axis="y")
    assert np.flatnonzero(found.missing).tolist() == [6, 7]


@pytest.mark.parametrize(
    ("facts", "message"),
    [
        ({"Rotation Type": "XYZ"}, "Rotation Type is 'XYZ'. Export again with Rotation Type Quaternion"),
        ({"Coordinate Space": "Local"}, "Coordinate Space is 'Local'. Export again"),
        ({"Length Units": "Parsecs"}, "Length Units is 'Parsecs'.*State unit"),
    ],
)
def test_a_motive_export_that_cannot_be_placed_is_refused_with_the_remedy(tmp_path, facts, message):
    body, _ = motive_body()
    with pytest.raises(InvalidArgument, match=message):
        recordings.load(motive(tmp_path / "a.csv", body, **facts))


def test_a_motive_export_without_its_header_lines_is_refused(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("Format Version,1.23\n1,0.0,3\n")
    with pytest.raises(InvalidArgument, match="no line headed Type or Name or Frame. Export again with the header"):
        recordings.bodies(path)


# ---------------------------------------------------------------- Vicon


def test_vicon_trajectories_read_between_other_sections(tmp_path):
    path = vicon(tmp_path / "a.csv", with_gap())
    assert recordings.format_of(path) == "vicon"
    assert_read(recordings.markers(path), with_gap(), ("S:a", "S:b"))


def test_vicon_sections_without_trajectories_are_named(tmp_path):
    with pytest.raises(InvalidArgument, match=r"no section 'Trajectories'.*Sections: Devices, Segments, Events"):
        recordings.markers(vicon(tmp_path / "a.csv", head="Segments"))


def test_vicon_columns_of_an_unknown_unit_ask_for_it(tmp_path):
    path = vicon(tmp_path / "a.csv", units="furlong")
    with pytest.raises(NotStated, match="the columns say 'furlong'. State unit"):
        recordings.markers(path)
    assert_read(recordings.markers(path, unit="mm"), names=("S:a", "S:b"))


# ---------------------------------------------------------------- TRC


@pytest.mark.parametrize("separator", ["\t", ","])
def test_trc_markers_read_between_tabs_or_commas(tmp_path, separator):
    path = trc(tmp_path / "a.trc", with_gap(), separator=separator)
    assert recordings.format_of(path) == "trc"
    assert_read(recordings.markers(path), with_gap())


def test_a_trc_with_fewer_frames_than_announced_says_so(tmp_path):
    found = recordings.markers(trc(tmp_path / "a.trc", announced=99))
    assert "WARNING: the header announces 99 frames, the file holds 12" in found.history


def test_a_trc_of_an_unknown_unit_asks_for_it_and_a_stated_one_counts(tmp_path):
    path = trc(tmp_path / "a.trc", units="ell")
    with pytest.raises(NotStated, match="Units is 'ell'"):
        recordings.markers(path)
    assert_read(recordings.markers(path, unit="mm"))


def test_a_unit_stated_against_the_files_own_word_is_noted(tmp_path):
    found = recordings.markers(qualisys(tmp_path / "a.tsv"), unit=2e-3)
    np.testing.assert_allclose(found.position, 2e-3 * POINTS)
    assert "the file gives mm; the unit specified is used" in found.history


def test_the_recorded_trc_reads_although_it_announces_more(recorded):
    found = recordings.markers(recorded / "pyomeca" / "markers.trc")
    assert (len(found), len(found.names)) == (93, 51)
    assert any("announces 652 frames" in note for note in found.history)


# ---------------------------------------------------------------- Aria


def test_aria_hands_read_with_lost_ones_as_gaps(recorded):
    path = recorded / "aria_mps" / "hand_tracking_results_v2.csv"
    assert recordings.bodies(path) == ("left_wrist", "right_wrist")
    left = recordings.load(path, "left_wrist")
    assert np.flatnonzero(~left.missing).tolist() == [0, 1, 2]
    assert left.time[1] == pytest.approx(0.199972, abs=1e-9)
    landmarks = recordings.markers(path)
    assert len(landmarks.names) == 42
    np.testing.assert_allclose(landmarks.position[0, 0], [0.0645316, -0.248787, 0.250952])
    assert landmarks.missing[3, 0]


def test_an_aria_trajectory_is_the_devices(tmp_path):
    names = [*(f"t{a}_world_device" for a in "xyz"), *(f"q{a}_world_device" for a in "xyzw")]
    lines = [",".join(["graph_uid", "tracking_timestamp_us", *names])]
    lines += [f"u,{1000 * k},{0.01 * k},0,0,0,0,0.6,0.8" for k in range(COUNT)]
    (tmp_path / "a.csv").write_text("\n".join(lines))
    found = recordings.load(tmp_path / "a.csv")
    assert found.body == "device"
    np.testing.assert_allclose(found.time, 0.001 * np.arange(COUNT))
    np.testing.assert_allclose(found.position[:, 0], 0.01 * np.arange(COUNT))


# ---------------------------------------------------------------- the value


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"names": ("a", "a")}, "expected names that differ"),
        ({"names": ("a",)}, r"shape \(12, 2, 3\), expected \(12, 1, 3\)"),
        ({"time": TIMES + 1.0}, r"time\[0\]: 1 s, expected 0"),
        ({"time": np.zeros(COUNT)}, r"time\[1\]: 0 s after 0 s"),
        ({"position": np.where(np.arange(3) == 1, np.nan, POINTS)}, r"position\[0\] of a: y is nan"),
        ({"time": TIMES[:4], "position": POINTS[:4]}, "4 samples, expected at least 8"),
        ({"up_axis": "w"}, "up_axis: 'w'"),
    ],
)
def test_markers_refuse_bad_data_and_name_the_place(changes, message):
    with pytest.raises(InvalidArgument, match=message):
        Markers(**{"names": ("a", "b"), "time": TIMES, "position": POINTS, **changes})


def test_markers_are_chosen_by_name_and_an_unknown_one_lists_them():
    markers = Markers(("a", "b"), TIMES, POINTS)
    np.testing.assert_array_equal(markers.chosen(["b"]).position[:, 0], POINTS[:, 1])
    assert "2 markers, 12 samples, 0.110 s, 100.0 Hz" in repr(markers)
    with pytest.raises(InvalidArgument, match=r"no marker 'c'. The file holds: a, b"):
        markers.chosen(["a", "c"])


def test_markers_of_one_name_are_told_apart():

    assert distinct(["a", "", "a", " ", "a"]) == ("a", "unnamed", "a (2)", "unnamed (2)", "a (3)")
