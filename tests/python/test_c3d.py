"""C3D: against ezc3d, against the same trial in another format, and files made byte by byte."""

import struct

import numpy as np
import pytest
from dmpcpp import recordings
from dmpcpp.errors import InvalidArgument, NotStated

COUNT, NAMES = 12, ("a", "b", "c")
POINTS = np.random.default_rng(3).normal(size=(COUNT, 3, 3)).round(3) * 50.0  # mm


def vax(value: float) -> bytes:
    """A VAX F floating point number: an exponent larger by 2 and the words swapped."""
    ieee = struct.pack("<f", 4.0 * value)
    return ieee[2:] + ieee[:2]


def parameter(group, name, kind, shape, data, order):
    body = struct.pack("bB", kind, len(shape)) + bytes(shape) + data + b"\0"
    head = struct.pack("bb", len(name), group) + name.encode()
    return head + struct.pack(order + "h", len(body) + 2) + body


def made(path, processor="intel", floating=True, unit=b"mm", lost=(), up=b"+Z"):
    """Write a C3D file of three markers, with two analog values a frame."""
    order = ">" if processor == "mips" else "<"
    real = vax if processor == "dec" else lambda v: struct.pack(order + "f", v)
    scale = -1.0 if floating else 0.01
    entries = [struct.pack("bb", 5, -1) + b"POINT" + struct.pack(order + "h", 3) + b"\0"]
    entries += [
        parameter(1, "USED", 2, (), struct.pack(order + "h", 3), order),
        parameter(1, "RATE", 4, (), real(100.0), order),
        parameter(1, "UNITS", -1, (len(unit),), unit, order),
        parameter(1, "LABELS", -1, (4, 3), b"a   b   c   ", order),
        parameter(1, "Y_SCREEN", -1, (2,), up, order),
    ]
    number = {"intel": 84, "dec": 85, "mips": 86}[processor]
    section = bytes([1, 80, 1, number]) + b"".join(entries)
    assert len(section) <= 512
    header = bytes([2, 80]) + struct.pack(order + "5H", 3, 2, 1, COUNT, 10) + real(scale)
    header += struct.pack(order + "2H", 3, 1) + real(100.0)
    data = b""
    for k, frame in enumerate(POINTS):
        for m, point in enumerate(frame):
            residual = -1 if (k, m) in lost else 0
            if floating:
                data += b"".join(real(v) for v in point) + real(float(residual))
            else:
                data += struct.pack(order + "4h", *(round(v / 0.01) for v in point), residual)
        data += 2 * (real(7.0) if floating else struct.pack(order + "h", 7))
    path.write_bytes(header.ljust(512, b"\0") + section.ljust(512, b"\0") + data)
    return path


@pytest.mark.parametrize("floating", [True, False])
@pytest.mark.parametrize("processor", ["intel", "dec", "mips"])
def test_numbers_of_every_processor_read(tmp_path, processor, floating):
    path = made(tmp_path / "a.c3d", processor, floating, lost=[(3, 1)])
    assert recordings.format_of(path) == "c3d"
    found = recordings.markers(path)
    expected = 1e-3 * POINTS
    expected[3, 1] = np.nan
    assert (found.names, found.rate, found.up_axis) == (NAMES, pytest.approx(100.0), "z")
    np.testing.assert_allclose(found.position, expected, rtol=1e-6)


@pytest.mark.parametrize(
    "name",
    [
        "c3d_ktk/sample_propulsion.c3d",
        "c3d_ktk/sample_probing_radial_styloid_R.c3d",
        "c3d_ktk/sample_probing_ulnar_styloid_R.c3d",
        "c3d_ktk/sample_probing_medial_epicondyle_R.c3d",
        "pyomeca/markers_analogs.c3d",
    ],
)
def test_recorded_files_read_as_ezc3d_reads_them(recorded, name):
    ezc3d = pytest.importorskip("ezc3d")
    oracle = ezc3d.c3d(str(recorded / name))
    found = recordings.markers(recorded / name)
    facts = oracle["parameters"]["POINT"]
    scale = {"m": 1.0, "mm": 1e-3}[facts["UNITS"]["value"][0]]
    assert found.names == tuple(facts["LABELS"]["value"])
    assert found.rate == pytest.approx(facts["RATE"]["value"][0])
    points = np.moveaxis(oracle["data"]["points"][:3], 0, 2)
    np.testing.assert_allclose(found.position, scale * points.transpose(1, 0, 2), atol=1e-12)


def test_one_trial_in_c3d_and_csv_agrees_to_a_hundredth_of_a_millimetre(recorded):
    c3d = recordings.markers(recorded / "pyomeca" / "markers_analogs.c3d")
    csv = recordings.markers(recorded / "pyomeca" / "markers.csv")
    assert (c3d.names, c3d.up_axis) == (csv.names, "z")
    np.testing.assert_allclose(c3d.time, csv.time, atol=1e-9)
    np.testing.assert_array_equal(c3d.missing, csv.missing)
    assert np.nanmax(np.abs(c3d.position - csv.position)) < 1e-5


def test_a_c3d_without_a_unit_asks_for_it(tmp_path):
    path = made(tmp_path / "a.c3d", unit=b"xx")
    with pytest.raises(NotStated, match="POINT:UNITS is 'xx'"):
        recordings.markers(path)
    np.testing.assert_allclose(recordings.markers(path, unit="mm").position, 1e-3 * POINTS, atol=1e-7)


def test_an_up_axis_that_points_down_is_not_taken(tmp_path):
    assert recordings.markers(made(tmp_path / "a.c3d", up=b"-Z")).up_axis is None


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda c: c[:700], "not a C3D file"),
        (lambda c: b"\2\7" + c[2:], "not a C3D file"),
        (lambda c: b"\xc8" + c[1:], "parameters from byte .* in a file of"),
        (lambda c: c[:515] + b"\1" + c[516:], "processor type 1"),
        (lambda c: c[:-1], "It is cut off or damaged"),
        (lambda c: c[:8] + b"\xff\xff" + c[10:], "It is cut off or damaged"),
    ],
)
def test_a_damaged_c3d_is_refused(tmp_path, damage, message):
    path = made(tmp_path / "a.c3d")
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(InvalidArgument, match=message):
        recordings.markers(path)
