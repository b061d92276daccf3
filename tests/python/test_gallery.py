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
