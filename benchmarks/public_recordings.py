"""`python -m benchmarks.public_recordings FOLDER...`: public files against readings that share no code with dmpcpp.

Every .c3d, TUM .txt, EuRoC .csv, ROS 1 .bag and HOT3D hand .jsonl below the folders is read twice; a line each says the
largest difference [m], of matrices [1], and whether the same samples are lost. Markers of C3D are compared with ezc3d,
in a process of its own since it ends the process on some files; texts with NumPy and json, bags with rosbags.
Exit status: 0 all within 1e-9 (1e-6 of float32 matrices), 3 one is not. docs/human-motion.md names the files tried.
"""

from __future__ import annotations

import io
import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import click
import numpy as np
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

Array = NDArray[np.float64]
Difference = tuple[str, float]  # what was compared, and by how much it differs

LARGEST, LARGEST_FLOAT32 = 1e-9, 1e-6
_METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}
_EZC3D = """
import sys, ezc3d, numpy as np
found = ezc3d.c3d(sys.argv[1])
point, rotation = found["parameters"]["POINT"], found["parameters"].get("ROTATION", {})
np.savez(
    sys.stdout.buffer,
    points=found["data"]["points"][:3],
    names=np.array(point["LABELS"]["value"], dtype=str),
    unit=np.array(point["UNITS"]["value"], dtype=str),
    rotations=found["data"].get("rotations", np.zeros((4, 4, 0, 0))),
    bodies=np.array(rotation.get("LABELS", {}).get("value", []), dtype=str),
)
"""


def c3d(path: Path) -> Iterator[Difference]:
    """Yield markers and segments against ezc3d."""
    done = subprocess.run([sys.executable, "-c", _EZC3D, str(path)], capture_output=True, check=False)
    if done.returncode != 0:
        raise InvalidArgument("ezc3d cannot read it")
    other = np.load(io.BytesIO(done.stdout))
    unit = _METRES[other["unit"][0]] if len(other["unit"]) else float("nan")
    for k, name in enumerate(other["bodies"]):
        mine = recordings.load(path, str(name).removesuffix("_4X4"))
        poses = other["rotations"][:, :, k].transpose(2, 0, 1)
        yield f"float32 {name}", _apart(mine.position, unit * poses[:, :3, 3])
        yield f"float32 {name}", _apart(mine.rotation.reshape(-1, 9), poses[:, :3, :3].reshape(-1, 9))
    if not len(other["bodies"]):
        markers = recordings.markers(path)
        for k, name in enumerate(markers.names):
            same = np.flatnonzero(other["names"] == name)
            if len(same) == 1:
                yield name, _apart(markers.position[:, k], unit * other["points"][:, same[0]].T)


def tum(path: Path) -> Iterator[Difference]:
    """Yield a TUM trajectory against NumPy."""
    rows = np.loadtxt(path)
    yield from _poses(path, rows[:, 0], rows[:, 1:4], rows[:, 4:8])


def euroc(path: Path) -> Iterator[Difference]:
    """Yield a EuRoC ground truth against NumPy; w first."""
    rows = np.loadtxt(path, delimiter=",")
    yield from _poses(path, 1e-9 * rows[:, 0], rows[:, 1:4], np.roll(rows[:, 4:8], -1, axis=1))


def bag(path: Path) -> Iterator[Difference]:
    """Yield stamped poses of a ROS 1 bag against rosbags."""
    from rosbags.highlevel import AnyReader

    with AnyReader([path]) as reader:
        for connection in reader.connections:
            if not connection.msgtype.endswith("/PoseStamped"):
                continue
            found = [reader.deserialize(raw, connection.msgtype) for *_, raw in reader.messages([connection])]
            poses = [message.pose for message in found]
            position = np.array([[getattr(pose.position, axis) for axis in "xyz"] for pose in poses])
            turn = np.array([[getattr(pose.orientation, axis) for axis in "xyzw"] for pose in poses])
            yield from _poses(path, None, position, turn, connection.topic)


def hot3d(path: Path) -> Iterator[Difference]:
    """Yield both wrists against json; of samples in pairs the first counts."""
    rows = [json.loads(line) for line in path.read_text().splitlines() if line.strip()]
    stamps = np.array([row["timestamp_ns"] for row in rows])
    for hand in recordings.bodies(path):
        mine = recordings.load(path, hand)
        kept = [int(np.argmin(np.abs(stamps - stamps[0] - 1e9 * t))) for t in mine.time]
        wrists = [rows[k]["hand_poses"].get(hand, {}).get("wrist_xform") for k in kept]
        position = np.array([wrist["t_xyz"] if wrist else [np.nan] * 3 for wrist in wrists])
        yield f"hand {hand}", _apart(mine.position, position)


def _poses(
    path: Path, time: Array | None, position: Array, turn: Array, body: str | None = None
) -> Iterator[Difference]:
    mine = recordings.load(path, body)
    yield f"{body or 'pose'}: position", _apart(mine.position, position)
    yield (
        f"{body or 'pose'}: rotation",
        _apart(mine.rotation.reshape(-1, 9), Rotation.from_quat(turn).as_matrix().reshape(-1, 9)),
    )
    if time is not None:
        yield f"{body or 'pose'}: time", float(np.abs(mine.time - (time - time[0])).max() > 1e-6)


def _apart(mine: Array, other: Array) -> float:
    """Return the largest difference; infinite where other samples are lost."""
    if mine.shape != other.shape or (np.isnan(mine) != np.isnan(other)).any():
        return float("inf")
    return float(np.nanmax(np.abs(mine - other), initial=0.0))


READERS: dict[str, Callable[[Path], Iterator[Difference]]] = {
    "c3d": c3d,
    "tum": tum,
    "euroc": euroc,
    "ros": bag,
    "hot3d": hot3d,
}


def _reader(path: Path) -> Callable[[Path], Iterator[Difference]] | None:
    try:
        reader = READERS.get(recordings.format_of(path))
    except InvalidArgument:
        return None
    return None if reader is bag and path.suffix != ".bag" else reader


@click.command()
@click.argument("folders", nargs=-1, required=True, type=click.Path(exists=True, path_type=Path))
def main(folders: tuple[Path, ...]) -> None:
    """Compare every file below FOLDERS with an independent reading."""
    missed = 0
    for path in sorted(path for folder in folders for path in folder.rglob("*") if path.is_file()):
        reader = _reader(path)
        if reader is None:
            continue
        try:
            found = list(reader(path))
        except InvalidArgument as error:
            click.echo(f"refused  {path.name}: {str(error).splitlines()[0][:120]}")
            continue
        if not found:
            continue
        worst = max((value for _, value in found), default=0.0)
        limit = LARGEST_FLOAT32 if any(what.startswith("float32") for what, _ in found) else LARGEST
        missed += worst > limit
        click.echo(
            f"{'ok      ' if worst <= limit else 'DIFFERS '} {path.name}: {len(found)} compared, at most {worst:.2g}"
        )
    sys.exit(3 if missed else 0)


if __name__ == "__main__":
    main()
