"""The kinds of files that producers write, each through `dmpcpp inspect`: read as written, or refused with the way out.

Every row makes a file of its kind, states what is stated, and says how the command ends: 0 ready, 3 something is to be
stated or doubted, 2 not readable; what its output names; and, of a file that is read, the samples against the truth.
"""

import json
import re
from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import recordings
from dmpcpp.cli import main
from scipy.spatial.transform import Rotation

COUNT = 200
TIME = 0.01 * np.arange(COUNT)
POSITION = np.column_stack([0.4 + 0.15 * np.sin(TIME), 0.2 * np.cos(2 * TIME), 0.9 + 0.1 * TIME])
TURN = Rotation.from_rotvec(np.column_stack([0.3 * np.sin(TIME), 0.4 * TIME, 0.2 * np.cos(TIME)]))
XYZW = TURN.as_quat()
WXYZ = TURN.as_quat(scalar_first=True)
MATRICES = np.tile(np.eye(4), (COUNT, 1, 1))
MATRICES[:, :3, :3], MATRICES[:, :3, 3] = TURN.as_matrix(), POSITION
READ, ASKED, REFUSED = 0, 3, 2


def table(name, header, *columns, delimiter=","):
    """Return what writes a table; columns of numbers or of text."""

    def make(folder):
        listed = [column for block in columns for column in (block.T if getattr(block, "ndim", 1) == 2 else [block])]
        rows = zip(*[[v if isinstance(v, str) else repr(float(v)) for v in column] for column in listed], strict=True)
        lines = [delimiter.join(row) for row in rows]
        (folder / name).write_text("\n".join(([header] if header else []) + lines) + "\n")
        return folder / name

    return make


def array(content):
    def make(folder):
        np.save(folder / "a.npy", content)
        return folder / "a.npy"

    return make


def named(**arrays):
    def make(folder):
        np.savez(folder / "a.npz", **arrays)
        return folder / "a.npz"

    return make


def hdf5(**arrays):
    def make(folder):
        h5py = pytest.importorskip("h5py")
        with h5py.File(folder / "a.hdf5", "w") as file:
            for name, content in arrays.items():
                file[name.replace("__", "/")] = content
        return folder / "a.hdf5"

    return make


def text(name, content):
    def make(folder):
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        return folder / name

    return make


def twice(*columns):
    """Return columns of two bodies, row by row; the second lies 0.3 m beside the first."""
    shift = np.zeros((COUNT, 7))
    shift[:, 1] = 0.3
    poses = np.column_stack([POSITION, XYZW])
    both = np.stack([poses, poses + shift], axis=1).reshape(2 * COUNT, 7)
    return [*columns, both]


def lost(k, value=0.0):
    position = POSITION.copy()
    position[k] = value
    return position


def jumped():
    position = POSITION.copy()
    position[100:, 0] += 0.4
    return position


def held(begin, end):
    position = POSITION.copy()
    position[begin:end], position[end:] = position[begin], position[end:] + [0.17, 0, 0]
    turn = XYZW.copy()
    turn[begin:end] = turn[begin]
    return position, turn


def marked():
    turn = XYZW.copy()
    turn[30:33] = -9999.0
    return turn


def bursts():
    """Return stamps that were taken at publication: three at once, 10 us apart."""
    return TIME[np.minimum((np.arange(COUNT) // 3 + 1) * 3, COUNT - 1)] + 1e-5 * (np.arange(COUNT) % 3)


BEGIN = datetime(2026, 11, 27, 10, 0, 0, tzinfo=UTC)
ISO = [(BEGIN + timedelta(seconds=float(t))).isoformat(timespec="microseconds") for t in TIME]
FILETIME = [str(133_000_000_000_000_000 + 100_000 * k) for k in range(COUNT)]
NAMES = "x,y,z,qx,qy,qz,qw"
REACH = 0.5 - 0.5 * np.cos(np.pi * np.clip((TIME - 0.6) / 0.8, 0.0, 1.0))
RESTING = np.column_stack([0.3 + 0.2 * REACH, 0.0 * TIME, 0.9 + 0.1 * REACH])
DOWN = Rotation.from_euler("x", 180, degrees=True)

TWO_EPISODES = table(
    "a.csv",
    f"episode_index,time,{NAMES}",
    ["0"] * COUNT + ["1"] * COUNT,
    np.tile(TIME, 2),
    np.tile(np.column_stack([POSITION, XYZW]), (2, 1)),
)

KINDS = {
    # stamps
    "bursts": (table("a.csv", f"time,{NAMES}", bursts(), POSITION, XYZW), "", ASKED, ["bursts", "--rate"]),
    "bursts, rate": (table("a.csv", f"time,{NAMES}", bursts(), POSITION, XYZW), "--rate 100", READ, []),
    "pairs": (
        table(
            "a.csv",
            f"time,{NAMES}",
            (TIME[:, None] + [0.0, 7e-5]).reshape(-1),
            *(np.repeat(v, 2, axis=0) for v in (POSITION, XYZW)),
        ),
        "",
        READ,
        ["pairs"],
    ),
    "iso": (table("a.csv", f"time,{NAMES}", ISO, POSITION, XYZW), "", READ, []),
    "frames only": (table("a.csv", f"frame,{NAMES}", np.arange(COUNT), POSITION, XYZW), "", ASKED, ["--rate"]),
    "frames only, rate": (table("a.csv", f"frame,{NAMES}", np.arange(COUNT), POSITION, XYZW), "--rate 100", READ, []),
    "Seconds, PosX, RotX": (
        table("a.csv", "Seconds,PosX,PosY,PosZ,RotX,RotY,RotZ,RotW", TIME, POSITION, XYZW),
        "--up y",
        READ,
        ["--handedness: right"],
    ),
    "UnixTime(ms), PosX, OrientX": (
        table(
            "a.csv", "UnixTime(ms),PosX,PosY,PosZ,OrientX,OrientY,OrientZ,OrientW", 1.7e12 + 1e3 * TIME, POSITION, XYZW
        ),
        "",
        READ,
        ["--up-axis: y"],
    ),
    "unnamed index": (
        table("a.tsv", "\tTX\tTY\tTZ\tRX\tRY\tRZ", TIME + 5.0, 1e3 * POSITION, TURN.as_euler("xyz"), delimiter="\t"),
        "--unit mm --euler-order xyz --angle-unit rad",
        READ,
        [],
    ),
    # several bodies or takes
    "two hands": (
        table("a.csv", f"hand,time,{NAMES}", ["l", "r"] * COUNT, np.repeat(TIME, 2), *twice()),
        "",
        ASKED,
        ["l, r", "--body l"],
    ),
    "one of two hands": (
        table("a.csv", f"hand,time,{NAMES}", ["l", "r"] * COUNT, np.repeat(TIME, 2), *twice()),
        "--where hand=l",
        READ,
        ["200 of 400 rows"],
    ),
    "objects": (
        table(
            "a.csv",
            "object_uid,timestamp[ns],t_wo_x[m],t_wo_y[m],t_wo_z[m],q_wo_x,q_wo_y,q_wo_z,q_wo_w",
            ["7", "9"] * COUNT,
            np.repeat(1e9 * TIME, 2),
            *twice(),
        ),
        "--body 7",
        READ,
        ["Quest 3 have y up"],
    ),
    "episodes": (
        TWO_EPISODES,
        "",
        ASKED,
        ["episode_index", "2 episodes", "--where episode_index=1"],
    ),
    "one episode": (
        TWO_EPISODES,
        "--episode 1",
        READ,
        [],
    ),
    "times begin anew": (
        table("a.csv", f"time,{NAMES}", np.tile(TIME, 2), np.tile(np.column_stack([POSITION, XYZW]), (2, 1))),
        "",
        ASKED,
        ["2 takes", "--episode 0"],
    ),
    "names twice": (
        table("a.csv", f"time,{NAMES},{NAMES}", TIME, POSITION, XYZW, POSITION, XYZW),
        "",
        ASKED,
        ["twice"],
    ),
    "rest, reach, rest": (
        table("a.csv", f"time,{NAMES}", TIME, RESTING, XYZW[:1].repeat(COUNT, 0)),
        "",
        READ,
        ["1 motion between rests"],
    ),
    # lost samples
    "zeros": (
        table("a.csv", f"time,{NAMES}", TIME, lost(slice(60, 75)), XYZW),
        "",
        READ,
        ["15 samples of exactly 0, 0, 0 taken as lost"],
    ),
    "held, then a jump": (
        table("a.csv", f"time,{NAMES}", TIME, *held(80, 110)),
        "",
        ASKED,
        ["30 samples repeat one value (0.8 to 1.09 s) before a jump of"],
    ),
    "teleport": (table("a.csv", f"time,{NAMES}", TIME, jumped(), XYZW), "", ASKED, ["jumps by 0.4", "0.99 and 1 s"]),
    "a mark": (
        table("a.csv", f"time,{NAMES}", TIME, lost(slice(30, 33), -9999.0), marked()),
        "",
        None,
        ["--missing -9999"],
    ),
    "a mark, stated": (
        table("a.csv", f"time,{NAMES}", TIME, lost(slice(30, 33), -9999.0), marked()),
        "--missing -9999",
        READ,
        ["3 of 200 samples are missing"],
    ),
    # arrays whose meaning nothing tells
    "seven with a gripper": (
        array(np.column_stack([POSITION, 0.5 * TURN.as_euler("xyz"), np.ones(COUNT)])),
        "--rate 100 --quat-order xyzw",
        REFUSED,
        ["gripper"],
    ),
    "seven with a layout": (
        array(np.column_stack([POSITION, TURN.as_euler("xyz"), np.ones(COUNT)])),
        "--rate 100 --layout x,y,z,rx,ry,rz,gripper --euler-order xyz --angle-unit rad",
        READ,
        [],
    ),
    "six": (
        array(np.column_stack([POSITION, TURN.as_rotvec()])),
        "--rate 100",
        ASKED,
        ["rotation vector", "Euler angles", "--layout x,y,z,rotvec"],
    ),
    "six, rotvec": (array(np.column_stack([POSITION, TURN.as_rotvec()])), "--rate 100 --layout x,y,z,rotvec", READ, []),
    "one hand at a time": (named(right_wrist=MATRICES[:, None], timestamps=TIME), "", READ, []),
    "named wrists": (
        named(right_wrist=MATRICES, left_wrist=MATRICES, head=MATRICES, time=TIME),
        "",
        ASKED,
        ["right_wrist, left_wrist, head", "--body"],
    ),
    "axis angle by name": (
        named(robot0_eef_pos=POSITION, robot0_eef_rot_axis_angle=TURN.as_rotvec(), timestamp=TIME),
        "",
        READ,
        [],
    ),
    "order not told": (named(position=POSITION, quaternion=WXYZ, time=TIME), "", ASKED, ["--quat-order"]),
    "order stated": (named(position=POSITION, quaternion=WXYZ, time=TIME), "--quat-order wxyz", READ, []),
    "AMASS": (
        named(trans=POSITION, poses=np.zeros((COUNT, 156)), mocap_framerate=100.0),
        "",
        REFUSED,
        ["AMASS", "rest joints"],
    ),
    "KITTI": (table("a.txt", "", MATRICES[:, :3].reshape(COUNT, 12), delimiter=" "), "--rate 100", READ, []),
    "matrix and FILETIME": (
        table("a.csv", "", FILETIME, np.ones(COUNT), MATRICES.reshape(COUNT, 16)),
        "",
        ASKED,
        ["4 x 4", "--layout"],
    ),
    "matrix and FILETIME, layout": (
        table("a.csv", "", FILETIME, np.ones(COUNT), MATRICES.reshape(COUNT, 16)),
        "--layout time,skip,mat16",
        READ,
        [],
    ),
    # rotations
    "rx ry rz": (table("a.csv", "time,x,y,z,rx,ry,rz", TIME, POSITION, TURN.as_rotvec()), "", ASKED, ["rotvec"]),
    "rx ry rz, rotvec": (
        table("a.csv", "time,x,y,z,rx,ry,rz", TIME, POSITION, TURN.as_rotvec()),
        "--euler-order rotvec --angle-unit rad",
        READ,
        [],
    ),
    "tool down as angles": (
        table(
            "a.csv",
            "time,x,y,z,rx,ry,rz",
            TIME,
            POSITION,
            (Rotation.from_rotvec(0.1 * TURN.as_rotvec()) * DOWN).as_rotvec(),
        ),
        "--euler-order xyz --angle-unit rad",
        None,
        ["rotation vector"],
    ),
    "controller of UR": (
        table(
            "a.csv", "timestamp," + ",".join(f"actual_TCP_pose_{k}" for k in range(6)), TIME, POSITION, TURN.as_rotvec()
        ),
        "",
        READ,
        [],
    ),
    "q0..q3": (table("a.csv", "time,x,y,z,q0,q1,q2,q3", TIME, POSITION, WXYZ), "", ASKED, ["--quat-order"]),
    "q0..q3, w first": (table("a.csv", "time,x,y,z,q0,q1,q2,q3", TIME, POSITION, WXYZ), "--quat-order wxyz", READ, []),
    "q0..q3, w last": (table("a.csv", "time,x,y,z,q0,q1,q2,q3", TIME, POSITION, XYZW), "--quat-order xyzw", READ, []),
    # units and frames
    "millimetres": (table("a.csv", f"time,{NAMES}", TIME, 1e3 * POSITION, XYZW), "", None, ["--unit mm"]),
    "TUM with commas": (table("a.csv", "", TIME + 1.7e9, POSITION, XYZW), "", READ, ["--quat-order: xyzw"]),
    # data sets
    "robomimic": (
        hdf5(
            data__demo_0__obs__robot0_eef_pos=POSITION,
            data__demo_0__obs__robot0_eef_quat=XYZW,
            data__demo_1__obs__robot0_eef_pos=POSITION,
            data__demo_1__obs__robot0_eef_quat=XYZW,
        ),
        "",
        ASKED,
        ["robomimic", "2 episodes", "--episode"],
    ),
    "robomimic, episode": (
        hdf5(
            data__demo_0__obs__robot0_eef_pos=POSITION,
            data__demo_0__obs__robot0_eef_quat=XYZW,
            data__demo_1__obs__robot0_eef_pos=POSITION,
            data__demo_1__obs__robot0_eef_quat=XYZW,
        ),
        "--episode 1 --rate 100",
        READ,
        ["90 deg about z"],
    ),
    "EgoDex": (
        hdf5(transforms__rightHand=MATRICES, transforms__camera=MATRICES),
        "--body rightHand --rate 100",
        READ,
        ["--up-axis: y"],
    ),
    "DROID": (
        hdf5(
            observation__robot_state__cartesian_position=np.column_stack([POSITION, TURN.as_euler("xyz")]),
            observation__timestamp__robot_state__read_start=1_700_000_000_000 + 10 * np.arange(COUNT),
        ),
        "",
        READ,
        [],
    ),
    "ALOHA": (hdf5(observations__qpos=np.zeros((COUNT, 14))), "", ASKED, ["joints"]),
    # what is not read
    "JSON": (text("a.json", json.dumps({"frames": [1, 2]})), "", REFUSED, ["JSON"]),
    "a pickle": (text("a.pkl", b"\x80\x04\x95\x00"), "", REFUSED, ["pickle", "never opened"]),
}


@pytest.mark.parametrize("kind", KINDS)
def test_a_kind_of_file_is_read_as_written_or_refused_with_the_way_out(tmp_path, kind):
    make, stated, ends, names = KINDS[kind]
    path = make(tmp_path)
    done = CliRunner().invoke(main, ["inspect", str(path), *stated.split()])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    output = re.sub(r"\s+", " ", done.output)
    assert ends in (None, done.exit_code), output
    for name in names:
        assert name in output, output
    if ends == READ and kind not in ("rest, reach, rest", "zeros", "a mark, stated"):
        _same_as_written(path, stated)


def _same_as_written(path, stated):
    flags = stated.replace("--up ", "--up-axis ").split()
    words = {name[2:].replace("-", "_"): value for name, value in zip(flags[::2], flags[1::2], strict=True)}
    numbers = {name: float(words[name]) for name in ("rate",) if name in words}
    numbers |= {name: int(words[name]) for name in ("episode",) if name in words}
    found = recordings.load(path, **(words | numbers))
    assert len(found) == COUNT and found.rate == pytest.approx(100.0, rel=1e-3)
    np.testing.assert_allclose(found.time, TIME, atol=2e-6)
    np.testing.assert_allclose(found.position, POSITION, atol=1e-9)
    np.testing.assert_allclose(found.rotation, TURN.as_matrix(), atol=1e-6)
