"""Every command that README, docs and help show is typed as it stands, after what the same page types before it."""

import re
import shlex
import subprocess
import sys
import time
from pathlib import Path

import pytest
from dmpcpp.cli import main

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
QUICK = {"example", "inspect", "arms", "check-urdf", "doctor", "fetch", "verify"}
EXPECTED = {"not ready to be learned": 3}  # an inspection that asks for what a file does not say


def typed_on(page: Path) -> list[list[str]]:
    blocks = re.findall(r"```sh\n(.*?)```", page.read_text(), re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines() if line.startswith("dmpcpp ")]
    return [shlex.split(line, comments=True) for line in lines]


def typed_in_help() -> list[list[str]]:
    helps = {name: " ".join((command.help or "").split()) for name, command in main.commands.items()}
    assert all("Example: dmpcpp " in text for text in helps.values())
    return [shlex.split(text.split("Example: ")[1]) for text in helps.values()]


def run(words: list[str], folder: Path, seconds: float = 900) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "dmpcpp", *words[1:]]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=seconds)
    assert "Traceback" not in done.stderr, done.stderr
    return done


def look_and_leave(words: list[str], folder: Path) -> None:
    """Start `dmpcpp view`, wait for its address, interrupt it."""
    command = [sys.executable, "-m", "dmpcpp", *words[1:]]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as view:
        said = ""
        until = time.monotonic() + 60
        while "http://" not in said and time.monotonic() < until and (line := view.stdout.readline()):
            said += line
        view.terminate()
    assert "http://" in said, said


def type_all(commands: list[list[str]], folder: Path) -> None:
    for words in commands:
        if words[1] == "view":
            look_and_leave(words, folder)
            continue
        done = run(words, folder)
        allowed = next((status for said, status in EXPECTED.items() if said in done.stdout), 0)
        assert done.returncode == allowed, f"{shlex.join(words)}: {done.returncode}\n{done.stdout}{done.stderr}"


def test_there_are_commands_to_type():
    assert len(typed_in_help()) == len(main.commands)
    assert sum(len(typed_on(page)) for page in PAGES) > 20


def test_the_quick_commands_of_the_readme_work(tmp_path):
    for words in typed_on(PAGES[0]):
        if words[1] in QUICK - {"verify"} and "--run" not in words:
            type_all([words], tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("page", [page for page in PAGES if typed_on(page)], ids=lambda page: page.stem)
def test_every_command_of_a_page_works(page, tmp_path):
    for package in ("pybullet", "matplotlib", "viser", "imageio_ffmpeg"):
        pytest.importorskip(package)
    type_all(typed_on(page), tmp_path)


@pytest.mark.slow
def test_every_example_of_the_help_works(tmp_path):
    for package in ("pybullet", "matplotlib", "viser", "imageio_ffmpeg"):
        pytest.importorskip(package)
    setup = [["dmpcpp", "example", name] for name in ("reach", "takes", "lift", "robot")]
    setup += [shlex.split("dmpcpp imitate reach.bvh --body RightHand --unit cm --arm panda --out reach")]
    setup += [shlex.split("dmpcpp example log --run reach")]
    type_all([*setup, *typed_in_help()], tmp_path)
