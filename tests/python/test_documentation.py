"""The documentation: built without a warning, every page of it reachable, and what it promises there."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from dmpcpp.cli import main

DOCS = Path(__file__).resolve().parents[2] / "docs"
KINDS = {".py", ".cpp", ".hpp"}


@pytest.mark.slow
def test_the_documentation_is_built_without_a_warning(tmp_path):
    for package in ("sphinx", "myst_nb", "furo"):
        pytest.importorskip(package)
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", DOCS, tmp_path / "html"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "html" / "python-api.html").read_text()
    for name in ("PoseDmp", "imitate", "imitate_many", "Session", "replay_page"):
        assert f'<span class="pre">{name}</span>' in page, name
    assert "mm RMSE" in (tmp_path / "html" / "notebooks" / "01_goal_and_tempo.html").read_text()


def test_every_page_stands_in_the_index():
    listed = set(re.findall(r"^([a-z-]+)$", (DOCS / "index.md").read_text(), flags=re.M))
    assert {path.stem for path in DOCS.glob("*.md")} - {"index"} <= listed


def test_every_command_is_described():
    text = (DOCS / "command-line.md").read_text()
    for name in main.commands:
        assert f"| `{name}` |" in text


def test_every_public_header_stands_in_the_reference():
    text = (DOCS / "cpp-api.md").read_text()
    for header in (DOCS.parent / "cpp" / "include" / "dmp").glob("*.hpp"):
        old_name = "#pragma message" in header.read_text()
        assert old_name or f"include/dmp/{header.name}" in text


def test_every_option_that_the_guide_types_exists():
    """Commands in the guide are parsed by the program itself."""
    for page in ("tutorial.md", "command-line.md", "troubleshooting.md"):
        for line in re.findall(r"^dmpcpp (.+)$", (DOCS / page).read_text(), flags=re.M):
            name, *rest = line.split()
            options = {option for parameter in main.commands[name].params for option in parameter.opts}
            assert {word for word in rest if word.startswith("--")} <= options | {"--help"}, line


def test_every_public_module_stands_in_the_reference():
    package = DOCS.parent / "python" / "dmpcpp"
    modules = {path.stem for path in package.iterdir() if path.suffix == ".py" or (path / "__init__.py").is_file()}
    public = {name for name in modules if not name.startswith("_")}
    rooms = {"robot", "show", "trials"}  # users import what is in them from dmpcpp
    named = set(re.findall(r"automodule:: dmpcpp\.(\w+)", (DOCS / "python-api.md").read_text()))
    assert len(named) > 20
    assert named - {"_core", "so3"} == public - rooms - {"cli"}  # the command line has its own page


def test_every_message_of_the_troubleshooting_page_is_one_of_the_programs():
    files = [path for room in ("python", "cpp") for path in (DOCS.parent / room).rglob("*") if path.suffix in KINDS]
    program = " ".join(" ".join(path.read_text().split()) for path in files)
    joined = re.sub(r'" f?"', "", program)  # a literal over several lines
    for row in re.findall(r"^\| ([^|]*`[^|]*) \|", (DOCS / "troubleshooting.md").read_text(), flags=re.M):
        for message in re.findall(r"`([^`]+)`", row):
            for part in re.split(r"\.\.\.|-?\d+\.\d+", message):  # dots stand for what differs, as numbers do
                assert part.strip() in joined, part


def test_every_number_of_the_comparison_stands_on_the_page_that_it_names():
    rows = re.findall(
        r"^\|[^|]*\|([^|]*)\|([^|]*)\| \[\w+\]\(([a-z-]+\.md)\) \|$", (DOCS / "comparison.md").read_text(), re.M
    )
    assert len(rows) >= 8
    for ours, theirs, page in rows:
        text = (DOCS / page).read_text()
        for number in re.findall(r"\d+(?:\.\d+)?", ours + theirs):
            assert re.search(rf"(?<![\d.]){re.escape(number)}(?![\d.])", text), f"{number} of {ours} | {theirs}"
