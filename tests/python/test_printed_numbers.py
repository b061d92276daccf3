"""The numbers that a command prints are those of its summary, in the units that the table names."""

import json
import math
import re

import pytest

from tests.python.command import run, write_hand

DEGREES = 180.0 / math.pi


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("printed")
    write_hand(folder / "hand.npz")
    return folder


def rows(text):
    """First cell that is no mark of each table row -> the numbers behind it."""
    found = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in re.split(r"[│┃]|\s{2,}", line) if cell.strip() and cell.strip() != "ok"]
        if len(cells) > 1:
            numbers = [cell for cell in cells[1:] if re.fullmatch(r"-?\d+(\.\d+)?(e[+-]?\d+)?", cell)]
            found.setdefault(cells[0], [float(cell) for cell in numbers])
    return found


def printed_as(*values):
    """Two significant digits at least, whole where a table rounds to whole numbers."""
    return pytest.approx(list(values), rel=0.06, abs=1e-9)


def test_inspect(folder):
    stated = ("inspect", "hand.npz", "--quat-order", "xyzw")
    (body,) = json.loads(run(*stated, "--json", cwd=folder).stdout)["bodies"]
    text = run(*stated, cwd=folder).stdout
    columns = ("samples", "duration", "rate", "missing", "longest_gap", "jumps")
    noise = (1e3 * body["noise_position"], DEGREES * body["noise_angle"])
    assert rows(text)[body["name"]] == printed_as(*(body[key] for key in columns), *noise, body["peak_speed"])
    assert body["samples"] == 120 and body["peak_speed"] == pytest.approx(0.2236, abs=1e-3)  # of the arc itself
    extent = " ".join(f"{1e3 * length:.0f}" for length in body["extent"])
    assert f"moves over {extent} mm in x, y, z; turns at most at {DEGREES * body['peak_turning']:.0f} deg/s" in text


def test_fit(folder):
    stated = ("fit", "hand.npz", "--quat-order", "xyzw", "--out")
    report = json.loads(run(*stated, "a", "--json", cwd=folder).stdout)
    text = run(*stated, "b", cwd=folder).stdout
    table = rows(text)
    for row, key in (("RMSE", "rmse"), ("largest", "largest")):
        position, turn = report["fit"][key][:3], report["fit"][key][3:]
        assert table[row] == printed_as(*(1e3 * error for error in position), *(DEGREES * error for error in turn))
        assert max(position) > 0.0
    checks_are_printed(table, report["checks"])
    assert f"{report['basis_count']} kernels, {report['duration']:.2f} s" in text


def test_demo(folder):
    pytest.importorskip("pybullet_data")
    text = run("demo", "--no-report", "--out", "demo", cwd=folder).stdout
    summary = json.loads((folder / "demo" / "summary.json").read_text())
    checks_are_printed(rows(text), summary["checks"])
    errors = [numbers for numbers in rows(text.split("checks")[0]).values() if len(numbers) == 4]
    assert len(errors) == len(summary["stages"]) == 3
    for numbers, stage in zip(errors, summary["stages"].values(), strict=True):
        assert numbers == printed_as(
            *(1e3 * stage[f"position_{kind}"] for kind in ("rmse", "max")),
            *(DEGREES * stage[f"angle_{kind}"] for kind in ("rmse", "max")),
        )


def checks_are_printed(table, checks):
    """Names longer than their column are cut; their first letters are enough to know them by."""
    judged = [check for check in checks if check["limit"] is not None and check["value"] is not None]
    assert judged
    for check in judged:
        name = next(row for row in table if check["name"].startswith(row.rstrip("…")) and len(row) > 5)
        assert table[name][:2] == pytest.approx([check["value"], check["limit"]], rel=0.02, abs=1e-9), check
