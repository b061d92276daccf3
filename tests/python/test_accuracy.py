"""The figures of accuracy, asked from the same code that prints them beside other packages."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks import accuracy, demonstrations, figures, peers
from benchmarks.figures import Figure


@pytest.fixture
def alone(monkeypatch):
    """As on a machine without the other packages: these tests are about this one."""
    monkeypatch.setattr(peers, "installed", lambda: dict.fromkeys(peers.PACKAGES))


def hold(measured: list[Figure], count: int) -> None:
    """Every goal is reached, and as many were asked as there should be."""
    assert len(measured) == count
    assert [f"{figure.name}: {figure.value:.3g} > {figure.goal:g}" for figure in measured if not figure.ok] == []


@pytest.mark.parametrize(
    ("measure", "count"),
    [
        (figures.helix, 3),
        (figures.reach, 3),
        (figures.rotation, 3),
        (figures.rotation_through_pi, 4),
        (figures.reach_rotations, 4),
        (figures.rates, 5),
        (figures.source, 6),
    ],
    ids=lambda value: getattr(value, "__name__", None),
)
def test_clean_demonstrations_are_reproduced_to_the_goals(measure, count, alone):
    hold(measure(), count)


@pytest.mark.parametrize("duration", [1.0, 2.0])
def test_noise_is_taken_out_to_the_goals(duration, alone):
    hold(figures.noise(duration), 2)
    hold(figures.noise_together(duration), 1)


def test_recorded_poses_are_reproduced(recorded, alone):
    measured = figures.recorded(recorded / "robotasks_clfd")
    assert len(measured) == 6
    assert all(figure.ok for figure in measured if "position" in figure.name)
    assert all(figure.value < 0.15 for figure in measured if "orientation" in figure.name)


def test_recorded_orientations_are_steps_that_no_smooth_curve_of_100_coefficients_follows(recorded):
    """The least-squares quintic spline is the best a curve of that size can do; the default comes within half."""
    from scipy.interpolate import make_lsq_spline
    from scipy.spatial.transform import Rotation

    best, ours = [], []
    time, degree = demonstrations.TIME, 5
    inner = np.linspace(0.0, time[-1], 100 - degree + 1)[1:-1]
    knots = np.r_[np.zeros(degree + 1), inner, np.full(degree + 1, time[-1])]
    for _, turned in demonstrations.recorded_poses(recorded / "robotasks_clfd"):
        spline = make_lsq_spline(time, peers._quaternions(turned), knots, degree)
        smooth = Rotation.from_quat(spline(time)[:, [1, 2, 3, 0]]).as_matrix()
        best.append(figures.angle_rmse(turned, smooth))
        ours.append(figures.angle_rmse(turned, figures.reproduced_rotation(turned)))
    assert np.median(best) > 0.02
    assert np.median(ours) <= 1.5 * np.median(best)


# ---- what the figures are made of -----------------------------------------------------------------------------------


def test_the_demonstrations_are_those_that_the_figures_name():
    helix, reach = demonstrations.helix(), demonstrations.reach()
    assert np.linalg.norm(helix[:, :2], axis=1) == pytest.approx(np.full(1000, 0.1))
    assert helix[-1, 2] == pytest.approx(0.2, rel=2e-3) and 0.05 * 999 / (2 * math.pi) == pytest.approx(8, rel=0.01)
    assert np.linalg.norm(reach[-1] - reach[0]) == pytest.approx(0.5385, rel=1e-3)
    assert np.linalg.norm(reach[1] - reach[0]) < 1e-6

    through = demonstrations.turning(4.995)
    away = np.degrees([figures.rotation_angles(through[-1:], r[None])[0] for r in through])
    assert away.max() == pytest.approx(179.95, abs=0.02)
    rest = demonstrations.turning(4.995, rest_to_rest=True)
    np.testing.assert_allclose(rest[[0, -1]], through[[0, -1]], atol=1e-15)
    assert figures.angle_rmse(rest[:1], rest[1:2]) < 1e-4

    whole = demonstrations.reach_rotation(2 * math.pi)
    np.testing.assert_allclose(whole[-1], np.eye(3), atol=1e-14)
    np.testing.assert_allclose(whole[500] @ [1, 2, 3], [1, 2, 3], atol=1e-14)


def test_the_errors_are_those_of_known_offsets():
    points = np.zeros((10, 3))
    assert figures.position_rmse(points, points + [0.001, 0.002, 0.002]) == pytest.approx(3.0)
    assert figures.axis_rmse(points, points + 0.001) == pytest.approx(1.0)
    box = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]])
    assert figures.diagonal_share(box, box + [0.05, 0.0, 0.0]) == pytest.approx(1.0)
    turned = demonstrations.turning(3.0)
    turn = demonstrations.reach_rotation(math.radians(2.0))[-1]
    assert figures.angle_rmse(turned, turn @ turned) == pytest.approx(2.0)


def test_a_figure_above_its_goal_is_a_miss_and_the_command_says_so(monkeypatch):
    reached, missed = Figure("a", 1.0, 1.0, "mm", {"pydmps": 2.0}), Figure("b", 1.1, 1.0, "mm")
    assert reached.ok and not missed.ok

    def run(*measured: Figure, arguments: tuple[str, ...] = ()):
        monkeypatch.setattr(accuracy, "measure", lambda: iter(measured))
        return CliRunner().invoke(accuracy.main, list(arguments))

    assert run(reached).exit_code == 0
    done = run(reached, missed)
    assert done.exit_code == 3 and "MISS" in done.stdout and "1 of 2 goals reached" in done.stdout
    summary = json.loads(run(reached, missed, arguments=("--json",)).stdout)
    assert summary["verdict"] == "fail" and [figure["ok"] for figure in summary["figures"]] == [True, False]
    assert summary["figures"][0]["peers"] == {"pydmps": 2.0} and set(summary["packages"]) == set(peers.PACKAGES)


def test_without_the_other_packages_they_are_named_and_the_figures_stand(monkeypatch):
    from importlib.metadata import PackageNotFoundError

    def missing(name: str) -> str:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(peers, "version", missing)
    monkeypatch.setattr(accuracy, "measure", lambda: iter(figures.reach()))
    monkeypatch.delenv("DMPCPP_RECORDINGS", raising=False)
    done = CliRunner().invoke(accuracy.main)
    assert done.exit_code == 0, done.output
    assert 'movement_primitives not installed: pip install "dmpcpp[bench]"' in done.stdout
    assert "recorded poses left out" in done.stdout


def test_the_other_packages_are_imported_only_when_they_are_measured():
    code = f"import sys, benchmarks.accuracy; assert not {{*sys.modules}} & {set(peers.PACKAGES)!r}"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=Path(accuracy.__file__).parents[1])


@pytest.mark.filterwarnings("default")
def test_movement_primitives_is_measured_as_it_is_delivered_and_at_its_best():
    """Its rollout is the demonstration one sample early: 0.644 mm on the reach, whatever the number of kernels."""
    pytest.importorskip("movement_primitives")
    reach = demonstrations.reach()
    early = peers.position_learners()["movement_primitives"](reach, 50)
    assert figures.position_rmse(reach, early) == pytest.approx(0.644, rel=0.01)
    assert figures.position_rmse(reach[1:], early[:-1]) < 0.01
    learners = peers.orientation_learners()
    turned = demonstrations.turning(3.0)
    at_rest, stepped = (figures.angle_rmse(turned, learner(turned, 100)) for learner in learners.values())
    assert at_rest == pytest.approx(1.68, rel=0.01) and stepped == pytest.approx(0.025, rel=0.02)


@pytest.mark.filterwarnings("default")
def test_pydmps_is_measured_as_it_is_delivered():
    pytest.importorskip("pydmps")
    again = peers.position_learners()["pydmps"](demonstrations.reach(), 100)
    assert again.shape == (1000, 3)
    assert 1.0 < figures.position_rmse(demonstrations.reach(), again) < 3.0
