"""Which physics engine is taken where none is named."""

import importlib.util


def default_engine() -> str:
    """Return "bullet", or "mujoco" where that alone is installed."""
    bullet, mujoco = (importlib.util.find_spec(name) is not None for name in ("pybullet", "mujoco"))
    return "mujoco" if mujoco and not bullet else "bullet"
