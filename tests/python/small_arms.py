"""A base and six links of 1 kg, drawn for these tests: nobody's robot, every part of which can be replaced."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from dmpcpp import Arm

INERTIA = '<inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>'
BOX = '<collision><origin xyz="0 0 0.04"/><geometry><box size="0.05 0.05 0.05"/></geometry></collision>'
LIMIT = '<limit lower="-2.8" upper="2.8" velocity="2" effort="80"/>'
_AXES = ("0 0 1", "0 1 0", "0 1 0", "0 0 1", "0 1 0", "0 0 1")
_OFFSETS = (0.1, 0.15, 0.3, 0.15, 0.2, 0.12)


def link(name: str, inertial: str | None = None, shape: str = BOX) -> str:
    """Return a link of 1 kg with a small box."""
    if inertial is None:
        inertial = f'<inertial><origin xyz="0 0 0.04"/><mass value="1"/>{INERTIA}</inertial>'
    return f'<link name="{name}">{inertial}{shape}</link>\n'


def joint(name: str, parent: str, child: str, axis: str, offset: float, inside: str = LIMIT, kind: str = "") -> str:
    """Return a joint that turns, `offset` above its parent's frame."""
    return (
        f'<joint name="{name}" type="{kind or "revolute"}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="0 0 {offset}"/><axis xyz="{axis}"/>{inside}</joint>\n'
    )


def six_axis(
    *,
    limit: str = LIMIT,
    limits: Mapping[str, str] | None = None,
    inertial: str | None = None,
    inertials: Mapping[str, str] | None = None,
    shape: str = BOX,
    shapes: Mapping[str, str] | None = None,
    extra: str = "",
    robot: str = '<robot name="six">',
) -> str:
    """Return the URDF; `limits`, `inertials` and `shapes` replace those of single joints and links."""
    limits, inertials, shapes = limits or {}, inertials or {}, shapes or {}
    names = ["base", *(f"l{k}" for k in range(1, 7))]
    links = "".join(link(name, inertials.get(name, inertial), shapes.get(name, shape)) for name in names)
    joints = "".join(
        joint(f"j{k}", names[k - 1], names[k], axis, offset, limits.get(f"j{k}", limit))
        for k, (axis, offset) in enumerate(zip(_AXES, _OFFSETS, strict=True), 1)
    )
    return f"{robot}\n{links}{joints}{extra}</robot>\n"


def arm(**changes: object) -> Arm:
    """Return the arm from base to l6."""
    return Arm.from_urdf(six_axis(**changes), base="base", tip="l6")  # type: ignore[arg-type]


def write(folder: Path, name: str = "six.urdf", **changes: object) -> Path:
    """Write the URDF."""
    path = folder / name
    path.write_text(six_axis(**changes))  # type: ignore[arg-type]
    return path
