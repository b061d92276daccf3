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
