"""A local page that shows the cameras of this machine with the hand that is found, and records their videos.

It listens on the loopback interface alone, answers only requests that carry its secret, and talks to no other machine:
the browser's pictures stay here. What is live is a viewfinder, frame by frame; what is learned from are the videos.
"""

from __future__ import annotations

import json
import secrets
import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlparse

import numpy as np

from dmpcpp._atomic import replacing
from dmpcpp._typing import Array
from dmpcpp.cameras._opencv import opencv
from dmpcpp.cameras._tracker import Tracker
from dmpcpp.cameras._viewfinder_page import PAGE

__all__ = ["NAMES", "Viewfinder"]

NAMES = ("left", "right")
"""What the videos of two cameras are called; that of one is the first."""

_MOST_PICTURE, _MOST_VIDEO = 4 << 20, 2 << 30  # bytes
_PIECE = 1 << 20
_HEADERS = {
    "Content-Security-Policy": "default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; "
    "connect-src 'self'; img-src data:; media-src blob:",
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}
_BONES = [(0, 1), (1, 2), (2, 3), (3, 4), (0, 5), (0, 9), (0, 13), (0, 17), (5, 9), (9, 13), (13, 17)]
_BONES += [(k + j, k + j + 1) for k in (5, 9, 13, 17) for j in range(3)]

ArmOf = Callable[[Array, Array], list[list[float]]]
"""Called with landmarks (21, 2), 0 to 1 of the picture, and world landmarks (21, 3) [m]; returns points (N, 2) of the
arm to draw, 0 to 1 of a square.
"""


@dataclass
class Viewfinder:
    """The page and its server.

    Parameters
    ----------
    folder : Path
        Where the videos are written.
    count : int
        Cameras, 1 or 2.
    arm : callable, optional
        Poses the arm that follows the hand in the first camera, see `ArmOf`.
    port : int
        0: any that is free.
    """

    folder: Path
    count: int = 2
    arm: ArmOf | None = None
    port: int = 0
    videos: list[Path] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Begin to listen on the loopback interface."""
        self.secret, self.nonce = secrets.token_urlsafe(18), secrets.token_urlsafe(12)
        self._done, self._lock = threading.Event(), threading.Lock()
        self._trackers = [Tracker() for _ in range(self.count)]
        self._server = ThreadingHTTPServer(("127.0.0.1", self.port), self._handler())
        self._server.daemon_threads = True
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    @property
    def address(self) -> str:
        """What to open in a browser of this machine."""
        return f"http://127.0.0.1:{self._server.server_address[1]}/?key={self.secret}"

    def wait(self, timeout: float | None = None) -> list[Path]:
        """Return the videos when all are recorded; what there is after `timeout` [s]."""
        self._done.wait(timeout)
        return sorted(self.videos)

    def close(self) -> None:
        """Stop listening."""
        self._server.shutdown()
        self._server.server_close()

    def page(self) -> bytes:
        """Return the page."""
        settings = {"count": self.count, "names": NAMES[: self.count], "bones": _BONES, "key": self.secret}
        return PAGE.replace("{{nonce}}", self.nonce).replace("{{settings}}", json.dumps(settings)).encode()

    def look(self, camera: int, encoded: bytes) -> dict[str, Any]:
        """Return what is found in a picture (JPEG): landmarks, how sure, and the arm."""
        cv2 = opencv()
        picture = cv2.imdecode(np.frombuffer(encoded, np.uint8), cv2.IMREAD_COLOR)
        if picture is None:
            return {"found": False}
        with self._lock:
            seen = self._trackers[camera].track(picture)
        if seen is None:
            return {"found": False}
        size = np.array([picture.shape[1], picture.shape[0]])
        answer = {
            "found": True,
            "points": np.round(seen.pixels / size, 4).tolist(),
            "right": round(seen.right, 3),
            "flat": _faces(seen.world),
        }
        if self.arm is not None and camera == 0:
            answer["arm"] = self.arm(seen.pixels / size, seen.world)
        return answer

    def keep(self, camera: int, stream: Any, length: int) -> Path:
        """Write a video that the browser recorded; when all are there, the waiting ends."""
        self.folder.mkdir(parents=True, exist_ok=True)
        path = self.folder / f"{NAMES[camera]}.webm"
        with replacing(path) as beside, beside.open("wb") as file:
            while length > 0 and (piece := stream.read(min(length, _PIECE))):
                file.write(piece)
                length -= len(piece)
        with self._lock:
            self.videos = sorted({*self.videos, path})
            if len(self.videos) == self.count:
                self._done.set()
        return path

    def _handler(self) -> type[BaseHTTPRequestHandler]:
        finder = self

        class Handler(BaseHTTPRequestHandler):
            def log_message(self, format: str, *args: object) -> None:
                """Print nothing."""

            def do_GET(self) -> None:
                where = urlparse(self.path)
                if not self._allowed() or where.path != "/":
                    return self._answer(404 if self._allowed() else 403, b"")
                return self._answer(200, finder.page(), "text/html; charset=utf-8")

            def do_POST(self) -> None:
                where = urlparse(self.path)
                camera = parse_qs(where.query).get("camera", ["0"])[0]
                length = self.headers.get("Content-Length", "")
                most = {"/frame": _MOST_PICTURE, "/video": _MOST_VIDEO}.get(where.path, 0)
                if not self._allowed() or not camera.isdigit() or int(camera) >= finder.count:
                    return self._refused(403)
                if not length.isdigit() or not 0 < int(length) <= most:
                    return self._refused(413 if most else 404)
                if where.path == "/frame":
                    found = finder.look(int(camera), self.rfile.read(int(length)))
                    return self._answer(200, json.dumps(found).encode(), "application/json")
                path = finder.keep(int(camera), self.rfile, int(length))
                return self._answer(200, json.dumps({"written": path.name}).encode(), "application/json")

            def _allowed(self) -> bool:
                """Whether the request is of this page: the secret, and a host that is this machine."""
                host, port = finder._server.server_address[:2]
                key = parse_qs(urlparse(self.path).query).get("key", [""])[0]
                own = {f"{host!s}:{port}", f"localhost:{port}"}
                origin = self.headers.get("Origin")
                return (
                    secrets.compare_digest(key.encode(), finder.secret.encode())
                    and self.headers.get("Host") in own
                    and (origin is None or origin.removeprefix("http://") in own)
                )

            def _refused(self, status: int) -> None:
                self.close_connection = True  # what was sent is not read
                self._answer(status, b"")

            def _answer(self, status: int, body: bytes, kind: str = "text/plain") -> None:
                self.send_response(status)
                for name, value in _HEADERS.items():
                    self.send_header(name, value.format(nonce=finder.nonce))
                self.send_header("Content-Type", kind)
                self.send_header("Content-Length", str(len(body)))
                self.end_headers()
                self.wfile.write(body)

        return Handler


def _faces(world: Array) -> float:
    """Return how much the palm faces the camera, 0 (edge on) to 1."""
    normal = np.cross(world[5] - world[0], world[17] - world[0])
    return round(float(abs(normal[2]) / max(float(np.linalg.norm(normal)), 1e-9)), 3)
