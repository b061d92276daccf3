"""Small arms as URDF text: links of 1 kg with a box each, joints that turn about z, y, y, x, y, x."""

from __future__ import annotations

from collections.abc import Iterable

AXES = ("0 0 1", "0 1 0", "0 1 0", "1 0 0", "0 1 0", "1 0 0", "0 0 1", "0 1 0")
OFFSETS = ("0 0 0.1", "0 0 0.12", "0 0 0.33", "0.28 0 0", "0.11 0 0", "0.09 0 0", "0.05 0 0", "0.05 0 0")
INERTIAL = '<inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>'
BOX = '<collision><origin xyz="0 0 0.05"/><geometry><box size="0.05 0.05 0.08"/></geometry></collision>'
LIMIT = '<limit lower="-2.5" upper="2.5" effort="80" velocity="2"/>'


def link(name: str, more: str = INERTIAL) -> str:
    """One link."""
    return f'<link name="{name}">{more}</link>\n'


def joint(
    name: str, kind: str, parent: str, child: str, *, xyz: str = "0 0 0", axis: str = "0 0 1", more: str = ""
) -> str:
    """One joint."""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}"/><axis xyz="{axis}"/>{more}</joint>\n'
    )


def slide(name: str, parent: str, child: str, stroke: float = 0.04, more: str = "") -> str:
    """A joint that slides from 0 to `stroke`."""
    limit = f'<limit lower="0" upper="{stroke}" effort="10" velocity="0.2"/>{more}'
    return joint(name, "prismatic", parent, child, axis="0 1 0", more=limit)


def jaw(name: str, parent: str, child: str, upper: float = 1.7, lower: float = 0.0) -> str:
    """A joint that turns from closed to open."""
    limit = f'<limit lower="{lower}" upper="{upper}" effort="5" velocity="3"/>'
    return joint(name, "revolute", parent, child, xyz="0.05 0 0", more=limit)


def chain(
    count: int, root: str = "base", *, prefix: str = "", names: Iterable[str] = (), body: str = INERTIAL + BOX
) -> str:
    """Links l1 .. l<count> on joints j1 .., without the root link."""
    called = [*names] or [f"{prefix}j{k}" for k in range(1, count + 1)]
    text, parent = "", root
    for k in range(count):
        child = f"{prefix}l{k + 1}"
        text += link(child, body) + joint(
            called[k], "revolute", parent, child, xyz=OFFSETS[k], axis=AXES[k], more=LIMIT
        )
        parent = child
    return text


def robot(*parts: str, root: str = "base", body: str = INERTIAL + BOX) -> str:
    """A robot with a root link and these parts."""
    return f'<robot name="own">\n{link(root, body)}{"".join(parts)}</robot>\n'
