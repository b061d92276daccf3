"""Stamps as producers write them: bursts, pairs, dates, epochs; nothing is made up without bound."""

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import motion, recordings
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument, NotStated
from dmpcpp.inspection import inspect
from dmpcpp.recordings import Recording
from dmpcpp.recordings._clock import clock_texts
from dmpcpp.recordings._stamps import usual_step
from scipy.spatial.transform import Rotation

COUNT, STEP = 120, 0.025
TIME = STEP * np.arange(COUNT)


def position(time):
    return np.column_stack([0.3 + 0.2 * np.sin(1.3 * time), 0.1 * np.cos(2.1 * time), 0.9 + 0.05 * time])


def quaternion(time):
    return Rotation.from_rotvec(np.column_stack([0.2 * time, 0.3 * np.sin(time), 0.1 * np.cos(time)])).as_quat()


def table(path, stamps, time=TIME, name="time"):
    rows = np.column_stack([position(time), quaternion(time)])
    lines = [f"{stamp},{','.join(repr(float(v)) for v in row)}" for stamp, row in zip(stamps, rows, strict=True)]
    path.write_text("\n".join([f"{name},x,y,z,qx,qy,qz,qw", *lines]))
    return path


def tum(path, stamps):
    rows = np.column_stack([position(TIME), quaternion(TIME)])
    path.write_text("\n".join(f"{s!r} {' '.join(map(repr, map(float, r)))}" for s, r in zip(stamps, rows, strict=True)))
    return path


def in_bursts(size, apart):
    """Stamps set at publication: each burst at the time of its last sample."""
    last = np.minimum((np.arange(COUNT) // size + 1) * size, COUNT) - 1
    return [float(t) for t in STEP * last + apart * (np.arange(COUNT) % size)]


@pytest.mark.parametrize("size", [2, 3, 4])
@pytest.mark.parametrize("apart", [1e-6, 1e-5, 1e-4])
def test_the_usual_step_of_bursts_is_that_of_the_device(size, apart):
    assert usual_step(np.array(in_bursts(size, apart))) == pytest.approx(STEP, rel=0.05)


def test_the_usual_step_is_the_median_of_even_stamps_and_no_gap_changes_it():
    assert usual_step(TIME) == pytest.approx(STEP, rel=1e-12)
    assert usual_step(np.concatenate([TIME, TIME + 500.0])) == pytest.approx(STEP, rel=1e-12)


@pytest.mark.parametrize("write", [table, tum])
def test_bursts_are_refused_with_the_rate_of_the_device_and_the_rate_is_exact(tmp_path, write):
    path = write(tmp_path / "a.txt", in_bursts(3, 1e-6))
    with pytest.raises(NotStated, match=r"stamps lie in bursts.*the least 1e-06 s.*rate=40\b"):
        recordings.load(path)
    found = recordings.load(path, rate=40.0)
    np.testing.assert_allclose(found.time, TIME, atol=1e-12)
    np.testing.assert_allclose(found.position, position(TIME), atol=1e-15)
    report = inspect(path)
    assert not report.ok and "rate" in report.needed


def test_a_few_samples_close_behind_others_are_left_out(tmp_path):
    stamps = [*map(float, TIME)]
    stamps[50] = stamps[49] + 1e-6
    found = recordings.load(table(tmp_path / "a.csv", stamps))
    assert len(found) == COUNT - 1 and any("in bursts" in note for note in found.history)
    assert motion.gaps(found) != ()


def test_pairs_of_two_cameras_count_once(tmp_path):
    time = np.sort(np.concatenate([TIME, TIME + 9e-5]))
    found = recordings.load(table(tmp_path / "a.csv", [*map(float, time)], time))
    np.testing.assert_allclose(found.time, TIME, atol=1e-12)
    np.testing.assert_allclose(found.position, position(TIME), atol=1e-15)
    assert any("in pairs" in note and "40 Hz" in note for note in found.history)


def sparse():
    """Eight samples in 0.7 s, and one more after two days."""
    time = np.append(0.1 * np.arange(8), 2e5)
    return Recording(time, position(0.01 * np.arange(9)), Rotation.from_quat(quaternion(time)).as_matrix())


def test_no_step_makes_up_more_than_ten_samples_for_each_that_is_there():
    with pytest.raises(InvalidArgument, match="samples would be made up from 9, expected at most 10 for each"):
        motion.fill(sparse(), longest=1e6)
    assert len(motion.resample(motion.crop(sparse(), 0.0, 0.7), 1000.0)) == 701  # as asked for


def test_inspect_is_never_ready_where_samples_would_be_made_up_without_bound(tmp_path):
    time = np.append(0.1 * np.arange(20), 600.0)
    report = inspect(table(tmp_path / "a.csv", [*map(float, time)], 0.1 * np.arange(21)))
    assert not report.ok and any("would be made up from 21" in problem for problem in report.problems)


@pytest.mark.parametrize(
    "write",
    [
        lambda k: f"2024-02-29T23:59:{59 if k < 40 else 60 - 1}.{(25 * k) % 1000:03d}" if k < 40 else None,
        lambda k: f"2024-03-01 00:00:{k // 40:02d},{25 * (k % 40):03d}",
        lambda k: f"2024-03-01T00:00:{k // 40:02d}.{25 * (k % 40):03d}000Z",
    ],
)
def test_dates_and_times_are_times(write):
    texts = [text for text in map(write, range(COUNT)) if text is not None]
    found = clock_texts(texts)
    assert found is not None and found[1] == "s"
    np.testing.assert_allclose(found[0], TIME[: len(texts)], atol=1e-9)


def test_epochs_of_nanoseconds_and_filetimes_keep_their_digits(tmp_path):
    for first, ticks in ((1_700_000_000_123_456_789, 10**9), (133_500_000_000_000_001, 10**7)):
        stamps = [first + round(STEP * ticks) * k for k in range(COUNT)]
        found = recordings.load(
            table(tmp_path / "a.csv", stamps, name="stamp" if ticks > 1e8 else "timestamp"),
            **({"columns": {n: k for k, n in enumerate(("time", "x", "y", "z", "qx", "qy", "qz", "qw"))}}),
        )
        np.testing.assert_allclose(found.time, TIME, atol=1e-12)


def test_a_first_column_without_a_name_is_the_time_if_it_can_be_no_row_number(tmp_path):
    found = recordings.load(table(tmp_path / "a.csv", [*map(float, TIME)], name=""))
    np.testing.assert_allclose(found.time, TIME, atol=1e-12)
    assert any(note.startswith("taken: rate") for note in found.history)
    with pytest.raises(NotStated, match="rate"):
        recordings.load(table(tmp_path / "b.csv", range(COUNT), name=""))


def test_takes_below_each_other_are_chosen_and_never_sorted_into_each_other(tmp_path):
    path = table(tmp_path / "a.csv", [*map(float, TIME), *map(float, TIME)], np.concatenate([TIME, TIME + 1.0]))
    for stated in ({}, {"sort_times": True}):
        with pytest.raises(NotStated, match="2 takes or episodes.*episode=0 to episode=1") as error:
            recordings.load(path, **stated)
        assert "sort_times" not in str(error.value)
    found = recordings.load(path, episode=1)
    np.testing.assert_allclose(found.position, position(TIME + 1.0), atol=1e-15)


def test_a_rate_is_taken_by_every_format_with_times(tmp_path):
    found = recordings.load(tum(tmp_path / "a.tum", [*map(float, TIME)]), rate=80.0)
    assert found.rate == pytest.approx(80.0)
    assert any("left aside" in note for note in found.history)


def test_the_command_names_the_flag_that_works(tmp_path):
    path = table(tmp_path / "a.csv", in_bursts(4, 1e-5))
    refused = CliRunner().invoke(main, ["inspect", str(path)])
    assert refused.exit_code == 3 and "--rate 40" in refused.output and "\nready" not in refused.output
    assert CliRunner().invoke(main, ["inspect", str(path), "--rate", "40"]).exit_code == 0
