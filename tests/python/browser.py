"""A page in headless Chromium: what it asked for, what it complained about and what it looks like."""

from __future__ import annotations

import base64
import json
import re
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest


@dataclass
class Seen:
    """What a page did until it was looked at."""

    requests: list[str] = field(default_factory=list)
    complaints: list[str] = field(default_factory=list)
    picture: bytes = b""
    values: dict[str, Any] = field(default_factory=dict)


def look(
    place: Path | str,
    folder: Path,
    *,
    until: Callable[[Seen], bool],
    scripts: dict[str, str] | None = None,
    size: str = "1280,2000",
    media: str = "screen",
    patience: float = 240.0,
    flags: tuple[str, ...] = (),
) -> Seen:
    """Open a file or an address, and run scripts in it and take its picture again and again until it is as wanted.

    `flags` are for Chromium. `media` is "screen" or "print". A page that is not as wanted after `patience` [s] is
    returned as it is. Skips where there is no Chromium.
    """
    connect = pytest.importorskip("websockets.sync.client").connect
    with _chromium(folder, size, flags) as address, connect(address, max_size=None) as socket:
        page = _Page(socket)
        target = page.call("Target.createTarget", url="about:blank")["targetId"]
        page.session = page.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Network", "Runtime", "Log", "Page"):
            page.call(f"{domain}.enable")
        page.call("Emulation.setEmulatedMedia", media=media)
        page.call("Page.navigate", url=place if isinstance(place, str) else place.resolve().as_uri())
        end = time.monotonic() + patience
        while True:
            page.listen(1.0)
            seen = Seen(values={name: page.evaluate(script) for name, script in (scripts or {}).items()})
            seen.picture = base64.b64decode(page.call("Page.captureScreenshot", format="png")["data"])
            seen.requests, seen.complaints = page.requests(), page.complaints()
            if until(seen) or time.monotonic() > end:
                return seen


class _Page:
    """The other end of Chromium's debugging protocol."""

    def __init__(self, socket: Any) -> None:
        self._socket, self._number, self.session, self._events = socket, 0, None, []

    def call(self, method: str, **parameters: Any) -> dict[str, Any]:
        self._number += 1
        message = {"id": self._number, "method": method, "params": parameters}
        self._socket.send(json.dumps(message | ({"sessionId": self.session} if self.session else {})))
        while True:
            answer = json.loads(self._socket.recv(timeout=120))
            if answer.get("id") == self._number:
                assert "error" not in answer, answer
                return answer["result"]
            self._events.append(answer)

    def evaluate(self, script: str) -> Any:
        """Return what a script gives; None where it fails, as before the page is there."""
        answer = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        return answer["result"].get("value")

    def listen(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            try:
                self._events.append(json.loads(self._socket.recv(timeout=left)))
            except TimeoutError:
                return

    def requests(self) -> list[str]:
        """Return the addresses that were asked for, but for the file itself and what it holds inside."""
        urls = [e["params"]["request"]["url"] for e in self._events if e.get("method") == "Network.requestWillBeSent"]
        return [url for url in urls if not re.match(r"data:|blob:|about:", url)]

    def complaints(self) -> list[str]:
        found = []
        for event in self._events:
            method, parameters = event.get("method"), event.get("params", {})
            if method == "Runtime.exceptionThrown":
                found.append(str(parameters["exceptionDetails"]))
            elif method == "Log.entryAdded" and parameters["entry"]["level"] == "error":
                found.append(parameters["entry"]["text"])
            elif method == "Runtime.consoleAPICalled" and parameters["type"] == "error":
                found.append(str([a.get("value", a.get("description")) for a in parameters["args"]]))
        return found


@contextmanager
def _chromium(folder: Path, size: str, more: tuple[str, ...] = ()) -> Iterator[str]:
    program = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if program is None:
        pytest.skip("Chromium is not installed (Debian: apt install chromium)")
    flags = ("--headless=new", "--no-sandbox", "--remote-debugging-port=0", f"--window-size={size}")
    drawing = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist")
    quiet = ("--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync")
    profile = folder / "chromium"
    process = subprocess.Popen(
        [program, *flags, *drawing, *quiet, *more, f"--user-data-dir={profile}", "about:blank"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield _address(profile / "DevToolsActivePort", process)
    finally:
        process.kill()
        process.wait()


def _address(path: Path, process: subprocess.Popen[bytes]) -> str:
    for _ in range(600):
        if path.exists() and len(lines := path.read_text().split()) == 2:
            return f"ws://127.0.0.1:{lines[0]}{lines[1]}"
        assert process.poll() is None, "Chromium did not start"
        time.sleep(0.1)
    raise AssertionError("Chromium did not answer")
