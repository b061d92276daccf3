"""What dmpcpp's kinematics are worth, measured beside other packages in one run.

    python -m benchmarks.kinematics [--parts poses,track,paths,causes,timing,threads] [--arms panda,iiwa,xarm6,ur5]
                                    [--poses 10000] [--paths 20] [--causes 20] [--seed 0]

Fixed seeds, others with --seed; times are CPU time of this process. Every error is computed from the arm's forward
kinematics (KDL). The arms' URDFs come with PyBullet, the ur5's with example-robot-data (extra `bench`, as the other
packages).

The rule for feasible paths: the joints pass through four random postures on a cubic spline with ends at rest, inside
90 % of every range; each posture lies the share `reach` of the way from the one before to a uniformly random one (0.35
easy, 0.8 hard). Only the tip's 1000 poses over 10 s are given, and no start. The rule for poses that cannot be met
stands in benchmarks.kinematics_causes.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from importlib.util import find_spec
from itertools import islice

import dmpcpp
import numpy as np
from dmpcpp import Arm, InverseKinematics, JointTracker, JointTrajectory
from scipy.interpolate import CubicSpline

from benchmarks import kinematics_causes as causes
from benchmarks import kinematics_peers as peers
from benchmarks.kinematics_arms import TIME, Array, errors, feasible_path, inside, load, met, random_joints, smooth_path
from benchmarks.kinematics_threads import threads


def seconds_of(work: Callable[[], object]) -> float:
    """CPU seconds that the work takes."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def single_poses(name: str, arm: Arm, urdf: str, count: int, seed: int) -> None:
    """Random reachable poses from random seeds, one call each; peers get the first tenth of them."""
    random = np.random.default_rng(1 + seed)
    poses = arm.forward_kinematics(random_joints(arm, random, count))
    seeds = random_joints(arm, random, count)
    median, late = _solve_all(name, "dmpcpp", arm, peers.ours(arm), poses, seeds)
    few = max(count // 10, 1)
    for peer, solver in peers.solvers(arm, urdf).items():
        theirs, their_late = _solve_all(name, peer, arm, solver, poses[:few], seeds[:few])
        print(f"{'':30} dmpcpp is {theirs / median:.1f} times as fast by the median, {their_late / late:.1f} by p99")


def _solve_all(
    name: str, solver_name: str, arm: Arm, solver: peers.Solver, poses: Array, seeds: Array
) -> tuple[float, float]:
    joints, times = np.empty_like(seeds), np.empty(len(poses))
    for k, (pose, seed) in enumerate(zip(poses, seeds, strict=True)):
        begin = time.process_time()
        joints[k] = solver(pose, seed)
        times[k] = time.process_time() - begin
    share = np.mean(met(arm, joints, poses))
    median, late = 1e6 * np.quantile(times, [0.5, 0.99])
    print(
        f"{name:6} {solver_name:22} {len(poses):6} poses  {100 * share:6.2f} % met  "
        f"{median:7.1f} us, p99 {late:8.1f} us",
        flush=True,
    )
    return float(median), float(late)


def tracking(name: str, arm: Arm, urdf: str) -> None:
    """The smooth path, pose by pose and as a whole, from the first joints that follow() finds for it."""
    poses, dt = smooth_path(arm), float(TIME[1])
    solver = InverseKinematics(arm)
    start = solver.follow(poses, times=TIME).position[0]
    follow = min(seconds_of(lambda: solver.follow(poses, times=TIME, start=start)) for _ in range(7)) / len(poses)
    print(f"{name:6} follow() from the start, report and spline included: {1e6 * follow:.2f} us a pose")
    ours = _track(name, arm, poses, start)
    for peer, solve in peers.trackers(arm, urdf, dt).items():
        theirs, joints = _follow_with(solve, poses, start)
        whole = np.mean(met(arm, joints, poses))
        step = np.abs(np.diff(joints, axis=0)).max()
        print(
            f"{name:6} {peer:22} {100 * whole:6.2f} % met, {1e6 * theirs:7.2f} us a pose, largest step {step:.3f} rad: "
            f"dmpcpp is {theirs / ours:.1f} times as fast",
            flush=True,
        )


def _track(name: str, arm: Arm, poses: Array, start: Array) -> float:
    """Seconds a pose of JointTracker.track, its joints checked in another round."""
    dt, spent = float(TIME[1]), []
    for _ in range(7):
        track = JointTracker(arm, start).track
        begin = time.process_time()
        for pose in poses:
            track(pose, dt)
        spent.append((time.process_time() - begin) / len(poses))
    tracker, joints = JointTracker(arm, start), np.empty((len(poses), len(start)))
    for k, pose in enumerate(poses):
        tracker.track(pose, dt)
        joints[k] = tracker.joints
    position, _ = errors(arm, joints, poses)
    fast = np.abs(np.diff(joints, axis=0)) > arm.velocity_limit * dt * (1 + 1e-9)
    violations = np.sum(~inside(arm, joints)) + fast.sum()
    print(
        f"{name:6} {'dmpcpp JointTracker':22} {100 * np.mean(met(arm, joints, poses)):6.2f} % met, "
        f"{1e6 * min(spent):7.2f} us a pose, {position.max():.1e} m, violations {violations}"
    )
    return min(spent)


def _follow_with(solve: peers.Solver, poses: Array, start: Array) -> tuple[float, Array]:
    joints, q = np.empty((len(poses), len(start))), start
    begin = time.process_time()
    for k, pose in enumerate(poses):
        q = solve(pose, q)
        joints[k] = q
    return (time.process_time() - begin) / len(poses), joints


def feasible_paths(name: str, arm: Arm, reach: float, count: int, seed: int) -> None:
    """The share of feasible paths that are followed whole."""
    random = np.random.default_rng(2 + seed)
    solver = InverseKinematics(arm)
    complete, times = 0, []
    for _ in range(count):
        poses = feasible_path(arm, random, reach)
        begin = time.process_time()
        joints = solver.follow(poses, times=TIME)
        times.append(time.process_time() - begin)
        steps = np.abs(np.diff(joints.position, axis=0)).max()
        complete += bool(np.all(met(arm, joints.position, poses)) and steps <= 0.2)
    print(
        f"{name:6} feasible paths, reach {reach}: {complete} of {count} whole, "
        f"median {1e3 * np.median(times):.0f} ms, longest {1e3 * np.max(times):.0f} ms",
        flush=True,
    )


def _both_kinds(name: str, arm: Arm, count: int, seed: int) -> None:
    for reach in (0.35, 0.8):
        feasible_paths(name, arm, reach, count, seed)


def unreachable(name: str, arm: Arm, count: int, seed: int) -> None:
    """Whether the cause is named, the limits are held, and the joints are the closest that 500 restarts know."""
    for kind in ("beyond", "limits", "step", "singular"):
        if kind == "limits" and not causes.has_narrow_joint(arm):
            print(f"{name:6} limits    none: every joint of this arm turns all the way round")
            continue
        random = np.random.default_rng(7 + seed)
        right, broken, worst = 0, 0, 1.0
        for k, case in enumerate(islice(causes.cases(arm, kind, random), count)):
            result = causes.answer(arm, case)
            right += result.status.name == case.status
            broken += not causes.held(arm, case, result)
            if kind == "limits" or (kind == "beyond" and k % 5 == 0):
                known = causes.closest_of_restarts(arm, case.pose, 500, random)
                worst = max(worst, causes.distance(result) / known)
        far = f", at worst {worst:.4f} of the error of 500 restarts" if worst > 1.0 else ""
        print(f"{name:6} {kind:9} {right} of {count} causes right, {broken} limits broken{far}", flush=True)


def timing(name: str, arm: Arm, count: int, seed: int) -> None:
    """Time-optimal timing of splines through five random postures, 1000 samples, beside toppra's."""
    random = np.random.default_rng(3 + seed)
    limit = arm.acceleration_limit
    ratios, ours, theirs, uniform, worst = [], [], [], [], 0.0
    for _ in range(count):
        through = 0.5 * random_joints(arm, random, 5)
        joints = JointTrajectory.through(TIME, CubicSpline(np.linspace(0.0, 10.0, 5), through)(TIME))

        def optimal(joints: JointTrajectory = joints) -> JointTrajectory:
            return dmpcpp.time_optimal(joints, arm.velocity_limit, limit)

        fast = optimal()
        worst = max(worst, dmpcpp.duration_factor(fast, arm.velocity_limit, limit))
        ours.append(min(seconds_of(optimal) for _ in range(3)))
        uniform.append(10.0 * dmpcpp.duration_factor(joints, arm.velocity_limit, limit) / fast.time[-1])
        if find_spec("toppra"):
            begin = time.process_time()
            duration = peers.toppra_duration(np.linspace(0.0, 10.0, 5), through, arm.velocity_limit, limit)
            theirs.append(time.process_time() - begin)
            ratios.append(fast.time[-1] / duration)
    print(
        f"{name:6} time_optimal: {1e3 * np.median(ours):.2f} ms, limits held to {worst - 1.0:.1e}, "
        f"{np.median(uniform):.2f} times as short as uniform stretching"
    )
    if ratios:
        print(
            f"{name:6} toppra: {1e3 * np.median(theirs):.2f} ms, dmpcpp is {np.median(theirs) / np.median(ours):.0f} "
            f"times as fast; duration over toppra's: median {np.median(ratios):.3f}, largest {np.max(ratios):.3f}",
            flush=True,
        )


def main() -> None:
    """Run the chosen parts."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--parts", default="poses,track,paths,causes,timing,threads")
    parser.add_argument("--arms", default="panda,iiwa,xarm6,ur5")
    parser.add_argument("--poses", type=int, default=10_000)
    parser.add_argument("--paths", type=int, default=20)
    parser.add_argument("--causes", type=int, default=20, help="of each of the four kinds, on each arm")
    parser.add_argument("--seed", type=int, default=0, help="added to the seeds of poses, paths, causes and splines")
    chosen = parser.parse_args()
    seed = chosen.seed
    print(peers.installed())
    for name in chosen.arms.split(","):
        arm, urdf = load(name)
        runs: dict[str, Callable[[], None]] = {
            "poses": lambda: single_poses(name, arm, urdf, chosen.poses, seed),  # noqa: B023 (run within the turn)
            "track": lambda: tracking(name, arm, urdf),  # noqa: B023
            "paths": lambda: _both_kinds(name, arm, chosen.paths, seed),  # noqa: B023
            "causes": lambda: unreachable(name, arm, chosen.causes, seed),  # noqa: B023
            "timing": lambda: timing(name, arm, 20, seed),  # noqa: B023
            "threads": lambda: threads(name, arm, 2_000),  # noqa: B023
        }
        for part in chosen.parts.split(","):
            runs[part]()


if __name__ == "__main__":
    main()
