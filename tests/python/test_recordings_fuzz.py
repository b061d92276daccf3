"""Damaged files: whatever happens to a file, only the two errors of the library come out of reading it."""

import json
import warnings

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import FileError, InvalidArgument
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

STATED = {
    "deepmimic": {"body": "right_hand"},
    "tum": {},
    "table": {},
    "arrays": {"rate": 30.0, "quat_order": "xyzw"},
}
FRAMES = 12


def clip() -> bytes:
    frame = np.zeros(44)
    frame[[0, 4, 8, 12, 16, 21, 25, 30, 35, 39]] = [1 / 30, 1, 1, 1, 1, 1, 1, 1, 1, 1]
    frames = np.tile(frame, (FRAMES, 1))
    frames[:, 1] = 0.01 * np.arange(FRAMES)
    return json.dumps({"Loop": "none", "Frames": frames.tolist()}, indent=0).encode()


def rows() -> np.ndarray:
    time = np.arange(FRAMES) / 30
    return np.column_stack([time, np.sin(time), np.cos(time), time, np.tile([0.0, 0.0, 0.6, 0.8], (FRAMES, 1))])


def tum() -> bytes:
    return b"# t tx ty tz qx qy qz qw\n" + b"".join(" ".join(map(str, r)).encode() + b"\n" for r in rows())


def table() -> bytes:
    return b"time,x,y,z,qx,qy,qz,qw\n" + b"".join(",".join(map(str, r)).encode() + b"\n" for r in rows())


def arrays(tmp_path) -> bytes:
    np.savez_compressed(tmp_path / "seed.npz", time=rows()[:, 0], pose=rows()[:, 1:])
    return (tmp_path / "seed.npz").read_bytes()


def npy(tmp_path) -> bytes:
    np.save(tmp_path / "seed.npy", rows())
    return (tmp_path / "seed.npy").read_bytes()


def attempt(path, content, format, **stated):
    """Read `content`; a Recording or one of the two errors is all that may come out."""
    path.write_bytes(content)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            recording = recordings.load(path, format=format, **stated)
        except (InvalidArgument, FileError) as error:
            assert str(error)
            return None
    assert np.isfinite(recording.position).all()
    return recording


@pytest.fixture(scope="module")
def seeds(tmp_path_factory):
    folder = tmp_path_factory.mktemp("seeds")
    return {
        "deepmimic": (folder / "a.txt", clip()),
        "tum": (folder / "a.tum", tum()),
        "table": (folder / "a.csv", table()),
        "arrays": (folder / "a.npz", arrays(folder)),
        "arrays (npy)": (folder / "a.npy", npy(folder)),
    }


KINDS = ["deepmimic", "tum", "table", "arrays", "arrays (npy)"]


@pytest.mark.parametrize("kind", KINDS)
def test_the_undamaged_file_reads(seeds, kind):
    path, content = seeds[kind]
    format = kind.split()[0]
    assert len(attempt(path, content, format, **STATED[format])) == FRAMES


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_cut_off_anywhere_is_read_or_refused(seeds, kind):
    path, content = seeds[kind]
    format = kind.split()[0]
    for end in np.unique(np.linspace(0, len(content) - 1, 300).astype(int)):
        attempt(path, content[:end], format, **STATED[format])


SPITE = [
    b"nan",
    b"1e999",
    b"-",
    b"\x00",
    b"\xff\xfe",
    b"1" * 400,
    b"[" * 50,
    b'"',
    b",,",
    b"\r",
    b"\n",
    b"0x1",
    b"e",
]


@pytest.mark.parametrize("kind", KINDS)
def test_a_file_with_damaged_bytes_is_read_or_refused(seeds, kind):
    path, content = seeds[kind]
    format = kind.split()[0]
    random = np.random.default_rng(7)
    for trial in range(500):
        damaged = bytearray(content)
        for _ in range(random.integers(1, 4)):
            at = int(random.integers(len(damaged)))
            if trial % 2:
                damaged[at] = int(random.integers(256))
            else:
                damaged[at : at + int(random.integers(6))] = SPITE[random.integers(len(SPITE))]
        attempt(path, bytes(damaged), format, **STATED[format])


@pytest.mark.parametrize("format", STATED)
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.one_of(st.binary(max_size=300), st.text(max_size=200).map(str.encode)))
def test_arbitrary_bytes_are_read_or_refused(tmp_path, format, content):
    attempt(tmp_path / "a.bin", content, format, **STATED[format])
    attempt(tmp_path / "a.csv", content, None)
