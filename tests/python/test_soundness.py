"""Samples that are not what they seem, in any format: zeros, held values, jumps, several bodies in one path."""

import numpy as np
import pytest
from dmpcpp import motion, recordings
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.inspection import inspect
from scipy.spatial.transform import Rotation

from tests.python.test_c3d import made

COUNT = 200
TIME = 0.01 * np.arange(COUNT)
HEADER = "time,x,y,z,qx,qy,qz,qw"


def path_of(time=TIME):
    return np.column_stack([0.4 + 0.2 * np.sin(2 * time), 0.1 * np.cos(3 * time), 1.0 + 0.1 * np.sin(time)])


def turns(time=TIME):
    return Rotation.from_rotvec(np.column_stack([0.3 * np.sin(time), 0.2 * time, 0.1 * time])).as_quat()


def table(path, position, quaternion=None, time=TIME, header=HEADER):
    rows = np.column_stack([time, position, turns(time) if quaternion is None else quaternion])
    path.write_text("\n".join([header, *(",".join(repr(float(v)) for v in row) for row in rows)]))
    return path


# ---------------------------------------------------------------- zeros


def test_zeros_among_other_positions_are_lost_in_tables_and_arrays(tmp_path):
    position = path_of()
    position[60:75] = 0.0
    np.savez(tmp_path / "a.npz", position=position, quaternion=turns(), time=TIME)
    table(tmp_path / "a.csv", position)
    for name in ("a.csv", "a.npz"):
        stated = {"quat_order": "xyzw"} if name == "a.npz" else {}
        found = recordings.load(tmp_path / name, **stated)
        assert np.flatnonzero(found.missing).tolist() == list(range(60, 75))
        assert any("15 samples of exactly 0, 0, 0" in note and "missing='nan'" in note for note in found.history)
        kept = recordings.load(tmp_path / name, missing="nan", **stated)
        assert not kept.missing.any()
        np.testing.assert_array_equal(kept.position[60:75], 0.0)


def test_a_motion_through_the_origin_keeps_its_zeros(tmp_path):
    position = path_of() - path_of()[50]
    assert (position[50] == 0.0).all()
    assert not recordings.load(table(tmp_path / "a.csv", position)).missing.any()


def test_zeros_of_a_marker_are_lost_before_a_body_is_computed_from_it(tmp_path):
    sound = recordings.load(made(tmp_path / "a.c3d"), markers=["a", "b", "c"])
    assert not any("0, 0, 0" in note for note in sound.history)


# ---------------------------------------------------------------- held values


def test_a_value_held_until_a_jump_is_lost_and_a_rest_is_not(tmp_path):
    position, quaternion = path_of(), turns()
    position[80:110], quaternion[80:110] = position[80], quaternion[80]
    found = recordings.load(table(tmp_path / "a.csv", position, quaternion))
    assert np.flatnonzero(found.missing).tolist() == list(range(81, 110))
    distance = 1e3 * np.linalg.norm(position[110] - position[80])
    assert any(
        f"30 samples repeat one value (0.8 to 1.09 s) before a jump of {distance:.3g} mm" in n for n in found.history
    )
    clock = np.concatenate([TIME[:80], np.full(30, TIME[80]), TIME[80:170]])
    rest = recordings.load(table(tmp_path / "b.csv", path_of(clock), turns(clock)))
    assert not rest.missing.any()


# ---------------------------------------------------------------- jumps


def test_a_step_that_no_hand_makes_is_refused_with_its_time(tmp_path):
    position = path_of()
    position[120:] += [0.3, 0.0, 0.0]
    found = recordings.load(table(tmp_path / "a.csv", position))
    with pytest.raises(
        InvalidArgument, match=r"jumps by 0\.\d+ m in one step between 1\.19 and 1\.2 s.*end=1\.19 or start=1\.2"
    ):
        motion.plausible(found)
    assert not inspect(tmp_path / "a.csv").ok
    assert motion.implausible(motion.crop(found, 1.2)) == "" and motion.implausible(motion.crop(found, 0.0, 1.19)) == ""


@pytest.mark.parametrize("pace", [1.0, 8.0, 20.0])
def test_a_fast_motion_is_no_jump(tmp_path, pace):
    assert motion.implausible(recordings.load(table(tmp_path / "a.csv", path_of(pace * TIME)))) == ""


# ---------------------------------------------------------------- several bodies


def test_two_bodies_in_alternate_rows_are_refused_without_a_key(tmp_path):
    position = path_of() + 0.15 * np.array([(-1) ** k for k in range(COUNT)])[:, None] * [0.0, 1.0, 0.0]
    with pytest.raises(NotStated, match="% of the steps turn back: rows of several bodies"):
        recordings.load(table(tmp_path / "a.csv", position))


@pytest.mark.parametrize("noise", [1e-3, 5e-3, 2e-2])
def test_noise_turns_back_too_and_is_not_taken_for_two_bodies(tmp_path, noise):
    position = path_of() + noise * np.random.default_rng(3).normal(size=(COUNT, 3))
    assert len(recordings.load(table(tmp_path / "a.csv", position))) == COUNT
