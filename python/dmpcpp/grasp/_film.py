"""A grasp to look at: a film, or a picture of its phases."""

from __future__ import annotations

import importlib
from collections.abc import Callable, Iterator
from os import PathLike
from pathlib import Path
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from dmpcpp._atomic import replacing
from dmpcpp.errors import InvalidArgument, MissingDependency
from dmpcpp.grasp._attempt import Grasp
from dmpcpp.grasp._timing import PHASES
from dmpcpp.simulation import GraspWorld, ParallelGripper

__all__ = ["FORMATS", "film", "refuse_format"]

FORMATS = (".mp4", ".gif", ".png")

_FRAMES_PER_SECOND = 12.5
_WIDTH, _HEIGHT = 512, 384  # multiples of 16: what video codecs want

Frame = NDArray[np.uint8]


def refuse_format(path: str | PathLike[str]) -> None:
    """Check that a film of that name can be written, before anything is computed.

    Raises
    ------
    InvalidArgument
        Another suffix than FORMATS.
    MissingDependency
        The package that writes it is not installed.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        raise InvalidArgument(f"video: '{path}', expected a name that ends in {', '.join(FORMATS)}.")
    _writer(suffix)


def film(
    run: Grasp,
    gripper: ParallelGripper,
    path: str | PathLike[str],
    progress: Callable[[float], None] | None = None,
) -> None:
    """Write a grasp as .mp4 or .gif in real time, or as .png: one image for the end of each phase.

    What was recorded is played back, not simulated again.

    Raises
    ------
    InvalidArgument, MissingDependency
        See `refuse_format`.
    FileError
        The file cannot be written.
    """
    refuse_format(path)
    suffix = Path(path).suffix.lower()
    records = _phase_ends(run) if suffix == ".png" else _evenly(run)
    frames = _frames(run, gripper, records, progress)
    with replacing(path) as beside:
        if suffix == ".mp4":
            _write_mp4(beside, frames)
        elif suffix == ".gif":
            _write_gif(beside, frames)
        else:
            _writer(suffix).fromarray(np.hstack(list(frames))).save(beside)


def _evenly(run: Grasp) -> list[int]:
    """Records in steps of a frame, the last one kept."""
    time = run.log.time
    records = np.searchsorted(time, np.arange(time[0], time[-1], 1.0 / _FRAMES_PER_SECOND))
    return [*map(int, records), len(time) - 1]


def _phase_ends(run: Grasp) -> list[int]:
    return [max(run.log.during(phase, phase).stop - 1, 0) for phase in PHASES[:-1]] + [len(run.log.time) - 1]


def _frames(
    run: Grasp, gripper: ParallelGripper, records: list[int], progress: Callable[[float], None] | None
) -> Iterator[Frame]:
    log, bottle = run.log, run.plan.bottle
    around = run.plan.around.obstacles
    with GraspWorld(run.arm, 1e-3, gripper, bottle.cylinder, bottle.place, visuals=True, obstacles=around) as world:
        for done, k in enumerate(records, start=1):
            world.put(log.position[k], float(log.opening[k]), log.object_pose[k])
            yield world.image(_WIDTH, _HEIGHT)
            if progress:
                progress(done / len(records))


def _write_mp4(path: Path, frames: Iterator[Frame]) -> None:
    size = (_WIDTH, _HEIGHT)
    output = _writer(".mp4").write_frames(str(path), size, fps=_FRAMES_PER_SECOND, ffmpeg_log_level="error")
    output.send(None)
    try:
        for frame in frames:
            output.send(np.ascontiguousarray(frame))
    finally:
        output.close()


def _write_gif(path: Path, frames: Iterator[Frame]) -> None:
    images = [_writer(".gif").fromarray(frame).quantize(64) for frame in frames]
    duration = round(1000.0 / _FRAMES_PER_SECOND)
    images[0].save(path, save_all=True, append_images=images[1:], duration=duration, loop=0, optimize=True)


def _writer(suffix: str) -> ModuleType:
    name = "imageio_ffmpeg" if suffix == ".mp4" else "PIL.Image"
    try:
        return importlib.import_module(name)
    except ImportError:
        raise MissingDependency(
            f"{name.partition('.')[0]}, which writes {suffix} files, is not installed. "
            'Install the extra: pip install "dmpcpp[video]".'
        ) from None
