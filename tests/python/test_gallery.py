"""The gallery: each picture is made by the script, looks like what is shown, is small, and stands on the page."""

import re

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from scripts.gallery.__main__ import DOCS, make
from scripts.gallery.pictures import PHYSICS, PICTURES


def test_the_page_shows_every_picture_that_is_made_and_no_other():
    shown = re.findall(r"^!\[[^\]]+\]\(gallery/(\w+)\.png\)$", (DOCS.parent / "gallery.md").read_text(), flags=re.M)
    assert sorted(shown) == sorted(PICTURES) == sorted(path.stem for path in DOCS.iterdir())


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_is_small_and_is_what_the_script_makes(name, tmp_path):
    from matplotlib.image import imread

    if name in PHYSICS:
        for package in ("pybullet", "yourdfpy"):
            pytest.importorskip(package)
    kept, made = DOCS / f"{name}.png", make(name, tmp_path)
    assert max(kept.stat().st_size, made.stat().st_size) < 110_000
    assert [path.name for path in tmp_path.iterdir()] == [made.name]
    before, now = imread(kept)[..., :3], imread(made)[..., :3]
    assert before.shape == now.shape
    # Another version of matplotlib places text a little differently; another curve is more than that.
    assert float(np.abs(before - now).mean()) < 0.01
    # Curves are thin: that they are there shows in the coloured pixels alone, colour by colour.
    kept_hues, hues = _coloured(before), _coloured(now)
    assert hues.sum() > 0
    assert np.abs(kept_hues - hues).sum() < 0.15 * kept_hues.sum()


def _coloured(picture):
    """How many pixels there are of twelve hues, grey ones left out."""
    from matplotlib.colors import rgb_to_hsv

    hue, saturation, _ = np.moveaxis(rgb_to_hsv(picture), -1, 0)
    return np.histogram(hue[saturation > 0.2], 12, (0.0, 1.0))[0]


def test_curves_that_vanish_are_seen():
    from matplotlib.image import imread

    for name in PICTURES:
        picture = imread(DOCS / f"{name}.png")[..., :3]
        grey = np.repeat(picture.mean(axis=-1, keepdims=True), 3, axis=-1)
        assert _coloured(picture).sum() > 100, name
        assert _coloured(grey).sum() == 0, name
