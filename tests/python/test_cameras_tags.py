"""Printed tags: exact pictures of them, cubes with a face that was read wrongly, and sheets to print."""

import re

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import cameras, recordings
from dmpcpp.cameras import Camera, TagFinder
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument
from scipy.spatial.transform import Rotation

cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed: the extra cameras")
from benchmarks.hand_pictures import write_video  # noqa: E402
from benchmarks.tag_pictures import draw_tags  # noqa: E402

CAMERA = Camera.of_fov(np.radians(70.8), (1280, 720))
FACING = Rotation.from_rotvec([np.pi, 0.0, 0.0])


def pose(rng, distance):
    axis = np.r_[rng.normal(size=2), 0.0]
    tilt = Rotation.from_rotvec(np.radians(rng.uniform(5.0, 50.0)) * axis / np.linalg.norm(axis))
    turn = tilt * FACING * Rotation.from_rotvec([0.0, 0.0, rng.uniform(-3.0, 3.0)])
    return turn.as_matrix(), np.array([rng.uniform(-0.15, 0.15), rng.uniform(-0.1, 0.1), distance])


def errors(found, rotation, position):
    angle = Rotation.from_matrix(found[0].T @ rotation).magnitude()
    return 1e3 * np.linalg.norm(found[1] - position), np.degrees(angle)


@pytest.mark.parametrize("said", ["0:60mm", "0-4:40mm,cube:50mm"])
def test_a_tag_and_a_cube_of_tags_measure_to_parts_of_a_millimetre(said):
    tags, rng, found = cameras.body_of_tags(said), np.random.default_rng(2), []
    for seed in range(12):
        rotation, position = pose(rng, 0.7)
        finder = TagFinder(tags, CAMERA)
        found.append(errors(finder.find(draw_tags(CAMERA, tags, rotation, position, seed=seed)), rotation, position))
    assert np.max(found, axis=0)[0] < 0.5
    assert np.max(found, axis=0)[1] < 0.3


def test_the_lens_is_taken_out_of_the_edges():
    lens = Camera(CAMERA.matrix, CAMERA.size, np.array([-0.15, 0.03, 1e-3, -1e-3, 0.0]))
    tags = cameras.body_of_tags("3:60mm")
    rotation, position = pose(np.random.default_rng(0), 0.5)
    position[:2] = 0.18, 0.1
    found = TagFinder(tags, lens).find(draw_tags(lens, tags, rotation, position))
    assert errors(found, rotation, position)[0] < 0.5


def test_a_face_that_is_read_wrongly_is_left_out():
    tags = cameras.body_of_tags("0-4:40mm,cube:50mm")
    rotation = (
        Rotation.from_euler("x", 40, degrees=True) * FACING * Rotation.from_euler("z", 30, degrees=True)
    ).as_matrix()
    position = np.array([0.02, 0.0, 0.6])
    finder = TagFinder(tags, CAMERA)
    picture = draw_tags(CAMERA, tags, rotation, position)
    right = finder.corners(picture)
    assert len(right) >= 2
    smallest = min(right, key=lambda each: np.ptp(right[each], axis=0).prod())
    wrong = {**right, smallest: right[smallest] + [[6.0, -5.0], [-4.0, 3.0], [5.0, 2.0], [0.0, 4.0]]}
    finder.corners = lambda picture: wrong
    found = finder.find(picture)
    assert finder.rejected == 1
    assert errors(found, rotation, position)[0] < 1.0


def test_of_two_poses_the_one_near_the_last_is_taken():
    tags = cameras.body_of_tags("0:40mm")
    finder = TagFinder(tags, CAMERA)
    turns = [Rotation.from_euler("x", 8.0 * np.sin(k / 4.0), degrees=True) * FACING for k in range(20)]
    for k, turn in enumerate(turns):
        position = np.array([0.1, 0.05, 1.2])
        found = finder.find(draw_tags(CAMERA, tags, turn.as_matrix(), position, seed=k))
        assert k == 0 or errors(found, turn.as_matrix(), position)[1] < 10.0


def test_a_video_of_a_tag_is_a_recording_in_a_level_world(tmp_path):
    camera = Camera.of_fov(np.radians(60.0), (640, 360))
    tags, time = cameras.body_of_tags("7:80mm"), np.arange(40) / 20.0
    places = np.stack([0.1 * np.sin(2.0 * time), 0.05 * np.cos(2.0 * time), 0.6 + 0.0 * time], axis=1)
    turns = Rotation.from_rotvec(np.outer(np.radians(20.0) * np.sin(time), [0.0, 1.0, 0.0])) * FACING
    pictures = (
        draw_tags(camera, tags, r.as_matrix(), p, seed=k) for k, (r, p) in enumerate(zip(turns, places, strict=True))
    )
    write_video(tmp_path / "tag.mp4", pictures, 20.0)
    found = recordings.load(tmp_path / "tag.mp4", tag="7:80mm", fov="60deg", up_axis="image")
    assert (found.body, found.up_axis) == ("tag_7", "z")
    expected = np.stack([places[:, 2], -places[:, 0], -places[:, 1]], axis=1)
    wanted = np.stack([np.interp(found.time, time, column) for column in expected.T], axis=1)
    assert np.linalg.norm(found.position - wanted, axis=1)[3:-3].max() < 0.003
    assert any("tag found in 40 of 40 frames" in line for line in found.history)
    assert 0.0 < found.accuracy[0] < 0.003
    with pytest.raises(InvalidArgument, match=r"tag: 8 of the family 36h11 found in 0 of 40 frames"):
        recordings.load(tmp_path / "tag.mp4", tag="8:80mm", fov="60deg", up_axis="image")


def test_a_blurred_tag_is_named(tmp_path):
    camera = Camera.of_fov(np.radians(60.0), (640, 360))
    tags = cameras.body_of_tags("7:80mm")
    pictures = (
        draw_tags(camera, tags, FACING.as_matrix(), np.array([0.002 * k, 0.0, 0.5]), blur=6.0) for k in range(20)
    )
    write_video(tmp_path / "tag.mp4", pictures, 20.0)
    found = recordings.load(tmp_path / "tag.mp4", tag="7:80mm", fov="60deg", up_axis="image")
    assert any("blurred. More light and a short exposure" in line for line in found.history)


def test_a_tag_on_the_table_says_where_up_is(tmp_path):
    camera = Camera.of_fov(np.radians(60.0), (640, 360))
    tags = cameras.body_of_tags("7:80mm") + cameras.body_of_tags("5:80mm")
    table = Rotation.from_euler("x", 120.0, degrees=True)  # a camera that looks 30 deg down
    below = (table.as_matrix(), np.array([0.0, 0.12, 0.6]))

    def picture(k):
        drawn = draw_tags(camera, tags[:1], FACING.as_matrix(), np.array([0.1, -0.08 + 0.002 * k, 0.6]), grain=0.0)
        other = draw_tags(camera, tags[1:], *below, grain=0.0)
        return np.where(np.arange(360)[:, None, None] > 200, other, drawn)

    write_video(tmp_path / "tag.mp4", (picture(k) for k in range(20)), 20.0)
    found = recordings.load(tmp_path / "tag.mp4", tag="7:80mm", fov="60deg", up_axis="tag:5")
    moved = found.position[-1] - found.position[0]
    up = table.as_matrix()[:, 2]
    assert moved[2] == pytest.approx(0.038 * up[1], abs=0.004)
    with pytest.raises(InvalidArgument, match=r"no tag 6 of the family 36h11"):
        recordings.load(tmp_path / "tag.mp4", tag="7:80mm", fov="60deg", up_axis="tag:6")


def test_a_printed_sheet_shows_its_tags_at_their_size(tmp_path):
    run = CliRunner().invoke(main, ["tag", "--tag", "0-2:40mm,cube:50mm", "--print", str(tmp_path / "tags.svg")])
    assert run.exit_code == 0, run.output
    text = (tmp_path / "tags.svg").read_text()
    scale = 6.0  # px a mm
    sheet = np.full((int(297 * scale), int(210 * scale)), 255, np.uint8)
    for x, y, w, h in re.findall(r'<rect x="([\d.]+)" y="([\d.]+)" width="([\d.]+)" height="([\d.]+)"', text):
        a, b = np.array([float(x), float(y)]), np.array([float(x) + float(w), float(y) + float(h)])
        cv2.rectangle(sheet, *(tuple(map(int, np.round(scale * each - [k, k]))) for each, k in ((a, 0), (b, 1))), 0, -1)
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    corners, ids, _ = cv2.aruco.ArucoDetector(dictionary).detectMarkers(sheet)
    assert sorted(np.ravel(ids)) == [0, 1, 2]
    sides = [np.linalg.norm(np.diff(each[0], axis=0), axis=1).mean() / scale for each in corners]
    np.testing.assert_allclose(sides, 40.0, atol=0.5)


def test_boards_and_tags_are_written_as_pdf(tmp_path):
    for words in (["--board", "5x7:30mm"], ["--tag", "0-4:60mm,cube:80mm"]):
        path = tmp_path / "sheet.pdf"
        run = CliRunner().invoke(main, ["tag", *words, "--print", str(path)])
        assert run.exit_code == 0, run.output
        content = path.read_bytes()
        assert content.startswith(b"%PDF-1.4")
        start = int(re.search(rb"startxref\n(\d+)", content)[1])
        assert content[start : start + 4] == b"xref"
        for k, offset in enumerate(re.findall(rb"(\d{10}) 00000 n", content), 1):
            assert content[int(offset) :].startswith(b"%d 0 obj" % k)


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["--print", "a.png"], "expected a file ending in .svg or .pdf"),
        (["--print", "a.svg", "--tag", "0:300mm"], "expected at most 186 mm on A4"),
        (["--print", "a.svg", "--board", "5x7:60mm"], "do not fit on A4"),
        (["--print", "a.svg", "--board", "5x7:30mm", "--tag", "0:60mm"], "both are stated"),
    ],
)
def test_a_sheet_that_cannot_be_printed_is_refused(tmp_path, monkeypatch, words, part):
    monkeypatch.chdir(tmp_path)
    run = CliRunner().invoke(main, ["tag", *words])
    assert run.exit_code == 2
    assert part in run.output
    assert not list(tmp_path.iterdir())


def test_a_board_that_both_cameras_see_relates_them(tmp_path):
    board = cameras.board_of("5x7:30mm")
    image = cameras.charuco(board).generateImage((500, 700), marginSize=0)
    camera = Camera.of_fov(np.radians(60.0), (640, 480))
    rotation, position = (
        Rotation.from_euler("xy", [-30.0, 20.0], degrees=True).as_matrix(),
        np.array([-0.07, -0.1, 0.5]),
    )
    corners = np.array([[0, 0, 0], [0.15, 0, 0], [0.15, 0.21, 0], [0, 0.21, 0]])
    pixels = camera.project(corners @ rotation.T + position).astype(np.float32)
    flat = np.array([[-0.5, -0.5], [499.5, -0.5], [499.5, 699.5], [-0.5, 699.5]], np.float32)
    matrix = cv2.getPerspectiveTransform(flat, pixels)
    picture = cv2.warpPerspective(image, matrix, (640, 480), flags=cv2.INTER_AREA, borderValue=200)
    write_video(tmp_path / "board.mp4", (np.repeat(picture[:, :, None], 3, axis=2) for _ in range(20)), 20.0)
    found = cameras.stand_of_board(cameras.open_video(tmp_path / "board.mp4"), camera, board)
    assert errors(found, rotation, position)[0] < 3.0
    assert errors(found, rotation, position)[1] < 1.0
