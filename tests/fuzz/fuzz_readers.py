"""Any bytes as a recording: a Recording, or one of the two errors of the library.

The first byte of an input picks the format. Run by scripts/fuzz.sh (atheris and libFuzzer's options).
"""

import contextlib
import sys
import tempfile
import warnings
from pathlib import Path

import atheris

with atheris.instrument_imports(include=["dmpcpp"]):
    from dmpcpp import recordings
    from dmpcpp.errors import FileError, InvalidArgument

STATED: dict[str, dict[str, object]] = {
    "deepmimic": {"body": "right_hand"},
    "tum": {},
    "table": {},
    "arrays": {"rate": 30.0, "quat_order": "xyzw"},
}
FORMATS = sorted(STATED)
SUFFIX = {"arrays": ".npz", "deepmimic": ".txt", "table": ".csv", "tum": ".txt"}
FOLDER = Path(tempfile.mkdtemp(prefix="dmpcpp-fuzz-"))


def read(data: bytes) -> None:
    """Read one input."""
    if not data:
        return
    format = FORMATS[data[0] % len(FORMATS)]
    path = FOLDER / f"input{SUFFIX[format]}"
    path.write_bytes(data[1:])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with contextlib.suppress(InvalidArgument, FileError):
            recordings.load(path, format=format, **STATED[format])


if __name__ == "__main__":
    atheris.Setup(sys.argv, read)
    atheris.Fuzz()
