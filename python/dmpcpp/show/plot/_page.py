"""A page: the empty figure, the look that all axes share, and a file that appears whole or not at all."""

from __future__ import annotations

import io
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from dmpcpp.errors import FileError, MissingDependency

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK, FAINT, GRID = "#333333", "#666666", "#DDDDDD"
LEGEND: dict[str, Any] = {"frameon": False, "fontsize": 8.5, "columnspacing": 1.2, "labelcolor": INK}


def figure(width: float = 12.5, height: float = 6.2, *, title: str = "", note: str = "") -> Figure:
    """Return an empty white page of `width` x `height` inches with a title above and a note below.

    Raises
    ------
    MissingDependency
        matplotlib is not installed.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        from mpl_toolkits.mplot3d import Axes3D  # noqa: F401  registers the projection "3d"
    except ImportError:
        raise MissingDependency('matplotlib is not installed. Install the extra: pip install "dmpcpp[plot]".') from None
    page = Figure(figsize=(width, height), dpi=130, facecolor="white")
    FigureCanvasAgg(page)
    page.suptitle(title, x=0.375 / width, y=1.0 - 0.217 / height, ha="left", fontsize=13, color=INK)
    page.text(0.375 / width, 0.186 / height, note, fontsize=8.5, color=FAINT)
    return page


def save(page: Figure, path: str | os.PathLike[str]) -> Path:
    """Write the page as a PNG; drawn in memory first, so that a failure leaves no half of a file.

    Raises
    ------
    FileError
        The file cannot be written.
    """
    path = Path(path)
    image = png(page)
    part = path.with_name(path.name + ".part")
    try:
        part.write_bytes(image)
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise FileError(f"{path}: cannot be written: {error.strerror}.") from None
    return path


def png(page: Figure, dpi: float | None = None) -> bytes:
    """Return the page as a PNG, at 130 dots per inch by default; the same page gives the same bytes."""
    image = io.BytesIO()
    page.savefig(image, format="png", dpi=dpi or "figure", metadata={"Software": None}, pil_kwargs={"optimize": True})
    return image.getvalue()


def svg(page: Figure) -> str:
    """Return the page as an SVG element for HTML: text stays text, and the same page gives the same element."""
    import matplotlib as mpl

    text = io.StringIO()
    with mpl.rc_context({"svg.fonttype": "none", "svg.hashsalt": "dmpcpp", "font.family": "sans-serif"}):
        page.savefig(text, format="svg", metadata={"Date": None})
    drawn = text.getvalue()
    return drawn[drawn.index("<svg") :]


def plain(axes: Axes) -> Axes:
    """Give 2-D axes the look of the pages: a faint grid, no box, small ticks."""
    axes.grid(color=GRID, linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(colors=FAINT, labelsize=8.5)
    axes.margins(x=0.01)
    return axes


def plain_3d(axes: Any, labels: tuple[str, str, str]) -> Any:
    """Give 3-D axes the look of the pages: no panes, a faint grid, few ticks."""
    from matplotlib.ticker import MaxNLocator

    for axis, label in zip((axes.xaxis, axes.yaxis, axes.zaxis), labels, strict=True):
        axis.set_pane_color((1.0, 1.0, 1.0, 0.0))
        axis._axinfo["grid"].update(color=GRID, linewidth=0.6)
        axis.set_label_text(label, color=INK)
        axis.set_major_locator(MaxNLocator(5))
    axes.tick_params(labelsize=8, colors=FAINT)
    axes.view_init(elev=22, azim=-58)
    return axes
