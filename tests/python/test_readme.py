"""What README.md shows is what the examples do, and they run."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)


@pytest.mark.parametrize(("language", "file"), [("python", "03_pose.py"), ("cpp", "03_pose.cpp")])
def test_the_readme_shows_the_example(language, file):
    assert (ROOT / "examples" / file).read_text() in blocks(language)


def test_every_link_of_the_readme_leads_somewhere():
    links = re.findall(r"\]\(([^)#]+)\)", (ROOT / "README.md").read_text())
    assert len(links) > 10
    assert [link for link in links if not (ROOT / link).is_file()] == []


EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
NEEDS = {"08_physics.py": ["pybullet"], "09_human_to_robot.py": ["pybullet", "matplotlib"]}


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_an_example_runs(example, tmp_path):
    for package in NEEDS.get(example.name, []):
        pytest.importorskip(package)
    done = subprocess.run([sys.executable, str(example)], capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stderr


SHORT = sorted(path for path in (ROOT / "examples").glob("[01]*.*") if "robot_loop" not in path.name)  # a whole loop


@pytest.mark.parametrize("example", SHORT, ids=lambda path: path.name)
def test_an_example_is_at_most_sixty_lines(example):
    assert len(example.read_text().splitlines()) <= 60
