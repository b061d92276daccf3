"""Write the golden model files of a new format version: python tests/data/models/make.py v2. Never over old ones.

Every kind of model and every option stands in one of them; motions.json has the motion that each must go on meaning.
"""

import json
import sys
from pathlib import Path

import dmpcpp
import numpy as np

TIME = np.linspace(0.0, 1.5, 60)
ANGLES = np.c_[0.8 * np.sin(2 * TIME), 0.5 * np.cos(2 * TIME), 1.2 * TIME]
POSITION = np.c_[0.1 * np.sin(4 * TIME), 0.2 * TIME**2, 0.3 - 0.1 * TIME]
OPTIONS: dict[str, dict[str, object]] = {
    "default": {},
    "ridge": {"regression": "ridge", "ridge": 1e-9, "overlap": 0.3},
    "source": {"kernels": "source", "passes": 1, "derivatives": "gradient", "integrator": "semi_implicit_euler"},
    "per_axis": {"scaling": "per_axis", "start": "rest"},
    "per_axis_relative": {"scaling": "per_axis_relative", "derivatives": "smooth"},
    "rotation_dilation": {"scaling": "rotation_dilation", "force_after_end": True, "phase_stop": 10.0},
    "log_linear": {"orientation_form": "log_linear", "goal_filter": 10.0, "tempo_filter": 0.0},
    "ude_principal": {"orientation_form": "ude", "log_branch": "principal"},
    "turning": {"orientation_form": "turning"},
    "advance": {"scaling": "advance"},
    "gains": {"alpha": 30.0, "beta": 6.0, "orientation_alpha": 20.0, "orientation_beta": 5.0, "alpha_x": 3.0},
}


def demonstrations() -> dict[str, object]:
    """One motion, seen as each kind of model sees it."""
    turning = dmpcpp.OrientationDemonstration.from_euler(TIME, ANGLES, "ZYX")
    poses = np.tile(np.eye(4), (len(TIME), 1, 1))
    poses[:, :3, :3] = turning.rotation
    poses[:, :3, 3] = POSITION
    return {
        "dmp": dmpcpp.Demonstration(TIME, POSITION),
        "orientation_dmp": turning,
        "pose_dmp": dmpcpp.PoseDemonstration(TIME, poses),
    }


def rounds() -> dict[str, object]:
    """One cycle, seen as each kind of model sees it; it turns once about the vertical."""
    share = np.linspace(0.0, 1.0, 41)
    turn = 2 * np.pi * share
    poses = np.tile(np.eye(4), (len(share), 1, 1))
    poses[:, :3, :3] = [dmpcpp.so3.exp([0.3 * np.cos(u), 0.2 * np.sin(u), 0]) @ dmpcpp.so3.exp([0, 0, u]) for u in turn]
    poses[:, :3, 3] = np.c_[0.1 * np.cos(turn), 0.2 * np.sin(turn), 0.3 + 0.05 * np.sin(2 * turn)]
    poses[-1] = poses[0]
    return {
        "dmp": dmpcpp.Demonstration(1.2 * share, poses[:, :3, 3]),
        "orientation_dmp": dmpcpp.OrientationDemonstration(1.2 * share, poses[:, :3, :3]),
        "pose_dmp": dmpcpp.PoseDemonstration(1.2 * share, poses),
    }


def sequence() -> object:
    """A reach, five and a half rounds, and back, past a via-pose."""
    model = dmpcpp.PoseDmp.fit(demonstrations()["pose_dmp"], basis_count=7)
    stir = dmpcpp.PoseDmp.fit(rounds()["pose_dmp"], basis_count=7, motion="rhythmic")
    via = dmpcpp.Via(0.6, model.start, np.linspace(-0.1, 0.1, 6), (0.2, 0.1))
    return dmpcpp.PoseDmpSequence([model, stir, model], leave=[0.9, 5.5, 1.0], reach=0.4, via=[[], [], [via]])


def distribution() -> object:
    """Three takes that reach further and turn further."""
    poses = np.array([demonstrations()["pose_dmp"].pose for _ in range(3)])
    for k, take in enumerate(poses):
        take[:, :3, 3] *= 1 + 0.1 * k
        take[:, :3, :3] = [dmpcpp.so3.exp([0.1 * k * t, 0, 0]) @ r for t, r in zip(TIME, take[:, :3, :3], strict=True)]
    return dmpcpp.PoseDistribution.fit([dmpcpp.PoseDemonstration(TIME, take) for take in poses], control_points=5)


def motion(model) -> list:
    """Where the model is at five moments, at another tempo."""
    plan = model.rollout_at(np.linspace(0.0, 2.0, 5), duration=2.0)
    return getattr(
        plan, {"Dmp": "position", "OrientationDmp": "rotation", "PoseDmp": "pose"}[type(model).__name__]
    ).tolist()


def main(folder: Path) -> None:
    """Write them."""
    folder.mkdir()
    fits = {"dmp": dmpcpp.Dmp.fit, "orientation_dmp": dmpcpp.OrientationDmp.fit, "pose_dmp": dmpcpp.PoseDmp.fit}
    motions = {}
    for kind, demonstration in demonstrations().items():
        for name, options in OPTIONS.items():
            model = fits[kind](demonstration, basis_count=7, **options)
            dmpcpp.save(model, folder / f"{kind}-{name}.json")
            motions[f"{kind}-{name}"] = motion(model)
    for kind, demonstration in rounds().items():
        model = fits[kind](demonstration, basis_count=7, motion="rhythmic")
        dmpcpp.save(model, folder / f"{kind}-rhythmic.json")
        motions[f"{kind}-rhythmic"] = motion(model)
    dmpcpp.save(sequence(), folder / "pose_dmp_sequence.json")
    motions["pose_dmp_sequence"] = sequence().rollout_at(np.linspace(0.0, 8.0, 9)).pose.tolist()
    dmpcpp.save(distribution(), folder / "pose_distribution.json")
    motions["pose_distribution"] = distribution().sample(seed=1, samples=9).pose.tolist()
    (folder / "motions.json").write_text(json.dumps(motions, indent=0) + "\n")


if __name__ == "__main__":
    main(Path(__file__).parent / sys.argv[1])
