"""What stands around an arm: stated by hand, or read from a YAML file or a URDF.

>>> from dmpcpp.robot import obstacles_of
>>> [ball] = obstacles_of("sphere:0.4,0.1,0.3,0.08")
>>> ball.name, ball.shape.radius
('obstacle', 0.08)
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from dmpcpp._core import Box, Capsule, Plane, Sphere
from dmpcpp._typing import Array
from dmpcpp.errors import FileError, InvalidArgument

__all__ = ["Obstacle", "Shape", "obstacles_in", "obstacles_of"]

Shape = Sphere | Box | Capsule | Plane

_NUMBERS = {"sphere": (4,), "box": (6, 10), "capsule": (7,), "plane": (6,)}
_FORMS = {
    "sphere": "sphere:X,Y,Z,R",
    "box": "box:X,Y,Z,SX,SY,SZ[,QW,QX,QY,QZ]",
    "capsule": "capsule:X1,Y1,Z1,X2,Y2,Z2,R",
    "plane": "plane:X,Y,Z,NX,NY,NZ",
}
EXPECTED = f"expected {', '.join(_FORMS.values())} (m; full side lengths; the free side is where N points), "


@dataclass(frozen=True, eq=False)
class Obstacle:
    """A fixed thing that an arm must not touch.

    Attributes
    ----------
    name : str
        As contacts name it.
    shape : Sphere, Box, Capsule or Plane
        m, in the frame of the URDF's root.
    note : str
        What was taken for what it is in truth; "" where it is exact.
    """

    name: str
    shape: Shape
    note: str = ""

    def text(self) -> str:
        """Return what `--obstacle` takes."""
        kind, numbers = _numbers_of(self.shape)
        return f"{kind}:" + ",".join(f"{number:.10g}" for number in numbers)

    def to_dict(self) -> dict[str, Any]:
        """For JSON."""
        return {"name": self.name, "shape": self.text()}


def obstacles_of(texts: str | Iterable[str]) -> tuple[Obstacle, ...]:
    """Return what `--obstacle` states: shapes as text, .yaml files and .urdf files.

    Raises
    ------
    InvalidArgument
        Naming the text and what was expected.
    FileError
        A file that cannot be read.
    """
    given = (texts,) if isinstance(texts, str) else tuple(texts)
    return _named(obstacle for text in given for obstacle in _obstacles_of(text))


def obstacles_in(values: Iterable[dict[str, Any]]) -> tuple[Obstacle, ...]:
    """Return what `to_dict` wrote."""
    return tuple(Obstacle(str(value["name"]), _shape(str(value["shape"]))) for value in values)


def _obstacles_of(text: str) -> Iterator[Obstacle]:
    suffix = Path(text).suffix.lower()
    if suffix in (".yaml", ".yml"):
        yield from _from_yaml(Path(text))
    elif suffix in (".urdf", ".xml"):
        yield from _from_urdf(Path(text))
    else:
        yield Obstacle("", _shape(text))


def _named(obstacles: Iterable[Obstacle]) -> tuple[Obstacle, ...]:
    """Give every one a name of its own: obstacle, obstacle_2, .. where none is stated."""
    taken: set[str] = set()
    named = []
    for obstacle in obstacles:
        stem, k = obstacle.name or "obstacle", 1
        name = stem
        while name in taken:
            k += 1
            name = f"{stem}_{k}"
        taken.add(name)
        named.append(replace(obstacle, name=name))
    return tuple(named)


# ---- text ------------------------------------------------------------------------------------------------------------


def _shape(text: str) -> Shape:
    kind, _, rest = text.partition(":")
    try:
        values = [float(part) for part in rest.split(",")]
    except ValueError:
        values = []
    if kind not in _NUMBERS or len(values) not in _NUMBERS[kind] or not np.isfinite(values).all():
        expected = _FORMS.get(kind, "")
        raise InvalidArgument(
            f"obstacle: '{text}', "
            + (f"expected {expected} with finite numbers." if expected else f"{EXPECTED}or a .yaml or .urdf file.")
        )
    try:
        return _made(kind, values)
    except InvalidArgument as error:
        raise InvalidArgument(f"obstacle: '{text}': {error}") from None


def _made(kind: str, values: list[float]) -> Shape:
    if kind == "sphere":
        return Sphere(values[:3], _positive("R", values[3:])[0])
    if kind == "capsule":
        return Capsule(values[:3], values[3:6], _positive("R", values[6:])[0])
    if kind == "plane":
        return Plane(values[:3], values[3:])
    pose = np.eye(4)
    pose[:3, 3] = values[:3]
    if len(values) == 10:
        pose[:3, :3] = _rotation(values[6:])
    return Box(pose, 0.5 * np.array(_positive("SX,SY,SZ", values[3:6])))


def _positive(name: str, values: list[float]) -> list[float]:
    if min(values) <= 0.0:
        raise InvalidArgument(f"{name}: {','.join(f'{value:g}' for value in values)}, expected lengths above 0.")
    return values


def _rotation(quaternion: list[float]) -> Array:
    """Of w, x, y, z, of any length but 0."""
    q = np.array(quaternion)
    length = float(np.linalg.norm(q))
    if length < 1e-9:
        raise InvalidArgument("QW,QX,QY,QZ: all 0, expected a quaternion.")
    w, x, y, z = q / length
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _quaternion(r: Array) -> list[float]:
    from scipy.spatial.transform import Rotation

    x, y, z, w = Rotation.from_matrix(r).as_quat()
    return [float(w), float(x), float(y), float(z)]


def _numbers_of(shape: Shape) -> tuple[str, list[float]]:
    if isinstance(shape, Sphere):
        return "sphere", [*shape.center, shape.radius]
    if isinstance(shape, Capsule):
        return "capsule", [*shape.start, *shape.end, shape.radius]
    if isinstance(shape, Plane):
        return "plane", [*shape.point, *shape.normal]
    turned = [] if np.array_equal(shape.pose[:3, :3], np.eye(3)) else _quaternion(shape.pose[:3, :3])
    return "box", [*shape.pose[:3, 3], *(2.0 * shape.half_sizes), *turned]


# ---- files -----------------------------------------------------------------------------------------------------------


def _from_yaml(path: Path) -> Iterator[Obstacle]:
    """A list, or one under `obstacles`, of one shape each: {sphere: [X, Y, Z, R], name: ball}."""
    import yaml

    try:
        content = yaml.safe_load(_read(path))
    except yaml.YAMLError as error:
        raise FileError(f"{path}: no YAML: {' '.join(str(error).split())}") from None
    listed = content.get("obstacles") if isinstance(content, dict) else content
    if not isinstance(listed, list) or not listed:
        raise FileError(f"{path}: expected a list of obstacles, such as '- sphere: [0.4, 0.1, 0.3, 0.08]'.")
    for k, one in enumerate(listed):
        yield _from_entry(f"{path}: obstacles[{k}]", one)


def _from_entry(where: str, one: Any) -> Obstacle:
    kinds = [kind for kind in _NUMBERS if isinstance(one, dict) and kind in one]
    unknown = set(one) - {*_NUMBERS, "name"} if isinstance(one, dict) else set()
    if len(kinds) != 1 or unknown or not isinstance(one[kinds[0]], list):
        raise FileError(f"{where}: {one!r}, expected one of {', '.join(_NUMBERS)} with its numbers, and a name.")
    try:
        shape = _shape(f"{kinds[0]}:" + ",".join(map(str, one[kinds[0]])))
    except InvalidArgument as error:
        raise FileError(f"{where}: {error}") from None
    return Obstacle(str(one.get("name", "")), shape)


def _from_urdf(path: Path) -> Iterator[Obstacle]:
    """The collision shapes of every link, joints at 0; cylinders and meshes as boxes around them."""
    from dmpcpp.robot._obstacle_urdf import shapes_of_urdf

    try:
        found = list(shapes_of_urdf(_read(path), path.parent))
    except ET.ParseError as error:
        raise FileError(f"{path}: no URDF: {error}") from None
    if not found:
        raise FileError(f"{path}: no link has a collision shape, expected a scene's URDF with some.")
    for name, shape, note in found:
        yield Obstacle(name, shape, note)


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is no text"
        raise FileError(f"{path}: cannot be read: {reason}.") from None
