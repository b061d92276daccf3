"""The numbers that a command prints are those of its summary, in the units that the table names."""

import io
import json
import math
import re

import pytest
from dmpcpp._check_words import figures_of
from dmpcpp.checks import Check
from dmpcpp.cli._tables import print_checks
from rich.console import Console

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
    assert f"checks: {len(report['checks'])} of {len(report['checks'])} hold" in text
    assert f"{report['basis_count']} kernels, {report['duration']:.2f} s" in text


def test_demo(folder):
    pytest.importorskip("pybullet_data")
    text = run("demo", "--no-report", "--out", "demo", cwd=folder).stdout
    summary = json.loads((folder / "demo" / "summary.json").read_text())
    held = sum(check["result"] == "holds" for check in summary["checks"])
    assert held and f"checks: {held} of {len(summary['checks'])} hold" in text
    for each in figures_of(summary):
        assert f"{each.title.lower():<19}{each.number}  ({each.line})" in text
    errors = [numbers for numbers in rows(text.split("checks")[0]).values() if len(numbers) == 4]
    assert len(errors) == len(summary["stages"]) >= 3
    for numbers, stage in zip(errors, summary["stages"].values(), strict=True):
        assert numbers == printed_as(
            *(1e3 * stage[f"position_{kind}"] for kind in ("rmse", "max")),
            *(DEGREES * stage[f"angle_{kind}"] for kind in ("rmse", "max")),
        )


def test_a_check_that_does_not_hold_is_printed_in_the_units_of_people():
    console = Console(width=200, record=True, file=io.StringIO())
    failed = Check("settle_error", False, 0.0123, 1e-4, "m", 2.5, "")
    print_checks(console, [Check("velocity_ratio", True, 0.5, 1.0, "1"), failed])
    text = console.export_text()
    assert "checks: 1 of 2 hold (limits 1)" in text and "velocity_ratio" not in text
    (row,) = (line for line in text.splitlines() if "settle_error" in line)
    cells = [cell.strip() for cell in row.split("│")[1:-1]]
    assert cells == ["FAIL", "settle_error", "tool off the goal at the end", "12.3 mm", "0.1 mm", "2.50 s"]
