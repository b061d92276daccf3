"""A six-joint arm of 0.9 m reach as a URDF: cylinders with the masses and inertias of solid ones."""

from __future__ import annotations

__all__ = ["my_robot"]

_RADIUS = 0.05  # m
_DENSITY = 1200.0  # kg/m3
# length of the link [m], axis, lower and upper [rad], velocity [rad/s], effort [Nm]
_JOINTS = (
    (0.25, "0 0 1", -2.9, 2.9, 2.2, 150),
    (0.35, "0 1 0", -2.0, 2.0, 2.2, 150),
    (0.30, "0 1 0", -2.6, 2.6, 2.6, 90),
    (0.12, "0 0 1", -3.0, 3.0, 3.2, 40),
    (0.10, "0 1 0", -2.0, 2.0, 3.2, 40),
    (0.08, "0 0 1", -3.1, 3.1, 3.2, 20),
)


def my_robot() -> str:
    """Return the URDF: link0 .. link6, joint1 .. joint6, and a fixed frame `tool0` at the flange."""
    lines = ['<?xml version="1.0"?>', '<robot name="my_robot">', *_link("link0", 0.15)]
    below = 0.15
    for k, (length, axis, lower, upper, velocity, effort) in enumerate(_JOINTS, start=1):
        lines += _link(f"link{k}", length)
        lines += [
            f'  <joint name="joint{k}" type="revolute">',
            f'    <parent link="link{k - 1}"/><child link="link{k}"/><origin xyz="0 0 {below}"/><axis xyz="{axis}"/>',
            f'    <limit lower="{lower}" upper="{upper}" velocity="{velocity}" effort="{effort}"/>',
            "  </joint>",
        ]
        below = length
    lines += [
        '  <link name="tool0"/>',
        '  <joint name="flange" type="fixed">',
        f'    <parent link="link6"/><child link="tool0"/><origin xyz="0 0 {below}"/>',
        "  </joint>",
        "</robot>",
    ]
    return "\n".join(lines) + "\n"


def _link(name: str, length: float) -> list[str]:
    """Return a solid cylinder from the link's frame upwards; across its axis m (3 r^2 + l^2) / 12."""
    mass = _DENSITY * 3.14159265 * _RADIUS**2 * length
    across, along = mass * (3 * _RADIUS**2 + length**2) / 12, mass * _RADIUS**2 / 2
    shape = f'<origin xyz="0 0 {length / 2}"/><geometry><cylinder radius="{_RADIUS}" length="{length}"/></geometry>'
    return [
        f'  <link name="{name}">',
        f'    <inertial><origin xyz="0 0 {length / 2}"/><mass value="{mass:.4f}"/>',
        f'      <inertia ixx="{across:.6f}" iyy="{across:.6f}" izz="{along:.6f}" ixy="0" ixz="0" iyz="0"/></inertial>',
        f"    <visual>{shape}</visual>",
        f"    <collision>{shape}</collision>",
        "  </link>",
    ]
