"""Any bytes as a recording of each kind: a Recording, or one of the two errors of the library.

The first byte of an input picks the kind. Run by scripts/fuzz.sh (atheris and libFuzzer's options);
`fuzz_readers.py --seeds FOLDER` writes an undamaged file of each kind for it to begin with.
"""

import contextlib
import sys
import tempfile
import warnings
from pathlib import Path

import atheris

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
with atheris.instrument_imports(include=["dmpcpp"]):
    from dmpcpp import recordings
    from dmpcpp.errors import FileError, InvalidArgument

    from tests.python.test_recordings_fuzz import KINDS, MADE, made, stated_of

FOLDER = Path(tempfile.mkdtemp(prefix="dmpcpp-fuzz-"))


def read(data: bytes) -> None:
    """Read one input."""
    if not data:
        return
    kind = KINDS[data[0] % len(KINDS)]
    path = FOLDER / MADE[kind][0]
    path.write_bytes(data[1:])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with contextlib.suppress(InvalidArgument, FileError):
            recordings.load(path, format=kind.split()[0], **stated_of(kind))


def write_seeds(folder: Path) -> None:
    """Write an undamaged file of each kind, with the byte before it that picks the kind."""
    for number, kind in enumerate(KINDS):
        (folder / kind.replace(" ", "_")).write_bytes(bytes([number]) + made(kind, FOLDER))


if __name__ == "__main__":
    if sys.argv[1] == "--seeds":
        write_seeds(Path(sys.argv[2]))
    else:
        atheris.Setup(sys.argv, read)
        atheris.Fuzz()
