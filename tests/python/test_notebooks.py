"""The notebooks of the documentation: they run from top to bottom, hold no outputs, and stand in the guide."""

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).resolve().parents[2] / "docs"
NOTEBOOKS = sorted((DOCS / "notebooks").glob("*.ipynb"))
NEEDS = {"03_recording_to_arm": ["pybullet_data", "matplotlib"]}

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")


@pytest.mark.filterwarnings("ignore")  # of the client and its kernel; what a notebook warns of stands in its outputs
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_complains_of_nothing(path):
    for package in NEEDS.get(path.stem, ["matplotlib"]):
        pytest.importorskip(package)
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(path.parent)}}).execute()
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    assert [output["text"] for output in outputs if output.get("name") == "stderr"] == []
    assert any("image/png" in output.get("data", {}) for output in outputs)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_kept_without_outputs_and_asserts_what_it_tells(path):
    cells = nbformat.read(path, as_version=4).cells
    code = [cell for cell in cells if cell.cell_type == "code"]
    assert all(not cell.outputs and cell.execution_count is None for cell in code)
    assert sum("assert " in cell.source for cell in code) >= 3


def test_there_are_three_and_the_guide_lists_them():
    listed = re.findall(r"^notebooks/(\w+)$", (DOCS / "notebooks.md").read_text(), flags=re.M)
    assert listed == [path.stem for path in NOTEBOOKS] and len(listed) == 3
