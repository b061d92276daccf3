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
    (folder / "motions.json").write_text(json.dumps(motions, indent=0) + "\n")


if __name__ == "__main__":
    main(Path(__file__).parent / sys.argv[1])
