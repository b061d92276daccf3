"""Sphinx: `sphinx-build -W docs build/docs`, with the extra `docs` and dmpcpp installed."""

import re
from typing import Any

import dmpcpp

project = "dmpcpp"
author = "the dmpcpp authors"
release = version = dmpcpp.__version__
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 3
nb_execution_mode = "force"  # notebooks are kept without outputs
nb_execution_raise_on_error = True
nb_execution_timeout = 300  # s a cell
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autodoc_default_options = {"members": True, "show-inheritance": False}
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = "dmpcpp"
suppress_warnings = ["ref.python"]  # errors and values stand in the module that makes them and where they are used

_LITERAL = re.compile(r"(``.*?``|`.*?`)", re.S)


def _plain(*about: Any) -> None:
    """Docstrings are written for people at a prompt: |x| is a norm and **options are keywords, not markup."""
    lines = about[-1]
    parts = _LITERAL.split("\n".join(lines))
    parts[::2] = [
        re.sub(r"\||\*\*(?=\w)|(?<=\()\*(?=[\w,])", lambda m: re.sub(r"(.)", r"\\\1", m[0]), part)
        for part in parts[::2]
    ]
    lines[:] = "".join(parts).split("\n")


def setup(app: Any) -> None:
    """Connect what is above."""
    app.connect("autodoc-process-docstring", _plain, priority=100)
