"""`python -m benchmarks.robot [--motions N] [--recordings] [--franka N] [--json]`: what leaves for a robot, and a run.

Random motions of the arms that ship with PyBullet, cut out of swings and slowed to the limits, and with --recordings
twelve recorded ones on the Panda (DMPCPP_RECORDINGS names their folder), sent at 125, 500 and 1000 Hz and looked at as
a robot at 1 kHz sees them; six faults; stops at random times; our work in a cycle; with --franka runs and stops against
franky-sim in a process of its own, beside a cosine of the same peak speed. Exit status: 0 every goal reached, 3 one
missed.
"""

from __future__ import annotations

import itertools
import json
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import click
import numpy as np
from dmpcpp import Arm, JointTrajectory, arms, export, learning, motion, planning, running, sending, stretched
from numpy.typing import NDArray

from benchmarks import demonstrations
from benchmarks.figures import Figure

Array = NDArray[np.float64]

RATES = (125.0, 500.0, 1000.0)
ARMS = ("panda", "iiwa", "xarm6")
FAULTS = ("start 1 mrad off", "step of velocity", "step of acceleration", "jerk of 1.01", "cut end", "sample lost")
STOPS = 20
_RECORDED = 12
_SEEN = 1000.0  # Hz
_HOME = (0.0, 0.0, 0.0, -1.57, 0.0, 1.57, 0.785)


# ---- motions --------------------------------------------------------------------------------------------


def random_motion(arm: Arm, seed: int) -> JointTrajectory:
    """Every joint swings at a pace of its own, anywhere in nine tenths of its range; it begins and ends at speed."""
    random = np.random.default_rng(seed)
    t = np.linspace(0.0, random.uniform(0.8, 6.0), 1001)
    lower, upper = np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi)
    size = 0.45 * (upper - lower) * random.uniform(0.1, 1.0, len(lower))
    pace, phase = random.uniform(0.5, 10.0, len(lower)), random.uniform(0.0, 6.3, len(lower))
    position = 0.5 * (lower + upper) + size * np.sin(np.outer(t, pace) + phase)
    joints = planning.slowed(arm, JointTrajectory.through(t, position, list(arm.joint_names))).joints
    while _torque_share(arm, joints) > 0.95:
        joints = stretched(joints, 1.1)
    return joints


def _torque_share(arm: Arm, joints: JointTrajectory) -> float:
    few = slice(None, None, 10)
    torque = sending.effort(arm, joints.position[few], joints.velocity[few], joints.acceleration[few])
    return float((np.abs(torque) / arm.effort_limit).max())


def recorded_motions(arm: Arm) -> Iterator[JointTrajectory]:
    """The hand-guided motions, placed, learned and solved; no physics."""
    from dmpcpp.recordings import Recording
    from dmpcpp.simulation import default_simulator

    folder = demonstrations.recordings()
    if folder is None:
        raise click.UsageError("--recordings: DMPCPP_RECORDINGS names no folder of recordings.")
    clear = planning.clear_of_itself(arm, default_simulator)
    for position, rotation in list(demonstrations.recorded_poses(folder))[:_RECORDED]:
        t = np.linspace(0.0, 8.0, len(position))
        hand = motion.continuous(Recording(time=t, position=position, rotation=rotation, body="hand"))
        found = planning.place(hand, arm, accept=clear)
        model = learning.learn(motion.demonstration(found.apply_to(hand)))
        yield planning.solve(model, arm, start=found.start, accept=clear).joints


# ---- what is sent ---------------------------------------------------------------------------------------


def beyond(arm: Arm, sent: sending.JointMotion) -> int:
    """Count samples at 1 kHz beyond a limit of position, velocity, acceleration or jerk."""
    begin, end = sent.time[0], sent.time[-1]
    at = begin + np.arange(-4, int((end - begin) * _SEEN) + 6) / _SEEN
    values = sending.interpolated(sent, np.clip(at, begin, end))[0]
    count = int(((values > arm.upper + 1e-9) | (values < arm.lower - 1e-9)).any(axis=1).sum())
    for limit in (arm.velocity_limit, arm.acceleration_limit, arm.jerk_limit):
        values = np.diff(values, axis=0) * _SEEN
        count += int((np.abs(values) > limit * (1.0 + 1e-6)).any(axis=1).sum())
    return count


def sent_figures(name: str, arm_and_motions: Iterator[tuple[Arm, JointTrajectory]]) -> Iterator[Figure]:
    """Ends, samples beyond limits and refusals of all motions at all rates."""
    moving = over = refused = slow = count = 0
    for arm, joints in arm_and_motions:
        whole = sending.from_rest_to_rest(arm, joints)
        count, slow = count + 1, slow + any(cost > 0.0 for cost in whole.slowed)
        for rate in RATES:
            sent = whole.at_rate(rate)
            moving += bool(sent.velocity[[0, -1]].any() or sent.acceleration[[0, -1]].any())
            over += beyond(arm, sent)
            refused += not sending.ready(sending.check(sent, arm)).ok
    title = f"{count} {name} at 125, 500, 1000 Hz"
    yield Figure(f"{title}: not exactly at rest at an end", moving, 0, "")
    yield Figure(f"{title}: samples beyond a limit at 1 kHz", over, 0, "")
    yield Figure(f"{title}: refused by the check", refused, 0, "")
    yield Figure(f"{title}: with an end slowed along the path", slow, count, "")


def faults(arm: Arm) -> Iterator[Figure]:
    """How many of the six faults that libfranka refuses the check refuses."""
    sent = sending.from_rest_to_rest(arm, random_motion(arm, 3)).at_rate(1000.0)
    missed = [name for name in FAULTS[1:] if sending.ready(sending.check(*_faulty(name, sent, arm))).ok]
    off = sending.check(sent, arm, stands=sent.position[0] + 1e-3)
    missed += [FAULTS[0]] if sending.ready(off).ok else []
    yield Figure(f"faults that pass the check, of 6 {missed or ''}".strip(), len(missed), 0, "")


def _faulty(name: str, sent: sending.RestToRest, arm: Arm) -> tuple[Any, Arm]:
    parts = {key: np.array(getattr(sent, key)) for key in ("time", "position", "velocity", "acceleration")}
    middle = len(sent.time) // 2
    late = parts["time"][middle:] - parts["time"][middle]
    if name == "step of velocity":
        parts["position"][middle:, 0] += 0.05 * late
        parts["velocity"][middle:, 0] += 0.05
    elif name == "step of acceleration":
        parts["position"][middle:, 0] += 5.0 * late**2
        parts["velocity"][middle:, 0] += 10.0 * late
        parts["acceleration"][middle:, 0] += 10.0
    elif name == "jerk of 1.01":
        share = next(one.value for one in sending.check(sent, arm) if one.name == "robot_jerk")
        arm = arm.with_limits(jerk=arm.jerk_limit * share / 1.01)
    elif name == "cut end":
        parts = {key: value[:-100] for key, value in parts.items()}
    elif name == "sample lost":
        fastest = int(np.argmax(np.abs(parts["velocity"]).max(axis=1)))
        parts = {key: np.delete(value, fastest, axis=0) for key, value in parts.items()}
    return SimpleNamespace(**parts, joint_names=sent.joint_names), arm


# ---- stops and cycles -----------------------------------------------------------------------------------


def stops(arm: Arm) -> Iterator[Figure]:
    """Stop random motions at random times: how long it takes, and how far off the path the arm comes."""
    longest = off = over = late = 0.0
    work: list[float] = []
    for seed in range(STOPS):
        plan = sending.from_rest_to_rest(arm, random_motion(arm, 1000 + seed))
        follower = running.Follower(plan, arm)
        asked = float(np.random.default_rng(seed).uniform(0.0, follower.duration))
        position = _stopped(follower, asked, work)
        longest, late = max(longest, follower.stop_duration), late + (follower.stop_duration > 0.3)
        off = max(off, *(_off_path(plan, q, asked) for q in position[:: max(1, len(position) // 50)]))
        stream = np.concatenate([np.repeat(position[:1], 4, 0), position, np.repeat(position[-1:], 4, 0)])
        for limit in (arm.velocity_limit, arm.acceleration_limit, arm.jerk_limit):
            stream = np.diff(stream, axis=0) * _SEEN
            over += int((np.abs(stream) > limit * (1.0 + 1e-6)).any(axis=1).sum())
    yield Figure(f"{STOPS} stops of the {arm.name}: the longest", longest, 0.3, "s")
    yield Figure(f"{STOPS} stops of the {arm.name}: longer than 0.3 s", late, 0, "")
    yield Figure(f"{STOPS} stops of the {arm.name}: off the path", off, 1e-6, "rad")
    yield Figure(f"{STOPS} stops of the {arm.name}: samples beyond a limit", over, 0, "")
    median, most = np.quantile(1e3 * np.array(work), (0.5, 0.999))
    yield Figure(f"our work in {len(work)} cycles, median", median, 0.1, "ms CPU")
    yield Figure(f"our work in {len(work)} cycles, 99.9 %", most, 0.3, "ms CPU")


def _stopped(follower: running.Follower, asked: float, work: list[float]) -> Array:
    position = []
    for k in range(10**6):
        if k / _SEEN >= asked:
            follower.stop()
        before = time.thread_time()
        target = follower(k / _SEEN)
        work.append(time.thread_time() - before)
        if target is None:
            break
        position.append(target.position.copy())
    return np.array(position)


def _off_path(plan: sending.JointMotion, q: Array, near: float) -> float:
    """The distance [rad] of joints to the path, by golden section around the nearest of many places."""
    from scipy.optimize import minimize_scalar

    def distance(place: float) -> float:
        return float(np.abs(sending.states_at(plan, np.array([place]))[0][0] - q).max())

    places = np.linspace(0.0, plan.time[-1] - plan.time[0], 4001)
    best = places[np.argmin(np.abs(sending.states_at(plan, places)[0] - q).max(axis=1))]
    step = places[1]
    found = minimize_scalar(distance, bounds=(best - step, best + step), method="bounded", options={"xatol": 1e-12})
    return min(float(found.fun), distance(float(best)))


# ---- franky-sim -----------------------------------------------------------------------------------------


def franka(runs: int) -> Iterator[Figure]:
    """Runs and stops against franky-sim; a cosine of the same peak speed says what its controller can do."""
    import franky_sim

    arm = arms.load(Path(franky_sim.__file__).parent / "assets" / "fr3_clean.urdf")
    server = subprocess.Popen(
        [str(Path(sys.executable).with_name("franky-sim")), "-s", "mujoco", "--hostname", "127.0.0.77"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield from _franka_figures(arm, running.FrankaRobot("127.0.0.77"), runs)
    finally:
        server.kill()
        server.wait()


def _franka_figures(arm: Arm, robot: running.FrankaRobot, runs: int) -> Iterator[Figure]:
    _reached(robot)
    limited = robot.limits(arm)
    complete = worst = 0.0
    work: list[Array] = []
    over = 0
    for seed in range(runs):
        plan = _about_home(limited, seed)
        run = running.execute(robot, running.brief(robot, arm, plan))
        complete += run.end.complete
        rms, peak = _tracking(run, plan)
        again = running.execute(robot, running.brief(robot, arm, _cosine(limited, peak)))
        worst = max(worst, rms / _tracking(again, _cosine(limited, peak))[0])
        work.append(run.log["work"])
        over += _commands_beyond(limited, run)
    yield Figure(f"{runs} runs against franky-sim: not complete", runs - complete, 0, "")
    yield Figure(f"{runs} runs against franky-sim: commands beyond a limit", over, 0, "")
    yield Figure(f"{runs} runs against franky-sim: tracking RMS over that of a cosine, worst", worst, 1.1, "")
    median, most = np.quantile(1e3 * np.concatenate(work), (0.5, 0.999))
    yield Figure("our work in a cycle there, median", median, 0.1, "ms CPU")
    yield Figure("our work in a cycle there, 99.9 %", most, 0.3, "ms CPU")
    yield Figure("cycles of more than 1 ms of work there", int((np.concatenate(work) > 1e-3).sum()), 0, "")
    yield from _franka_stops(arm, robot, runs)


def _franka_stops(arm: Arm, robot: running.FrankaRobot, runs: int) -> Iterator[Figure]:
    limited = robot.limits(arm)
    still, off = 0, 0.0
    for seed in range(runs):
        plan = _about_home(limited, 100 + seed)
        found = running.brief(robot, arm, plan)
        length = found.whole.time[-1] - found.whole.time[0]
        asked = float(np.random.default_rng(seed).uniform(0.0, length))
        run = running.execute(robot, found, watch=_after(int(asked * _SEEN)))
        still += run.end.complete and bool(np.abs(robot.state().velocity).max() < 0.02)
        off = max(off, _off_path(found.whole, run.log["commanded"][-1], asked))
    yield Figure(f"{runs} stops against franky-sim: not at rest at the end", runs - still, 0, "")
    yield Figure(f"{runs} stops against franky-sim: off the path", off, 1e-6, "rad")


def _after(cycles: int) -> Callable[[], bool]:
    """Stop after so many cycles of the robot's."""
    counter = itertools.count()
    return lambda: next(counter) >= cycles


def _reached(robot: running.FrankaRobot) -> None:
    for left in reversed(range(60)):
        try:
            robot.connect()
            return
        except running.RobotError:
            if not left:
                raise
            time.sleep(0.5)


def _about_home(arm: Arm, seed: int) -> export.JointSamples:
    random = np.random.default_rng(seed)
    t = np.linspace(0.0, 1.5, 376)
    size, pace, phase = random.uniform(-0.3, 0.3, 7), random.uniform(0.5, 3.0, 7), random.uniform(0.0, 6.0, 7)
    swing = size * np.sin(np.outer(t, pace) + phase)
    joints = planning.slowed(arm, JointTrajectory.through(t, np.array(_HOME) + swing, list(arm.joint_names))).joints
    return _samples(sending.from_rest_to_rest(arm, joints))


def _cosine(arm: Arm, peak: Array) -> export.JointSamples:
    """Half a second up and down with these peak speeds (7,) [rad/s]."""
    t = np.linspace(0.0, 1.5, 376)
    rate = 2.0 * np.pi / 1.5
    position = np.array(_HOME) + np.outer(1.0 - np.cos(rate * t), peak / rate)
    joints = JointTrajectory.through(t, position, list(arm.joint_names))
    return _samples(sending.from_rest_to_rest(arm, joints))


def _samples(sent: sending.RestToRest) -> export.JointSamples:
    parts = (sent.time, sent.position, sent.velocity, sent.acceleration)
    return export.JointSamples(*parts, sent.joint_names, sent.motion)


def _tracking(run: running.Run, plan: export.JointSamples) -> tuple[float, Array]:
    """RMS [rad] of what was commanded against what was measured during the motion, and the peak speeds (7,)."""
    during = (run.time >= plan.time[0]) & (run.time <= plan.time[-1])
    error = run.log["position"][during] - run.log["commanded"][during]
    return float(np.sqrt(np.mean(error**2))), np.abs(plan.velocity).max(axis=0)


def _commands_beyond(arm: Arm, run: running.Run) -> int:
    kept = np.append(np.diff(run.time) > 0.0, True)
    values, count = run.log["commanded"][kept], 0
    for limit in (arm.velocity_limit, arm.acceleration_limit, arm.jerk_limit):
        values = np.diff(values, axis=0) * _SEEN
        count += int((np.abs(values) > limit * 1.001).any(axis=1).sum())
    return count


@click.command()
@click.option("--motions", default=400, show_default=True, type=click.IntRange(1), help="Random motions.")
@click.option("--recordings", is_flag=True, help="Twelve recorded motions on the Panda as well.")
@click.option("--franka", "runs", default=0, type=click.IntRange(0), help="Runs and stops against franky-sim.")
@click.option("--json", "as_json", is_flag=True, help="Print the figures as JSON.")
def main(motions: int, recordings: bool, runs: int, as_json: bool) -> None:
    """Measure, print and compare with the goals."""
    known = {name: arms.find(name) for name in ARMS}
    each = ((known[ARMS[k % len(ARMS)]], random_motion(known[ARMS[k % len(ARMS)]], k)) for k in range(motions))
    parts: list[Callable[[], Iterator[Figure]]] = [lambda: sent_figures("random motions", each)]
    if recordings:
        panda = known["panda"]
        parts.append(lambda: sent_figures("recordings", ((panda, joints) for joints in recorded_motions(panda))))
    parts += [lambda: faults(known["panda"]), lambda: stops(known["panda"])]
    if runs:
        parts.append(lambda: franka(runs))
    missed = 0
    for figure in (figure for part in parts for figure in part()):
        missed += not figure.ok
        shown = {"name": figure.name, "value": figure.value, "goal": figure.goal, "unit": figure.unit, "ok": figure.ok}
        mark = "ok    " if figure.ok else "missed"
        text = f"{mark} {figure.name}: {figure.value:.3g} {figure.unit} (goal {figure.goal:g})"
        click.echo(json.dumps(shown) if as_json else text, color=False)
        sys.stdout.flush()
    sys.exit(3 if missed else 0)


if __name__ == "__main__":
    main()
