"""What the commands and the library say: each in the words of who called it, an option or a parameter."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest
from dmpcpp.cli import main
from dmpcpp.cli._flags import flagged, flags_of, in_flags
from dmpcpp.errors import InvalidArgument, NotStated, within

LIMITS = {kind: f"--{kind}" for kind in ("velocity", "acceleration", "effort", "density", "dynamics")}
PACKAGE = Path(__file__).parents[2] / "python" / "dmpcpp"

DATA = {  # what a file, a model or a class holds: no command passes such an argument on
    "time", "timestamp", "position", "rotation", "velocity", "pose", "joint_names", "joints", "b", "other", "names",
    "signal", "limit", "reference", "rounds", "speed", "max_residual", "candidates", "lead", "time_step", "mass_error",
    "quaternion", "measured",
    "payload_offset", "control_rate", "misjudged", "home", "half_width", "grasp_height", "bottle", "on", "kind",
    "right", "cost", "decay", "search", "step", "rollouts",
}  # fmt: skip


@cache
def messages():
    """Return the message of every InvalidArgument and NotStated of the package, what differs written as X."""
    found = []
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("InvalidArgument", "NotStated"):
                found.append(_text(node.args[-1]))
    assert len(found) > 150
    return found


@cache
def sentences():
    """Return every text of the library (the command line is in cli/), docstrings aside, what differs written as X."""
    found = []
    for path in PACKAGE.rglob("*.py"):
        if "cli" not in path.parts and path.name != "doctor.py":  # doctor says what the commands need
            tree = ast.parse(path.read_text())
            silent = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
            silent |= {id(part) for node in ast.walk(tree) if isinstance(node, ast.JoinedStr) for part in node.values}
            strings = (node for node in ast.walk(tree) if isinstance(node, ast.Constant | ast.JoinedStr))
            found += [_text(node) for node in strings if id(node) not in silent]
    found = [text for text in found if " " in text and "<" not in text]  # words of a format are not said to anyone
    assert len(found) > 600
    return found


def _text(node):
    if isinstance(node, ast.Constant):
        return str(node.value)
    if isinstance(node, ast.JoinedStr):
        return "".join(_text(part) for part in node.values)
    if isinstance(node, ast.BinOp):
        return _text(node.left) + _text(node.right)
    return "X"


def names_of(command):
    return {name for name in flags_of(command) if name not in ("config", "as_json")}


def test_every_argument_of_a_message_is_an_option_somewhere_or_known_to_be_none():
    options = {name for command in main.commands.values() for name in names_of(command)}
    named = {InvalidArgument(message).argument for message in messages()} - {"", "X", "XX", "Frames", "LeRobot"}
    assert len(named) > 40
    assert named - options - DATA == set()


@pytest.mark.parametrize("name", sorted(main.commands))
def test_a_message_names_options_and_no_parameters(name):
    command = main.commands[name]
    flags = flags_of(command)
    for message in messages():
        shown = flagged(InvalidArgument(message), flags)
        for parameter in names_of(command):
            spelled = rf"(?<![\w-]){parameter}=|^{parameter}(\[[^\]]*\])?: "
            spelled += rf"|(?<![\w-]){parameter}(?![\w=(])" if "_" in parameter.strip("_") else ""
            assert not re.search(spelled, shown), f"{parameter} in {shown!r}"


def test_the_library_names_no_option_of_the_command_line():
    options = {option for command in main.commands.values() for each in command.params for option in each.opts}
    options = {option for option in options if option.startswith("--")}
    assert len(options) > 60
    for text in sentences():
        commands = r"dmpcpp [a-z-]+ --[a-z-]+|`[^`]*`"  # a whole command may be named: `dmpcpp arms --fetch ur5e`
        named = set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", re.sub(commands, "", text)))
        assert not named & options, text


@pytest.mark.parametrize("name", ["plan", "imitate", "batch", "check-urdf"])
def test_a_limit_or_a_contact_to_state_is_named_as_the_option(name):
    flags = flags_of(main.commands[name]) if name != "check-urdf" else dict(LIMITS)
    for parameter in flags.keys() & {*LIMITS, "floor", "ignored"}:
        said = [text for text in sentences() if re.search(rf"(?<![\w.]){parameter}=[.XN'\[]", text)]
        assert said, parameter
        for text in said:
            shown = in_flags(text, flags)
            assert flags[parameter] in shown and f"{parameter}=" not in shown, shown


def test_an_error_carries_its_argument_through_the_name_of_a_file():
    assert InvalidArgument("rate: 0, expected > 0.").argument == "rate"
    assert InvalidArgument("time[3]: nan, expected a finite number.").argument == "time"
    assert InvalidArgument("hand.csv: line 3: no number.").argument == ""
    inner = within("hand.csv", InvalidArgument("rate: 0, expected > 0."))
    assert (str(inner), inner.argument) == ("hand.csv: rate: 0, expected > 0.", "rate")
    lacking = within("hand.csv", NotStated(("unit", "rate"), "unit: not there."))
    assert (lacking.names, lacking.argument) == (("unit", "rate"), "unit")


@pytest.mark.parametrize(
    ("command", "message", "shown"),
    [
        ("imitate", "cutoff: 8 Hz, expected below 5.", "--low-pass: 8 Hz, expected below 5."),
        ("fit", "recordings: none, expected at least one.", "FILE: none, expected at least one."),
        ("plan", "start: shape (3,), expected (7,).", "--from-joints: shape (3,), expected (7,)."),
        ("imitate", "start: 9 s, the motion ends at 3 s.", "--start: 9 s, the motion ends at 3 s."),
        ("imitate", "unit: unknown. State unit='cm'.", "--unit: unknown. State --unit cm."),
        ("inspect", "up_axis: lacking. State up_axis as well.", "--up-axis: lacking. State --up-axis as well."),
        ("generality", "noises: none, expected one.", "--noise: none, expected one."),
        ("doctor", "up_axis: lacking.", "up_axis: lacking."),
        ("plan", "state ignored=[('a', 'b'), ('c', 'd')].", "state --ignore-contact a,b --ignore-contact c,d."),
        ("plan", "floor=Z, or floor=None without one", "--floor Z, or --floor none without one"),
        ("plan", "Set it with arms.with_stated(arm, velocity=...) [m/s].", "Set it with --velocity ... [m/s]."),
        ("demo", "the shapes (arms.with_stated(arm, density=2700)), or", "the shapes (--density 2700), or"),
        ("demo", "by kinematics alone (dynamics='none')", "by kinematics alone (--dynamics none)"),
        ("plan", "by kinematics alone (dynamics='none')", "by kinematics alone (--simulator none)"),
        ("verify", "joints: 1 sample(s), expected at least 2.", "PLAN: 1 sample(s), expected at least 2."),
        ("imitate", "may take it: simulator='mujoco'.", "may take it: --simulator mujoco."),
    ],
)
def test_the_argument_of_an_error_is_written_as_its_option(command, message, shown):
    assert flagged(InvalidArgument(message), flags_of(main.commands[command])) == shown


def test_a_file_named_as_a_parameter_stays_a_file():
    flags = {"rate": "--rate", "start": "--start"}
    error = within("rate.csv", InvalidArgument("start: 9 s, the motion ends at 3 s."))
    assert flagged(error, flags) == "rate.csv: --start: 9 s, the motion ends at 3 s."
    assert in_flags("rate, start", flags) == "rate, start"
