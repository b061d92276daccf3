"""One page for one run: the verdict, the motion played by the arm, figures, and how to repeat it.

>>> from dmpcpp import report
>>> report.write("dmpcpp-demo")          # doctest: +SKIP
PosixPath('dmpcpp-demo/report.html')

The page is one file and loads nothing: it can be mailed, and opens without a network.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from dmpcpp._atomic import write_text
from dmpcpp.show.report._page import html
from dmpcpp.show.report._record import RunRecord as RunRecord
from dmpcpp.show.report._record import drawn as drawn
from dmpcpp.show.report._record import write_record as write_record
from dmpcpp.show.report._run_folder import RunFolder, read_run

__all__ = ["RunFolder", "html", "read_run", "write"]


def write(folder: str | PathLike[str]) -> Path:
    """Write report.html into the folder of a run, whole or not at all, and return its path.

    Raises
    ------
    FileError
        A file of the run is missing or cannot be read, or the page cannot be written.
    InvalidArgument
        A file of the run is not what a run writes.
    MissingDependency
        matplotlib or viser is not installed (the extras `plot` and `view`).
    """
    path = Path(folder) / "report.html"
    write_text(path, html(read_run(Path(folder))))
    return path
