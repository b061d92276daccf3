"""The source's experiments: its errors, those of the default, and the repetition over random motions."""

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import DmpOptions, InvalidArgument, reproduction, so3
from dmpcpp.trials.reproduction import _run as run
from dmpcpp.trials.reproduction._repetition import Statistics, random_motion, with_angle_noise, with_position_noise
from scipy.spatial.transform import Rotation

PICTURES = {f"rotation-{convention}-{seconds}s.png" for convention in ("source", "zyx") for seconds in (1, 5)}
FILES = {"activations.png", "helix.png", "coordinates.png", "summary.json", "config.toml"} | PICTURES


def command(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run the command as a user does."""
    whole = [sys.executable, "-m", "dmpcpp", "reproduce", *map(str, arguments)]
    done = subprocess.run(whole, capture_output=True, text=True, cwd=cwd, timeout=300)
    assert "Traceback" not in done.stderr + done.stdout
    return done


@pytest.fixture(scope="module")
def helix():
    return reproduction.helix()


def test_the_command_writes_pictures_and_numbers_and_says_reproduced(tmp_path):
    pytest.importorskip("matplotlib")
    done = command("--repeat", 2, "--out", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert {path.name for path in (tmp_path / "out").iterdir()} == FILES | {"repetition.png"}
    for picture in (tmp_path / "out").glob("*.png"):
        assert picture.read_bytes().startswith(b"\x89PNG"), picture.name
    assert re.search(r"source +│ +0\.327 │ +0\.116 │ +10\.5 ", done.stdout)
    for text in ("errors [deg]", "T [s]", "noise [mm]", "noise [deg]", "reproduced; written to out/"):
        assert text in done.stdout

    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["verdict"] == "pass" and len(summary["checks"]) == 6
    assert summary["helix"]["errors"]["source"]["max"] == pytest.approx([0.327, 0.116, 10.5], rel=0.02)
    assert [level["noise"] for level in summary["repetition"]["levels"][:4]] == [0.0, 0.1e-3, 1e-3, 3e-3]


def test_json_is_the_summary_and_nothing_else_and_the_same_every_time(tmp_path):
    pytest.importorskip("matplotlib")
    first, second = (command("--json", "--repeat", 2, "--seed", 3, "--out", out, cwd=tmp_path) for out in "ab")
    assert first.returncode == 0 and first.stdout == second.stdout
    assert json.loads(first.stdout) == json.loads((tmp_path / "a" / "summary.json").read_text())


@pytest.mark.parametrize(
    ("arguments", "message"),
    [(["--repeat", "-1"], "--repeat"), (["--repeat", "many"], "--repeat"), (["--seed", "-1"], "--seed")],
)
def test_wrong_usage_is_status_2_and_writes_nothing(arguments, message, tmp_path):
    done = command(*arguments, cwd=tmp_path)
    assert done.returncode == 2 and message in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_a_file_is_refused(tmp_path):
    (tmp_path / "out").write_text("mine")
    done = command("--out", "out", cwd=tmp_path)
    assert done.returncode == 2 and "'out' is a file" in done.stderr
    assert (tmp_path / "out").read_text() == "mine"


@pytest.mark.parametrize(
    ("spoilt", "preset"),
    [
        ("helix_x_source_as_known", {"source": lambda: DmpOptions(alpha=20.0)}),
        ("helix_z_default_to_source", {"default": lambda: DmpOptions(passes=1)}),
    ],
)
def test_a_reproduction_that_misses_a_check_fails_with_status_3(spoilt, preset, tmp_path, monkeypatch):
    from click.testing import CliRunner
    from dmpcpp.cli import main

    for name, options in preset.items():
        monkeypatch.setitem(reproduction.PRESETS, name, options)
    done = CliRunner().invoke(main, ["reproduce", "--json", "--out", str(tmp_path / "out")])
    assert done.exit_code == 3
    failed = {check["name"] for check in json.loads(done.stdout)["checks"] if not check["ok"]}
    assert spoilt in failed


def test_the_source_equations_make_the_known_errors_and_the_default_a_thousandth(helix):
    source, default = helix.errors["source"], helix.errors["default"]
    np.testing.assert_allclose(source.max, reproduction.SOURCE_ERRORS, rtol=0.02)
    assert (default.max <= 1e-3 * source.max).all()
    assert (default.rmse <= default.max).all() and (source.rmse <= source.max).all()


def test_errors_are_those_of_the_arrays_that_the_pictures_show(helix):
    k = np.arange(201)
    original = np.c_[np.sin(0.05 * k), np.cos(0.05 * k), 2.0 * k]
    np.testing.assert_array_equal(helix.demonstration.position, original)
    for name, path in helix.reproduced.items():
        np.testing.assert_array_equal(helix.errors[name].max, np.abs(path - original).max(axis=0))


def test_the_source_rotation_is_its_passive_product():
    experiment = reproduction.rotation(1.0, "source")
    t = experiment.demonstration.time[[40]]
    a, b, c = 0.8 * np.sin(t[0]), 0.5 * np.cos(t[0]), 0.6 * t[0]
    factors = [Rotation.from_euler(axis, -angle) for axis, angle in zip("zyx", (a, b, c), strict=True)]
    product = factors[0] * factors[1] * factors[2]
    np.testing.assert_allclose(experiment.demonstration.rotation[40], product.as_matrix(), atol=1e-15)


@pytest.mark.parametrize("duration", [1.0, 5.0])
def test_the_default_turns_as_shown_where_the_source_is_degrees_off(duration):
    """The source's 5 s motion in ZYX passes 180 deg from its goal, where its logarithm turns round."""
    for convention in ("source", "ZYX"):
        errors = reproduction.rotation(duration, convention).errors
        assert errors["default"].max <= np.radians(0.003) and errors["source"].max >= np.radians(2.0)
    worst = errors["source"].max
    assert worst == pytest.approx(np.pi, abs=0.1) if duration == 5.0 else worst < 0.1


def test_the_source_rotation_errors_are_those_of_an_independent_computation():
    """Formulation 3.6: from rest, (alpha, beta) = (10, 4), in its product: 8.1e-2 and 4.6e-1 rad."""
    assert reproduction.rotation(1.0, "source").errors["source"].max == pytest.approx(0.081, rel=0.1)
    assert reproduction.rotation(5.0, "source").errors["source"].max == pytest.approx(0.46, rel=0.02)


def test_statistics_are_mean_sample_deviation_and_worst():
    assert Statistics.of([1.0, 2.0, 6.0]) == Statistics(3.0, pytest.approx(np.sqrt(7.0)), 6.0, 3)
    assert Statistics.of([2.0]) == Statistics(2.0, 0.0, 2.0, 1)


def test_a_motion_of_a_seed_does_not_depend_on_how_many_are_asked_for():
    few, many = reproduction.repeat(1, seed=5), reproduction.repeat(3, seed=5)
    assert reproduction.repeat(3, seed=5) == many
    for a, b in zip(few, many, strict=True):
        assert a.rmse["source"].worst <= b.rmse["source"].worst and b.rmse["source"].count == 3
    assert reproduction.repeat(3, seed=6) != many


def test_noise_has_the_deviation_that_is_stated():
    rng = np.random.default_rng(0)
    still = np.zeros((20000, 3))
    assert with_position_noise(still, 2e-3, rng).std(axis=0) == pytest.approx([2e-3] * 3, rel=0.03)
    turned = with_angle_noise(np.tile(np.eye(3), (20000, 1, 1)), 0.01, rng)
    turns = np.array([so3.log(r) for r in turned])
    assert turns.std(axis=0) == pytest.approx([0.01] * 3, rel=0.03)


def test_random_motions_are_smooth_bounded_and_sampled_at_200_hz():
    for index in range(10):
        time, position, rotation = random_motion(np.random.default_rng(index))
        np.testing.assert_allclose(np.diff(time), 0.005, rtol=1e-9)
        assert time[-1] + 0.005 >= 1.0 and time[-1] <= 5.0
        assert np.abs(position).max() <= 0.2
        fastest = 0.2 * (2 * np.pi * 1.5) ** 2  # of a sinusoid of the largest amplitude and frequency
        assert np.abs(np.diff(position, n=2, axis=0)).max() / 0.005**2 <= fastest
        assert np.abs(rotation @ rotation.transpose(0, 2, 1) - np.eye(3)).max() < 1e-14


def test_smoothing_takes_out_noise_that_the_source_learns_along_and_so_does_the_default():
    levels = {(level.quantity, level.noise): level.rmse for level in reproduction.repeat(8, seed=1)}
    for (quantity, noise), rmse in levels.items():
        if noise == 0.0:
            assert rmse["default"].worst <= 1e-3 * rmse["source"].mean, quantity
        else:
            assert rmse["smoothed"].worst < 0.75 * noise * np.sqrt(3.0)  # closer than the demonstration itself
            assert rmse["smoothed"].worst < rmse["source"].mean
            assert rmse["default"].worst < 0.75 * noise * np.sqrt(3.0) or quantity == "orientation"


def test_negative_counts_and_seeds_are_refused_by_name():
    with pytest.raises(InvalidArgument, match=r"repeat: -1, expected 0 or more"):
        run.reproduce(repeat=-1)
    with pytest.raises(InvalidArgument, match=r"seed: -2, expected 0 or more"):
        run.reproduce(seed=-2)


def test_progress_is_told_from_the_first_motion_to_the_last():
    told: list[float] = []
    reproduction.repeat(4, progress=told.append)
    assert told == [0.25, 0.5, 0.75, 1.0]
