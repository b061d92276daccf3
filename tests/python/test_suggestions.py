"""Every suggestion that a message makes is followed, and leads on: to a motion, or to a question that is new."""

import re
import shlex

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp.cli import main
from scipy.spatial.transform import Rotation

COUNT = 120
TIME = 0.02 * np.arange(COUNT)
POSITION = np.column_stack([0.3 + 0.15 * np.sin(TIME), 0.2 * np.cos(TIME), 0.9 + 0.1 * TIME])
TURN = Rotation.from_rotvec(np.column_stack([0.3 * np.sin(TIME), 0.4 * TIME, 0.2 * np.cos(TIME)]))
QUATERNION = TURN.as_quat()
NAMES = "x,y,z,qx,qy,qz,qw"
_FLAG = re.compile(r"--([a-z][a-z-]+)(?: ((?!--)[^\s;)]+))?")
_SWITCHES = {"fixed-orientation", "mend-times", "sort-times"}


def text(path, header, columns, delimiter=","):
    rows = [delimiter.join(str(v) if isinstance(v, str) else repr(float(v)) for v in row) for row in columns]
    path.write_text("\n".join(([header] if header else []) + rows))
    return path


def stacked(*columns):
    return np.column_stack(columns).tolist()


def bursts(path):
    stamps = TIME[np.minimum((np.arange(COUNT) // 3 + 1) * 3, COUNT) - 1] + 1e-6 * (np.arange(COUNT) % 3)
    return text(path / "a.csv", f"time,{NAMES}", stacked(stamps, POSITION, QUATERNION))


def no_times(path):
    return text(path / "a.csv", NAMES, stacked(POSITION, QUATERNION))


def numbered_quaternion(path):
    return text(path / "a.csv", "time,x,y,z,q0,q1,q2,q3", stacked(TIME, POSITION, TURN.as_quat(scalar_first=True)))


def three_numbers(path):
    return text(path / "a.csv", "time,x,y,z,rx,ry,rz", stacked(TIME, POSITION, TURN.as_rotvec()))


def rotation_vector_in_degrees(path):
    return text(
        path / "a.csv", "time,x,y,z,rotvec_x,rotvec_y,rotvec_z", stacked(TIME, POSITION, 200 * TURN.as_rotvec())
    )


def positions_only(path):
    return text(path / "a.csv", "time,x,y,z", stacked(TIME, POSITION))


def two_hands(path):
    rows = []
    for k in range(COUNT):
        for hand, shift in (("left", -0.2), ("right", 0.2)):
            rows.append([TIME[k], hand, *(POSITION[k] + [0, shift, 0]), *QUATERNION[k]])
    return text(path / "a.csv", f"time,hand,{NAMES}", rows)


def takes(path):
    rows = [[str(take), TIME[k], *(POSITION[k] + 0.01 * take), *QUATERNION[k]] for take in (1, 2) for k in range(COUNT)]
    return text(path / "a.csv", f"take,time,{NAMES}", rows)


def takes_without_a_name(path):
    twice = np.concatenate([TIME, TIME])
    return text(path / "a.csv", f"time,{NAMES}", stacked(twice, np.tile(POSITION, (2, 1)), np.tile(QUATERNION, (2, 1))))


def millimetres(path):
    return text(path / "a.csv", f"time,{NAMES}", stacked(TIME, 1000 * POSITION, QUATERNION))


def milliseconds(path):
    return text(path / "a.csv", f"time,{NAMES}", stacked(1000 * TIME, POSITION, QUATERNION))


def a_gap(path):
    rows = stacked(TIME, POSITION, QUATERNION)
    return text(path / "a.csv", f"time,{NAMES}", rows[:50] + rows[70:])


def a_jump(path):
    position = POSITION.copy()
    position[60:, 0] += 0.5
    return text(path / "a.csv", f"time,{NAMES}", stacked(TIME, position, QUATERNION))


def some_misplaced(path):
    order = np.arange(COUNT)
    order[[40, 41]] = 41, 40
    return text(path / "a.csv", f"time,{NAMES}", stacked(TIME[order], POSITION[order], QUATERNION[order]))


def cut_off_times(path):
    return text(path / "a.csv", f"time,{NAMES}", stacked(np.floor(10 * TIME) / 10, POSITION, QUATERNION))


def lost_marks(path):
    position = POSITION.copy()
    position[30:33] = -9999.0
    quaternion = QUATERNION.copy()
    quaternion[30:33] = -9999.0
    return text(path / "a.csv", f"time,{NAMES}", stacked(TIME, position, quaternion))


def matrices_without_names(path):
    poses = np.tile(np.eye(4), (COUNT, 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = TURN.as_matrix(), POSITION
    return text(path / "a.csv", "", stacked(TIME, poses.reshape(COUNT, 16)))


def array_of_six(path):
    np.save(path / "a.npy", np.column_stack([POSITION, TURN.as_rotvec()]))
    return path / "a.npy"


def array_of_seven(path):
    np.save(path / "a.npy", np.column_stack([POSITION, QUATERNION]))
    return path / "a.npy"


def angles_and_gripper(path):
    np.save(path / "a.npy", np.column_stack([POSITION, 0.5 * TURN.as_euler("xyz"), np.ones(COUNT)]))
    return path / "a.npy"


def demonstrations(path):
    np.save(path / "a.npy", np.stack([np.column_stack([POSITION, QUATERNION])] * 3))
    return path / "a.npy"


def named_arrays(path):
    poses = np.tile(np.eye(4), (COUNT, 1, 1))
    poses[:, :3, :3], poses[:, :3, 3] = TURN.as_matrix(), POSITION
    np.savez(path / "a.npz", right_wrist=poses, left_wrist=poses, time=TIME)
    return path / "a.npz"


def hdf5_of_episodes(path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(path / "a.hdf5", "w") as file:
        for k in range(2):
            file[f"data/demo_{k}/obs/robot0_eef_pos"] = POSITION
            file[f"data/demo_{k}/obs/robot0_eef_quat"] = QUATERNION
    return path / "a.hdf5"


FILES = (
    bursts,
    no_times,
    numbered_quaternion,
    three_numbers,
    rotation_vector_in_degrees,
    positions_only,
    two_hands,
    takes,
    takes_without_a_name,
    millimetres,
    milliseconds,
    a_gap,
    a_jump,
    some_misplaced,
    cut_off_times,
    lost_marks,
    matrices_without_names,
    array_of_six,
    array_of_seven,
    angles_and_gripper,
    demonstrations,
    named_arrays,
    hdf5_of_episodes,
)


def suggested(output):
    """Return the options that lines about what is missing or wrong propose, each with its value."""
    asked = [line for line in output.splitlines() if not line.startswith(("taken:", "  "))]
    found = {}
    for name, value in _FLAG.findall("\n".join(asked)):
        value = value.rstrip(".,:'")
        if name in _SWITCHES:
            found.setdefault(name, "")
        elif value and value not in ("...", "or", "and", "to") and "..." not in value:
            found.setdefault(name, value)
    return found


def followed(command, path, options):
    """Return the outcome of a command with options, and the options that it proposes."""
    arguments = [command, str(path)]
    for name, value in options.items():
        arguments += [f"--{name}", *([value] if value else [])]
    done = CliRunner().invoke(main, arguments)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done


@pytest.mark.parametrize("make", FILES)
def test_following_what_is_suggested_leads_to_a_motion(tmp_path, make):
    path = make(tmp_path)
    options, said = {}, []
    for _ in range(4):
        done = followed("inspect", path, options)
        if done.exit_code == 0:
            break
        assert done.output not in said, f"{shlex.join(map(str, options.items()))}: the same again:\n{done.output}"
        said.append(done.output)
        new = {name: value for name, value in suggested(done.output).items() if name not in options}
        assert new, f"nothing new to do is said, after {options}:\n{done.output}"
        name = next(iter(new))
        options[name] = new[name]
        options |= {n: v for n, v in new.items() if n in ("euler-order", "angle-unit") and name == "layout"}
    assert done.exit_code == 0, f"after {options}:\n{done.output}"
    assert said, "the file was to be refused first"
