"""Videos as recordings: rendered hands with known truth, and what cannot be read, named in one sentence."""

from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import cameras, recordings
from dmpcpp.cameras import Camera
from dmpcpp.cli import main
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency, NotStated

from benchmarks.hand_model import body_errors, second_camera, seeded_motion

cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed: the extra cameras")
from benchmarks.hand_pictures import pictures_of, write_video  # noqa: E402

LATE = 1.0 / 15.0  # s, of the first frame that both cameras saw
CAMERA = Camera.of_fov(np.radians(70.8), (640, 360))
STATED = {"fov": "70.8deg", "hand_length": "192mm", "up_axis": "image"}


@pytest.fixture(scope="module")
def nets():
    try:
        cameras.net_files()
    except MissingDependency as missing:
        pytest.skip(f"the hand model is not there: {cameras.GET} ({str(missing)[:40]}..)")


@pytest.fixture(scope="module")
def hand(tmp_path_factory, nets):
    """Two videos of one motion, 50 deg apart, the second started 50 ms later, and the motion."""
    folder = tmp_path_factory.mktemp("hand")
    motion = seeded_motion(3, duration=2.0, rate=15.0, facing=25.0)
    late = motion.at(motion.time[:-1] + 0.05)
    write_video(folder / "left.mp4", pictures_of(motion, CAMERA, seed=3), 15.0)
    write_video(folder / "right.mp4", pictures_of(late, CAMERA, second_camera(50), seed=4), 15.0)
    return folder / "left.mp4", folder / "right.mp4", motion


def errors_of(found, motion, begin=0.0):
    """Root mean square errors [m], [rad]; the recording begins at a time of the motion [s]."""
    truth = motion.at(begin + found.time)
    return body_errors(truth.rotation, truth.position, found.rotation, found.position, shape=True)


def plain(path, count=40, size=(160, 90)):
    write_video(path, (np.full((size[1], size[0], 3), 90 + k % 3, np.uint8) for k in range(count)), 15.0)
    return path


def test_two_videos_are_a_recording_as_accurate_as_it_says(hand):
    left, right, motion = hand
    found = recordings.load(left, second_view=right, **STATED)
    assert (found.body, found.up_axis, found.kind) == ("right_hand", "z", "video")
    assert np.ptp(np.diff(found.time)) < 1e-9
    position, angle = errors_of(found, motion, begin=LATE)
    assert position < 0.015
    assert np.degrees(angle) < 8.0
    assert 0.4 < found.accuracy[0] / position < 3.0
    said = "\n".join(found.history)
    for part in ("earlier than left.mp4", "cameras related by the hand", "band-limited", "estimated accuracy"):
        assert part in said
    assert not found.approximate


def test_stated_extrinsics_are_taken(hand, tmp_path):
    left, right, motion = hand
    relation = second_camera(50)
    (tmp_path / "cameras.toml").write_text(
        f"rotation = {relation.rotation.tolist()}\ntranslation = {relation.translation.tolist()}\n"
    )
    found = recordings.load(left, second_view=right, fov="70.8deg", up_axis="z", extrinsics=tmp_path / "cameras.toml")
    position, _ = errors_of(found, motion, begin=LATE)
    assert position < 0.012
    assert not any("related by the hand" in line for line in found.history)


def test_a_left_hand_is_the_mirror_image_of_a_right_one(hand, tmp_path):
    left = hand[0]
    flipped = tmp_path / "flipped.mp4"
    pictures = (np.ascontiguousarray(picture[:, ::-1]) for _, picture in cameras.open_video(left).frames())
    write_video(flipped, pictures, 15.0)
    with pytest.raises(InvalidArgument, match=r"a left hand, or a mirrored video.*body='left_hand'"):
        recordings.load(flipped, **STATED)
    same = recordings.load(left, **STATED)
    other = recordings.load(flipped, body="left_hand", **STATED)
    mirror = np.diag([1.0, -1.0, 1.0])  # the world's sideways axis
    np.testing.assert_allclose(other.position, same.position @ mirror, atol=0.02)
    back = recordings.load(flipped, mirrored=True, **STATED)
    np.testing.assert_allclose(back.position, same.position, atol=0.02)


def test_the_runtime_of_opencv_finds_the_same_hand(hand):
    _, picture = next(iter(cameras.open_video(hand[0]).frames()))
    first = cameras.Tracker().track(picture)
    other = cameras.Tracker("opencv").track(picture)
    np.testing.assert_allclose(other.pixels, first.pixels, atol=0.05)
    assert other.right == pytest.approx(first.right, abs=1e-3)


def test_one_video_is_approximate_or_refused_with_what_to_do(hand):
    left, _, motion = hand
    try:
        found = recordings.load(left, **STATED)
    except InvalidArgument as refused:
        assert "Turn the open palm to the camera, add a second camera" in str(refused)
        return
    assert found.approximate.startswith("approximate: one camera")
    assert errors_of(found, motion)[0] < 0.04


def test_videos_of_two_motions_are_refused(hand, tmp_path):
    other = seeded_motion(8, duration=2.0, rate=15.0, facing=25.0)
    write_video(tmp_path / "other.mp4", pictures_of(other, CAMERA, second_camera(50), seed=4), 15.0)
    with pytest.raises(InvalidArgument, match=r"second_view: other\.mp4 does not show the same hand motion"):
        recordings.load(hand[0], second_view=tmp_path / "other.mp4", **STATED)


def test_two_hands_are_asked_about(tmp_path, nets):
    motion = seeded_motion(1, duration=0.8, rate=15.0, distance=0.9, reach=0.03, turn=5.0)
    one = replace(motion, position=motion.position - [0.2, 0.0, 0.0])
    two = replace(motion, position=motion.position + [0.2, 0.0, 0.0])
    both = (
        np.where(np.arange(640)[None, :, None] < 320, a, b)
        for a, b in zip(pictures_of(one, CAMERA, seed=1), pictures_of(two, CAMERA, seed=1), strict=True)
    )
    write_video(tmp_path / "two.mp4", both, 15.0)
    with pytest.raises(InvalidArgument, match=r"two hands are seen. State which one counts: body='right_hand'"):
        recordings.load(tmp_path / "two.mp4", **STATED)


def test_a_video_without_a_hand_is_refused(tmp_path, nets):
    with pytest.raises(InvalidArgument, match=r"empty\.mp4: a hand is found in 0 of 40 frames"):
        recordings.load(plain(tmp_path / "empty.mp4"), **STATED)


def test_what_a_video_does_not_say_is_asked_for(tmp_path):
    path = plain(tmp_path / "a.mp4", 3)
    with pytest.raises(NotStated, match=r"fov='69deg'"):
        recordings.load(path)
    with pytest.raises(NotStated, match=r"hand_length='190mm'"):
        recordings.load(path, fov="69deg")
    with pytest.raises(NotStated, match=r"up_axis='image'"):
        recordings.load(path, fov="69deg", hand_length="190mm")


@pytest.mark.parametrize(
    ("said", "part"),
    [
        ({"fov": "69"}, r"fov: '69', expected a number with its unit"),
        ({"fov": "200deg"}, "expected the horizontal field of view"),
        ({"hand_length": "19mm"}, "hand_length: 19 mm, expected 120 to 260 mm"),
        ({"up_axis": "up"}, "up_axis: 'up', expected image, board, tag:ID, x, y or z"),
        ({"tag": "zero"}, "tag: 'zero', expected ID:SIZE"),
        ({"tag": "0-4:40mm"}, "add cube:EDGE"),
        ({"board": "5x7"}, "board: '5x7', expected COLUMNSxROWS:SQUARE"),
        ({"extrinsics": "no.toml"}, "extrinsics: with one video it says nothing"),
        ({"body": "foot"}, "no body 'foot' in the file"),
    ],
)
def test_a_wrong_statement_is_named(tmp_path, said, part):
    path = plain(tmp_path / "a.mp4")
    with pytest.raises(InvalidArgument, match=part):
        recordings.load(path, **{**STATED, **said})


def test_what_cannot_be_decoded_and_one_frame_are_refused(tmp_path):
    broken = tmp_path / "broken.mp4"
    broken.write_bytes(b"\x00\x00\x00\x18ftypmp42" + bytes(2000))
    with pytest.raises(InvalidArgument, match=r"broken\.mp4: no frame can be decoded"):
        recordings.load(broken, **STATED)
    with pytest.raises(InvalidArgument, match=r"1 frame\(s\) can be decoded, expected at least 8"):
        recordings.load(plain(tmp_path / "one.mp4", 1), tag="0:60mm", fov="70deg", up_axis="image")
    with pytest.raises(FileError):
        recordings.load(tmp_path / "none.mp4", **STATED)


def test_frames_have_the_true_times_and_one_is_held_at_a_time(tmp_path):
    video = cameras.open_video(plain(tmp_path / "a.mp4", 30))
    times = []
    for time, picture in video.frames():
        times.append(time)
        assert picture.shape == (90, 160, 3)
    np.testing.assert_allclose(times, np.arange(30) / 15.0, atol=2e-3)


def test_a_camera_that_moves_is_named(hand, tmp_path):
    shaken = tmp_path / "shaken.mp4"
    pictures = [picture for _, picture in cameras.open_video(hand[0]).frames()]
    moved = (np.roll(picture, 2 * k, axis=1) for k, picture in enumerate(pictures))
    write_video(shaken, moved, 15.0)
    watched = cameras.watch_hand(cameras.open_video(shaken), CAMERA)
    assert watched.moved > 0.02
    assert cameras.watch_hand(cameras.open_video(hand[0]), CAMERA).moved < 0.004


def test_the_command_writes_nothing_of_what_it_cannot_read(tmp_path):
    path = plain(tmp_path / "a.mp4", 1)
    words = ["imitate", str(path), "--tag", "0:60mm", "--fov", "70deg", "--up", "image", "--arm", "panda"]
    run = CliRunner().invoke(main, [*words, "--out", str(tmp_path / "out")])
    assert run.exit_code == 2
    assert run.output.count("\n") == 1
    assert "Traceback" not in run.output
    assert not (tmp_path / "out").exists()


def test_inspect_asks_for_what_is_missing_in_options(tmp_path):
    run = CliRunner().invoke(main, ["inspect", str(plain(tmp_path / "a.mp4", 3))])
    assert run.exit_code == 3
    assert "--fov 69deg" in run.output
