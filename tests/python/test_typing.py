"""What a type checker knows of the package."""

import os
import subprocess
import sys
from pathlib import Path

import dmpcpp
import pytest

PROGRAM = Path(__file__).with_name("typed_program.py")


def test_a_program_passes_the_strict_type_checker_and_its_mistakes_do_not(tmp_path):
    """A `type: ignore` that no mistake needs is an error too, so the types are not Any."""
    pytest.importorskip("mypy")
    folder = Path(dmpcpp.__file__).parents[1]
    path = {} if folder.name == "site-packages" else {"MYPYPATH": str(folder)}  # where mypy looks by itself
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file", "", "--cache-dir", str(tmp_path), PROGRAM]
    done = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=tmp_path, env={**os.environ, **path}
    )
    assert done.returncode == 0, done.stdout + done.stderr
