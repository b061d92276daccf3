"""A robot in a viser scene, moved to given joints."""

from __future__ import annotations

import io
import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.spatial.transform import Rotation

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument, MissingDependency
from dmpcpp.robot import find_mesh

if TYPE_CHECKING:
    from viser import ViserServer
    from yourdfpy import URDF

__all__ = ["RobotShape", "ShownArm", "triangles"]

_GREY = (214, 218, 224)


class RobotShape:
    """The robot that an arm is a part of, as yourdfpy reads it."""

    def __init__(self, arm: Arm) -> None:
        """Read the robot, with the shapes that it collides with, or is drawn with where it has no others.

        Raises
        ------
        InvalidArgument
            A mesh of the URDF cannot be found or read.
        MissingDependency
            yourdfpy is not installed.
        """
        self.arm = arm
        self.model, self.collision = _read(arm)
        self._others = _middle_of_other_joints(self.model, arm)

    def all_joints(self, joints: ArrayLike) -> dict[str, float]:
        """Return every joint of the robot by name; those that the arm has not are in the middle of their range."""
        values = np.asarray(joints, dtype=np.float64)
        if values.shape != (self.arm.joint_count,):
            raise InvalidArgument(f"joints: shape {values.shape}, expected ({self.arm.joint_count},).")
        return self._others | dict(zip(self.arm.joint_names, values.tolist(), strict=True))

    def base_to_root(self) -> Array:
        """Return the pose (4, 4) of the robot's root in the frame of the arm's base."""
        base = self.model.get_transform(self.arm.base, self.model.base_link, collision_geometry=self.collision)
        return np.asarray(np.linalg.inv(base))

    def triangles(self, joints: ArrayLike) -> Array:
        """Return the corners (F, 3, 3) of its triangles [m] in the frame of the arm's base."""
        self.model.update_cfg(self.all_joints(joints))
        scene = self.model.collision_scene if self.collision else self.model.scene
        corners = np.asarray(scene.to_geometry().triangles)
        root = self.base_to_root()
        return np.asarray(corners @ root[:3, :3].T + root[:3, 3])


class ShownArm:
    """An arm, the robot it is a part of included, with the frame of its base as the scene's world."""

    def __init__(
        self, server: ViserServer, arm: Arm, *, name: str = "/robot", colour: tuple[int, int, int] = _GREY
    ) -> None:
        """Put the robot into the scene, at zero joints.

        Parameters
        ----------
        server : viser.ViserServer
        arm : Arm
        name : str
            Of the robot's node in the scene.
        colour : (int, int, int)
            0 to 255.

        Raises
        ------
        InvalidArgument
            A mesh of the URDF cannot be found or read.
        MissingDependency
            viser or yourdfpy is not installed.
        """
        try:
            from viser.extras import ViserUrdf
        except ImportError:
            raise MissingDependency(
                'viser or yourdfpy is not installed. Install the extra: pip install "dmpcpp[view]".'
            ) from None
        self._root = server.scene.add_frame(name, show_axes=False)
        self._shape = RobotShape(arm)
        self._urdf = ViserUrdf(
            server,
            self._shape.model,
            root_node_name=name,
            collision_mesh_color_override=colour,
            load_meshes=not self._shape.collision,
            load_collision_meshes=self._shape.collision,
        )
        self.move(np.zeros(arm.joint_count))

    def move(self, joints: ArrayLike) -> None:
        """Show the arm at joints (n,) in rad, or m; other joints stay in the middle of their range."""
        self._urdf.update_cfg(self._shape.all_joints(joints))  # type: ignore[arg-type]
        root = self._shape.base_to_root()
        self._root.position = root[:3, 3]
        self._root.wxyz = Rotation.from_matrix(root[:3, :3]).as_quat()[[3, 0, 1, 2]]


def _read(arm: Arm) -> tuple[URDF, bool]:
    """Return the robot, and whether its shapes are those that it collides with."""
    try:
        from yourdfpy import URDF
    except ImportError:
        raise MissingDependency('yourdfpy is not installed. Install the extra: pip install "dmpcpp[view]".') from None

    def load(collision: bool) -> Any:
        drawn = {"build_scene_graph": not collision, "load_meshes": not collision}
        solid = {"build_collision_scene_graph": collision, "load_collision_meshes": collision}
        # yourdfpy uses calls of trimesh that are going out of use, and logs where a prefix is not declared.
        with warnings.catch_warnings(), _unlogged("yourdfpy.urdf"):
            warnings.simplefilter("ignore", DeprecationWarning)
            return URDF.load(
                io.BytesIO(arm.urdf.encode()), filename_handler=partial(_mesh_path, arm.folder), **drawn, **solid
            )

    model = load(collision=True)
    if model.collision_scene is not None and model.collision_scene.geometry:
        return model, True
    return load(collision=False), False


@contextmanager
def _unlogged(name: str) -> Iterator[None]:
    logger = logging.getLogger(name)
    before, logger.disabled = logger.disabled, True
    try:
        yield
    finally:
        logger.disabled = before


def _mesh_path(folder: str, fname: str) -> str:
    """Where a mesh is; one that is nowhere is not drawn."""
    try:
        return str(find_mesh(fname, folder))
    except InvalidArgument:
        return fname


def _middle_of_other_joints(model: URDF, arm: Arm) -> dict[str, float]:
    """Joints that the arm has not, such as fingers; those without limits stay at 0."""
    middle = {}
    for joint in model.actuated_joints:
        limit = joint.limit
        known = limit is not None and limit.lower is not None and limit.upper is not None
        middle[joint.name] = 0.5 * (limit.lower + limit.upper) if known else 0.0
    return {name: value for name, value in middle.items() if name not in arm.joint_names}


def triangles(arm: Arm, joints: ArrayLike) -> Array:
    """Return what the arm collides with at joints (K, n) [rad]: (K, F, 3, 3) corners of F triangles [m], in its base.

    Other joints of the robot, such as fingers, are in the middle of their range.

    Raises
    ------
    InvalidArgument
        joints of another shape, or a mesh of the URDF cannot be found or read.
    MissingDependency
        yourdfpy is not installed.
    """
    shape = RobotShape(arm)
    return np.stack([shape.triangles(values) for values in np.atleast_2d(np.asarray(joints, dtype=np.float64))])
