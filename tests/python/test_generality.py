"""Random trials: drawn as stated, repeatable, resumed where they were stopped, every failure with its cause."""

import json
import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import arms, generality
from dmpcpp.errors import InvalidArgument
from dmpcpp.generality import Distribution, Result, Trial, run
from dmpcpp.metrics import StageErrors
from dmpcpp.trials.generality._motions import drawn_placement
from dmpcpp.trials.generality._trial import _changed, _learning_cause
from scipy.spatial.distance import pdist
from scipy.spatial.transform import Rotation

from tests.python.small_arms import write
from tests.python.urdfs import chain, robot

TEMPO = {"tempo": "person", "tolerance": "1mm,0.5deg"}
DONE = Result(Trial("panda", "none", 0, 0, options=TEMPO), True, "", 0, 1.0, 1e-5, 1e-5, 1e-5, 1.5, 1e-8, 1e-8, 2.0)


def motions(count=60):
    return [generality.random_motion(np.random.default_rng([9, k])) for k in range(count)]


# ---- what is drawn ------------------------------------------------------------------------------------------


def test_random_motions_span_what_they_shall():
    spans = [pdist(motion.position).max() for motion in motions(40)]
    turns = []
    for motion in motions(8):
        turning = Rotation.from_matrix(motion.rotation[::5])
        turns.append(max((each.inv() * turning).magnitude().max() for each in turning))
    assert 0.2 <= min(spans) < 0.22 and 0.38 < max(spans) <= 0.4
    assert math.radians(29.0) <= min(turns) and max(turns) <= math.radians(90.1)
    assert max(turns) - min(turns) > math.radians(20.0)


def test_a_component_is_a_sum_of_three_sinusoids():
    motion = motions(1)[0]
    time, x = motion.time, motion.position[:, 0]
    # Prony: a sum of three sinusoids obeys x[k+3] + x[k-3] = a (x[k+2] + x[k-2]) + b (x[k+1] + x[k-1]) + c x[k].
    step = 12
    middle = np.arange(3 * step, len(time) - 3 * step)
    pairs = [x[middle + m * step] + x[middle - m * step] for m in (1, 2, 3)]
    design = np.column_stack([pairs[1], pairs[0], 2.0 * x[middle]])
    _, residual, _, _ = np.linalg.lstsq(design, pairs[2], rcond=None)
    assert math.sqrt(float(residual.sum()) / len(middle)) < 1e-9


def test_changes_stay_within_their_ranges():
    changes = [generality.random_change(np.random.default_rng([4, k])) for k in range(300)]
    moved, tempo = np.array([np.linalg.norm(c.goal) for c in changes]), np.array([c.tempo for c in changes])
    assert moved.max() <= 0.1 and moved.max() > 0.09
    assert 0.5 <= tempo.min() < 0.55 and 1.9 < tempo.max() <= 2.0
    assert np.median(tempo) == pytest.approx(1.0, abs=0.12)


def test_noise_has_its_standard_deviation():
    still = motions(1)[0]
    noise = generality.NOISE["high"]
    shown = generality.noisy(still, noise, np.random.default_rng(0))
    off = shown.position - still.position
    turn = (Rotation.from_matrix(shown.rotation) * Rotation.from_matrix(still.rotation).inv()).as_rotvec()
    assert np.std(off) == pytest.approx(noise.position, rel=0.08)
    assert np.std(turn) == pytest.approx(noise.angle, rel=0.08)
    assert generality.noisy(still, generality.NOISE["none"], np.random.default_rng(0)) is still


def test_a_drawn_place_keeps_the_size_and_lies_within_reach():
    arm = arms.find("panda")
    for k, motion in enumerate(motions(10)):
        placement = drawn_placement(motion, arm, np.random.default_rng(k))
        position = placement.apply_to(motion).position
        assert placement.scale == 1.0
        assert pdist(position).max() == pytest.approx(pdist(motion.position).max())
        assert np.linalg.norm(position, axis=1).max() < 1.3 and position[:, 2].min() > 0.0


def test_a_changed_motion_ends_at_the_moved_goal_in_the_new_time():
    from dmpcpp import imitation, motion

    shown = motions(1)[0]
    model = imitation.learn(motion.demonstration(shown))
    changed, miss = _changed(model, np.array([0.05, -0.03, 0.02]), 1.7)
    assert changed.duration == pytest.approx(1.7 * shown.duration)
    assert np.linalg.norm(changed.position[-1] - shown.position[-1] - [0.05, -0.03, 0.02]) < 1e-3
    assert miss < 1e-3
    assert np.allclose(changed.position[0], shown.position[0], atol=1e-9)


def test_a_motion_badly_learned_or_a_goal_missed_is_a_cause():
    good = StageErrors(*(1e-4,) * len(StageErrors.__dataclass_fields__))
    assert _learning_cause(good, 1e-5, 0.0, 0.0) == ""
    assert _learning_cause(replace(good, position_rmse=1.5e-3), 1e-5, 0.0, 0.0).startswith("learning: 1.50 mm")
    assert _learning_cause(replace(good, position_rmse=1.5e-3), 1e-5, 2e-3, 0.0) == ""  # within the noise
    assert _learning_cause(good, 5e-3, 0.0, 0.0) == "goal: missed by 5.00 mm"


# ---- a trial ------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("arm", ["panda", "iiwa"])
def test_a_trial_passes_and_repeats(arm):
    trial = Trial(arm, "low", 0, 0)
    first, again = generality.attempt(trial), generality.attempt(trial)
    assert first.ok, first.cause
    assert replace(first, seconds=0.0) == replace(again, seconds=0.0)
    assert first.tracked_position < 1e-6 and first.learned_position < 1e-3


def test_a_motion_without_a_place_names_the_cause(monkeypatch):
    def nowhere(*_, **__):
        raise InvalidArgument("recording: no placement found")

    monkeypatch.setattr("dmpcpp.imitation._flow.place_motion", nowhere)
    monkeypatch.setattr("dmpcpp.trials.generality._trial._follows", lambda *_: False)
    result = generality.attempt(Trial("panda", "none", 0, 0))
    assert not result.ok and result.slowdown is None and result.scale is None
    assert result.cause == "placement: recording: no placement found"


def test_what_is_refused_where_it_was_drawn_does_not_stop_the_series(monkeypatch):
    def refused(*_, place=True, **__):
        raise InvalidArgument("no place" if place else "not even here")

    monkeypatch.setattr("dmpcpp.trials.generality._trial.imitation.imitate", refused)
    monkeypatch.setattr("dmpcpp.trials.generality._trial._follows", lambda *_: True)
    result = generality.attempt(Trial("panda", "none", 0, 0))
    assert not result.ok and result.cause == "placement: no place"


# ---- many of them -------------------------------------------------------------------------------------------


def made(monkeypatch):
    """Trials answered at once; returns the list of those that were really made."""
    asked = []

    def answer(trial):
        asked.append(trial)
        return replace(DONE, trial=trial, ok=trial.index != 3, cause="placement: none" * (trial.index == 3))

    monkeypatch.setattr("dmpcpp.trials.generality._series.attempt", answer)
    return asked


def test_a_stopped_run_goes_on_where_it_was(tmp_path, monkeypatch):
    asked = made(monkeypatch)
    path = tmp_path / "trials.jsonl"
    first = generality.trials(4, ["panda"], ["none"])
    assert [result.trial for result in run(first, path)] == first
    path.write_bytes(path.read_bytes()[:-30])  # stopped in the middle of the fourth line
    asked.clear()
    more = generality.trials(6, ["panda"], ["none"])
    results = run(more, path)
    assert [trial.index for trial in asked] == [3, 4, 5]
    assert [result.trial.index for result in results] == list(range(6))
    assert [result.trial.index for result in generality.kept(path)] == list(range(6))


def test_progress_counts_what_is_done_and_what_failed(tmp_path, monkeypatch):
    made(monkeypatch)
    seen = []
    run(generality.trials(5, ["panda"], ["none"]), tmp_path / "t.jsonl", progress=lambda *told: seen.append(told))
    assert seen[0] == (0, 0, 5) and seen[-1] == (5, 1, 5)


def test_the_summary_counts_passes_and_names_every_failure(tmp_path, monkeypatch):
    made(monkeypatch)
    summary = generality.summary(run(generality.trials(5, ["panda", "iiwa"], ["none", "high"]), tmp_path / "t.jsonl"))
    assert (summary["verdict"], summary["trials"], summary["share_passed"]) == ("fail", 20, 0.8)
    assert [(row["arm"], row["noise"], row["passed"]) for row in summary["rows"]] == [
        (arm, noise, 4) for arm in ("panda", "iiwa") for noise in ("none", "high")
    ]
    assert summary["rows"][0]["causes"] == {"placement": 1}
    assert [failure["index"] for failure in summary["failures"]] == [3] * 4
    assert all(failure["cause"] for failure in summary["failures"])
    json.dumps(summary, allow_nan=False)


def test_a_distribution_is_numpys_and_leaves_out_what_is_unknown():
    values = [None, *np.random.default_rng(0).uniform(size=41).tolist()]
    found = Distribution.of(values)
    assert found == Distribution(*np.percentile(values[1:], [50, 95, 100]))
    assert Distribution.of([None]) is None


def test_results_survive_the_file_and_a_foreign_line_is_refused(tmp_path):
    assert Result.from_dict(json.loads(json.dumps(DONE.to_dict()))) == DONE
    path = tmp_path / "t.jsonl"
    path.write_text('{"trial": 1}\n')
    with pytest.raises(InvalidArgument, match=r"t\.jsonl, line 1: no result of a trial"):
        run(generality.trials(1, ["panda"]), path)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0, ["panda"]), "count: 0, expected 1 or more"),
        ((1, ["panda"], ["loud"]), r"noises: \['loud'\], expected some of none, low, high"),
        ((1, []), "arms: none"),
        ((1, ["panda"], ["none"], -1), "seed: -1"),
    ],
)
def test_what_are_no_trials_is_refused(arguments, message):
    with pytest.raises(InvalidArgument, match=message):
        generality.trials(*arguments)


def test_no_jobs_are_refused(tmp_path):
    with pytest.raises(InvalidArgument, match="jobs: 0, expected 1 or more"):
        run(generality.trials(1, ["panda"]), tmp_path / "t.jsonl", jobs=0)


# ---- the command line -----------------------------------------------------------------------------------------


def command(*arguments: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-m", "dmpcpp", "generality", *map(str, arguments)]
    done = subprocess.run(line, capture_output=True, text=True, cwd=cwd, timeout=500)
    assert "Traceback" not in done.stderr + done.stdout
    return done


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--arm", "ur99"], "'ur99' is not known"),
        (["--noise", "loud"], "--noise: ['loud']"),
        (["-k", "0"], "0 is not in the range"),
    ],
)
def test_wrong_usage_is_one_clear_error_and_status_2(arguments, message, tmp_path):
    done = command(*arguments, cwd=tmp_path)
    assert done.returncode == 2 and message in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_kept_trials_are_summed_up_without_being_made_again(tmp_path):
    (tmp_path / "out").mkdir()
    failed = replace(
        DONE, trial=Trial("panda", "none", 0, 1, options=TEMPO), ok=False, cause="torque_clipped 3 (limit 0)"
    )
    lines = [json.dumps(result.to_dict()) + "\n" for result in (DONE, failed)]
    (tmp_path / "out" / "trials.jsonl").write_text("".join(lines))
    done = command("-k", 2, "--arm", "panda", "--noise", "none", "--out", "out", cwd=tmp_path)
    assert done.returncode == 3, done.stderr
    assert "panda, noise none, motion 1: torque_clipped 3" in done.stdout and "50.0 % of 2" in done.stdout
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["rows"][0]["causes"] == {"torque_clipped": 1}


BARE = '<limit lower="-2.8" upper="2.8" velocity="0" effort="0"/>'


def test_trials_take_the_options_of_an_arm(tmp_path):
    """Limits, contacts, dynamics and what is followed reach every trial, and another limit is another trial."""
    write(tmp_path, limit=BARE, inertials={f"l{k}": "" for k in range(1, 7)})
    made = ("-k", 1, "--arm", "six.urdf", "--noise", "none", "--out", "out", "--json", "--dynamics", "none")
    made = (*made, "--follow", "position", "--floor", "none", "--ignore-contact", "base,l2")
    done = command(*made, "--velocity", 2, "--tip", "l6", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    (trial,) = [result.trial for result in generality.kept(tmp_path / "out" / "trials.jsonl")]
    assert trial.choice == {"tip": "l6", "limits": {"velocity": [2.0]}}
    around = {"floor": None, "ignored": [["base", "l2"]]}
    assert trial.options == {"follow": "position", "dynamics": "none", "surroundings": around, **TEMPO}
    done = command(*made, "--velocity", 1, "--tip", "l6", cwd=tmp_path)
    slow, fast = [result.slowdown for result in reversed(generality.kept(tmp_path / "out" / "trials.jsonl"))]
    assert done.returncode == 0 and fast < slow <= 2.2 * fast


def test_what_is_as_usual_is_the_same_trial_whether_stated_or_not():
    usual = {"follow": None, "dynamics": "full", "surroundings": {"floor": "auto", "ignored": []}}
    plain = generality.trials(1, ["panda"])
    assert generality.trials(1, ["panda"], choice={"base": None, "limits": {}}, options=usual) == plain
    assert plain[0].imitation_options()["tempo"] == "person"


def test_trials_of_before_the_tempo_are_slowed_down_evenly():
    before = Trial("panda", "none", 0, 0)
    assert before.key not in {trial.key for trial in generality.trials(1, ["panda"], ["none"])}
    assert before.imitation_options()["tempo"] == "uniform" and before.imitation_options()["tolerance"] == "0"


def test_other_options_make_another_trial():
    usual = {"follow": None, "dynamics": "full", "surroundings": {"floor": "auto", "ignored": []}}
    plain = generality.trials(1, ["panda"])
    other = generality.trials(1, ["panda"], options={**usual, "dynamics": "none"})[0]
    assert other.key != plain[0].key and other.imitation_options()["dynamics"] == "none"


def test_an_arm_of_five_joints_is_refused_before_the_first_trial(tmp_path):
    (tmp_path / "five.urdf").write_text(robot(chain(5)))
    done = command("-k", 1, "--arm", "five.urdf", cwd=tmp_path)
    assert done.returncode == 2 and "--follow position" in done.stderr and not (tmp_path / "dmpcpp-generality").exists()


@pytest.mark.slow
def test_both_cores_make_trials_from_drawing_to_verdict(tmp_path):
    arguments = ["-k", 2, "--arm", "panda", "--noise", "none", "--jobs", 2, "--out", "out", "--json"]
    done = command(*arguments, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert json.loads(done.stdout)["share_passed"] == 1.0
    assert len((tmp_path / "out" / "trials.jsonl").read_text().splitlines()) == 2
