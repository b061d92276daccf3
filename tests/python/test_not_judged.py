"""What nobody states is not judged, and what was not judged is not "verified" unless a person accepts it."""

import json
import time

import numpy as np
import pytest

pytest.importorskip("pybullet", reason="the extra `sim`")

from dmpcpp import Arm, checks, planning, report, simulation, urdf_check
from dmpcpp.checks import Check, Checked
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import assumptions, limit_doubts, overloads, random_postures, require_holdable
from dmpcpp.simulation import Tolerances

from benchmarks.joint_motions import reach
from tests.python.command import run
from tests.python.small_arms import INERTIA, LIMIT, arm, write

HOLDS = Check("kept", True, 0.5, 1.0, "1")
FAILS = Check("broken", False, 2.0, 1.0, "1")
OPEN = Check.not_judged("torque_ratio", "1", "no effort limit is stated")


class Found(Checked):
    def __init__(self, *found, accepted=()):
        self.checks, self.accepted = found, accepted


# ---- three results ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("found", "accepted", "ok", "word", "verdict"),
    [
        ((HOLDS,), (), True, "verified", "pass"),
        ((HOLDS, FAILS), (), False, "not verified", "fail"),
        ((HOLDS, OPEN), (), False, "not verified", "not judged"),
        ((HOLDS, OPEN), ("torque_ratio",), True, "verified, not judged: torque_ratio", "pass"),
        ((HOLDS, FAILS), ("broken",), False, "not verified", "fail"),
        ((FAILS, OPEN), ("torque_ratio", "broken"), False, "not verified", "fail"),
        ((HOLDS, OPEN), ("inertia",), False, "not verified", "not judged"),
    ],
)
def test_a_verdict_has_three_results_and_takes_only_what_was_not_judged(found, accepted, ok, word, verdict):
    result = Found(*found, accepted=accepted)
    assert (result.ok, result.verdict_word, result.judged()["verdict"]) == (ok, word, verdict)
    assert [check.result for check in (HOLDS, FAILS, OPEN)] == ["holds", "fails", "not judged"]


def test_a_check_that_was_not_judged_is_not_ok_and_goes_through_json():
    assert not OPEN.ok
    plain = json.loads(json.dumps(OPEN.to_dict(), allow_nan=False))
    assert plain["result"] == "not judged" and plain["ok"] is False and plain["value"] is None
    assert "judged" not in plain  # a reader of 0.1 asks for ok
    with pytest.raises(ValueError, match="cannot hold"):
        Check("torque_ratio", True, 0.0, 1.0, "1", judged=False)


def test_only_checks_that_may_be_left_unjudged_can_be_accepted():
    assert checks.accepted_names(["inertia", "torque_ratio", "inertia"]) == ("inertia", "torque_ratio")
    with pytest.raises(InvalidArgument, match=r"accept: 'self_collision', expected .*torque_ratio"):
        checks.accepted_names(["self_collision"])


# ---- limits -----------------------------------------------------------------------------------------------------


def executed(robot: Arm, target=(0.3, 0.4, 0.3, 0.2, 0.3, 0.2), seconds=2.0):
    return simulation.execute(robot, reach(robot, target, seconds, [0.1] * 6), settle=0.1)


def results(log):
    return {check.name: check.result for check in log.verdict.checks}


UNJUDGED = {
    "no velocity": ('<limit lower="-2.8" upper="2.8" velocity="0" effort="80"/>', {"velocity_ratio"}),
    "no effort": ('<limit lower="-2.8" upper="2.8" velocity="2" effort="0"/>', {"torque_ratio"}),
    "neither": ('<limit lower="-2.8" upper="2.8" velocity="0" effort="0"/>', {"velocity_ratio", "torque_ratio"}),
    "enormous velocity": ('<limit lower="-2.8" upper="2.8" velocity="1e3" effort="80"/>', {"velocity_ratio"}),
    "enormous effort": ('<limit lower="-2.8" upper="2.8" velocity="2" effort="1e9"/>', {"torque_ratio"}),
    "speed in degrees": ('<limit lower="-2.8" upper="2.8" velocity="180" effort="80"/>', {"velocity_ratio"}),
    "angles in degrees": ('<limit lower="-160" upper="160" velocity="2" effort="80"/>', {"joint_margin"}),
}


@pytest.mark.parametrize("name", UNJUDGED)
def test_a_limit_that_is_missing_or_that_no_arm_has_judges_nothing(name):
    limit, expected = UNJUDGED[name]
    log = executed(arm(limit=limit))
    found = results(log)
    assert {check for check, result in found.items() if result == "not judged"} == expected
    assert "fails" not in found.values()
    assert not log.verdict.ok
    for check in expected:
        assert "j1 to j6" in log.verdict[check].detail


def test_limits_that_arms_have_are_judged():
    log = executed(arm())
    assert log.verdict.ok and log.verdict.verdict_word == "verified"
    assert 0.0 < log.verdict["velocity_ratio"].value < 1.0
    assert 0.0 < log.verdict["torque_ratio"].value < 1.0


def test_one_joint_without_a_limit_is_named_alone():
    log = executed(arm(limits={"j3": '<limit lower="-2.8" upper="2.8" velocity="2" effort="0"/>'}))
    assert log.verdict["torque_ratio"].detail.startswith("j3: no effort limit is stated")


def test_a_joint_beyond_a_limit_that_is_stated_fails_whatever_the_others_lack():
    limits = {"j3": '<limit lower="-2.8" upper="2.8" velocity="0" effort="80"/>', "j2": LIMIT.replace('"2"', '"0.05"')}
    check = executed(arm(limits=limits)).verdict["velocity_ratio"]
    assert check.result == "fails" and check.detail == "j2"


def test_limits_of_the_user_judge_what_the_description_left_open():
    bare = arm(limit='<limit lower="-2.8" upper="2.8" velocity="0" effort="0"/>')
    log = executed(bare.with_limits(velocity=[2.0] * 6, effort=[80.0] * 6))
    assert log.verdict.verdict_word == "verified"


def test_degrees_are_recognised_with_the_figure_in_radians():
    doubts = limit_doubts(arm(limit='<limit lower="-180" upper="90" velocity="180" effort="80"/>'))
    texts = [f"{doubt.what} {doubt.to_do}" for doubt in doubts if doubt.joint == "j4"]
    assert len(texts) == 2 and all("degrees" in text for text in texts)
    assert "-3.142 to 1.571" in texts[0] and "3.142 rad/s" in texts[1]


def test_the_range_of_a_joint_of_two_turns_and_a_fast_wrist_are_no_placeholders():
    assert not limit_doubts(arm(limit='<limit lower="-12.5" upper="12.5" velocity="14" effort="2500"/>'))


def test_the_assumed_acceleration_is_named_and_a_stated_one_is_not():
    assert assumptions(arm()) == ("acceleration limit 10 rad/s^2 of every joint",)
    assert assumptions(arm().with_limits(acceleration=[3.0] * 6)) == ()


def test_lengths_in_millimetres_and_masses_in_grams_are_recognised():
    text = arm().urdf.replace('<origin xyz="0 0 0.3"/>', '<origin xyz="0 0 300"/>')
    log = executed(Arm.from_urdf(text, base="base", tip="l6").with_limits(effort=[1e4] * 6))
    assert log.verdict["dimensions"].result == "not judged" and "millimetres" in log.verdict["dimensions"].detail
    heavy = arm().urdf.replace('<mass value="1"/>', '<mass value="5000"/>')
    heavy = Arm.from_urdf(heavy, base="base", tip="l6")
    assert "grams" in simulation.judge(executed(heavy.with_limits(effort=[9e4] * 6)))["dimensions"].detail


# ---- what motors can hold ---------------------------------------------------------------------------------------


WEAK = LIMIT.replace('"80"', '"3"')


def test_gravity_beyond_an_effort_limit_is_found_by_the_closed_form():
    found = {
        overload.joint: overload for overload in overloads(arm(limit=WEAK), np.array([[0, np.pi / 2, 0, 0, 0, 0]]))
    }
    # Stretched out horizontally the links lie 0.04 beyond their joints, which are 0.3, 0.15, 0.2 and 0.12 m apart.
    at = np.cumsum([0.0, 0.3, 0.15, 0.2, 0.12])
    assert set(found) == {"j2", "j3"}
    assert found["j2"].asked == pytest.approx(9.81 * np.sum(at + 0.04), rel=1e-9)
    assert found["j3"].asked == pytest.approx(9.81 * np.sum(at[1:] - 0.3 + 0.04), rel=1e-9)
    assert "gravity alone asks 23.2 Nm, the URDF allows 3" in found["j2"].sentence


def test_an_arm_that_can_be_held_is_not_refused():
    require_holdable(arm())
    require_holdable(arm(), random_postures(arm()))
    with pytest.raises(InvalidArgument, match=r"joint 'j2': gravity alone asks .* Nm, the URDF allows 3\. .*effort="):
        require_holdable(arm(limit=WEAK))


def test_whose_limit_it_is_is_said():
    with pytest.raises(InvalidArgument, match="you allow 2"):
        require_holdable(arm().with_limits(effort=[2.0] * 6))


def test_a_run_of_an_arm_that_cannot_be_held_is_refused_before_anything_is_executed(tmp_path):
    path = write(tmp_path, limit=WEAK)
    began = time.perf_counter()
    done = run("demo", "--arm", path, "--no-report", "--out", "out", cwd=tmp_path)
    assert done.returncode == 2 and "gravity alone asks" in done.stderr and "allows 3" in done.stderr
    assert not (tmp_path / "out" / "summary.json").exists()
    assert time.perf_counter() - began < 120  # no search for a placement: a second or two on an idle machine


# ---- check-urdf -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"limit": '<limit lower="-160" upper="160" velocity="170" effort="80"/>'}, ["degrees"]),
        ({"limit": WEAK}, ["gravity alone asks", "URDF allows 3"]),
        ({"limit": LIMIT.replace('"80"', '"1e12"')}, ["more than any arm has"]),
        ({"limit": LIMIT.replace('"2"', '"0"')}, ["velocity is 0"]),
    ],
)
def test_check_urdf_names_placeholders_of_every_joint(changes, words, tmp_path):
    report = urdf_check.check(write(tmp_path, **changes))
    assert not report.ok and report.arm is not None
    said = [f"{defect.where} {defect.what} {defect.to_do}" for defect in report.defects]
    for word in words:
        assert any(word in text for text in said)
    done = run("check-urdf", "six.urdf", cwd=tmp_path)
    assert done.returncode == 3 and all(word in done.stdout for word in words)


def test_check_urdf_finds_nothing_in_a_sound_arm(tmp_path):
    assert urdf_check.check(write(tmp_path)).defects == ()


# ---- inertias ---------------------------------------------------------------------------------------------------


def with_izz(value):
    inertia = INERTIA.replace('izz="0.02"', f'izz="{value}"')
    return f'<inertial><origin xyz="0 0 0.04"/><mass value="1"/>{inertia}</inertial>'


@pytest.mark.parametrize(("izz", "change", "result"), [("0.041", 0.0081, "holds"), ("0.06", 0.111, "not judged")])
def test_an_inertia_that_no_body_can_have_is_a_note_up_to_five_percent(izz, change, result):
    log = executed(arm(inertials={"l3": with_izz(izz)}))
    check = log.verdict["inertia"]
    assert check.result == result and "l3" in check.detail
    assert log.inertia_repairs[0].link == "l3"
    assert log.inertia_repairs[0].change == pytest.approx(change, rel=0.02)  # a third of the excess over the largest


def test_how_far_an_inertia_may_be_changed_is_a_tolerance():
    log = executed(arm(inertials={"l3": with_izz("0.06")}))
    assert simulation.judge(log, Tolerances(inertia_change=0.2))["inertia"].ok
    assert simulation.judge(log, Tolerances(repaired_inertias=1))["inertia"].ok


def test_a_body_without_mass_between_others_leaves_the_inertia_unjudged_and_a_frame_does_not():
    assert executed(arm(inertials={"l4": ""})).verdict["inertia"].result == "not judged"
    assert executed(arm(inertials={"l4": ""}, shapes={"l4": ""})).verdict["inertia"].result == "holds"


def on_the_tip(side, inertial=""):
    """A cube that is fixed to the last link, which weighs 1 kg."""
    cube = f'<collision><origin xyz="0 0 0.1"/><geometry><box size="{side} {side} {side}"/></geometry></collision>'
    fixed = '<joint name="f" type="fixed"><parent link="l6"/><child link="frame"/></joint>'
    return arm(extra=f'<link name="frame">{inertial}{cube}</link>{fixed}')


@pytest.mark.parametrize(("side", "result"), [(0.01, "holds"), (0.018, "holds"), (0.019, "not judged")])
def test_a_small_part_without_mass_is_a_note_and_a_large_one_is_not_judged(side, result):
    """In solid steel, 7850 kg/m^3, 5 % of 1 kg are a cube of 18.5 mm."""
    for inertial in ("", f'<inertial><mass value="0"/>{ZERO}</inertial>'):
        log = executed(on_the_tip(side, inertial))
        check = log.verdict["inertia"]
        assert check.result == result
        (repair,) = log.inertia_repairs
        assert repair.change == pytest.approx(7850 * side**3, rel=1e-6) and repair.missing
        assert f"frame (states none: at most {785e3 * side**3:.2g} % of its body)" in check.detail
        assert log.repaired_links == ()


def test_a_shape_without_volume_weighs_nothing():
    assert executed(on_the_tip("0")).verdict["inertia"].value == 0.0


@pytest.mark.parametrize(
    ("mass", "change", "result"),
    [("1e-9", None, "holds"), ("0.04", 0.04 / 1.04, "holds"), ("0.1", 0.1 / 1.1, "not judged")],
)
def test_a_mass_without_inertia_counts_by_its_share_of_the_body(mass, change, result):
    log = executed(on_the_tip(0.01, f'<inertial><mass value="{mass}"/>{ZERO}</inertial>'))
    assert log.verdict["inertia"].result == result
    assert [repair.change for repair in log.inertia_repairs] == ([] if change is None else [pytest.approx(change)])


ZERO = '<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>'


def test_what_the_arm_does_not_move_has_any_inertia():
    assert executed(arm(inertials={"base": with_izz("1")})).verdict["inertia"].value == 0.0


# ---- plans and summaries ----------------------------------------------------------------------------------------


def test_a_summary_states_version_limits_with_sources_and_assumptions(tmp_path):
    from dmpcpp import PoseDemonstration, PoseDmp

    robot = arm(limit='<limit lower="-2.8" upper="2.8" velocity="0" effort="80"/>')
    motion = reach(robot, (0.4, 0.6, 0.5, 0.2, 0.4, 0.3), 2.0, [0.1, 0.3, 0.8, 0.1, 0.7, 0.1])
    model = PoseDmp.fit(PoseDemonstration(motion.time, robot.forward_kinematics(motion.position)))
    found = planning.plan(model, robot)
    assert not found.ok and [check.name for check in found.open] == ["velocity_ratio"]
    planning.write(found, tmp_path / "open")
    assert not (tmp_path / "open" / "joints.csv").exists()
    found = planning.plan(model, robot, accept=["velocity_ratio"])
    assert found.ok and found.verdict_word == "verified, not judged: velocity_ratio"
    planning.write(found, tmp_path / "taken")
    assert (tmp_path / "taken" / "joints.csv").exists()
    summary = json.loads((tmp_path / "taken" / "summary.json").read_text())
    assert summary["version"] == checks.SUMMARY_VERSION and summary["accepted"] == ["velocity_ratio"]
    assert summary["limits"]["velocity"]["sources"] == ["unstated"] * 6
    assert summary["limits"]["effort"]["sources"] == ["urdf"] * 6
    assert summary["assumed"] == ["acceleration limit 10 rad/s^2 of every joint"]


def test_accepting_is_printed_and_kept_and_a_report_says_so(tmp_path):
    write(tmp_path, limit='<limit lower="-2.8" upper="2.8" velocity="0" effort="0"/>')
    demo = ("demo", "--arm", "six.urdf", "--no-report", "--out", "out")
    done = run(*demo, cwd=tmp_path)
    assert done.returncode == 3
    assert "not verified: not judged: velocity_ratio, torque_ratio" in done.stdout
    assert "--velocity" in done.stdout and "--effort" in done.stdout and "j1 to j6" in done.stdout
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["verdict"] == "not judged"
    done = run(*demo, "--accept", "velocity_ratio,torque_ratio", cwd=tmp_path)
    assert done.returncode == 0
    assert "verified, not judged: velocity_ratio, torque_ratio" in done.stdout
    assert "assumed: acceleration limit 10 rad/s^2 of every joint" in done.stdout
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["verdict"] == "pass" and summary["accepted"] == ["velocity_ratio", "torque_ratio"]
    page = report.html(report.read_run(tmp_path / "out"))
    assert "<b>Verified, not judged: velocity_ratio, torque_ratio</b>" in page
    assert "Assumed: acceleration limit 10 rad/s^2 of every joint." in page and "j1 to j6" in page
    _as_of_0_1(tmp_path / "out" / "summary.json")
    page = report.html(report.read_run(tmp_path / "out"))
    assert "<b>Verified</b>: all" in page
    done = run(*demo, "--accept", "finite", cwd=tmp_path)
    assert done.returncode == 2 and "--accept: 'finite'" in done.stderr


def _as_of_0_1(path):
    """Write a summary as dmpcpp 0.1 did: every check judged, and no version."""
    summary = json.loads(path.read_text())
    for name in ("version", "not_judged", "accepted", "limits", "assumed", "changed"):
        del summary[name]
    for check in summary["checks"]:
        check["ok"] = True
        check["value"], check["limit"] = check["value"] or 0.0, check["limit"] or 1.0
        del check["result"]
    path.write_text(json.dumps(summary))
