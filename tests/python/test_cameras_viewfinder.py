"""The page of `dmpcpp record`: what it answers and to whom, and in Chromium with a fake camera."""

import http.client
import json
from urllib.parse import urlparse

import numpy as np
import pytest
from dmpcpp import cameras
from dmpcpp.cameras import Camera, Viewfinder
from dmpcpp.errors import MissingDependency

from benchmarks.hand_model import seeded_motion
from tests.python.browser import look

cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed: the extra cameras")
from benchmarks.hand_pictures import pictures_of  # noqa: E402

CAMERA = Camera.of_fov(np.radians(70.8), (640, 360))


@pytest.fixture
def finder(tmp_path):
    try:
        cameras.net_files()
    except MissingDependency:
        pytest.skip(f"the hand model is not there: {cameras.GET}")
    finder = Viewfinder(tmp_path / "out", 1, lambda pixels, world: [[0.5, 0.5], [0.5, 0.2]])
    yield finder
    finder.close()


@pytest.fixture(scope="module")
def pictures():
    return list(pictures_of(seeded_motion(1, duration=0.4, rate=10.0, turn=10.0), CAMERA))


def asked(finder, method, path, body=None, **headers):
    where = urlparse(finder.address)
    connection = http.client.HTTPConnection(where.hostname, where.port, timeout=60)
    connection.request(method, path, body, headers)
    answer = connection.getresponse()
    return answer.status, answer.read()


def test_it_listens_on_the_loopback_interface_alone(finder):
    assert urlparse(finder.address).hostname == "127.0.0.1"
    assert finder._server.server_address[0] == "127.0.0.1"


def test_only_its_own_page_is_answered(finder):
    key = f"?key={finder.secret}"
    assert asked(finder, "GET", "/" + key)[0] == 200
    assert asked(finder, "GET", "/")[0] == 403
    assert asked(finder, "GET", "/?key=wrong")[0] == 403
    assert asked(finder, "GET", "/" + key, Host="evil.example")[0] == 403
    assert asked(finder, "POST", f"/frame{key}&camera=0", b"x", Origin="http://evil.example")[0] == 403
    assert asked(finder, "POST", f"/frame{key}&camera=7", b"x")[0] == 403
    assert asked(finder, "GET", "/other" + key)[0] == 404
    assert asked(finder, "POST", f"/other{key}&camera=0", b"x")[0] == 404
    assert not finder.folder.exists()


def test_the_page_asks_no_other_machine(finder):
    page = finder.page().decode()
    assert "{{" not in page
    assert "http://" not in page
    assert "https://" not in page


def test_a_picture_is_answered_with_the_hand_and_the_arm(finder, pictures):
    encoded = cv2.imencode(".jpg", pictures[0])[1].tobytes()
    status, body = asked(finder, "POST", f"/frame?key={finder.secret}&camera=0", encoded)
    found = json.loads(body)
    assert (status, found["found"], len(found["points"])) == (200, True, 21)
    assert found["arm"] == [[0.5, 0.5], [0.5, 0.2]]
    assert found["right"] > 0.5
    status, body = asked(finder, "POST", f"/frame?key={finder.secret}&camera=0", b"no picture")
    assert (status, json.loads(body)) == (200, {"found": False})


def test_a_video_is_written_whole_and_the_waiting_ends(finder):
    status, _ = asked(finder, "POST", f"/video?key={finder.secret}&camera=0", b"webm" * 1000)
    assert status == 200
    assert finder.wait(5.0) == [finder.folder / "left.webm"]
    assert (finder.folder / "left.webm").read_bytes() == b"webm" * 1000


def test_in_chromium_a_fake_camera_is_shown_recorded_and_saved(finder, pictures, tmp_path):
    film = tmp_path / "camera.mjpeg"
    film.write_bytes(b"".join(cv2.imencode(".jpg", picture)[1].tobytes() for picture in pictures * 3))
    flags = (
        "--use-fake-device-for-media-stream",
        "--use-fake-ui-for-media-stream",
        f"--use-file-for-fake-video-capture={film}",
    )
    act = """(() => {
        const v = views[0], done = v && v.found > 2;
        if (done && !document.getElementById("start").disabled && !window.began) { window.began = Date.now();
            document.getElementById("start").click(); }
        if (window.began && Date.now() - window.began > 3000 && !window.ended) { window.ended = true;
            document.getElementById("stop").click(); }
        return [document.getElementById("state").textContent, v ? v.found : 0, !!document.getElementById("arm")];
    })()"""
    seen = look(
        finder.address,
        tmp_path,
        until=lambda seen: seen.values["now"][0].startswith("saved"),
        scripts={"now": act},
        flags=flags,
        size="1280,900",
        patience=90.0,
    )
    assert seen.values["now"][0].startswith("saved"), seen.values
    assert seen.values["now"][2]
    assert not [
        each for each in seen.requests if "127.0.0.1" not in each and not each.startswith(("about:", "data:", "blob:"))
    ]
    (video,) = finder.wait(1.0)
    frames = list(cameras.open_video(video).frames())
    assert len(frames) > 8
    assert frames[0][1].shape[1] > 300
    assert np.all(np.diff([time for time, _ in frames]) > 0.0)
