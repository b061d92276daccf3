"""Long tables: rows of several bodies or takes told apart by a column, and names that stand twice."""

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import recordings
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.inspection import inspect
from scipy.spatial.transform import Rotation

COUNT = 40
TIME = 0.02 * np.arange(COUNT)
POSE = np.column_stack(
    [
        0.3 + 0.1 * np.sin(TIME),
        0.2 * TIME,
        0.9 + 0.0 * TIME,
        Rotation.from_rotvec(np.outer(TIME, [0, 0.4, 0])).as_quat(),
    ]
)
NAMES = "x,y,z,qx,qy,qz,qw"


def shifted(by):
    return POSE + np.array([0.0, by, 0.0, 0.0, 0.0, 0.0, 0.0])


def write(path, header, rows):
    path.write_text("\n".join([header, *(",".join(map(str, row)) for row in rows)]))
    return path


def long(path, key="hand", values=("left", "right"), delay=0.0):
    """Rows of several bodies in turn, each 0.2 m beside the one before."""
    rows = [
        (float(TIME[k]) + n * delay, value, *map(float, shifted(0.2 * n)[k]))
        for k in range(COUNT)
        for n, value in enumerate(values)
    ]
    return write(path, f"time,{key},{NAMES}", rows)


@pytest.mark.parametrize("delay", [0.0, 0.007])
@pytest.mark.parametrize(
    ("key", "values"), [("hand", ("left", "right")), ("object_uid", (17, 4, 99)), ("tag", ("a", "b"))]
)
def test_rows_of_several_bodies_are_told_apart_and_chosen(tmp_path, key, values, delay):
    path = long(tmp_path / "a.csv", key, values, delay)
    assert recordings.bodies(path) == tuple(map(str, values))
    with pytest.raises(NotStated, match=f"where: the column '{key}' tells the rows of .*{values[0]}, {values[1]}"):
        recordings.load(path)
    for n, value in enumerate(values):
        for stated in ({"where": f"{key}={value}"}, {"where": {key: value}}, {"body": str(value)}):
            found = recordings.load(path, **stated)
            np.testing.assert_allclose(found.position, shifted(0.2 * n)[:, :3], atol=1e-15)
            np.testing.assert_allclose(found.time, TIME, atol=1e-12)
    report = inspect(path)
    assert [body.name for body in report.bodies] == list(map(str, values)) and "body" in report.needed


@pytest.mark.parametrize("restart", [True, False])
def test_takes_below_each_other_are_told_apart_by_their_column(tmp_path, restart):
    rows = [
        (take, float(TIME[k]) + (0 if restart else 2 * take), *map(float, shifted(0.1 * take)[k]))
        for take in (1, 2, 3)
        for k in range(COUNT)
    ]
    path = write(tmp_path / "a.csv", f"trial,time,{NAMES}", rows)
    with pytest.raises(NotStated, match="'trial' tells the rows of 3 takes or episodes apart: 1, 2, 3"):
        recordings.load(path)
    for stated in ({"where": "trial=2"}, {"episode": 2}):
        np.testing.assert_allclose(recordings.load(path, **stated).position, shifted(0.2)[:, :3], atol=1e-15)


def test_flags_and_counters_are_no_keys(tmp_path):
    rows = [
        (float(TIME[k]), k, k % 7 if k < 20 else 3, "normal" if k != 5 else "limited", *map(float, POSE[k]))
        for k in range(COUNT)
    ]
    path = write(tmp_path / "a.csv", f"time,frame,button,tracking_state,{NAMES}", rows)
    assert len(recordings.load(path)) == COUNT
    assert len(recordings.load(path, where="tracking_state=normal")) == COUNT - 1


def test_a_column_or_value_that_is_not_there_is_refused_with_those_that_are(tmp_path):
    path = long(tmp_path / "a.csv")
    with pytest.raises(InvalidArgument, match=r"where: no row with hand=both. The column holds: left, right"):
        recordings.load(path, where="hand=both")
    with pytest.raises(InvalidArgument, match=r"where: no column 'foot'. The file holds: time, hand"):
        recordings.load(path, where="foot=left")
    with pytest.raises(InvalidArgument, match="expected COLUMN=VALUE"):
        recordings.load(path, where="left")


def test_a_name_that_stands_twice_is_refused_and_numbers_reach_both(tmp_path):
    rows = np.column_stack([TIME, POSE, shifted(0.5)])
    path = write(tmp_path / "a.csv", f"time,{NAMES},{NAMES}", rows.tolist())
    with pytest.raises(NotStated, match="the name 'x' stands twice in the header, in the columns 1 and 8"):
        recordings.load(path)
    for first, by in ((1, 0.0), (8, 0.5)):
        columns = {"time": 0, **{name: first + k for k, name in enumerate(NAMES.split(","))}}
        np.testing.assert_allclose(recordings.load(path, columns=columns).position, shifted(by)[:, :3], atol=1e-15)


def test_the_commands_name_the_option_that_chooses_and_it_works(tmp_path):
    path = long(tmp_path / "a.csv")
    for command in ("fit", "imitate"):
        refused = CliRunner().invoke(main, [command, str(path), "--out", str(tmp_path / "out")])
        assert refused.exit_code == 2 and "--where hand=right" in refused.output
    assert CliRunner().invoke(main, ["inspect", str(path), "--where", "hand=right"]).exit_code == 0


def test_positions_of_a_table_are_markers(tmp_path):
    random = np.random.default_rng(2)
    shape = random.normal(size=(4, 3)) * 0.05
    turn = Rotation.from_quat(POSE[:, 3:]).as_matrix()
    points = POSE[:, None, :3] + np.einsum("tij,mj->tmi", turn, shape)
    header = ",".join(["frame", *(f"{name}_{axis}" for name in ("WRIST", "THUMB", "INDEX", "PINKY") for axis in "xyz")])
    path = write(tmp_path / "a.csv", header, np.column_stack([np.arange(COUNT), points.reshape(COUNT, 12)]).tolist())
    found = recordings.load(path, markers=["WRIST", "INDEX", "PINKY"], rate=50.0)
    relative = np.einsum("ji,tjk->tik", found.rotation[0], found.rotation)
    to_body = found.rotation[0].T @ turn[0]
    expected = to_body @ np.einsum("ji,tjk->tik", turn[0], turn) @ to_body.T
    np.testing.assert_allclose(relative, expected, atol=1e-9)
    assert recordings.markers(path, rate=50.0).names == ("WRIST", "THUMB", "INDEX", "PINKY")


@pytest.mark.parametrize(
    ("name", "values", "where", "kept"),
    [
        ("hand_visible", ["true", "false"], "hand_visible=true", lambda k: k % 2 == 0),
        ("valid", ["1", "0"], "valid=1", lambda k: k % 2 == 0),
        ("occluded", ["1", "0"], "occluded=0", lambda k: k % 2 == 1),
        ("tracking_confidence", [f"{k / 20}" for k in range(21)], "tracking_confidence>=0.5", lambda k: k % 21 >= 10),
        ("confidence", [str(5 * k) for k in range(21)], "confidence>=50", lambda k: k % 21 >= 10),
    ],
)
def test_a_column_that_says_which_samples_count_is_offered_by_name(tmp_path, name, values, where, kept):
    path = tmp_path / "a.csv"
    rows = [f"{0.02 * k},{0.3 + 0.002 * k},0.1,0.9,0,0,0,1,{values[k % len(values)]}" for k in range(100)]
    path.write_text("\n".join([f"time,x,y,z,qx,qy,qz,qw,{name}", *rows]))
    found = recordings.load(path)
    (warned,) = [note for note in found.history if note.about == "where"]
    count = sum(not kept(k) for k in range(100))
    assert warned.kind == "warning" and f"{name!r} says of {count} of 100 rows that they do not count" in warned
    assert f"where='{where}' leaves them out" in warned
    chosen = recordings.load(path, where=where)
    np.testing.assert_allclose(chosen.position[:, 0], [0.3 + 0.002 * k for k in range(100) if kept(k)])
    assert not [note for note in chosen.history if note.about == "where"]
    done = CliRunner().invoke(main, ["inspect", str(path)])
    assert f"--where {where}" in done.output.replace("\n", " ")


def test_states_of_tracking_are_listed_and_flags_of_another_body_are_not(tmp_path):
    path = tmp_path / "a.csv"
    names = ",".join(f"{side}_{axis}" for side in ("left", "right") for axis in ("x", "y", "z", "qx", "qy", "qz", "qw"))
    pose = "0.1,0.9,0,0,0,1"
    rows = [
        f"{0.02 * k},{k},{pose},{k},{pose},{k % 2},{k % 3}".replace(f"{k},0.1", f"{0.01 * k},0.1") for k in range(60)
    ]
    path.write_text("\n".join([f"time,{names},left_visible,right_tracking_state", *rows]))
    (left,) = [note for note in recordings.load(path, "left").history if note.about == "where"]
    assert "'left_visible' says of 30 of 60 rows" in left
    (right,) = [note for note in recordings.load(path, "right").history if note.about == "where"]
    assert "'right_tracking_state' holds 0, 1, 2, and all rows are used" in right


def test_rows_are_compared_with_numbers(tmp_path):
    path = tmp_path / "a.csv"
    rows = [f"{0.02 * k},{0.01 * k},0.1,0.9,0,0,0,1,{k}" for k in range(60)]
    path.write_text("\n".join(["time,x,y,z,qx,qy,qz,qw,level", *rows]))
    for where, kept in (("level<20", range(20)), ("level>40", range(41, 60)), ("level<=20", range(21))):
        chosen = recordings.load(path, where=where)
        np.testing.assert_allclose(chosen.position[:, 0], [0.01 * k for k in kept])
    assert len(recordings.load(path, where="level!=30")) == 59
    assert len(recordings.load(path, where={"level": ">=30"})) == 30
    with pytest.raises(InvalidArgument, match="no row with level>99"):
        recordings.load(path, where="level>99")
