#!/usr/bin/env python3
"""The rooms of the C++ sources: their size, the includes that run up, and the files that a change touches.

    scripts/rooms.py

docs/architecture.md draws the floors and lists the changes. Status 1 where an include runs up, or where a listed file
is not there or not counted.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
SOURCES = ROOT / "cpp" / "src"
HEADERS = ROOT / "cpp" / "include" / "dmp"
BINDINGS = ROOT / "python" / "bindings"
DRAWING = ROOT / "docs" / "architecture.md"

# Public headers without a source of their name; all others belong to the room of that source.
HEADER_ONLY = {
    "base": {"alignment", "export", "ik_status", "mailbox", "realtime", "status", "trajectory"},
    "spline": {"noise"},
    "motion": {"align"},
    "primitive": {"batch", "coupling", "primitive", "product", "spread", "stepper", "via"},
}


def floors() -> dict[str, int]:
    """Return {room: floor} as the drawing has them."""
    block = re.search(r"```\ncpp/src\n(.*?)```", DRAWING.read_text(), re.DOTALL)[1]
    rows = re.findall(r"^ *(\d+)  (.*?)(?: {12}.*)?$", block, re.MULTILINE)  # behind a gap stands a remark
    return {room: int(floor) for floor, rooms in rows for room in rooms.split()}


def rooms() -> dict[str, list[Path]]:
    """Return the files of each room, its public headers among them."""
    found = {room: sorted((SOURCES / room).rglob("*.?pp")) for room in floors() if (SOURCES / room).is_dir()}
    found["python/bindings"] = sorted(BINDINGS.glob("*.?pp"))
    stems = {path.stem: room for room, files in found.items() for path in files if path.suffix == ".cpp"}
    stems |= {stem: room for room, names in HEADER_ONLY.items() for stem in names}
    for header in sorted(HEADERS.glob("*.hpp")):
        found[stems[header.stem]].append(header)
    return found


def runs_up(found: dict[str, list[Path]]) -> list[str]:
    """Return every include of another room that is not on a lower floor."""
    floor = floors()
    room_of = {path: room for room, files in found.items() for path in files}
    wrong = []
    for path, room in room_of.items():
        for name in re.findall(r'^#include ["<]([\w/]+\.hpp)[">]', path.read_text(), re.MULTILINE):
            target = HEADERS / name.removeprefix("dmp/") if name.startswith("dmp/") else SOURCES / name
            there = room_of.get(target, room)
            if there != room and floor[there] >= floor[room]:
                wrong.append(f"{path.relative_to(ROOT)} includes {name}: from {room} up to {there}")
    return wrong


def changes() -> list[tuple[str, int, int, list[str]]]:
    """Return (change, files before, files now, their names) of the table in docs/architecture.md."""
    rows = re.findall(r"^\| (.+?) \| (\d+) \| (\d+) \| (.+?) \|$", DRAWING.read_text(), re.MULTILINE)
    return [(what, int(before), int(now), re.findall(r"`(\w+\.\w+)`", which)) for what, before, now, which in rows]


def miscounted() -> list[str]:
    """Return every row of that table whose files are not there or not as many as it says."""
    there = {path.name for folder in (SOURCES, HEADERS, BINDINGS) for path in folder.rglob("*") if path.is_file()}
    wrong = []
    for what, _, now, names in changes():
        wrong += [f"{what}: {name} is not there" for name in names if name not in there]
        if len(names) != now:
            wrong.append(f"{what}: {len(names)} files named, {now} counted")
    return wrong


def lines_of(path: Path) -> int:
    """Return the number of lines."""
    return path.read_text().count("\n")


def main() -> int:
    """Print it all."""
    found = rooms()
    print(f"{'room':16} {'floor':>5} {'files':>5} {'lines':>6}  longest")
    for room, files in sorted(found.items(), key=lambda item: (-floors()[item[0]], item[0])):
        longest = max(files, key=lines_of)
        total = sum(map(lines_of, files))
        print(f"{room:16} {floors()[room]:5} {len(files):5} {total:6}  {longest.name} {lines_of(longest)}")
    up = runs_up(found)
    print(f"\nincludes that run up: {len(up)}", *up, sep="\n  ")
    print(f"\n{'files that a change touches':52} before  now")
    for what, before, now, names in changes():
        print(f"{what:52} {before:6} {now:4}  {', '.join(names)}")
    wrong = miscounted()
    print(*wrong, sep="\n")
    return 1 if up or wrong else 0


if __name__ == "__main__":
    sys.exit(main())
