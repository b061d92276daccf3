"""The report of a run: one page that is right, small, silent, and shows the arm."""

import io
import json
import re

import numpy as np
import pytest
from dmpcpp import report

from tests.python.browser import look
from tests.python.command import run, write_hand

pytest.importorskip("pybullet_data")
pytest.importorskip("viser")
pytest.importorskip("yourdfpy")
pytest.importorskip("matplotlib")
ndimage = pytest.importorskip("scipy.ndimage")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder of a run with its report."""
    path = tmp_path_factory.mktemp("run")
    write_hand(path / "hand.npz")
    done = run("imitate", "hand.npz", "--quat-order", "xyzw", "--out", "out", cwd=path)
    assert done.returncode == 0, done.stdout + done.stderr
    return path / "out"


def test_the_page_is_one_file_under_five_megabytes_that_names_no_other(folder):
    page = (folder / "report.html").read_text()
    assert len(page.encode()) <= 5e6
    outside = re.sub(r'srcdoc="[^"]*"', "", page)
    outside = re.sub(r"<metadata>.*?</metadata>", "", outside, flags=re.S)
    assert not re.search(r'(src|href)="(?!data:|#)', outside)


def test_verdict_and_checks_come_first_and_are_those_of_the_summary(folder):
    page, summary = (folder / "report.html").read_text(), json.loads((folder / "summary.json").read_text())
    assert page.index('id="verdict"') < page.index("<iframe") < page.index("<svg")
    assert "<b>Verified</b>" in page
    for check in summary["checks"]:
        assert f"<td>{check['name']}</td>" in page
    assert page.count("<svg") == 7
    for line in summary["recording"]["history"]:
        assert line.split("(")[0].strip() in page


def test_the_page_says_how_to_repeat_the_run(folder):
    page = (folder / "report.html").read_text()
    assert "dmpcpp imitate --config config.toml" in page and "[imitate]" in page


def test_the_page_is_made_anew_from_the_folder(folder):
    first = (folder / "report.html").read_text()
    done = run("report", "out", "--json", cwd=folder.parent)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["verdict"] == "pass"
    scene = re.compile(r'srcdoc="[^"]*"')
    assert scene.sub("", (folder / "report.html").read_text()) == scene.sub("", first)


def test_a_failed_run_says_so_first(folder, tmp_path):
    for name in ("model.json", "plan.npz", "execution.npz"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    summary = json.loads((folder / "summary.json").read_text())
    summary["verdict"], summary["checks"][3]["ok"] = "fail", False
    (tmp_path / "summary.json").write_text(json.dumps(summary))
    page = report.write(tmp_path).read_text()
    assert "<b>Not verified</b>: 1 of" in page
    assert page.index('<tr class="failed">') < page.index('<tr class="held">')


def test_a_folder_that_is_not_whole_is_refused_by_what_is_missing(tmp_path):
    (tmp_path / "half").mkdir()
    (tmp_path / "half" / "summary.json").write_text("{}")
    done = run("report", "half", cwd=tmp_path)
    assert done.returncode == 2 and "model.json, plan.npz, execution.npz" in done.stderr


def scene(seen):
    """Return the pixels (H, W, 3) of the arm's scene, beside its notices and above its play bar."""
    image = pytest.importorskip("PIL.Image")
    picture = image.open(io.BytesIO(seen.picture)).convert("RGB").crop(tuple(map(int, seen.values["place"])))
    pixels = np.asarray(picture).astype(int)
    return pixels[: int(0.9 * len(pixels)), pixels.shape[1] // 3 :]


def arm_pixels(pixels):
    grey = (np.ptp(pixels, axis=2) < 25) & (pixels.mean(axis=2) > 90) & (pixels.mean(axis=2) < 225)
    return int(ndimage.binary_erosion(grey, iterations=3).sum())  # the floor's lines are thinner


def path_pixels(pixels):
    red, green, blue = pixels[..., 0], pixels[..., 1], pixels[..., 2]
    return int(((red > green + 15) & (green > blue + 30)).sum())


def test_the_first_screen_has_verdict_motion_and_four_figures_before_anything_else(folder):
    page = (folder / "report.html").read_text()
    first = page[: page.index('id="checks"')]
    assert first.count('class="tile"') == 4
    for title in ("How close", "How fast", "How near to limits", "What was changed"):
        assert f"<span>{title}</span>" in first
    assert first.index('id="verdict"') < first.index('class="poster"') < first.index("<iframe")
    assert "<table" not in first


def test_checks_are_grouped_in_plain_words_and_folded(folder):
    page = (folder / "report.html").read_text()
    assert '<summary class="held"><b>Limits</b>: 6 of 6 hold</summary>' in page
    assert "<td>joint speed, share of its limit</td>" in page
    assert page.count("<details>") >= 5 and "<details open" not in page


def test_the_command_that_repeats_the_run_can_be_copied(folder):
    page = (folder / "report.html").read_text()
    assert re.search(r"<pre>dmpcpp imitate --config[^<]*</pre><button[^>]*clipboard[^>]*>copy</button>", page)


@pytest.mark.slow
def test_the_first_screen_of_a_laptop_shows_arm_verdict_and_figures(folder, tmp_path):
    bottom = "[...document.querySelectorAll('.tile, iframe')].map(e => e.getBoundingClientRect().bottom)"
    scripts = {"bottom": bottom, "drawn": "document.querySelector('.stage').classList.contains('drawn')"}
    page = folder / "report.html"
    seen = look(page, tmp_path, until=lambda seen: bool(seen.values["drawn"]), scripts=scripts, size="1366,768")
    assert seen.values["drawn"] and seen.complaints == []
    assert max(seen.values["bottom"]) <= 768


@pytest.mark.slow
def test_chromium_shows_the_arm_without_a_request_or_a_complaint(folder, tmp_path):
    # Chromium draws a frame only once it is in view, and by the processor that takes as long as it takes.
    show = "document.querySelector('iframe').scrollIntoView(); 1"
    place = "(b => [b.x, b.y, b.right, b.bottom])(document.querySelector('iframe').getBoundingClientRect())"

    def drawn(seen):
        return bool(seen.values["place"]) and arm_pixels(scene(seen)) > 500 and path_pixels(scene(seen)) > 100

    page = folder / "report.html"
    seen = look(page, tmp_path, until=drawn, scripts={"show": show, "place": place}, size="1280,1000")
    (tmp_path / "page.png").write_bytes(seen.picture)
    assert seen.requests == [page.resolve().as_uri()]
    assert seen.complaints == []
    assert drawn(seen), f"arm {arm_pixels(scene(seen))} pixels, path {path_pixels(scene(seen))} pixels"


@pytest.mark.slow
def test_on_paper_the_arm_stands_still_and_nothing_is_wider_or_higher_than_a_page(folder, tmp_path):
    scripts = {
        "scene": "getComputedStyle(document.querySelector('iframe')).display",
        "still": "document.querySelector('figure.paper img').clientWidth",
        "width": "document.documentElement.scrollWidth",
        "heights": "[...document.querySelectorAll('figure')].map(f => f.clientHeight)",
    }

    def loaded(seen):
        return bool(seen.values["still"]) and seen.values["heights"] != []

    paper = look(folder / "report.html", tmp_path, until=loaded, scripts=scripts, size="794,1123", media="print")
    assert paper.values["scene"] == "none" and paper.values["still"] > 600
    assert paper.values["width"] <= 794  # A4 in px
    assert max(paper.values["heights"]) < 1000
