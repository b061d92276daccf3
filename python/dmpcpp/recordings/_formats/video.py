"""Videos of a hand or of a printed tag (extra `cameras`): poses measured by one camera or two.

What a video does not say is stated: the camera, a length, where up is. See `dmpcpp.cameras`.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.recordings._reader import Reader
from dmpcpp.recordings._recording import Recording
from dmpcpp.recordings._statement import Stated

if TYPE_CHECKING:
    from dmpcpp.cameras import Camera, Poses

__all__ = ["READER"]

_ENDINGS = (".mp4", ".mov", ".m4v", ".webm", ".mkv", ".avi", ".gif")
_HANDS = ("right_hand", "left_hand")
TAKES = (
    "second_view",
    "fov",
    "camera",
    "hand_length",
    "board",
    "extrinsics",
    "pitch",
    "tag",
    "mirrored",
    "up_axis",
)


def _recognises(path: Path, head: bytes) -> bool:
    if path.suffix.lower() not in (*_ENDINGS, ""):
        return False
    riff = head.startswith(b"RIFF") and head[8:12] == b"AVI "
    return head[4:8] == b"ftyp" or head.startswith((b"\x1aE\xdf\xa3", b"GIF8")) or riff


def bodies(path: Path, stated: Stated) -> tuple[str, ...]:
    """Return the body of the tag, or the right hand."""
    from dmpcpp import cameras  # not for other formats

    if stated.tag is not None:
        return (f"tag_{cameras.body_of_tags(stated.tag)[0].id}",)
    return ("right_hand",)


def read(path: Path, body: str | None, stated: Stated) -> Recording:
    """Return the poses of a hand or a body of tags."""
    from dmpcpp import cameras

    _require_stated(stated)
    if stated.tag is not None:
        name = bodies(path, stated)[0]
        if body not in (None, name):
            raise InvalidArgument(f"body: no body {body!r} in the file. It holds: {name}.")
        tagged = cameras.TagSetup(_Cameras(stated, 0), stated.tag, str(stated.up_axis), stated.pitch)
        return _recording(cameras.tag_poses(path, tagged), name, path)
    hand = _hand(body)
    paths = [path] if stated.second_view is None else [path, Path(stated.second_view)]
    setup = cameras.HandSetup(
        lambda k, size: _Cameras(stated, k)(size),
        None if stated.hand_length is None else cameras.hand_length(stated.hand_length),
        str(stated.up_axis),
        None if stated.extrinsics is None else cameras.relation_from_file(stated.extrinsics),
        None if stated.board is None else cameras.board_of(stated.board),
        stated.pitch,
        hand,
        bool(stated.mirrored),
    )
    return _recording(cameras.hand_poses(paths, setup), f"{hand or 'right'}_hand", path)


def _hand(body: str | None) -> Literal["left", "right"] | None:
    names = {"left": "left", "right": "right", "left_hand": "left", "right_hand": "right", None: None}
    if body not in names:
        raise InvalidArgument(
            f"body: no body {body!r} in the file. It holds: {', '.join(_HANDS)}, or a tag (tag='0:60mm')."
        )
    return names[body]  # type: ignore[return-value]


def _require_stated(stated: Stated) -> None:
    """Ask for what no video says, all at once as far as it is known."""
    if stated.fov is None and stated.camera is None:
        raise NotStated(
            ("fov", "camera"),
            "fov: a video does not say how wide its camera sees. State its horizontal field of view, fov='69deg' (a "
            "phone's main camera: 65 to 75, a webcam: 55 to 80), or a calibration file, camera=....",
        )
    metric = stated.tag is not None or (stated.second_view is not None and (stated.board or stated.extrinsics))
    if stated.hand_length is None and not metric:
        raise NotStated(
            ("hand_length", "tag"),
            "hand_length: a video does not say how large things are. Measure the hand from the crease of the wrist to "
            "the tip of the middle finger and state hand_length='190mm', or use a printed tag: tag='0:60mm'.",
        )
    if stated.up_axis is None:
        raise NotStated(
            "up_axis",
            "up_axis: a video does not say where up is. State up_axis='image' where the first camera stands level "
            "(pitch='15deg' where it looks down), up_axis='tag:5' or up_axis='board' where one lies on the table.",
        )
    if stated.second_view is not None and stated.tag is not None:
        raise InvalidArgument("tag, second_view: both are stated, expected one of them: a tag needs one camera.")
    for name in ("board", "extrinsics"):
        if name == "extrinsics" and getattr(stated, name) is not None and stated.second_view is None:
            raise InvalidArgument("extrinsics: with one video it says nothing. Give the second video, too.")


class _Cameras:
    """The camera of the k-th video, for a size of its pictures."""

    def __init__(self, stated: Stated, k: int) -> None:
        self.stated, self.k = stated, k

    def __call__(self, size: tuple[int, int]) -> Camera:
        from dmpcpp import cameras

        if self.stated.camera is not None:
            return cameras.camera_from_file(self.stated.camera, size, self.k)
        assert self.stated.fov is not None
        if isinstance(self.stated.fov, str) and "," in self.stated.fov:
            each = self.stated.fov.split(",")
            return cameras.Camera.of_fov(cameras.angle("fov", each[min(self.k, len(each) - 1)]), size)
        return cameras.Camera.of_fov(cameras.angle("fov", self.stated.fov), size)


def _recording(found: Poses, body: str, path: Path) -> Recording:
    rotation = np.where(np.isnan(found.rotation), np.eye(3), found.rotation)
    u, _, vt = np.linalg.svd(rotation)
    rotation = np.where(np.isnan(found.rotation), np.nan, u @ vt)
    notes = list(found.notes)
    return Recording(
        time=found.time,
        position=found.position,
        rotation=rotation,
        body=body,
        source=path.name,
        up_axis=found.up_axis,  # type: ignore[arg-type]
        history=tuple(notes),
        kind="video",
        accuracy=(found.accuracy.position, found.accuracy.angle),
    )


READER = Reader(
    "video",
    "video of a hand, or of a printed tag (extra cameras)",
    TAKES,
    _recognises,
    bodies,
    read,
    kind="video",
)
