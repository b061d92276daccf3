#!/usr/bin/env python3
"""Mutation score of the Python package: how many small faults, one at a time, its tests notice.

    scripts/mutation_python.py [--count 20] [--seed 1] [--minutes 30] [python/dmpcpp/learning.py motion ...]

A sample of all faults of the files (or rooms) is drawn with a fixed seed, files weighted by their faults. Each is put
into a copy of the package in build/mutation_python, and the tests of its room run against it until one fails (noticed)
or all pass (missed). A fault is a comparison, a sign, a constant, a unit, a pair of arguments or a deleted statement;
messages, docstrings and printing are left alone. The extension module is the one of the package that is installed.
"""

from __future__ import annotations

import argparse
import ast
import os
import random
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TREE = ROOT / "build" / "mutation_python"
LEAST = 0.8

# Room or module: the tests that should notice a fault in it, the quickest first.
TESTS = {
    "checks": ["verdict", "planning"],
    "learning": ["learning", "learning_noise", "learning_units", "cli_learning"],
    "metrics": ["metrics"],
    "motion": ["motion", "motion_gaps", "motion_segmentation", "motion_alignment", "plausibility", "learning_noise"],
    "recordings": [
        "recording_kinds", "stamps", "soundness", "long_tables", "representations", "tables", "markers", "datasets",
        "capture_dialects", "rigid_body", "bvh", "c3d", "sampling", "hostile_files", "takes", "recordings", "ros",
        "inspection", "inspection_whole", "recordings_fuzz",
    ],
    "robot": ["arms", "urdf_changes", "convex_pieces", "robot_description", "cli_checking", "planning", "retarget"],
    "planning": ["planning", "retarget_anchor", "retarget", "cli_learning", "placing"],
    "simulation": ["verdict", "simulation", "execution_modes", "mujoco", "physics_figures"],
    "verification": ["verification"],
}  # fmt: skip
ROOMS = ("learning", "motion", "recordings", "planning", "robot", "simulation", "verification")

COMPARE = {ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
           ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In}  # fmt: skip
BINARY = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
NAMES = {"argmax": "argmin", "argmin": "argmax", "max": "min", "min": "max", "mean": "median", "any": "all",
         "all": "any", "degrees": "radians", "radians": "degrees", "lower": "upper", "upper": "lower",
         "maximum": "minimum", "minimum": "maximum"}  # fmt: skip
QUIET = {"InvalidArgument", "NotStated", "FileError", "MissingDependency", "Note", "print", "echo", "KeyError"}


@dataclass(frozen=True)
class Fault:
    """One place of a file as it should not be."""

    file: Path
    line: int
    what: str
    number: int  # of the file's faults


def faults_of(node: ast.AST) -> Iterator[tuple[str, Callable[[], None]]]:
    """Yield what can be wrong at a node, and what makes it so."""
    if isinstance(node, ast.Compare) and len(node.ops) == 1 and type(node.ops[0]) in COMPARE:
        other = COMPARE[type(node.ops[0])]
        yield f"{type(node.ops[0]).__name__} -> {other.__name__}", lambda: node.ops.__setitem__(0, other())
    elif isinstance(node, ast.BinOp) and type(node.op) in BINARY and not isinstance(node.left, ast.JoinedStr):
        other = BINARY[type(node.op)]
        yield f"{type(node.op).__name__} -> {other.__name__}", lambda: setattr(node, "op", other())
    elif isinstance(node, ast.BoolOp):
        other = ast.Or if isinstance(node.op, ast.And) else ast.And
        yield f"{type(node.op).__name__} -> {other.__name__}", lambda: setattr(node, "op", other())
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield "sign dropped", lambda: setattr(node, "op", ast.UAdd())
    elif isinstance(node, ast.Constant) and type(node.value) in (int, float):
        value = node.value + 1 if type(node.value) is int else node.value * 10.0 or 1.0
        yield f"{node.value} -> {value}", lambda: setattr(node, "value", value)
    elif isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield f"{node.value} -> {not node.value}", lambda: setattr(node, "value", not node.value)
    elif isinstance(node, ast.Attribute) and node.attr in NAMES:
        yield f"{node.attr} -> {NAMES[node.attr]}", lambda: setattr(node, "attr", NAMES[node.attr])
    elif isinstance(node, ast.Name) and node.id in NAMES:
        yield f"{node.id} -> {NAMES[node.id]}", lambda: setattr(node, "id", NAMES[node.id])
    elif isinstance(node, ast.Call) and len(node.args) == 2 and not node.keywords:
        yield "arguments swapped", node.args.reverse
    elif isinstance(node, ast.Expr | ast.AugAssign | ast.Raise):
        yield f"{type(node).__name__} deleted", lambda: _delete(node)


def _delete(node: ast.AST) -> None:
    """Make a statement do nothing."""
    node.__class__ = ast.Pass  # type: ignore[assignment]
    node.__dict__ = {
        k: v for k, v in vars(node).items() if k in ("lineno", "col_offset", "end_lineno", "end_col_offset")
    }


def places(tree: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes that compute: no docstrings, annotations, messages or imports."""
    skipped = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            if name in QUIET:
                skipped.update(map(id, ast.walk(node)))
        if isinstance(node, ast.JoinedStr | ast.AnnAssign) and not isinstance(node, ast.JoinedStr):
            skipped.update(map(id, ast.walk(node.annotation)))
        if isinstance(node, ast.JoinedStr | ast.Import | ast.ImportFrom):
            skipped.update(map(id, ast.walk(node)))
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            skipped.update(map(id, ast.walk(node)))
        if isinstance(node, ast.FunctionDef):
            for part in [node.returns, *(a.annotation for a in [*node.args.args, *node.args.kwonlyargs])]:
                if part is not None:
                    skipped.update(map(id, ast.walk(part)))
    yield from (node for node in ast.walk(tree) if id(node) not in skipped)


def faults(file: Path) -> list[Fault]:
    """Return every fault of a file, in order."""
    tree = ast.parse(file.read_text())
    found = [(getattr(node, "lineno", 0), what) for node in places(tree) for what, _ in faults_of(node)]
    return [Fault(file, line, what, number) for number, (line, what) in enumerate(found)]


def faulty(fault: Fault) -> str:
    """Return the text of the file with the fault in it."""
    tree = ast.parse(fault.file.read_text())
    number = 0
    for node in list(places(tree)):
        for _, make in faults_of(node):
            if number == fault.number:
                make()
                return ast.unparse(ast.fix_missing_locations(tree))
            number += 1
    raise AssertionError(fault)


def tests_of(file: Path) -> list[str]:
    """Return the tests of a file's room that exist."""
    relative = file.relative_to(ROOT / "python" / "dmpcpp")
    room = relative.parts[0].removesuffix(".py")
    paths = [ROOT / "tests" / "python" / f"test_{name}.py" for name in TESTS[room]]
    return [str(path) for path in paths if path.is_file()]


def noticed(fault: Fault, seconds: float) -> str:
    """Return "noticed", "missed" or "timeout" (which is noticed, too)."""
    copy = TREE / fault.file.relative_to(ROOT / "python")
    whole = fault.file.read_text()
    copy.write_text(faulty(fault))
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *tests_of(fault.file)]
    try:
        environment = {**os.environ, "PYTHONPATH": f"{TREE}:{ROOT}", "PYTHONDONTWRITEBYTECODE": "1"}
        run = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return "timeout"
    finally:
        copy.write_text(whole)
    return "missed" if run.returncode == 0 else "noticed"


def chosen(names: list[str]) -> list[Path]:
    """Return the files of the rooms and paths named."""
    package = ROOT / "python" / "dmpcpp"
    found: list[Path] = []
    for name in names:
        path = next(p for p in (Path(name).resolve(), package / name, package / f"{name}.py") if p.exists())
        found += sorted(path.rglob("*.py")) if path.is_dir() else [path]
    return [path for path in found if path.name != "__init__.py"]


def copy_package() -> None:
    """Make the copy that faults are put into, with the installed extension module."""
    import dmpcpp._core

    shutil.rmtree(TREE, ignore_errors=True)
    shutil.copytree(ROOT / "python" / "dmpcpp", TREE / "dmpcpp", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    shutil.copy(dmpcpp._core.__file__, TREE / "dmpcpp")


def main() -> None:
    """Draw, try and report."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", default=list(ROOMS), help="rooms or files; default: " + ", ".join(ROOMS))
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=30.0, help="stop drawing after this long")
    parser.add_argument("--timeout", type=float, default=300.0, help="s for the tests of one fault")
    chosen_options = parser.parse_args()
    pool = [fault for file in chosen(chosen_options.names) for fault in faults(file)]
    sample = random.Random(chosen_options.seed).sample(pool, min(chosen_options.count, len(pool)))
    copy_package()
    begun, score = time.monotonic(), {"noticed": 0, "timeout": 0, "missed": 0}
    for fault in sample:
        if time.monotonic() - begun > 60.0 * chosen_options.minutes:
            print(f"stopped after {sum(score.values())} of {len(sample)} faults: {chosen_options.minutes:g} minutes")
            break
        answer = noticed(fault, chosen_options.timeout)
        score[answer] += 1
        print(f"{answer:8} {fault.file.relative_to(ROOT)}:{fault.line} {fault.what}", flush=True)
    tried = sum(score.values())
    share = (tried - score["missed"]) / tried if tried else 0.0
    print(f"{tried} of {len(pool)} faults tried, seed {chosen_options.seed}: {100 * share:.0f} % noticed {score}")
    sys.exit(share < LEAST)


if __name__ == "__main__":
    main()
