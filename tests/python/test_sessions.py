"""Sessions of many motions: their parts are listed, one or all of them learned, long ones made short and said to be."""

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import motion, recordings
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument
from dmpcpp.inspection import inspect
from dmpcpp.recordings import Recording
from scipy.spatial.transform import Rotation

RATE, TIMES = 50.0, 4


def there_and_back(count=TIMES, rate=RATE, rest=0.8, reach=1.2):
    """A hand that reaches and returns `count` times, a little farther each time, with rests."""
    period = 2 * (rest + reach)
    time = np.arange(round(count * period * rate) + round(rest * rate)) / rate
    phase = np.mod(time, period)
    share = np.clip((phase - rest) / reach, 0, 1) - np.clip((phase - 2 * rest - reach) / reach, 0, 1)
    smooth = 10 * share**3 - 15 * share**4 + 6 * share**5
    far = 0.3 + 0.01 * np.floor(time / period)
    position = np.column_stack([far * smooth, 0.1 * smooth, 0.9 + 0.05 * np.sin(np.pi * smooth)])
    return time, position, Rotation.from_rotvec(np.outer(smooth, [0.0, 0.4, 0.2]))


def session(path, **how):
    time, position, turn = there_and_back(**how)
    rows = np.column_stack([time, position, turn.as_quat()])
    path.write_text("\n".join(["time,x,y,z,qx,qy,qz,qw", *(",".join(map(repr, map(float, row))) for row in rows)]))
    return path


def test_inspect_lists_the_cycles_and_the_motions_between_rests_with_their_times(tmp_path):
    body = inspect(session(tmp_path / "a.csv")).bodies[0]
    assert len(body.cycles) == TIMES and len(body.segments) == 2 * TIMES
    begin, end = body.segments[0]
    assert 0.75 < begin < 1.0 and 1.8 < end < 2.05
    said = CliRunner().invoke(main, ["inspect", str(tmp_path / "a.csv")]).output
    assert (
        f"{TIMES} cycles (--repetition K uses one)" in said
        and f"{2 * TIMES} motions between rests (--segment K" in said
    )


def test_inspect_looks_at_the_part_that_will_be_learned(tmp_path):
    path = session(tmp_path / "a.csv")
    done = inspect(path, preparation=motion.Preparation(segment=1)).bodies[0]
    assert 0.9 < done.duration < 1.3
    assert inspect(path, preparation=motion.Preparation(segment=99)).bodies[0].refused
    result = CliRunner().invoke(main, ["inspect", str(path), "--start", "4", "--end", "8"])
    assert result.exit_code == 0 and "4.00" in result.output


def test_all_repetitions_of_one_file_are_prepared_alike():
    time, position, turn = there_and_back()
    recording = Recording(time, position, turn.as_matrix())
    parts = motion.prepare_all(recording, motion.Preparation(repetition="all"))
    assert len(parts) == TIMES
    for number, part in enumerate(parts, start=1):
        alone = motion.prepare(recording, motion.Preparation(repetition=number))
        np.testing.assert_array_equal(part.position, alone.position)
    assert len(motion.prepare_all(recording)) == 1
    with pytest.raises(InvalidArgument, match="repetition: 'all' is several recordings"):
        motion.prepare(recording, motion.Preparation(repetition="all"))
    still = motion.crop(recording, 0.0, 0.5)
    with pytest.raises(InvalidArgument, match="no whole cycle"):
        motion.prepare_all(still, motion.Preparation(repetition="all"))


def test_fit_learns_all_repetitions_of_one_file(tmp_path):
    path = session(tmp_path / "a.csv")
    out = tmp_path / "model.json"
    done = CliRunner().invoke(main, ["fit", str(path), "--repetition", "all", "--out", str(out), "--json"])
    assert out.exists(), done.output
    assert done.output.count('"source"') == TIMES


def test_a_gap_in_the_middle_is_named_with_the_flags_that_get_around_it(tmp_path):
    path = session(tmp_path / "a.csv")
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:60], *lines[90:]]))
    refused = CliRunner().invoke(main, ["fit", str(path), "--out", str(tmp_path / "m.json")])
    assert refused.exit_code == 2 and "--longest-gap 0.63" in refused.output and "--start" in refused.output
    found = CliRunner().invoke(main, ["inspect", str(path)])
    assert found.exit_code == 3 and "--longest-gap 0.63 fills it" in found.output
    assert CliRunner().invoke(main, ["inspect", str(path), "--longest-gap", "0.63"]).exit_code == 0


def test_a_long_recording_is_cut_to_its_first_cycle_and_the_history_warns():
    time, position, turn = there_and_back(count=14, rate=1000.0)
    recording = Recording(time, position, turn.as_matrix())
    assert len(recording) > 50_000
    found = motion.prepare(recording)
    assert found.duration < 5.0 and any(
        note.startswith("WARNING") and "first of 14 cycles" in note for note in found.history
    )
    assert found.rate == pytest.approx(1000.0)
    chosen = motion.prepare(recording, motion.Preparation(repetition=2))
    assert not any("more than one motion" in note for note in chosen.history)


def test_a_long_recording_of_no_parts_is_thinned_and_a_short_one_never():
    time = np.arange(120_000) / 1000.0
    position = np.column_stack([0.001 * time, 0.002 * time, 0 * time])
    recording = Recording(time, position, np.tile(np.eye(3), (len(time), 1, 1)))
    found = motion.one_motion(recording)
    assert len(found) <= 50_000 and any("thinned" in note for note in found.history)
    short = motion.crop(recording, 0.0, 10.0)
    assert motion.one_motion(short) is short and motion.thinned(short) is short


def test_inspect_draws_what_it_read(tmp_path):
    pytest.importorskip("matplotlib")
    path = session(tmp_path / "a.csv")
    done = CliRunner().invoke(main, ["inspect", str(path), "--plot", str(tmp_path / "a.png")])
    assert done.exit_code == 0 and (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    two = tmp_path / "two.csv"
    two.write_text(path.read_text().replace("time,x,y,z,qx,qy,qz,qw", "time,x,y,z,rx,ry,rz,w"))
    refused = CliRunner().invoke(main, ["inspect", str(two), "--plot", str(tmp_path / "b.png")])
    assert refused.exit_code == 2 and "--plot: 0 bodies were read" in refused.output
    assert not (tmp_path / "b.png").exists()


def test_a_channel_stays_with_the_samples_it_belongs_to(tmp_path):
    time, position, turn = there_and_back()
    grip = np.linspace(0, 1, len(time))
    rows = np.column_stack([time, position, turn.as_quat(), grip])
    path = tmp_path / "a.csv"
    path.write_text(
        "\n".join(["time,x,y,z,qx,qy,qz,qw,gripper", *(",".join(map(repr, map(float, row))) for row in rows)])
    )
    found = recordings.load(path)
    np.testing.assert_array_equal(found.channels["gripper"], grip)
    cropped = motion.crop(found, 1.0, 2.0)
    kept = (time >= 1.0 - 1e-9) & (time <= 2.0 + 1e-9)
    np.testing.assert_array_equal(cropped.channels["gripper"], grip[kept])
    part = motion.segments(found)[0]
    begin = int(np.argmin(np.abs(position - part.position[0]).sum(axis=1)))
    np.testing.assert_array_equal(part.channels["gripper"], grip[begin : begin + len(part)])
    finer = motion.resample(found, 300.0)
    np.testing.assert_allclose(finer.channels["gripper"], np.interp(finer.time, time, grip), atol=1e-12)
    assert found.with_("later", time=2.0 * found.time).channels == {}
