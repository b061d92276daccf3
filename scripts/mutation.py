#!/usr/bin/env python3
"""Mutation score: how many small faults, put into the sources one at a time, the tests notice.

    scripts/mutation.py [--count 20] [--seed 1] [--minutes 30] [so3 basis ...]

A sample of all faults is drawn with a fixed seed. Each is compiled in a copy of the sources in build/mutation and the
tests named below are run against it, until one fails (noticed) or all pass (missed). What does not compile is no fault.
"""

import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TREE = ROOT / "build" / "mutation"
BUILD = TREE / "build" / "release"
LEAST = 0.8

# Source under cpp/src (a .cpp unless its name says otherwise): the tests that should notice a fault, the nearest first.
TESTS = {
    "geometry/so3": ["so3", "refusals", "orientation_dmp", "so3_properties"],
    "primitive/basis": ["basis", "forcing", "refusals", "dmp", "dmp_properties"],
    "primitive/forcing": ["forcing", "refusals", "dmp", "fit_report", "dmp_properties"],
    "primitive/forcing_fit": ["forcing", "refusals", "dmp", "batch", "fit_report"],
    "primitive/normal_equations": ["forcing", "dmp", "fit_report", "batch"],
    "primitive/vector_system": ["dmp", "coupling", "run_refusals", "dmp_properties"],
    "primitive/rotation_system": ["orientation_dmp", "coupling", "run_refusals", "dmp_properties"],
    "primitive/runner.hpp": ["dmp", "coupling", "run_refusals", "pose_dmp", "realtime"],
    "primitive/fitting.hpp": ["dmp", "learning", "average", "pose_gripper_dmp", "orientation_dmp", "refusals"],
    "primitive/rotation_space": ["orientation_dmp", "fit_report", "learning"],
    "primitive/orientation_forms": ["orientation_dmp", "pose_gripper_dmp", "fit_report"],
    "primitive/automatic_fit": ["learning", "dmp", "fit_report", "pose_dmp"],
    "primitive/product_space.hpp": ["pose_gripper_dmp", "pose_dmp", "fit_report", "spread"],
    "primitive/primitive_bodies.hpp": ["dmp", "learning", "refusals", "run_refusals", "pose_gripper_dmp"],
}

SWAPS = {
    " < ": " <= ", " > ": " >= ", " <= ": " < ", " >= ": " > ", " == ": " != ", " != ": " == ", " + ": " - ",
    " - ": " + ", " * ": " / ", " / ": " * ", " && ": " || ", " || ": " && ", " += ": " -= ", " -= ": " += ",
    " *= ": " /= ", "true": "false", "false": "true", "++": "--", "std::min": "std::max", "std::max": "std::min",
}  # fmt: skip
SWAP = re.compile("|".join(rf"\b{re.escape(s)}\b" if s.isalpha() else re.escape(s) for s in SWAPS))
NUMBER = re.compile(r"(?<![\w.<])\d+(\.\d*)?(e-?\d+)?(?![\w.>])")
STATEMENT = re.compile(r"^\s+[\w.\[\]()>-]+( [-+*/]?= .*|\(.*\));$")
NO_CODE = re.compile(r"^\s*(//|#|using |template|case )|InvalidArgument|static_assert|^\s*\"")


@dataclass(frozen=True)
class Fault:
    """One line of a source as it should not be."""

    source: str
    line: int
    text: str


def in_code(line: str, at: int) -> bool:
    """Return whether a place in a line lies outside strings and comments."""
    comment = line.find("//")
    return line[:at].count('"') % 2 == 0 and (comment < 0 or at < comment)


def changed(line: str) -> list[str]:
    """Return a line with each fault that it can have."""
    if NO_CODE.search(line):
        return []
    found = [line[: m.start()] + SWAPS[m[0]] + line[m.end() :] for m in SWAP.finditer(line) if in_code(line, m.start())]
    for m in NUMBER.finditer(line):
        if in_code(line, m.start()):
            found.append(f"{line[: m.start()]}({m[0]} + 1){line[m.end() :]}")
    return found + ([";"] if STATEMENT.match(line) else [])


def file_of(source: str) -> str:
    """Return the path below cpp/src."""
    return source if source.endswith(".hpp") else f"{source}.cpp"


def faults(source: str) -> list[Fault]:
    """Return every fault of a source that is known here."""
    lines = (ROOT / "cpp" / "src" / file_of(source)).read_text().splitlines()
    return [Fault(source, k, text) for k, line in enumerate(lines) for text in changed(line)]


def quiet(*command: str | Path, seconds: float | None = None) -> bool:
    """Run a command; return whether it succeeded in time."""
    try:
        few = {**os.environ, "DMP_CASES": "200"}
        done = subprocess.run(command, cwd=TREE, capture_output=True, check=False, timeout=seconds, env=few)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def prepare(sources: list[str]) -> None:
    """Copy the sources and build the tests; these must pass as the sources are.

    Copied with the time of now: an object that an earlier run left, with a fault in it, is older then.
    """
    for name in ("CMakeLists.txt", "CMakePresets.json", "LICENSE"):
        TREE.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, TREE)
    for name in ("cmake", "cpp", "tests", "examples", "benchmarks"):
        shutil.copytree(ROOT / name, TREE / name, dirs_exist_ok=True, copy_function=shutil.copy)
    needed = sorted({test for source in sources for test in TESTS[source]})
    configured = quiet("cmake", "--preset", "release", "-DDMP_KINEMATICS=OFF", "-DDMP_BENCHMARKS=OFF")
    if not configured or not quiet("ninja", "-C", BUILD, *(f"test_{test}" for test in needed)):
        sys.exit("mutation.py: the sources do not build as they are")
    for test in needed:
        if not all_pass([test]):
            sys.exit(f"mutation.py: the test {test} fails with the sources as they are")


def all_pass(tests: list[str]) -> bool:
    """Return whether they do; one that does not come to its end fails."""
    return all(quiet(BUILD / "tests" / "cpp" / f"test_{test}", seconds=120) for test in tests)


def verdict(fault: Fault) -> str:
    """Put one fault in, build, test, and take it out again."""
    original = ROOT / "cpp" / "src" / file_of(fault.source)
    mutated = TREE / "cpp" / "src" / file_of(fault.source)
    lines = original.read_text().splitlines()
    lines[fault.line] = fault.text
    mutated.write_text("\n".join(lines) + "\n")
    try:
        if not quiet("ninja", "-C", BUILD, "libdmp.so"):
            return "no code"
        return "missed" if all_pass(TESTS[fault.source]) else "noticed"
    finally:
        shutil.copy(original, mutated)


def trials(source: str, count: int, seed: int, end: float) -> list[str]:
    """Return the verdicts of a sample of a source's faults, as far as the time goes, and tell what was missed."""
    everything = faults(source)
    verdicts: list[str] = []
    for fault in random.Random(seed).sample(everything, min(count, len(everything))):
        if time.monotonic() > end:
            break
        verdicts.append(verdict(fault))
        if verdicts[-1] == "missed":
            print(f"missed  cpp/src/{file_of(source)}:{fault.line + 1}:{fault.text}", flush=True)
    tried = len(verdicts) - verdicts.count("no code")
    print(f"{source}: {verdicts.count('noticed')} of {tried} noticed ({len(everything)} faults known)", flush=True)
    return verdicts


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", nargs="*", default=list(TESTS), metavar="SOURCE")
    parser.add_argument("--count", type=int, default=20, help="faults of each source")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--minutes", type=float, default=90.0, help="after which no fault is begun")
    arguments = parser.parse_args()
    for source in arguments.sources:
        if source not in TESTS:
            parser.error(f"SOURCE: '{source}', expected one of {', '.join(TESTS)}")
    prepare(arguments.sources)
    end = time.monotonic() + 60.0 * arguments.minutes
    verdicts = {s: trials(s, arguments.count, arguments.seed, end) for s in arguments.sources}
    noticed = sum(v.count("noticed") for v in verdicts.values())
    tried = sum(len(v) - v.count("no code") for v in verdicts.values())
    print(f"mutation score {100 * noticed / max(tried, 1):.1f} %, {noticed} of {tried}, seed {arguments.seed}")
    untried = [source for source, v in verdicts.items() if len(v) == v.count("no code")]
    if untried:
        print(f"not tried within {arguments.minutes:g} min: {', '.join(untried)}")
    sys.exit(0 if tried and noticed >= LEAST * tried and not untried else 1)


if __name__ == "__main__":
    main()
