"""Recordings: what each reader yields from real and written files, and what it refuses."""

import json

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency, NotStated
from dmpcpp.recordings import Recording
from scipy.spatial.transform import Rotation

TURNS = Rotation.from_rotvec(np.linspace([0.0, 0.0, 0.0], [0.4, -1.0, 2.0], 12))
TIMES = 0.1 * np.arange(12.0)
POSITIONS = np.column_stack([np.sin(TIMES), np.cos(TIMES), TIMES])


def made(**changes) -> Recording:
    return Recording(**{"time": TIMES, "position": POSITIONS, "rotation": TURNS.as_matrix(), **changes})


def poses() -> np.ndarray:
    pose = np.tile(np.eye(4), (12, 1, 1))
    pose[:, :3, :3], pose[:, :3, 3] = TURNS.as_matrix(), POSITIONS
    return pose


def rows(order="xyzw", scale=1.0) -> np.ndarray:
    """Return t x y z and the quaternion."""
    quaternion = TURNS.as_quat(scalar_first=order == "wxyz")
    return np.column_stack([TIMES, scale * POSITIONS, quaternion])


def write_csv(path, table, header, delimiter=","):
    lines = [delimiter.join(header)] if header else []
    lines += [delimiter.join(repr(float(v)) for v in row) for row in table]
    path.write_text("\n".join(lines) + "\n")
    return path


def assert_same_motion(recording, position=POSITIONS, time=TIMES):
    np.testing.assert_allclose(recording.time, time, atol=1e-12)
    np.testing.assert_allclose(recording.position, position, atol=1e-12)
    np.testing.assert_allclose(recording.rotation, TURNS.as_matrix(), atol=1e-12)


# ---------------------------------------------------------------- the value


def test_a_recording_knows_its_length_duration_and_rate():
    recording = made(body="hand")
    assert len(recording) == 12
    assert recording.duration == pytest.approx(1.1)
    assert recording.rate == pytest.approx(10.0)
    assert "'hand', 12 samples, 1.100 s" in repr(recording)


def test_a_recording_does_not_change_with_the_arrays_it_was_made_from():
    position = POSITIONS.copy()
    recording = made(position=position)
    position[:] = 0.0
    assert recording.position[-1, 2] == TIMES[-1]
    with pytest.raises(ValueError, match="read-only"):
        recording.position[0, 0] = 1.0


def test_a_changed_copy_says_what_was_done_and_leaves_the_original():
    recording = made()
    moved = recording.with_("moved by 1 m", position=POSITIONS + 1.0)
    assert moved.history == ("moved by 1 m",)
    assert recording.history == ()


def corrupted(array, index, value):
    changed = np.array(array, dtype=float)
    changed[index] = value
    return changed


REFUSED_VALUES = {
    "nan position": ({"position": corrupted(POSITIONS, (4, 1), np.nan)}, r"position\[4, 1\]: nan"),
    "inf time": ({"time": corrupted(TIMES, 11, np.inf)}, r"time\[11\]: inf"),
    "nan rotation": (
        {"rotation": corrupted(TURNS.as_matrix(), (3, 2, 2), np.nan)},
        r"rotation\[3, 2, 2\]: nan",
    ),
    "time backwards": ({"time": corrupted(TIMES, 5, 0.35)}, r"time\[5\]: 0\.35 s after 0\.4 s"),
    "time repeated": ({"time": corrupted(TIMES, 5, 0.4)}, r"time\[5\]: 0\.4 s after 0\.4 s"),
    "time not from zero": ({"time": TIMES + 3.0}, r"time\[0\]: 3 s, expected 0"),
    "seven samples": (
        {"time": TIMES[:7], "position": POSITIONS[:7], "rotation": TURNS.as_matrix()[:7]},
        "7 samples, expected at least 8",
    ),
    "one position short": ({"position": POSITIONS[:11]}, r"position: shape \(11, 3\), expected \(12, 3\)"),
    "reflection": (
        {"rotation": corrupted(TURNS.as_matrix(), 6, np.diag([1.0, 1.0, -1.0]))},
        r"rotation\[6\]: det\(R\) = -1\.000, expected \+1 \(a reflection\)",
    ),
    "scaled rotation": ({"rotation": 1.01 * TURNS.as_matrix()}, r"rotation\[0\]: \|R\^T R - I\| = 0\.0201"),
    "huge rotation": ({"rotation": 1e200 * TURNS.as_matrix()}, r"rotation\[0\]"),
    "kilometres": ({"position": 1e300 * POSITIONS}, r"ranges over .* Check the length unit"),
    "text": ({"position": "abc"}, "position: not an array of numbers"),
    "up axis": ({"up_axis": "up"}, "up_axis: 'up', expected 'x', 'y', 'z' or None"),
}


@pytest.mark.parametrize(("changes", "message"), REFUSED_VALUES.values(), ids=REFUSED_VALUES)
def test_a_recording_refuses_bad_data_and_names_the_place(changes, message):
    with pytest.raises(InvalidArgument, match=message):
        made(**changes)


# ---------------------------------------------------------------- choosing reader and body


def test_a_missing_file_is_a_file_error_with_its_path(tmp_path):
    with pytest.raises(FileError, match=r"nix\.csv: cannot be read \(No such file"):
        recordings.load(tmp_path / "nix.csv")


def test_a_folder_is_a_file_error(tmp_path):
    with pytest.raises(FileError, match="Is a directory"):
        recordings.load(tmp_path)


def test_an_unknown_format_and_one_that_cannot_be_told_list_the_formats(tmp_path):
    path = tmp_path / "words.txt"
    path.write_text("these are words\n")
    with pytest.raises(InvalidArgument, match=r"cannot be recognised(.*\n)+  arrays .*\n(.*\n)+  tum "):
        recordings.load(path)
    with pytest.raises(InvalidArgument, match=r"format: 'xml', expected one of:(.*\n)+  tum "):
        recordings.load(path, format="xml")


def test_an_unknown_body_is_refused_with_those_that_exist(tmp_path):
    header = [f"{b}{c}" for b in ("hand_", "cup_") for c in ("x", "y", "z", "qx", "qy", "qz", "qw")]
    table = np.column_stack([TIMES, rows()[:, 1:], rows()[:, 1:]])
    path = write_csv(tmp_path / "two.csv", table, ["time", *header])
    assert recordings.bodies(path) == ("hand", "cup")
    with pytest.raises(InvalidArgument, match=r"no body 'foot' in the file. It holds: hand, cup"):
        recordings.load(path, body="foot")
    with pytest.raises(InvalidArgument, match=r"no body named and the file holds several. It holds: hand, cup"):
        recordings.load(path)


def test_a_statement_that_the_format_does_not_take_is_refused(tmp_path):
    path = write_csv(tmp_path / "a.tum", rows(), [], " ")
    with pytest.raises(InvalidArgument, match="euler_order: the format 'tum' does not take it; it takes quat_order="):
        recordings.load(path, euler_order="ZYX")


# ---------------------------------------------------------------- DeepMimic clips


@pytest.fixture(scope="module")
def clips():
    pytest.importorskip("pybullet_data")
    return recordings.clip_names()


def clip_frames(name) -> np.ndarray:
    return np.array(json.loads(recordings.clip_path(name).read_text())["Frames"])


def written(tmp_path, frames):
    path = tmp_path / "clip.txt"
    path.write_text(json.dumps({"Loop": "none", "Frames": np.asarray(frames).tolist()}))
    return path


def test_fifteen_clips_ship_with_pybullet_and_an_unknown_name_lists_them(clips):
    assert len(clips) == 15
    with pytest.raises(InvalidArgument, match=r"no clip 'samba'.*backflip.*dance_b.*walk"):
        recordings.clip("samba")


def test_without_pybullet_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setattr("dmpcpp._pybullet_data.find", lambda: None)
    with pytest.raises(MissingDependency, match=r'dmpcpp fetch.*pip install "dmpcpp\[bullet\]"'):
        recordings.clip("dance_b")


def test_dance_b_is_the_clean_gesture_it_is_known_as(clips):
    recording = recordings.clip("dance_b")
    assert len(recording) == 153
    assert recording.rate == pytest.approx(60.0, rel=1e-3)
    assert recording.up_axis == "y"
    path_length = np.linalg.norm(np.diff(recording.position, axis=0), axis=1).sum()
    assert path_length == pytest.approx(4.6, abs=0.1)


def test_the_figures_joints_are_the_bodies(clips):
    bodies = recordings.bodies(recordings.clip_path("walk"))
    assert {"right_hand", "left_hand", "chest", "neck", "left_ankle"} < set(bodies)
    with pytest.raises(InvalidArgument, match=r"no body 'tail'.*right_hand, left_"):
        recordings.clip("walk", "tail")


@pytest.fixture(scope="module")
def humanoid(clips):
    """PyBullet's own figure: set a frame, read the poses of its joints."""
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    urdf = recordings.clip_path("walk").parents[2] / "humanoid" / "humanoid.urdf"
    figure = pybullet.loadURDF(str(urdf), globalScaling=0.25, physicsClientId=client)
    names = [pybullet.getJointInfo(figure, k, physicsClientId=client)[1].decode() for k in range(15)]
    links = {name.replace("wrist", "hand"): k for k, name in enumerate(names)}

    def pose_of(frame):
        xyzw = lambda q: np.roll(q / np.linalg.norm(q), -1).tolist()  # noqa: E731
        pybullet.resetBasePositionAndOrientation(figure, frame[1:4].tolist(), xyzw(frame[4:8]), physicsClientId=client)
        turns = {"chest": 8, "neck": 12, "right_hip": 16, "right_ankle": 21, "right_shoulder": 25}
        turns |= {"left_hip": 30, "left_ankle": 35, "left_shoulder": 39}
        for name, first in turns.items():
            pybullet.resetJointStateMultiDof(
                figure, links[name], xyzw(frame[first : first + 4]), physicsClientId=client
            )
        for name, column in {"right_knee": 20, "right_elbow": 29, "left_knee": 34, "left_elbow": 43}.items():
            pybullet.resetJointState(figure, links[name], frame[column], physicsClientId=client)
        states = pybullet.getLinkStates(figure, range(15), computeForwardKinematics=True, physicsClientId=client)
        return {name: states[k][4:6] for name, k in links.items()}

    yield pose_of
    pybullet.disconnect(client)


@pytest.mark.parametrize("name", ["dance_b", "spinkick", "getup_faceup", "walk", "punch"])
def test_forward_kinematics_agrees_with_pybullets_figure(humanoid, name):
    frames = clip_frames(name)
    figure = {body: recordings.clip(name, body) for body in recordings.bodies(recordings.clip_path(name))}
    for k in range(0, len(frames), 11):
        for body, (position, quaternion) in humanoid(frames[k]).items():
            np.testing.assert_allclose(figure[body].position[k], position, atol=2e-6, err_msg=f"{body} {k}")
            turned = Rotation.from_matrix(figure[body].rotation[k]).inv() * Rotation.from_quat(quaternion)
            assert turned.magnitude() < 5e-6, (body, k)


def test_the_last_frame_counts_although_its_duration_is_zero(clips):
    frames = clip_frames("punch")
    assert frames[-1, 0] == 0.0
    recording = recordings.clip("punch")
    assert len(recording) == len(frames)
    assert recording.duration == pytest.approx(frames[:, 0].sum())


def test_a_frame_of_duration_zero_in_the_middle_is_refused(clips, tmp_path):
    frames = clip_frames("dance_b")
    frames[20, 0] = 0.0
    with pytest.raises(InvalidArgument, match=r"time\[21\].*expected strictly increasing"):
        recordings.load(written(tmp_path, frames), "right_hand")


def test_an_irregular_frame_keeps_its_own_duration(clips):
    steps = np.diff(recordings.clip("roll", "chest").time)
    assert steps.max() == pytest.approx(0.032666)
    assert np.median(steps) == pytest.approx(0.016666)


@pytest.mark.parametrize(("name", "rate"), [("dance_b", 60), ("punch", 30), ("spin", 24), ("backflip", 16)])
def test_each_clip_has_the_rate_its_frames_say(clips, name, rate):
    assert recordings.clip(name).rate == pytest.approx(rate, rel=1e-3)


def test_non_unit_quaternions_are_refused_only_in_the_chain_of_the_body(clips):
    assert recordings.clip("kick", "right_hand").position.shape == (47, 3)
    with pytest.raises(InvalidArgument, match=r"kick.txt: right_hip quaternion\[\d+\]: \|q\| = "):
        recordings.clip("kick", "right_knee")
    with pytest.raises(InvalidArgument, match=r"roll.txt: right_shoulder quaternion\[\d+\]: \|q\| = "):
        recordings.clip("roll", "right_hand")


def test_a_slightly_non_unit_quaternion_is_renormalised_with_a_warning_in_the_history(clips):
    history = recordings.clip("jump").history
    assert any(h.startswith("WARNING: right_shoulder quaternion: renormalised, off by") for h in history)


def test_sign_flips_between_frames_leave_the_motion_untouched(clips, tmp_path):
    frames = clip_frames("dance_b")
    plain = recordings.load(written(tmp_path, frames), "right_hand")
    for first in (4, 8, 25):
        frames[30:60, first : first + 4] *= -1.0
    flipped = recordings.load(written(tmp_path, frames), "right_hand")
    np.testing.assert_array_equal(flipped.rotation, plain.rotation)
    np.testing.assert_array_equal(flipped.position, plain.position)
    assert "root quaternion: sign flips fixed: 2 (the first at frame 30)" in flipped.history


def test_the_hands_orientation_is_the_forearms_and_the_history_says_so(clips):
    hand, elbow = recordings.clip("dance_b", "left_hand"), recordings.clip("dance_b", "left_elbow")
    np.testing.assert_array_equal(hand.rotation, elbow.rotation)
    assert any("forearm" in step for step in hand.history)


def test_damaged_frames_are_named(clips, tmp_path):
    frames = clip_frames("dance_b").tolist()
    frames[7] = frames[7][:40]
    path = tmp_path / "clip.txt"
    path.write_text(json.dumps({"Frames": frames}))
    with pytest.raises(InvalidArgument, match=r"clip.txt: Frames\[7\]: 40 numbers, expected 44"):
        recordings.load(path, "right_hand")
    frames[7] = [*frames[6][:43], "0.5"]
    path.write_text(json.dumps({"Frames": frames}))
    with pytest.raises(InvalidArgument, match=r"Frames\[7\]\[43\]: str, expected a finite number"):
        recordings.load(path, "right_hand")


@pytest.mark.parametrize("text", ["{", "[" * 100000, '{"Frames": 1}', "{" + '"a":{' * 50000, '{"Frames": []}'])
def test_json_that_is_no_clip_is_refused(tmp_path, text):
    path = tmp_path / "clip.json"
    path.write_text(text)
    with pytest.raises(InvalidArgument, match=r"not JSON|not a DeepMimic clip"):
        recordings.load(path, "right_hand", format="deepmimic")


def test_numbers_too_large_for_a_float_are_refused(clips, tmp_path):
    frames = clip_frames("dance_b").tolist()
    for huge in ("1" + "0" * 400, "1" + "0" * 5000, "1e999", "NaN"):
        text = json.dumps({"Frames": frames}).replace(repr(frames[3][1]), huge, 1)
        path = tmp_path / "clip.txt"
        path.write_text(text)
        with pytest.raises(InvalidArgument, match=r"clip\.txt"):
            recordings.load(path, "right_hand")


# ---------------------------------------------------------------- TUM


def test_a_tum_file_reads_in_seconds_from_its_first_sample(tmp_path):
    table = rows()
    table[:, 0] += 1305031098.0
    path = write_csv(tmp_path / "a.txt", table, [], " ")
    path.write_text("# a comment\n\n" + path.read_text().replace("\n", "\r\n"))
    recording = recordings.load(path, up_axis="z")
    np.testing.assert_allclose(recording.position, POSITIONS, atol=1e-12)
    np.testing.assert_allclose(recording.time, TIMES, atol=1e-6)
    assert recording.up_axis == "z"
    assert any("time counted from the first sample at 1.3050311e+09 s" in step for step in recording.history)


def test_a_tum_line_with_a_missing_or_bad_number_is_named(tmp_path):
    path = tmp_path / "a.tum"
    path.write_text("# comment\n" + "0 0 0 0 0 0 0 1\n" + "1 0 0 0 0 0 0\n")
    with pytest.raises(InvalidArgument, match=r"a.tum: line 3: 7 columns, expected 8"):
        recordings.load(path)
    path.write_text("0 0 0 0 0 0 0 1\n0.1 0 abc 0 0 0 0 1\n")
    with pytest.raises(InvalidArgument, match="line 2, ty: 'abc', expected a number"):
        recordings.load(path)


def test_the_hand_held_camera_reads_as_recorded(recorded):
    truth = recordings.load(recorded / "tum_evo" / "freiburg1_xyz-groundtruth.txt")
    assert len(truth) == 3000
    assert truth.rate == pytest.approx(100.0, rel=0.01)
    assert np.diff(truth.time).max() == pytest.approx(0.11, abs=0.01)  # the gap
    np.testing.assert_allclose(truth.position[0], [1.3563, 0.6305, 1.6380])
    assert any("renormalised, off by at most 8.4e-05" in step for step in truth.history)


def test_metres_that_are_millimetres_are_refused_with_the_remedy(tmp_path):
    path = write_csv(tmp_path / "a.tum", rows(scale=1000.0), [], " ")
    with pytest.raises(
        InvalidArgument, match=r"z ranges over 1100 m, more than 100, in the unit that the file states, m.*unit='mm'"
    ):
        recordings.load(path)
    recording = recordings.load(path, unit="mm")
    assert_same_motion(recording)
    assert "positions converted from mm to m" in recording.history


def test_a_large_range_is_accepted_when_the_caller_insists(tmp_path):
    path = write_csv(tmp_path / "a.tum", rows(scale=10.0), [], " ")
    assert_same_motion(recordings.load(path, unit="m"), 10.0 * POSITIONS)


def test_an_unknown_unit_is_refused(tmp_path):
    path = write_csv(tmp_path / "a.tum", rows(), [], " ")
    for unit in ("furlong", -1.0, True, float("nan")):
        with pytest.raises(InvalidArgument, match=r"unit: .*, expected one of m, cm, mm, in or a positive factor"):
            recordings.load(path, unit=unit)


# ---------------------------------------------------------------- tables

HEADER = ["time", "x", "y", "z", "qx", "qy", "qz", "qw"]


@pytest.mark.parametrize("delimiter", [",", ";", "\t", " "])
def test_named_columns_are_found_whatever_stands_between_them(tmp_path, delimiter):
    path = write_csv(tmp_path / "a.csv", rows(), HEADER, delimiter)
    assert recordings.bodies(path) == ("pose",)
    recording = recordings.load(path)
    assert_same_motion(recording)
    assert "no length unit given: positions taken as metres" in recording.history


def test_the_names_of_the_quaternion_columns_tell_their_order(tmp_path):
    header = ["Timestamp", "hand_tx", "hand_ty", "hand_tz", "hand_qw", "hand_qx", "hand_qy", "hand_qz"]
    path = write_csv(tmp_path / "a.csv", rows("wxyz"), header)
    recording = recordings.load(path, body="hand")
    assert_same_motion(recording)
    assert recording.body == "hand"


def test_columns_can_be_stated_by_name(tmp_path):
    header = ["sec", "east", "north", "up", "a", "b", "c", "d"]
    path = write_csv(tmp_path / "a.csv", rows(), header)
    with pytest.raises(InvalidArgument, match=r"no body with columns.*State the columns"):
        recordings.load(path)
    stated = dict(zip(HEADER, header, strict=True))
    assert_same_motion(recordings.load(path, columns=stated))


def test_columns_can_be_stated_by_number_for_a_table_without_header(tmp_path):
    path = write_csv(tmp_path / "a.txt", rows(), [], " ")
    columns = {name: k for k, name in enumerate(HEADER)}
    assert_same_motion(recordings.load(path, format="table", columns=columns, delimiter=" "))


def test_times_in_other_units_are_stated_and_a_slip_is_caught(tmp_path):
    table = rows()
    table[:, 0] *= 1000.0
    path = write_csv(tmp_path / "a.csv", table, HEADER)
    with pytest.raises(InvalidArgument, match=r"100 s between samples.*State time_unit='ms'"):
        recordings.load(path)
    assert_same_motion(recordings.load(path, time_unit="ms"))


def test_a_table_without_times_needs_a_rate(tmp_path):
    path = write_csv(tmp_path / "a.csv", rows()[:, 1:], HEADER[1:])
    with pytest.raises(InvalidArgument, match=r"rate: the file holds no times.*rate=100"):
        recordings.load(path)
    assert_same_motion(recordings.load(path, rate=10.0))
    for rate in (0, -5, float("nan"), "fast", True):
        with pytest.raises(InvalidArgument, match=r"rate: .*, expected a sampling rate in Hz"):
            recordings.load(path, rate=rate)


def test_cells_that_are_empty_missing_or_no_number_are_named(tmp_path):
    path = write_csv(tmp_path / "a.csv", rows(), HEADER)
    lines = path.read_text().splitlines()
    for bad, message in {
        "0.1,,1,0,0,0,0,1": "line 3, column 'x': an empty cell",
        "0.1,1,nan,0,0,0,0,1": "line 3, column 'y': nan, expected a finite number",
        "0.1,1,2": "line 3, column 'z': the line ends after 3 cells",
        "0.1,1,2,'3,0,0,0,1": "line 3, column 'z': \"'3\", expected a number",
    }.items():
        path.write_text("\n".join([*lines[:2], bad, *lines[3:]]))
        with pytest.raises(InvalidArgument, match=message):
            recordings.load(path)


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"x": 1}, "columns: missing y, z, qx"),
        (dict.fromkeys(HEADER, "nix"), "no column 'nix' in the header"),
        (dict.fromkeys(HEADER, -1), "columns: -1, expected"),
        ({**dict.fromkeys(HEADER, 0), "w": 3}, "columns: unknown 'w'"),
        (dict.fromkeys(HEADER, 99), "line 2, column 99: the line ends after 8 cells"),
    ],
)
def test_stated_columns_that_do_not_exist_are_refused(tmp_path, columns, message):
    path = write_csv(tmp_path / "a.csv", rows(), HEADER)
    with pytest.raises(InvalidArgument, match=message):
        recordings.load(path, columns=columns)


def test_text_that_is_not_utf_8_or_binary_is_refused_with_its_line(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"time,x\n1,\xb0\n")
    with pytest.raises(InvalidArgument, match="line 2: byte 0xb0 is not UTF-8"):
        recordings.load(path)
    path.write_bytes(b"time,x\n\n1,\x00\n")
    with pytest.raises(InvalidArgument, match="line 3: binary content"):
        recordings.load(path)


def test_hand_guided_unscrewing_reads_by_column_number(recorded):
    columns = {"time": 0, "x": 1, "y": 2, "z": 3, "qw": 10, "qx": 11, "qy": 12, "qz": 13}
    recording = recordings.load(recorded / "gsutanto_unscrewing" / "03.txt", format="table", columns=columns, unit="m")
    assert recording.rate == pytest.approx(300.0, rel=1e-3)
    orientation = Rotation.from_matrix(recording.rotation)
    turned = (orientation[0].inv() * orientation).magnitude().max()
    assert np.degrees(turned) == pytest.approx(180.0, abs=1.0)
    wrong = {**columns, "qw": 9, "qx": 10, "qy": 11, "qz": 12}
    with pytest.raises(InvalidArgument, match=r"\|q\| = .*Check the quaternion columns"):
        recordings.load(recorded / "gsutanto_unscrewing" / "03.txt", format="table", columns=wrong)


# ---------------------------------------------------------------- NumPy files


def test_a_npz_of_times_and_poses_reads_exactly(tmp_path):
    np.savez(tmp_path / "a.npz", time=TIMES + 7.0, pose=poses(), units="m")
    recording = recordings.load(tmp_path / "a.npz")
    assert_same_motion(recording)
    assert recording.body == "pose"


def test_a_npz_may_hold_the_rate_in_place_of_times(tmp_path):
    np.savez(tmp_path / "a.npz", rate=10, poses=poses())
    assert_same_motion(recordings.load(tmp_path / "a.npz"))


def test_a_npy_of_poses_needs_its_rate(tmp_path):
    np.save(tmp_path / "a.npy", poses())
    with pytest.raises(InvalidArgument, match="rate: the file holds no times"):
        recordings.load(tmp_path / "a.npy")
    assert_same_motion(recordings.load(tmp_path / "a.npy", rate=10))


@pytest.mark.parametrize("order", ["xyzw", "wxyz"])
def test_seven_or_eight_columns_need_the_quaternion_order(tmp_path, order):
    np.save(tmp_path / "eight.npy", rows(order))
    np.save(tmp_path / "seven.npy", rows(order)[:, 1:])
    with pytest.raises(InvalidArgument, match="quat_order: not stated"):
        recordings.load(tmp_path / "eight.npy")
    with pytest.raises(InvalidArgument, match="quat_order: 'wzyx', expected 'xyzw' or 'wxyz'"):
        recordings.load(tmp_path / "eight.npy", quat_order="wzyx")
    assert_same_motion(recordings.load(tmp_path / "eight.npy", quat_order=order))
    assert_same_motion(recordings.load(tmp_path / "seven.npy", quat_order=order, rate=10))


def test_transposed_or_reflected_matrices_are_refused_with_their_index(tmp_path):
    np.savez(tmp_path / "a.npz", time=TIMES, pose=np.swapaxes(poses(), 1, 2))
    with pytest.raises(InvalidArgument, match=r"poses\[0\]: last row .* transposed"):
        recordings.load(tmp_path / "a.npz")
    mirrored = poses()
    mirrored[5, :3, :3] *= -1.0
    np.savez(tmp_path / "a.npz", time=TIMES, pose=mirrored)
    with pytest.raises(InvalidArgument, match=r"poses\[5\]: det\(R\) = -1\.000, expected \+1 \(a reflection\)"):
        recordings.load(tmp_path / "a.npz")


def test_nearly_orthonormal_matrices_become_the_nearest_rotation(tmp_path):
    sheared = poses()
    sheared[:, :3, :3] = sheared[:, :3, :3] @ np.diag([1.002, 1.0, 0.999])
    np.savez(tmp_path / "a.npz", time=TIMES, pose=sheared)
    recording = recordings.load(tmp_path / "a.npz")
    assert_same_motion(recording)
    assert any(step.startswith("WARNING: poses: renormalised, off by at most 0.002") for step in recording.history)
    sheared[4, :3, :3] *= 1.2
    np.savez(tmp_path / "a.npz", time=TIMES, pose=sheared)
    with pytest.raises(InvalidArgument, match=r"poses\[4\]: singular value = 1\.2"):
        recordings.load(tmp_path / "a.npz")


def test_hand_guided_pouring_reads_by_index_in_centimetres(recorded):
    path = recorded / "robotasks_clfd" / "pouring.npy"
    stated = {"rate": 100.0, "quat_order": "wxyz", "unit": "cm"}
    ends = [recordings.load(path, index=k, **stated).position[-1] for k in range(9)]
    np.testing.assert_allclose(ends, np.tile(ends[0], (9, 1)), atol=1e-9)  # they were shifted to a common point
    assert np.linalg.norm(ends[0]) < 1.5
    for index in (None, 9, -1, "a"):
        with pytest.raises(InvalidArgument, match=r"expected 0 to 8: the array .* holds 9 demonstrations"):
            recordings.load(path, index=index, **stated)
    with pytest.raises(InvalidArgument, match="State unit='mm' or unit='cm'"):
        recordings.load(path, index=0, rate=100.0, quat_order="wxyz")


@pytest.mark.parametrize(
    "array",
    [
        np.array([{"a": 1}] * 9, dtype=object),
        np.array(["text"]),
        np.zeros((12, 5)),
        np.zeros(()),
        np.zeros((0, 4, 4)),
    ],
    ids=["objects", "text", "five columns", "scalar", "empty"],
)
def test_arrays_that_hold_no_poses_are_refused(tmp_path, array):
    np.save(tmp_path / "a.npy", array)
    with pytest.raises(InvalidArgument, match=r"a\.npy"):
        recordings.load(tmp_path / "a.npy", rate=100.0, quat_order="xyzw")


def test_a_header_that_claims_more_than_the_file_holds_takes_no_memory(tmp_path):
    np.save(tmp_path / "a.npy", poses())
    content = (tmp_path / "a.npy").read_bytes()
    (tmp_path / "a.npy").write_bytes(content.replace(b"(12, 4, 4), }         ", b"(12000000000, 4, 4), }"))
    with pytest.raises(InvalidArgument, match="an array of 1536000000000 bytes"):
        recordings.load(tmp_path / "a.npy", rate=10.0)


# ---------------------------------------------------------------- what the caller states


def test_a_lost_sample_is_nan_in_all_of_position_and_rotation():
    position, rotation = corrupted(POSITIONS, 4, np.nan), corrupted(TURNS.as_matrix(), 4, np.nan)
    recording = made(position=position, rotation=rotation)
    assert np.flatnonzero(recording.missing).tolist() == [4]
    assert recording.rate == pytest.approx(10.0)
    with pytest.raises(InvalidArgument, match=r"position\[4, 0\]: nan.*A missing sample is NaN in all of position"):
        made(position=position)
    with pytest.raises(InvalidArgument, match="11 of 12 samples are missing"):
        made(
            position=np.where(np.arange(12)[:, None] > 0, np.nan, POSITIONS),
            rotation=np.where(np.arange(12)[:, None, None] > 0, np.nan, TURNS.as_matrix()),
        )


@pytest.mark.parametrize(("missing", "cell"), [("empty", ""), ("nan", "NaN"), (0, "0.0"), (-9999.0, "-9999")])
def test_lost_samples_of_a_table_are_gaps_once_their_mark_is_stated(tmp_path, missing, cell):
    path = write_csv(tmp_path / "a.csv", rows(), HEADER)
    lines = path.read_text().splitlines()
    lines[4] = ",".join([lines[4].split(",")[0], *[cell] * 7])
    path.write_text("\n".join(lines))
    with pytest.raises(InvalidArgument):
        recordings.load(path)
    recording = recordings.load(path, missing=missing)
    assert np.flatnonzero(recording.missing).tolist() == [3]
    assert "1 of 12 samples are missing (the first: 3)" in recording.history
    np.testing.assert_allclose(recording.rotation[4:], TURNS.as_matrix()[4:], atol=1e-12)


def test_lost_samples_of_an_array_are_gaps_once_stated(tmp_path):
    lost = poses()
    lost[5] = np.nan
    np.savez(tmp_path / "a.npz", time=TIMES, pose=lost)
    with pytest.raises(InvalidArgument, match=r"poses\[5\]"):
        recordings.load(tmp_path / "a.npz")
    assert np.flatnonzero(recordings.load(tmp_path / "a.npz", missing="nan").missing).tolist() == [5]


@pytest.mark.parametrize("missing", ["", True, float("inf")])
def test_an_unknown_mark_of_lost_samples_is_refused(tmp_path, missing):
    path = write_csv(tmp_path / "a.csv", rows(), HEADER)
    with pytest.raises(InvalidArgument, match=r"missing: .*, expected 'empty', 'nan', another word, or a number"):
        recordings.load(path, missing=missing)


EULER = {"time": "time", "x": "x", "y": "y", "z": "z", "rx": "a", "ry": "b", "rz": "c"}


@pytest.mark.parametrize("order", ["ZYX", "XYZ", "zxy"])
@pytest.mark.parametrize("unit", ["deg", "rad"])
def test_angles_about_the_axes_turn_in_the_stated_order(tmp_path, order, unit):
    angles = TURNS.as_euler(order, degrees=unit == "deg")
    by_axis = angles[:, [order.lower().index(axis) for axis in "xyz"]]
    path = write_csv(tmp_path / "a.csv", np.column_stack([TIMES, POSITIONS, by_axis]), list("txyzabc"))
    columns = {**EULER, "time": "t"}
    assert_same_motion(recordings.load(path, columns=columns, euler_order=order, angle_unit=unit))
    with pytest.raises(NotStated, match="euler_order: three numbers rx, ry, rz are Euler angles or a rotation vector"):
        recordings.load(path, columns=columns, angle_unit=unit)
    with pytest.raises(NotStated, match="angle_unit: not stated"):
        recordings.load(path, columns=columns, euler_order=order)
    with pytest.raises(InvalidArgument, match="euler_order: 'XYX'"):
        recordings.load(path, columns=columns, euler_order="XYX", angle_unit=unit)


def test_lines_above_the_header_are_skipped_when_stated(tmp_path):
    path = write_csv(tmp_path / "a.csv", rows(), HEADER)
    path.write_text("Made by\nhand, on a day\n" + path.read_text())
    assert_same_motion(recordings.load(path, skip_lines=2))
    for lines in (-1, 1.5, True):
        with pytest.raises(InvalidArgument, match="skip_lines: .*expected a number of lines"):
            recordings.load(path, skip_lines=lines)


@pytest.mark.parametrize(("up", "mirrored"), [("z", 1), ("y", 2), ("x", 2)])
def test_a_left_handed_world_is_mirrored_sideways(tmp_path, up, mirrored):
    path = write_csv(tmp_path / "a.csv", rows(), HEADER)
    found = recordings.load(path, handedness="left", up_axis=up)
    mirror = np.eye(3)
    mirror[mirrored, mirrored] = -1.0
    np.testing.assert_allclose(found.position, POSITIONS @ mirror, atol=1e-12)
    np.testing.assert_allclose(found.rotation, mirror @ TURNS.as_matrix() @ mirror, atol=1e-12)
    assert f"left-handed world mirrored along {'xyz'[mirrored]}" in found.history
    with pytest.raises(NotStated, match="State up_axis as well"):
        recordings.load(path, handedness="left")
    with pytest.raises(InvalidArgument, match="handedness: 'both', expected 'right' or 'left'"):
        recordings.load(path, handedness="both")


def test_a_motion_too_small_for_its_unit_is_refused_unless_the_unit_is_a_number(tmp_path):
    path = write_csv(tmp_path / "a.csv", rows(scale=0.01), HEADER)  # 1 cm in m
    with pytest.raises(InvalidArgument, match=r"z ranges over 1.1e-05 m only.*taken as mm.*unit=0.001"):
        recordings.load(path, unit="mm")
    assert_same_motion(recordings.load(path, unit=0.001), 1e-5 * POSITIONS)
    still = write_csv(tmp_path / "b.csv", rows(scale=0.0), HEADER)
    assert_same_motion(recordings.load(still), 0.0 * POSITIONS)


def test_what_must_be_stated_is_named_by_the_error(tmp_path):
    path = write_csv(tmp_path / "a.csv", rows()[:, 1:], HEADER[1:])
    with pytest.raises(NotStated) as refused:
        recordings.load(path)
    assert refused.value.names == ("rate",)


# ---------------------------------------------------------------- EuRoC and OpenSim


def test_a_euroc_file_reads_to_the_nanosecond(tmp_path):
    head = "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []"
    stamps = [1_403_636_580_838_555_648 + 5_000_001 * k for k in range(12)]
    lines = [",".join([str(t), *map(repr, map(float, row[1:]))]) for t, row in zip(stamps, rows("wxyz"), strict=True)]
    path = tmp_path / "data.csv"
    path.write_text("\n".join([head, *lines]))
    assert recordings.format_of(path) == "euroc"
    assert_same_motion(recordings.load(path), time=5.000001e-3 * np.arange(12))
    path.write_text("\n".join([head, *lines[:5], "later" + lines[5]]))
    with pytest.raises(InvalidArgument, match="line 7, timestamp: 'later140.*expected a whole number"):
        recordings.load(path)
    path.write_text(head.replace("q_RS_w", "r") + "\n" + lines[0])
    with pytest.raises(InvalidArgument, match="line 1: no column for qw"):
        recordings.load(path)


def test_coordinates_of_a_model_are_refused_until_six_of_them_are_a_pose(recorded):
    path = recorded / "pyomeca" / "inverse_kin.mot"
    with pytest.raises(NotStated, match=r"inverse_kin\.mot: columns: coordinates of a model's joints.*box_transX"):
        recordings.load(path)
    columns = {a: f"box_trans{a.upper()}" for a in "xyz"} | {f"r{a}": f"box_rot{a.upper()}" for a in "xyz"}
    box = recordings.load(path, columns=columns, euler_order="XYZ", up_axis="y")
    angles = np.radians([-89.84738783, -181.00286714, 18.49171606])
    np.testing.assert_allclose(box.rotation[0], Rotation.from_euler("XYZ", angles).as_matrix(), atol=1e-9)
    np.testing.assert_allclose(box.position[0], [0.19682993, 0.0095494, 0.22749238])
    assert len(box) == 88 and "WARNING: the header announces 250 rows, the file holds 88" in box.history
    with pytest.raises(InvalidArgument, match="no column 'boxx'"):
        recordings.load(path, columns={**columns, "x": "boxx"}, euler_order="XYZ")


def test_every_recorded_file_reads_or_says_what_to_state(recorded):
    stated = {
        ".bvh": {"body": "Hips", "unit": "cm"},
        ".npy": {"index": 0, "rate": 100.0, "quat_order": "wxyz", "unit": "cm"},
    }
    columns = {"time": 0, "x": 1, "y": 2, "z": 3, "qw": 10, "qx": 11, "qy": 12, "qz": 13}
    read = set()
    for path in sorted(recorded.glob("*/*.*")):
        if path.suffix == ".md" or path.name.startswith(("PROVENANCE", "LICENSE")):
            continue
        if path.parent.name == "gsutanto_unscrewing":
            assert len(recordings.load(path, columns=columns)) > 1000
        elif path.suffix == ".mot":
            continue  # see above
        elif recordings.bodies(path):
            assert (
                len(recordings.load(path, **{"body": recordings.bodies(path)[0], **stated.get(path.suffix, {})})) >= 8
            )
        else:
            assert len(recordings.markers(path)) >= 8
        read.add(path.suffix)
    assert read == {".bvh", ".npy", ".c3d", ".csv", ".trc", ".tsv", ".txt"}


@pytest.mark.parametrize("place", [-0.4, 0.4])
def test_transposed_matrices_are_refused_whatever_the_sign_of_their_translation(tmp_path, place):
    poses = np.tile(np.eye(4), (20, 1, 1))
    poses[:, 3, :3] = [place, 0.0, 0.0]
    np.save(tmp_path / "poses.npy", poses)
    with pytest.raises(InvalidArgument, match=r"poses\[0\]: last row .* Are the matrices transposed"):
        recordings.load(tmp_path / "poses.npy", rate=100)


@pytest.mark.parametrize("value", [-1e9, 1e9, "-Infinity", "NaN"])
def test_a_clip_with_a_number_that_is_none_names_frame_and_column(tmp_path, value):
    row = ["0.1", *["0.0"] * 43]
    frames = [list(row) for _ in range(10)]
    frames[3][2] = str(value)
    text = ",".join(f"[{','.join(frame)}]" for frame in frames)
    (tmp_path / "clip.txt").write_text(f'{{"Loop": "wrap", "Frames": [{text}]}}')
    with pytest.raises(InvalidArgument, match=r"Frames\[3\]\[2\]: .*expected a finite number"):
        recordings.load(tmp_path / "clip.txt", body="right_hand", format="deepmimic")
