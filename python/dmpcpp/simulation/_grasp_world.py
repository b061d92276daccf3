"""PyBullet with a gripper and an object to be gripped. Nothing holds the object but friction."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from dmpcpp._core import Arm
from dmpcpp._typing import Array
from dmpcpp.errors import InvalidArgument
from dmpcpp.robot import Obstacle
from dmpcpp.simulation._bullet import Bullet
from dmpcpp.simulation._objects import Cylinder, Friction, ParallelGripper

_STAND = 0.15  # m, side of the column under the object
_GEAR_FORCE = 50.0  # N that keeps one finger as far out as the other
_GEAR_STIFFNESS = 0.1  # share of the fingers' difference that the gear takes back in a step


class GraspWorld(Bullet):
    """An arm with a parallel gripper, and a cylinder that stands upright on a stand or on the floor.

    Parameters
    ----------
    arm : Arm
    time_step : float
        [s]
    gripper : ParallelGripper
        At ``arm.tip``; open at first.
    cylinder : Cylinder
    place : array_like (3,)
        Centre of the cylinder's lower face [m] in the root's frame. If that is above the floor, a square column
        of 0.15 m stands under it.
    visuals : bool
        Load what is only drawn as well.
    obstacles : sequence of Obstacle
        What stands around the bottle.

    Raises
    ------
    InvalidArgument
        The arm has no such fingers.
    """

    object_name, stand_name = "bottle", "stand"

    def __init__(
        self,
        arm: Arm,
        time_step: float,
        gripper: ParallelGripper,
        cylinder: Cylinder,
        place: Array,
        *,
        visuals: bool = False,
        obstacles: Sequence[Obstacle] = (),
    ) -> None:
        """Load arm, floor and cylinder."""
        super().__init__(arm, time_step, visuals=visuals, obstacles=obstacles)
        self._posts = {body: name for body, name in self._others.items() if name in self.obstacles}
        self._gripper = gripper
        try:
            self._fingers = self._find_fingers()
            self._couple_fingers()
            self._others |= self._add_stand(place)
            self._object = self._add_cylinder(cylinder, place)
            self._others[self._object] = self.object_name
        except BaseException:
            self.close()
            raise
        self.grip(gripper.opening)
        for body, colour in self._colours():
            self._p.changeVisualShape(body, -1, rgbaColor=colour, physicsClientId=self._client)

    def put_fingers(self, opening: float) -> None:
        """Put both fingers at ``opening`` [m] without dynamics."""
        for finger in self._fingers:
            self._p.resetJointState(self._body, finger, opening, 0.0, physicsClientId=self._client)
        self._read()

    def put(self, position: Array, opening: float, object_pose: Array) -> None:
        """Put arm (n,) [rad], fingers [m] and object (4, 4) where they were, for a picture; no dynamics."""
        self.reset(position, np.zeros_like(position))
        self.put_fingers(opening)
        quaternion = Rotation.from_matrix(object_pose[:3, :3]).as_quat()
        self._p.resetBasePositionAndOrientation(
            self._object, object_pose[:3, 3].tolist(), quaternion.tolist(), physicsClientId=self._client
        )

    def image(self, width: int, height: int) -> NDArray[np.uint8]:
        """What a camera in front of the arm sees (height, width, 3), by Bullet's software renderer."""
        p = self._p
        view = p.computeViewMatrix([1.35, -0.95, 0.85], [0.28, 0.0, 0.32], [0.0, 0.0, 1.0])
        projection = p.computeProjectionMatrixFOV(34.0, width / height, 0.05, 5.0)
        options = {"renderer": p.ER_TINY_RENDERER, "flags": p.ER_NO_SEGMENTATION_MASK, "shadow": 0}
        light = {"lightDirection": [1.0, -1.0, 2.0]}
        _, _, pixels, *_ = p.getCameraImage(
            width, height, view, projection, **options, **light, physicsClientId=self._client
        )
        return np.asarray(pixels, dtype=np.uint8).reshape(height, width, 4)[..., :3]

    def grip(self, opening: float) -> None:
        """Let the fingers go to ``opening`` [m] with the gripper's force; 0 closes them on what is between."""
        p = self._p
        options = {"targetPositions": [opening] * 2, "forces": [self._gripper.force] * 2}
        p.setJointMotorControlArray(
            self._body, self._fingers, p.POSITION_CONTROL, **options, physicsClientId=self._client
        )

    def opening(self) -> float:
        """How far a finger stands from the middle [m], the mean of both."""
        states = self._p.getJointStates(self._body, self._fingers, physicsClientId=self._client)
        return 0.5 * float(states[0][0] + states[1][0])

    def object_pose(self) -> Array:
        """Pose (4, 4) of the object in the root's frame, its axis z."""
        position, quaternion = self._p.getBasePositionAndOrientation(self._object, physicsClientId=self._client)
        r = self._p.getMatrixFromQuaternion(quaternion)
        x, y, z = position
        return np.array([(*r[:3], x), (*r[3:6], y), (*r[6:], z), (0.0, 0.0, 0.0, 1.0)])

    def clearance(self, within: float) -> tuple[float, str]:
        """Distance [m] from the object to the closest link and its name; ``within`` if none is that close."""
        points = self._p.getClosestPoints(self._body, self._object, within, physicsClientId=self._client)
        nearest = min(points, key=lambda point: point[8], default=None)
        return (float(nearest[8]), self._link_names[nearest[3]]) if nearest else (within, "")

    def obstacle_clearance(self, within: float) -> tuple[float, str, str]:
        """Distance [m] to the closest obstacle, the link and the obstacle; ``within`` if none is that close."""
        found = []
        for body, name in self._posts.items():
            points = self._p.getClosestPoints(self._body, body, within, physicsClientId=self._client)
            links = ((float(one[8]), self._link_names[one[3]]) for one in points if one[3] not in self._standing)
            found += [(distance, link, name) for distance, link in links]
        return min(found, default=(within, "", ""))

    # ---- setting up --------------------------------------------------------------------------------------

    def _find_fingers(self) -> list[int]:
        of_name = {info[1].decode(): info[0] for info in self._held}
        for name in self._gripper.joints:
            if name not in of_name:
                raise InvalidArgument(
                    f"gripper.joints: '{name}' is no joint of '{self.arm.name}' beyond its tip; "
                    f"there are {', '.join(of_name) or 'none'}."
                )
        return [of_name[name] for name in self._gripper.joints]

    def _couple_fingers(self) -> None:
        """Gear the fingers together as the real gripper's are: one motor moves both."""
        p, client, body = self._p, self._client, self._body
        axes = {"jointAxis": [1, 0, 0], "parentFramePosition": [0, 0, 0], "childFramePosition": [0, 0, 0]}
        gear = p.createConstraint(
            body, self._fingers[0], body, self._fingers[1], p.JOINT_GEAR, **axes, physicsClientId=client
        )
        p.changeConstraint(gear, gearRatio=-1, erp=_GEAR_STIFFNESS, maxForce=_GEAR_FORCE, physicsClientId=client)
        for link in self._gripper.links:
            self._give_friction(body, self._links[link], self._gripper.friction)
        self.put_fingers(self._gripper.opening)

    def _add_stand(self, place: Array) -> dict[int, str]:
        """Return its number with its name; nothing for a cylinder that stands on the floor."""
        x, y, height = (float(value) for value in place)
        if height <= 0.0:
            return {}
        p, client = self._p, self._client
        shape = p.createCollisionShape(
            p.GEOM_BOX, halfExtents=[0.5 * _STAND, 0.5 * _STAND, 0.5 * height], physicsClientId=client
        )
        body = p.createMultiBody(0.0, shape, basePosition=[x, y, 0.5 * height], physicsClientId=client)
        return {int(body): self.stand_name}

    def _add_cylinder(self, cylinder: Cylinder, place: Array) -> int:
        p, client = self._p, self._client
        shape = p.createCollisionShape(
            p.GEOM_CYLINDER, radius=cylinder.radius, height=cylinder.height, physicsClientId=client
        )
        centre = [float(place[0]), float(place[1]), float(place[2]) + 0.5 * cylinder.height]
        body = int(p.createMultiBody(cylinder.mass, shape, basePosition=centre, physicsClientId=client))
        across = cylinder.mass * (3.0 * cylinder.radius**2 + cylinder.height**2) / 12.0
        inertia = [across, across, 0.5 * cylinder.mass * cylinder.radius**2]
        damping = {"linearDamping": 0.0, "angularDamping": 0.0}
        p.changeDynamics(body, -1, localInertiaDiagonal=inertia, **damping, physicsClientId=client)
        self._give_friction(body, -1, cylinder.friction)
        return body

    def _colours(self) -> list[tuple[int, list[float]]]:
        blue, grey = [0.16, 0.42, 0.72, 1.0], [0.6, 0.6, 0.58, 1.0]
        return [(body, blue if body == self._object else grey) for body in self._others if body != self._floor]

    def _give_friction(self, body: int, link: int, friction: Friction) -> None:
        kinds: dict[str, Any] = {
            "lateralFriction": friction.lateral,
            "spinningFriction": friction.spinning,
            "rollingFriction": friction.rolling,
        }
        self._p.changeDynamics(body, link, **kinds, physicsClientId=self._client)
