"""Several takes of one motion: in one file or several, learned together, and those that do not belong left out."""

import json
import warnings

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import learning, load, motion, recordings
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument, NotStated

COUNT = 80
TIME = 0.02 * np.arange(COUNT)
NAMES = "time,x,y,z,qx,qy,qz,qw"


def take(k=0, away=0.0):
    """Return rows (T, 8) of a reach, each take a little different, or one that goes another way."""
    s = TIME / TIME[-1]
    way = 10 * s**3 - 15 * s**4 + 6 * s**5
    x, y = 0.3 + 0.3 * way, 0.1 * np.sin(np.pi * way) + 1e-3 * (k + 1) * np.sin((k + 2) * way)
    z = 0.5 + 0.2 * way + away * np.sin(np.pi * way)
    return np.column_stack([TIME, x, y, z, np.tile([0.0, 0.0, 0.6, 0.8], (COUNT, 1))])


def write(path, header, rows):
    path.write_text("\n".join([header, *(",".join(map(str, row)) for row in rows)]))
    return path


def by_column(path, count=3, away=()):
    rows = [[f"t{k}", *row] for k in range(count) for row in take(k, 0.2 * (k in away))]
    return write(path / "takes.csv", f"take,{NAMES}", rows)


def by_restart(path, count=3, away=()):
    return write(path / "takes.csv", NAMES, np.concatenate([take(k, 0.2 * (k in away)) for k in range(count)]))


def by_group(path, count=3, away=()):
    h5py = pytest.importorskip("h5py")
    with h5py.File(path / "takes.hdf5", "w") as file:
        for k in range(count):
            rows = take(k, 0.2 * (k in away))
            file[f"data/demo_{k}/obs/robot0_eef_pos"] = rows[:, 1:4]
            file[f"data/demo_{k}/obs/robot0_eef_quat"] = rows[:, 4:]
    return path / "takes.hdf5"


WAYS = [
    (by_column, {"where": "take=all"}),
    (by_column, {"episode": "all"}),
    (by_restart, {"episode": "all"}),
    (by_group, {"episode": "all", "rate": 50.0}),
]


@pytest.mark.parametrize(("make", "stated"), WAYS)
def test_all_takes_of_a_file_are_read_each_by_itself(tmp_path, make, stated):
    path = make(tmp_path)
    with pytest.raises(NotStated, match="learn them together: (where='take=all'|episode='all')"):
        recordings.load(path, **{k: v for k, v in stated.items() if k == "rate"})
    found = recordings.load_all(path, **stated)
    assert len(found) == 3
    for k, recording in enumerate(found):
        np.testing.assert_allclose(recording.position, take(k)[:, 1:4], atol=1e-12)
        np.testing.assert_allclose(recording.time, TIME, atol=1e-12)


def test_a_file_of_one_take_is_a_list_of_one(tmp_path):
    path = write(tmp_path / "a.csv", NAMES, take())
    assert len(recordings.load_all(path)) == 1 and len(recordings.load_all(path, episode="all")) == 1
    with pytest.raises(InvalidArgument, match="where: hand=all, but no column 'hand' tells several takes apart"):
        recordings.load_all(path, where="hand=all")
    with pytest.raises(InvalidArgument, match="'all' is several recordings"):
        recordings.load(path, episode="all")


def test_rows_of_one_hand_and_all_its_takes(tmp_path):
    rows = [[hand, k, *(row + shift)] for k in range(2) for row in take(k) for hand, shift in (("l", 0.0), ("r", 0.0))]
    path = write(tmp_path / "a.csv", f"hand,take,{NAMES}", rows)
    found = recordings.load_all(path, where="hand=r,take=all")
    assert [len(each) for each in found] == [COUNT, COUNT]
    np.testing.assert_allclose(found[1].position, take(1)[:, 1:4], atol=1e-12)


def fit(folder, *arguments):
    done = CliRunner().invoke(main, ["fit", *map(str, arguments), "--out", str(folder / "model.json")])
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done


@pytest.mark.parametrize(("make", "stated"), WAYS)
def test_fit_learns_all_takes_of_a_file_together(tmp_path, make, stated):
    flags = [text for name, value in stated.items() for text in (f"--{name}", value)]
    done = fit(tmp_path, make(tmp_path), *flags, "--json")
    assert done.exit_code == 0, done.output
    assert len(json.loads(done.stdout)["recordings"]) == 3
    middle = np.mean([take(k)[COUNT // 2, 1:4] for k in range(3)], axis=0)
    model = load(tmp_path / "model.json")
    assert np.abs(model.rollout_at(TIME).pose[COUNT // 2, :3, 3] - middle).max() < 3e-3


def test_the_number_to_leave_out_is_that_of_the_file_and_its_take(tmp_path):
    alone = write(tmp_path / "alone.csv", NAMES, take(7))
    broken = tmp_path / "broken.csv"
    broken.write_text("nothing")
    path = by_restart(tmp_path, count=5, away=(3,))
    (tmp_path / "model.json").write_text("{}")
    done = fit(tmp_path, broken, alone, path, "--episode", "all", "--leave-out", 1)
    assert done.exit_code == 3
    assert "take_3.4_position_rmse" in done.output and "To learn without: --leave-out 3.4" in done.output
    assert not (tmp_path / "model.json").exists() and (tmp_path / "model.json.old").read_text() == "{}"
    assert "model.json is of an earlier run; renamed to model.json.old" in done.output
    again = fit(tmp_path, broken, alone, path, "--episode", "all", "--leave-out", 1, "--leave-out", "3.4")
    assert again.exit_code == 0 and (tmp_path / "model.json").exists()
    wrong = fit(tmp_path, alone, path, "--episode", "all", "--leave-out", "2.9")
    assert wrong.exit_code == 2
    assert "--leave-out: 2.9, expected one of 1, 2, 2.1, 2.2, 2.3, 2.4, 2.5." in wrong.output
    nothing = fit(tmp_path, alone, "--leave-out", 1)
    assert nothing.exit_code == 2 and "leaves nothing to learn from" in nothing.output


def test_the_old_name_of_an_option_is_saved_under_the_new_one(tmp_path):
    rows = take()
    rows[[40, 41]] = rows[[41, 40]]
    path = write(tmp_path / "a.csv", NAMES, rows)
    assert fit(tmp_path, path, "--mend-times").exit_code == 0
    saved = (tmp_path / "model.config.toml").read_text()
    assert "sort-times = true" in saved and "mend" not in saved
    old = tmp_path / "old.toml"
    old.write_text(saved.replace("sort-times", "mend-times"))
    done = CliRunner().invoke(main, ["fit", "--config", str(old)])
    assert done.exit_code == 0 and "--mend-times is --sort-times now" in done.output


def test_noise_that_has_no_effect_is_warned_of(tmp_path):
    shown = motion.demonstration(recordings.load(write(tmp_path / "a.csv", NAMES, take())))
    with pytest.warns(DeprecationWarning, match="noise has no effect"):
        learning.learn(shown, noise=motion.Noise(1e-3, 1e-3))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        learning.learn(shown)


@pytest.mark.parametrize("anchor", ["--anchor-start", "--anchor-goal"])
def test_an_anchor_out_of_reach_is_called_by_its_option(tmp_path, anchor):
    path = write(tmp_path / "a.csv", NAMES, take())
    done = CliRunner().invoke(main, ["imitate", str(path), anchor, "9,0,0.5", "--out", str(tmp_path / "out")])
    assert done.exit_code == 2 and f"{anchor}: the " in done.output
