"""Pictures: whole files, honest curves, no global state."""

import subprocess
import sys

import numpy as np
import pytest
from dmpcpp import plot
from dmpcpp.errors import FileError, InvalidArgument, MissingDependency
from dmpcpp.show.plot import _execution as execution

pytest.importorskip("matplotlib")


def helix(offset=0.0):
    u = np.linspace(0.0, 1.0, 300)
    poses = np.tile(np.eye(4), (300, 1, 1))
    poses[:, :3, 3] = np.column_stack([0.4 + 0.2 * np.cos(6 * u), 0.2 * np.sin(6 * u), 0.3 + 0.3 * u]) + offset
    return poses


def draw(path, **changes):
    time = np.linspace(0.0, 3.0, 300)
    curve = plot.ErrorCurve("demonstration → DMP", time, np.full(300, 1e-3), np.full(300, 1e-2))
    content = {"demonstrated": helix(0.002), "planned": helix(), "executed": helix(), "errors": [curve]}
    return plot.picture(path, **(content | changes))


def pixels(path):
    from matplotlib.image import imread

    return (imread(path)[:, :, :3] * 255.0 + 0.5).astype(int)


def coloured(image, colour, tolerance=12):
    rgb = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)])
    return int((np.abs(image - rgb).max(axis=2) <= tolerance).sum())


def test_the_picture_shows_all_three_paths_and_the_errors(tmp_path):
    path = draw(tmp_path / "picture.png")
    assert path.read_bytes().startswith(b"\x89PNG")
    image = pixels(path)
    half = image.shape[1] * 55 // 100
    for name, style in execution._PATHS.items():
        assert coloured(image[:, :half], style["color"]) > 300, name
    assert coloured(image[:, half:], execution._STAGE_COLOURS[0]) > 300


def test_an_error_of_zero_still_has_a_place_in_the_picture(tmp_path):
    time = np.linspace(0.0, 1.0, 50)
    draw(tmp_path / "zero.png", errors=[plot.ErrorCurve("exact", time, np.zeros(50), np.zeros(50))])


def test_positions_without_orientation_can_be_drawn_too(tmp_path):
    draw(tmp_path / "positions.png", planned=helix()[:, :3, 3], executed=helix()[:, :3, 3])


def test_the_curve_never_looks_better_than_what_was_measured():
    time, values = np.arange(10_000.0), np.random.default_rng(0).random(10_000)
    values[1234] = 50.0
    shown_time, shown = execution._envelope(time, values)
    assert len(shown) <= execution._BINS
    assert shown.max() == 50.0
    for k, start in enumerate(shown_time.astype(int)):
        end = int(shown_time[k + 1]) if k + 1 < len(shown_time) else len(values)
        assert shown[k] == values[start:end].max()


def test_a_picture_leaves_pyplot_and_its_settings_alone(tmp_path):
    code = (
        "import sys, numpy as np, matplotlib as m; from dmpcpp import plot; before = dict(m.rcParams);"
        "p = np.random.default_rng(0).random((30, 3)); t = np.arange(30.0);"
        f"plot.picture(r'{tmp_path / 'a.png'}', demonstrated=p, planned=p, executed=p,"
        " errors=[plot.ErrorCurve('a', t, t, t)]);"
        "import matplotlib.pyplot as pp; assert not pp.get_fignums(); assert dict(m.rcParams) == before"
    )
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)


def test_a_file_that_cannot_be_written_leaves_nothing_behind(tmp_path):
    with pytest.raises(FileError, match="cannot be written: No such file or directory"):
        draw(tmp_path / "missing" / "picture.png")
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(FileError, match=r"folder\.png: cannot be written"):
        draw(tmp_path / "folder.png")
    assert [entry.name for entry in tmp_path.iterdir()] == ["folder.png"]


def test_a_path_of_the_wrong_shape_is_refused_by_name(tmp_path):
    with pytest.raises(InvalidArgument, match=r"executed: shape \(5, 2\), expected \(T, 4, 4\) or \(T, 3\)"):
        draw(tmp_path / "a.png", executed=np.zeros((5, 2)))


def test_without_matplotlib_the_error_says_what_to_install(tmp_path, monkeypatch):
    for module in [name for name in sys.modules if name.split(".")[0] == "matplotlib"]:
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingDependency, match=r"dmpcpp\[plot\]"):
        draw(tmp_path / "a.png")


def test_a_body_is_lit_where_it_is_seen_and_hides_nothing_that_is_drawn_after_it(tmp_path):
    corners = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
    quads = [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]  # seen from outside
    box = corners[[[q[i], q[j], q[k]] for q in quads for i, j, k in ((0, 1, 2), (0, 2, 3))]]
    page = plot.figure(5, 5)
    axes = plot.shape(page.add_subplot(projection="3d"), box)
    (body,) = axes.collections
    assert len(body.get_facecolor()) == 6  # two triangles for each of the three sides in view
    axes.plot([0.5, 0.5], [0.5, 0.5], [0.0, 1.0], color="#D55E00", linewidth=4, zorder=3)
    assert coloured(pixels(plot.save(page, tmp_path / "box.png")), "#D55E00") > 300


def test_the_same_page_gives_the_same_bytes():
    def drawn():
        page = plot.figure(3, 3)
        plot.phase(page.add_subplot(), np.linspace(0, 1, 9), np.linspace(1, 0, 9))
        return plot.png(page)

    assert drawn() == drawn()
