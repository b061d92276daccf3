"""The teaching page: a viser scene whose handles and sliders ask a `Session`."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial.transform import Rotation

from dmpcpp._core import Arm, PoseDmp
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import Follow, unjudged
from dmpcpp.show.scene import ShownArm, draw_path, look_at, quaternion, serving
from dmpcpp.show.view._session import Session, Shown

if TYPE_CHECKING:
    from viser import ViserServer

__all__ = ["Page", "described", "serve"]

_FRAME = 1.0 / 30.0  # s between two pictures of the moving arm
_ORANGE, _GREEN, _RED = (230, 159, 0), (0, 158, 115), (213, 94, 0)


def serve(
    model: PoseDmp,
    arm: Arm,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    ready: Callable[[str], None] | None = None,
    stop: threading.Event | None = None,
    follow: str | Follow | None = None,
) -> None:
    """Serve the page until `stop` is set, or the program is interrupted.

    Parameters
    ----------
    model : PoseDmp
        Of poses of the arm's tip in its base frame.
    arm : Arm
    host, port
        See `scene.serving`.
    ready : callable, optional
        Called with the page's address.
    stop : threading.Event, optional
    follow : str, optional
        "pose", "axis", "axis:x", .. or "position": the part of each pose that the arm follows. An arm with fewer
        than six joints needs it.

    Raises
    ------
    InvalidArgument
        The model is not one of poses, or a mesh of the arm cannot be found.
    MissingDependency
        viser or yourdfpy is not installed.
    """
    session, stop = Session(model, arm, follow), stop or threading.Event()
    with serving(host, port) as server:
        page = Page(server, session, arm)
        if ready:
            ready(f"http://{host}:{server.get_port()}")
        while not stop.wait(_FRAME):
            page.tick()


class Page:
    """Handles, sliders, the arm and its path; `tick` is called many times a second."""

    def __init__(self, server: ViserServer, session: Session, arm: Arm) -> None:
        """Fill the scene."""
        self._server, self._session, self._arm = server, session, arm
        self._shown_arm = ShownArm(server, arm)
        self._choice = session.demonstrated
        self._changed = threading.Event()
        self._changed.set()
        self._shown: Shown | None = None
        self._add_handles()
        self._add_panel()
        original = session.update(self._choice).pose[:, :3, 3]
        draw_path(server, "/demonstrated", original, _ORANGE, 0.006)
        look_at(server, original)

    def tick(self) -> None:
        """Compute what has been changed, and move the arm on."""
        if self._changed.is_set():
            self._changed.clear()
            self._recompute()
        shown = self._shown
        if shown is not None and self._play.value:
            phase = (time.monotonic() / max(shown.time[-1], 0.1)) % 1.15  # it rests at the end
            self._shown_arm.move(shown.joints.position[min(int(phase * len(shown.time)), len(shown.time) - 1)])

    def change(self, **fields: Any) -> None:
        """Replace fields of the choice; the next `tick` shows it."""
        self._choice = replace(self._choice, **fields)
        self._changed.set()

    def _add_handles(self) -> None:
        for name in ("goal", "start"):
            pose: Array = getattr(self._choice, name)
            handle = self._server.scene.add_transform_controls(
                f"/{name}", scale=0.16 if name == "goal" else 0.11, position=pose[:3, 3], wxyz=quaternion(pose)
            )
            self._server.scene.add_label(f"/{name}/label", name)
            handle.on_update(partial(self._dragged, name))
            setattr(self, f"_{name}_handle", handle)

    def _dragged(self, name: str, event: Any) -> None:
        self.change(**{name: _pose_of(event.target)})

    def _add_panel(self) -> None:
        gui, begin = self._server.gui, self._choice
        most = max(5.0, 3.0 * begin.duration)
        self._time = gui.add_slider("duration [s]", 0.2, most, 0.05, min(max(begin.duration, 0.2), most))
        self._gain = gui.add_slider("gain alpha", 4.0, max(100.0, begin.alpha), 0.5, begin.alpha)
        self._kernels = gui.add_slider("kernels", 5, max(400, begin.basis_count), 1, begin.basis_count)
        self._play = gui.add_checkbox("move the arm", True)
        again = gui.add_button("as demonstrated")
        self._said = gui.add_markdown("")
        self._time.on_update(lambda _: self.change(duration=float(self._time.value)))
        self._gain.on_update(lambda _: self.change(alpha=float(self._gain.value)))
        self._kernels.on_update(lambda _: self.change(basis_count=int(self._kernels.value)))
        again.on_click(lambda _: self._reset())

    def _reset(self) -> None:
        begin = self._session.demonstrated
        for name in ("goal", "start"):
            handle, pose = getattr(self, f"_{name}_handle"), getattr(begin, name)
            handle.position, handle.wxyz = pose[:3, 3], quaternion(pose)
        self._time.value = begin.duration
        self._gain.value = begin.alpha
        self._kernels.value = begin.basis_count
        self._choice = begin
        self._changed.set()

    def _recompute(self) -> None:
        try:
            shown = self._session.update(self._choice)
        except InvalidArgument as error:
            self._said.content = f"**refused**: {error}"
            return
        self._shown = shown
        draw_path(self._server, "/motion", shown.pose[:, :3, 3], _GREEN if shown.feasible else _RED, 0.005)
        self._said.content = described(shown, self._arm)


def described(shown: Shown, arm: Arm) -> str:
    """Return in Markdown whether the motion is feasible, and what each joint uses of its limits."""
    report = shown.joints.report
    unknown = {
        kind: {doubt.joint for doubt in unjudged(arm, kind)} for kind in ("position", "velocity", "acceleration")
    }
    missed = len(shown.time) - report.solved
    rows = "\n".join(
        f"| {name} | {_share(v, name in unknown['velocity'])} | {_share(a, name in unknown['acceleration'])} "
        f"| {np.degrees(m):.0f}° |"
        for name, v, a, m in zip(
            arm.joint_names, shown.velocity_share, shown.acceleration_share, shown.margin, strict=True
        )
    )
    left = ", ".join(kind for kind, joints in unknown.items() if joints)
    said = (f"**feasible, {left} not judged**" if left else "**feasible**") if shown.feasible else "**not feasible**"
    why = f"; {missed} of {len(shown.time)} poses are missed" if missed else ""
    return (
        f"{said}{why}; the limits allow {shown.shortest:.2f} s or more\n\n"
        f"| joint | velocity | acceleration | to its limit |\n|---|---|---|---|\n{rows}"
    )


def _share(value: float, is_unknown: bool) -> str:
    return "-" if is_unknown else f"{100 * value:.0f} %"


def _pose_of(handle: Any) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = handle.position
    pose[:3, :3] = Rotation.from_quat(np.asarray(handle.wxyz)[[1, 2, 3, 0]]).as_matrix()
    return pose
