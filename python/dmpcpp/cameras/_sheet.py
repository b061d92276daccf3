"""Tags and boards to print, as SVG or PDF of A4 pages at their true size, with a ruler to check it by."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from dmpcpp._atomic import replacing
from dmpcpp.cameras._boards import Board, charuco
from dmpcpp.cameras._opencv import opencv
from dmpcpp.cameras._tags import Tag
from dmpcpp.errors import InvalidArgument

__all__ = ["print_board", "print_tags"]

_PAGE = (210.0, 297.0)  # mm, A4
_MARGIN, _GAP, _TEXT = 12.0, 10.0, 3.5  # mm
_CELLS = 8  # of a 36h11 tag with its black border
_FINE = 56  # cells of a board's square: its markers' cells are 6, their margin 7
_RULER = 100.0  # mm


@dataclass
class _Page:
    """Black rectangles (x, y, width, height) and words (x, y, text) [mm], from the upper left."""

    boxes: list[tuple[float, float, float, float]] = field(default_factory=list)
    words: list[tuple[float, float, str]] = field(default_factory=list)


def print_tags(path: Path, tags: list[Tag]) -> None:
    """Write tags, as many on a page as fit.

    Raises
    ------
    InvalidArgument
        Another ending than .svg or .pdf, several pages of an SVG, or a tag wider than a page.
    FileError
        It cannot be written.
    """
    pages, x, y, row = [_Page()], _MARGIN, _MARGIN + _GAP, 0.0
    for tag in tags:
        size = 1e3 * tag.size
        if size > _PAGE[0] - 2.0 * _MARGIN:
            raise InvalidArgument(f"tag: {size:.4g} mm, expected at most {_PAGE[0] - 2.0 * _MARGIN:g} mm on A4.")
        if x + size > _PAGE[0] - _MARGIN:
            x, y, row = _MARGIN, y + row + _GAP + 2.0 * _TEXT, 0.0
        if y + size > _PAGE[1] - _MARGIN - 2.0 * _GAP:
            pages.append(_Page())
            x, y, row = _MARGIN, _MARGIN + _GAP, 0.0
        pages[-1].boxes += _boxes(_tag_cells(tag.id), x, y, size / _CELLS)
        pages[-1].words.append((x, y + size + size / _CELLS + _TEXT, f"36h11 id {tag.id}: black side {size:.4g} mm"))
        x, row = x + size + size / _CELLS + _GAP, max(row, size + size / _CELLS)
    _write(path, pages)


def print_board(path: Path, board: Board) -> None:
    """Write a board on a page; errors are those of `print_tags`."""
    square = 1e3 * board.square
    width, height = board.columns * square, board.rows * square
    if width > _PAGE[0] - 2.0 * _MARGIN or height > _PAGE[1] - 2.0 * _MARGIN - 2.0 * _GAP:
        raise InvalidArgument(f"board: {width:.4g} x {height:.4g} mm do not fit on A4. Take smaller squares or fewer.")
    image = charuco(board).generateImage((_FINE * board.columns, _FINE * board.rows), marginSize=0)
    words = f"{board.columns}x{board.rows}, squares of {square:.4g} mm"
    page = _Page(_boxes(image < 128, _MARGIN, _MARGIN, square / _FINE), [(_MARGIN, _MARGIN + height + 6.0, words)])
    _write(path, [page])


def _tag_cells(number: int) -> NDArray[np.bool_]:
    aruco = opencv().aruco
    dictionary = aruco.getPredefinedDictionary(aruco.DICT_APRILTAG_36h11)
    return np.asarray(aruco.generateImageMarker(dictionary, number, _CELLS) < 128)


def _boxes(black: NDArray[np.bool_], x: float, y: float, cell: float) -> list[tuple[float, float, float, float]]:
    """Return a rectangle for each run of black cells in a row; runs that repeat in the next rows are one."""
    open_runs: dict[tuple[int, int], int] = {}
    boxes = []
    for j in range(len(black) + 1):
        row = black[j] if j < len(black) else np.zeros(black.shape[1], dtype=bool)
        edges = np.flatnonzero(np.diff(np.concatenate([[False], row, [False]]).astype(int)))
        runs = {(int(a), int(b)) for a, b in edges.reshape(-1, 2)}
        for run in [run for run in open_runs if run not in runs]:
            begin = open_runs.pop(run)
            boxes.append((x + run[0] * cell, y + begin * cell, (run[1] - run[0]) * cell, (j - begin) * cell))
        for run in runs - set(open_runs):
            open_runs[run] = j
    return boxes


def _write(path: Path, pages: list[_Page]) -> None:
    for page in pages:
        bottom = _PAGE[1] - _MARGIN
        page.boxes.append((_MARGIN, bottom - 1.0, _RULER, 0.5))
        page.boxes += [(_MARGIN + at, bottom - 3.0, 0.3, 3.0) for at in np.linspace(0.0, _RULER, 11)]
        said = "Print at 100 %: this ruler is 100 mm long. Keep the white border; glue on something flat."
        page.words.append((_MARGIN, bottom - 5.0, said))
    kind = path.suffix.lower()
    if kind not in (".svg", ".pdf"):
        raise InvalidArgument(f"print: '{path.name}', expected a file ending in .svg or .pdf.")
    if kind == ".svg" and len(pages) > 1:
        raise InvalidArgument(f"print: {len(pages)} pages, an SVG has one. Write a PDF, or fewer tags.")
    content = _svg(pages[0]) if kind == ".svg" else _pdf(pages)
    with replacing(path) as beside:
        beside.write_bytes(content)


def _svg(page: _Page) -> bytes:
    width, height = _PAGE
    size = f'width="{width:g}mm" height="{height:g}mm" viewBox="0 0 {width:g} {height:g}"'
    text = f'font-size="{_TEXT}" font-family="sans-serif"'
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size}>',
        f'<rect width="{width:g}" height="{height:g}" fill="#fff"/>',
        *(f'<rect x="{x:.4f}" y="{y:.4f}" width="{w:.4f}" height="{h:.4f}"/>' for x, y, w, h in page.boxes),
        *(f'<text x="{x:.3f}" y="{y:.3f}" {text}>{said}</text>' for x, y, said in page.words),
        "</svg>",
    ]
    return ("\n".join(lines) + "\n").encode()


def _pdf(pages: list[_Page]) -> bytes:
    """Return a PDF 1.4 of rectangles and words in Helvetica, which every reader has."""
    point = 72.0 / 25.4
    kids = " ".join(f"{4 + 2 * k} 0 R" for k in range(len(pages)))
    media = f"[0 0 {_PAGE[0] * point:.3f} {_PAGE[1] * point:.3f}]"
    objects = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        f"<< /Type /Pages /Kids [{kids}] /Count {len(pages)} >>".encode(),
        b"<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
    ]
    for k, page in enumerate(pages):
        drawn = [
            f"{x * point:.4f} {(_PAGE[1] - y - h) * point:.4f} {w * point:.4f} {h * point:.4f} re f"
            for x, y, w, h in page.boxes
        ]
        drawn += [
            f"BT /F1 {_TEXT * point:.2f} Tf {x * point:.3f} {(_PAGE[1] - y) * point:.3f} Td ({text}) Tj ET"
            for x, y, text in page.words
        ]
        stream = "\n".join(drawn).encode("latin-1", "replace")
        objects.append(
            f"<< /Type /Page /Parent 2 0 R /MediaBox {media} /Contents {5 + 2 * k} 0 R "
            "/Resources << /Font << /F1 3 0 R >> >> >>".encode()
        )
        objects.append(b"<< /Length %d >>\nstream\n%s\nendstream" % (len(stream), stream))
    out, offsets = b"%PDF-1.4\n", []
    for k, each in enumerate(objects, 1):
        offsets.append(len(out))
        out += b"%d 0 obj\n%s\nendobj\n" % (k, each)
    table = b"".join(b"%010d 00000 n \n" % offset for offset in offsets)
    size = len(objects) + 1
    end = b"trailer\n<< /Size %d /Root 1 0 R >>\nstartxref\n%d\n%%%%EOF\n" % (size, len(out))
    return out + b"xref\n0 %d\n0000000000 65535 f \n" % size + table + end
