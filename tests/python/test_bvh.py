"""BVH: forward kinematics against an independent package and closed forms, and files that are refused."""

import warnings

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument, NotStated
from scipy.spatial.transform import Rotation

FILES = ["bvh_python/test_mocapbank.bvh", "bvh_toolbox/walk01.bvh", "cmu_fairmotion/01_01_first600.bvh"]

SKELETON = """HIERARCHY
ROOT Hips
{
\tOFFSET 1 2 3
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT mixamorig:Arm {
\t\tOFFSET 0 10 0
\t\tCHANNELS 4 Yrotation Xrotation Zrotation Yposition
\t\tJOINT Hand
\t\t{
\t\t\tOFFSET 5.0e0 0 0
\t\t\tCHANNELS 3 Xrotation Yrotation Zrotation
\t\t\tEnd Site
\t\t\t{
\t\t\t\tOFFSET 0 0 1
\t\t\t}
\t\t}
\t}
}
"""


def written(path, frames, time=".0083333", skeleton=SKELETON, announced=None):
    rows = "\n".join("\t".join(f"{v:.9e}" for v in row) for row in frames)
    count = len(frames) if announced is None else announced
    path.write_bytes(f"{skeleton}MOTION\nFrames:\t{count}\nFrame Time: {time}\n{rows}\n".replace("\n", "\r\n").encode())
    return path


FRAMES = np.random.default_rng(2).uniform(-60.0, 60.0, (12, 13))


def test_a_chain_is_the_product_of_its_transforms(tmp_path):
    path = written(tmp_path / "a.bvh", FRAMES)
    assert recordings.bodies(path) == ("Hips", "mixamorig:Arm", "Hand")
    hand = recordings.load(path, "Hand", unit="cm", up_axis="y")
    hips = Rotation.from_euler("ZXY", FRAMES[:, 3:6], degrees=True)
    arm = hips * Rotation.from_euler("YXZ", FRAMES[:, 6:9], degrees=True)
    shift = np.column_stack([np.zeros(12), FRAMES[:, 9], np.zeros(12)])  # the channel in place of the offset's 10
    expected = FRAMES[:, :3] + hips.apply(shift) + arm.apply([5.0, 0.0, 0.0])
    np.testing.assert_allclose(hand.position, 0.01 * expected, atol=1e-9)
    turned = arm * Rotation.from_euler("XYZ", FRAMES[:, 10:13], degrees=True)
    np.testing.assert_allclose(hand.rotation, turned.as_matrix(), atol=1e-9)
    assert hand.rate == pytest.approx(1 / 0.0083333)


@pytest.mark.parametrize("name", FILES)
def test_every_joint_stands_where_an_independent_package_puts_it(recorded, name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # its own import of another package is deprecated
        bvhio = pytest.importorskip("bvhio")
    path = recorded / name
    oracle = bvhio.readAsHierarchy(str(path))
    found = {body: recordings.load(path, body, unit="cm") for body in recordings.bodies(path)}
    checked = 0
    for frame in (0, 33, 100):
        oracle.loadPose(frame)
        for joint, _, _ in oracle.layout():
            if joint.Name in found:
                place = 0.01 * np.array(joint.PositionWorld.to_tuple())
                np.testing.assert_allclose(found[joint.Name].position[frame], place, atol=1e-5, err_msg=joint.Name)
                checked += 1
    assert checked == 3 * len(found)


@pytest.mark.parametrize("name", FILES)
def test_every_joint_turns_as_its_channels_say(recorded, name):
    parser = pytest.importorskip("bvh")
    path = recorded / name
    parsed = parser.Bvh(path.read_text())
    frames = np.array(parsed.frames, dtype=float)
    turned = {}
    for body in parsed.get_joints_names():  # parents stand before their children
        channels = parsed.joint_channels(body)
        first = parsed.get_joint_channels_index(body)
        turns = [k for k, channel in enumerate(channels) if channel.endswith("rotation")]
        order = "".join(channels[k][0] for k in turns)
        turn = Rotation.from_euler(order, frames[:, [first + k for k in turns]], degrees=True)
        parent = parsed.joint_parent(body)
        turned[body] = turn if parent is None else turned[parent.name] * turn
        found = recordings.load(path, body, unit="cm")
        np.testing.assert_allclose(found.rotation, turned[body].as_matrix(), atol=1e-9, err_msg=body)


def test_the_unit_of_a_bvh_must_be_stated(tmp_path):
    path = written(tmp_path / "a.bvh", FRAMES)
    with pytest.raises(NotStated, match=r"a\.bvh: unit: a BVH file does not say its unit") as refused:
        recordings.load(path, "Hips")
    assert refused.value.names == ("unit",)
    cmu = recordings.load(path, "Hips", unit=0.056444)  # inches over 0.45
    np.testing.assert_allclose(cmu.position, 0.056444 * FRAMES[:, :3], atol=1e-9)


def test_fewer_frames_than_announced_are_said(tmp_path):
    found = recordings.load(written(tmp_path / "a.bvh", FRAMES, announced=99), "Hips", unit="cm")
    assert "WARNING: 99 frames announced, 12 there" in found.history


DAMAGED = {
    "no motion": (lambda t: t.replace("MOTION", "NOTION"), "no line MOTION"),
    "unknown word": (lambda t: t.replace("OFFSET 0 10 0", "OFSET 0 10 0"), "line 7: 'OFSET', expected JOINT"),
    "unknown channel": (lambda t: t.replace("4 Yrotation", "4 Wrotation"), "line 8: channels Wrotation"),
    "channel twice": (lambda t: t.replace("4 Yrotation", "4 Xrotation"), "expected different ones"),
    "many channels": (
        lambda t: t.replace("CHANNELS 4", "CHANNELS 400000"),
        "line 8: '400000' channels, expected 0 to 6",
    ),
    "no name": (lambda t: t.replace("JOINT Hand", "JOINT"), "line 9|line 10"),
    "a name twice": (lambda t: t.replace("JOINT Hand", "JOINT Hips"), "a joint called 'Hips'"),
    "an offset of text": (lambda t: t.replace("0 10 0", "0 ten 0"), "line 7, OFFSET: 'ten', expected a number"),
    "an open brace": (lambda t: t.replace("\t}\r\n}", "\t}\r\n"), "ends in the middle"),
    "a brace too many": (lambda t: t.replace("HIERARCHY", "HIERARCHY }"), "line 1: outside of any joint"),
    "a second root": (lambda t: t.replace("JOINT Hand", "ROOT Hand"), "a ROOT inside of a joint"),
    "no frame time": (lambda t: t.replace("Frame Time:", "Time:"), "line 22: .*expected 'Frame Time:'"),
    "a frame time of 0": (lambda t: t.replace(".0083333", "0"), "line 22: a frame time of 0 s"),
    "half a frame": (lambda t: t[:-40], "numbers, expected 13 as there are that many channels"),
    "no frames": (lambda t: t[: t.index("Frame Time")], "behind MOTION"),
}


@pytest.mark.parametrize(("damage", "message"), DAMAGED.values(), ids=DAMAGED)
def test_a_damaged_bvh_is_refused_with_its_line(tmp_path, damage, message):
    path = written(tmp_path / "a.bvh", FRAMES)
    path.write_bytes(damage(path.read_bytes().decode()).encode())
    with pytest.raises(InvalidArgument, match=message):
        recordings.load(path, "Hand", format="bvh", unit="cm")
