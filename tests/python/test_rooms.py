"""The rooms of the Python package: imports point down, private modules stay private, public addresses stay."""

import ast
import importlib
import re
import subprocess
import sys
import warnings
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2] / "python" / "dmpcpp"
DRAWING = ROOT.parents[1] / "docs" / "architecture.md"

ADDRESSES = {
    "arms": "robot.arms",
    "urdf_check": "robot.urdf_check",
    "plot": "show.plot",
    "scene": "show.scene",
    "report": "show.report",
    "view": "show.view",
    "batch": "trials.batch",
    "generality": "trials.generality",
    "reproduction": "trials.reproduction",
}
ALIASES = {*ADDRESSES, "retarget", "teaching"}  # modules that only name what lies in a room
HALLS = {"show", "trials"}  # rooms of rooms


def room_of(parts):
    """Return the room of a module: a hall's part, else what stands in python/dmpcpp."""
    if parts[0] in HALLS and len(parts) > 1 and not parts[1].startswith("_"):
        return "/".join(parts[:2])
    return parts[0]


@cache
def modules():
    """Return {("motion", "_poses"): path} of every module."""
    found = {}
    for path in ROOT.rglob("*.py"):
        parts = path.with_suffix("").relative_to(ROOT).parts
        found[parts[:-1] if parts[-1] == "__init__" else parts] = path
    return found


@cache
def imports():
    """Return (module, imported module, names) for every import within the package, also within functions."""
    found = []
    for module, path in modules().items():
        tree = ast.parse(path.read_text())
        typing_only = {id(low) for node in ast.walk(tree) if _is_for_types(node) for low in ast.walk(node)}
        for node in ast.walk(tree):
            if id(node) in typing_only:
                continue
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "dmpcpp":
                base = tuple(node.module.split(".")[1:])
                for name in node.names:
                    whole = (*base, name.name)
                    found.append((module, whole if whole in modules() else base, name.name))
    assert len(found) > 500
    return found


def _is_for_types(node):
    return isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test)


@cache
def floors():
    """Return {room: floor} as docs/architecture.md draws them."""
    block = re.search(r"```\npython/dmpcpp\n(.*?)```", DRAWING.read_text(), re.DOTALL)[1]
    rows = re.findall(r"^ *(\d+)  (.*?)(?:  +[^ ].*)?$", block, re.MULTILINE)
    found = {room: int(floor) for floor, rooms in rows for room in rooms.split()}
    assert len(found) > 25
    return found


def test_every_room_stands_on_a_floor_of_the_drawing():
    rooms = {room_of(module) for module in modules() if module} - {"__main__", "_address", "show", *ALIASES}
    assert rooms == floors().keys() - {"_core"}


def test_imports_point_down():
    for module, imported, _ in imports():
        if not module or not imported or module[0] in {"__main__", *ALIASES}:
            continue
        above, below = room_of(module), room_of(imported)
        if above != below:
            assert floors()[below] < floors()[above], f"{'.'.join(module)} imports {'.'.join(imported)}"


def test_includes_of_the_cpp_sources_point_down_and_its_changes_touch_the_files_that_are_listed():
    rooms = subprocess.run(
        [sys.executable, DRAWING.parents[1] / "scripts" / "rooms.py"], capture_output=True, text=True
    )
    assert rooms.returncode == 0, rooms.stdout
    assert "includes that run up: 0" in rooms.stdout


def test_modules_of_one_room_import_one_another_in_no_circle():
    graph = {}
    for module, imported, _ in imports():
        if module and imported and module != imported and module[:1] == imported[:1]:
            graph.setdefault(module, set()).add(imported)
    graph = {module: {low for low in lows if low != module[: len(low)]} for module, lows in graph.items()}
    assert len(graph) > 60

    def reachable(module, seen):
        for low in graph.get(module, ()):
            if low not in seen:
                seen.add(low)
                reachable(low, seen)
        return seen

    assert [module for module in graph if module in reachable(module, set())] == []


def test_what_is_private_to_a_room_is_imported_there_only():
    for module, imported, name in imports():
        if not imported or imported[0].startswith("_"):
            continue
        own = imported[: next((k for k, part in enumerate(imported) if part.startswith("_")), len(imported))]
        if len(own) < len(imported) or (name.startswith("_") and not name.startswith("__")):
            assert module[: len(own)] == own, f"{'.'.join(module)} imports {'.'.join(imported)}: {name}"


def test_the_rooms_do_not_use_the_addresses_of_users():
    for module, imported, _ in imports():
        if module and module[0] not in ALIASES:
            assert not (imported and imported[0] in ALIASES), f"{'.'.join(module)} imports {'.'.join(imported)}"


def test_learning_loads_no_simulator():
    program = "import sys, dmpcpp.learning; print(*[name for name in sys.modules if name.startswith('dmpcpp')])"
    loaded = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout.split()
    assert "dmpcpp.learning" in loaded
    assert [
        name for name in loaded if re.match(r"dmpcpp\.(simulation|robot|planning|imitation|show|export)", name)
    ] == []


@pytest.mark.parametrize(("address", "room"), ADDRESSES.items())
def test_a_public_address_is_the_module_in_its_room(address, room):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = importlib.import_module(f"dmpcpp.{address}")
    assert found is importlib.import_module(f"dmpcpp.{room}")


def test_the_addresses_of_functions_that_moved_have_them():
    from dmpcpp import imitation, learning, planning, retarget, simulation, teaching

    assert {retarget.place, retarget.anchor, retarget.anchor_within_reach} <= {
        getattr(planning, name) for name in planning.__all__
    }
    assert (teaching.teach, teaching.Lesson, teaching.placed) == (learning.teach, learning.Lesson, planning.placed)
    assert imitation.learn is learning.learn
    assert imitation.clear_of_itself is planning.clear_of_itself
    assert simulation.Check.__module__ == "dmpcpp.checks"
