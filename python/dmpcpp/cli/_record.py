"""`dmpcpp record`: videos from the cameras of this machine, handed to `imitate`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import click

from dmpcpp.cli._arm_options import optional_arm_options, taken_arm
from dmpcpp.cli._group import refuse_file


@click.command()
@click.option("--cameras", "count", default=2, show_default=True, type=click.IntRange(1, 2), help="Cameras to record.")
@click.option("--fov", metavar="69deg", help="Horizontal field of view of the cameras, for `imitate`.")
@click.option("--hand-length", metavar="190mm", help="Crease of the wrist to tip of the middle finger, for `imitate`.")
@click.option("--up", default="image", show_default=True, metavar="image|..", help="Where up is, for `imitate`.")
@optional_arm_options("Show this arm following the hand, and run `imitate` on it with the videos.")
@click.option(
    "--out",
    default="dmpcpp-record",
    show_default=True,
    type=click.Path(file_okay=False, path_type=Path),
    help="Folder for left.webm and right.webm.",
)
@click.option("--port", default=0, type=click.IntRange(0, 65535), help="Port of the page (default: any that is free).")
@click.option("--no-browser", is_flag=True, help="Print the page's address and open no browser.")
def record(
    count: int,
    fov: str | None,
    hand_length: str | None,
    up: str,
    out: Path,
    port: int,
    no_browser: bool,
    **options: Any,
) -> None:
    """Show the cameras of this machine with the hand that is found, and record their videos.

    A page opens in the browser; it is served to this machine alone, and nothing leaves it. On "Stop and save" the
    videos are written, and `dmpcpp imitate` goes on with them where --arm, --fov and --hand-length are given; else its
    command is printed.

    Example: dmpcpp record --cameras 2 --arm panda --fov 69deg --hand-length 190mm
    """
    from dmpcpp import cameras
    from dmpcpp.cli._live_arm import LiveArm

    refuse_file(out)
    arm = options["arm"]
    live = LiveArm(taken_arm(options)) if arm is not None else None
    finder = cameras.Viewfinder(out, count, live, port)
    click.echo(f"open {finder.address} (Ctrl-C ends it)")
    if not no_browser:
        click.launch(finder.address)
    try:
        videos = finder.wait()
    finally:
        finder.close()
    click.echo(f"written: {', '.join(map(str, videos))}")
    words = ["imitate", *map(str, videos), "--up", up, "--out", str(out / "imitation")]
    words += ["--fov", fov] if fov else []
    words += ["--hand-length", hand_length] if hand_length else []
    words += ["--arm", arm] if arm else []
    if arm is None or fov is None or hand_length is None:
        missing = [f"{name} .." for name in ("--arm", "--fov", "--hand-length") if name not in words]
        click.echo(f"next: dmpcpp {' '.join([*words, *missing])}")
        return
    sys.exit(subprocess.run([sys.executable, "-m", "dmpcpp", *words]).returncode)
