"""A world in PyBullet with an arm in it: loaded, indexed by name, its traps closed.

Its defaults are not rigid-body dynamics: inertias are taken from the collision shapes unless
URDF_USE_INERTIA_FROM_FILE is set, every link is damped by 0.04, and every joint starts with a motor on.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import sys
import tempfile
from collections.abc import Sequence
from itertools import combinations
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, Self

import numpy as np

from dmpcpp._core import Arm
from dmpcpp._quiet import quiet
from dmpcpp._typing import Array
from dmpcpp.errors import MissingDependency
from dmpcpp.robot import (
    Disturbance,
    Levers,
    Obstacle,
    RobotDescription,
    Surroundings,
    contact_rules,
    describe,
    floor_height,
    links_of,
    parsed,
)
from dmpcpp.simulation._objects import Box, refuse_names
from dmpcpp.simulation._simulator import FLOOR, GRAVITY, checked_time_step, refused
from dmpcpp.simulation._solids import Solid, quaternion_of, solid_of

_UNLIMITED_TORQUE = 1e6  # Nm, for a joint whose URDF states no effort: Bullet wants a finite number


class BulletWorld:
    """What ``Bullet`` stands on; see there for the parameters."""

    def __init__(
        self,
        arm: Arm,
        time_step: float,
        *,
        floor: float | Literal["auto"] | None = "auto",
        ignored: Sequence[tuple[str, str]] = (),
        visuals: bool = False,
        disturbance: Disturbance | None = None,
        obstacles: Sequence[Box | Obstacle] = (),
    ) -> None:
        """Load the arm into a world of its own."""
        self.arm, self.time_step = arm, checked_time_step(time_step)
        refuse_names(obstacles, links_of(arm))
        self.obstacles = tuple(thing.name for thing in obstacles)
        self._around = Surroundings(floor, tuple(ignored))
        self.contact_rules = contact_rules(arm, self._around)
        self._p = _pybullet()
        with quiet():
            self._client: int = self._p.connect(self._p.DIRECT)
        self.name = f"PyBullet {importlib.metadata.version('pybullet')}"
        try:
            self._set_up(visuals, disturbance or Disturbance())
            self._others |= {self._add_obstacle(thing): thing.name for thing in obstacles}
        except BaseException:
            self.close()
            raise

    def _set_up(self, visuals: bool, disturbance: Disturbance) -> None:
        options = {"numSolverIterations": 100, "deterministicOverlappingPairs": 1}
        self._p.setPhysicsEngineParameter(self.time_step, **options, physicsClientId=self._client)
        self._p.setGravity(0.0, 0.0, GRAVITY, physicsClientId=self._client)
        with tempfile.TemporaryDirectory(prefix="dmpcpp-") as folder:
            description = describe(self.arm, Path(folder), visuals=visuals, disturbance=disturbance)
            self._body = self._load(description, Path(folder, "arm.urdf"))
            self.levers = Levers(parsed(description.text), self.arm.joint_names, description.aliases)
            still = frozenset(map(description.in_engine, self.contact_rules.still))
            self.floor = floor_height(description.text, self.arm, self._around, still)
        self.inertia_repairs = description.repairs
        self.unjudged_links = description.unjudged
        self._find_joints(description)
        self._switch_off_damping_and_motors()
        self._add_friction(disturbance)
        self._ignore_overlaps()
        self._others: dict[int, str] = {}
        self._off_floor: set[int] = set()
        if self.floor is not None:
            self._add_floor(self.floor)
        self._read()
        self._dynamics = self._own_dynamics(description)

    def _own_dynamics(self, description: RobotDescription) -> Arm | None:
        """Return what stands in for Bullet's inverse dynamics where that fails, and say so in the name.

        Bullet refuses inertias of which rounding makes two halves differ by 1e-15: large ones with products.
        """
        still = [0.0] * len(self._moving)
        try:
            with quiet():
                self._p.calculateInverseDynamics(self._body, still, still, still, physicsClientId=self._client)
        except SystemError:
            self.name = f"{self.name} (inverse dynamics by KDL)"
            base, tip = (description.in_engine(name) for name in (self.arm.base, self.arm.tip))
            return Arm.from_urdf(description.text, base, tip)
        return None

    def close(self) -> None:
        """Free the world; a second call does nothing."""
        if self._client >= 0:
            with quiet():
                self._p.disconnect(physicsClientId=self._client)
            self._client = -1

    def __enter__(self) -> Self:
        """The world, open until the end of the block."""
        return self

    def __exit__(self, *failure: object) -> None:
        """Close it."""
        self.close()

    # ---- setting up --------------------------------------------------------------------------------------

    def _load(self, description: RobotDescription, path: Path) -> int:
        p = self._p
        path.write_text(description.text, encoding="utf-8")
        options = {"useFixedBase": True, "flags": p.URDF_USE_INERTIA_FROM_FILE | p.URDF_USE_SELF_COLLISION}
        with quiet() as heard:
            try:
                return int(p.loadURDF(str(path), **options, physicsClientId=self._client))
            except p.error as error:
                reason = " ".join(heard().split()) or str(error)
        raise refused("PyBullet", self.arm, "mujoco", reason)

    def _find_joints(self, description: RobotDescription) -> None:
        """Index joints and links by name: Bullet has its own order, with fingers and fixed joints in it."""
        p, client, body = self._p, self._client, self._body
        infos = [p.getJointInfo(body, i, physicsClientId=client) for i in range(self._joint_count())]
        self._link_names = {info[0]: description.link(info[12].decode()) for info in infos}
        self._link_names[-1] = description.link(p.getBodyInfo(body, physicsClientId=client)[0].decode())
        self._links = {name: index for index, name in self._link_names.items()}
        self._base, self._tip = self._links[self.arm.base], self._links[self.arm.tip]
        self._index_moving([info for info in infos if info[2] != p.JOINT_FIXED])

    def _index_moving(self, moving: list[Any]) -> None:
        """Where the arm's joints are among all that move."""
        names = [info[1].decode() for info in moving]
        self._damping = [info[6] for info in moving]
        self._of_arm = [names.index(name) for name in self.arm.joint_names]
        of_held = [k for k in range(len(moving)) if k not in self._of_arm]
        self._tree_order = np.argsort(self._of_arm + of_held).tolist()
        self._arm_comes_first = self._tree_order == sorted(self._tree_order)
        self._arm_joints = [moving[k][0] for k in self._of_arm]
        self._held = [moving[k] for k in of_held]
        self._moving = self._arm_joints + [info[0] for info in self._held]
        self._at_rest = [0.0] * len(self._held)
        self._unit_gains = [1.0] * len(self._arm_joints)
        self._servo_limit = np.minimum(self.arm.effort_limit, _UNLIMITED_TORQUE).tolist()

    def _joint_count(self) -> int:
        return int(self._p.getNumJoints(self._body, physicsClientId=self._client))

    def _switch_off_damping_and_motors(self) -> None:
        p, client, body = self._p, self._client, self._body
        for link in range(-1, self._joint_count()):
            p.changeDynamics(body, link, linearDamping=0.0, angularDamping=0.0, physicsClientId=client)
        for joint in self._moving:
            p.setJointMotorControl2(body, joint, p.VELOCITY_CONTROL, force=0.0, physicsClientId=client)
        for info in self._held:
            self._hold(info)

    def _hold(self, info: Any) -> None:
        """Keep a joint that is not the arm's in the middle of its range: no finger touches another."""
        lower, upper, effort = info[8], info[9], info[10]
        middle = 0.5 * (lower + upper) if lower < upper else 0.0
        motor = {"targetPosition": middle, "positionGain": 1.0, "force": effort or _UNLIMITED_TORQUE}
        p, client, body = self._p, self._client, self._body
        p.resetJointState(body, info[0], middle, physicsClientId=client)
        p.setJointMotorControl2(body, info[0], p.POSITION_CONTROL, **motor, physicsClientId=client)

    def _add_friction(self, disturbance: Disturbance) -> None:
        """Bullet's joint damping, and its motors at zero speed: with little force they are Coulomb friction."""
        p, client, body = self._p, self._client, self._body
        for joint, known in zip(self._arm_joints, (self._damping[k] for k in self._of_arm), strict=True):
            p.changeDynamics(body, joint, jointDamping=known + disturbance.damping, physicsClientId=client)
            p.setJointMotorControl2(body, joint, p.VELOCITY_CONTROL, force=disturbance.friction, physicsClientId=client)

    def _ignore_overlaps(self) -> None:
        """Let links overlap where the contact rules leave them out."""
        rules = self.contact_rules
        for pair in rules.left_out:
            a, b = (self._links.get(name) for name in pair)
            if a is not None and b is not None:
                self._p.setCollisionFilterPair(self._body, self._body, a, b, 0, physicsClientId=self._client)
        self._standing = [link for name, link in self._links.items() if name in rules.still]
        self._base_stands = self.arm.base in rules.still
        self._root_in_still_base = np.linalg.inv(self._link_pose(self._base))
        self._free_links = [link for name, link in self._links.items() if name not in rules.still]
        self._self_pairs = [
            (self._links[a], self._links[b])
            for a, b in combinations(self._links, 2)
            if frozenset((a, b)) not in rules.left_out
        ]

    def _add_floor(self, height: float) -> None:
        p, client = self._p, self._client
        shape = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client)
        self._floor = p.createMultiBody(0.0, shape, basePosition=[0.0, 0.0, height], physicsClientId=client)
        self._others[self._floor] = FLOOR
        self._off_floor = {self._links[name] for name in self.contact_rules.off_floor if name in self._links}
        for link in (*self._standing, *self._off_floor):
            p.setCollisionFilterPair(self._floor, self._body, -1, link, 0, physicsClientId=client)

    def _add_obstacle(self, thing: Box | Obstacle) -> int:
        p, client = self._p, self._client
        shape, pose = self._collision_shape(solid_of(thing))
        place = {"basePosition": pose[:3, 3].tolist(), "baseOrientation": quaternion_of(pose)}
        body = int(p.createMultiBody(0.0, shape, **place, physicsClientId=client))
        for link in self._standing:
            p.setCollisionFilterPair(body, self._body, -1, link, 0, physicsClientId=client)
        return body

    def _collision_shape(self, solid: Solid) -> tuple[int, Array]:
        p = self._p
        kinds: dict[str, dict[str, Any]] = {
            "sphere": {"shapeType": p.GEOM_SPHERE, "radius": solid.radius},
            "box": {"shapeType": p.GEOM_BOX, "halfExtents": list(solid.half)},
            "capsule": {"shapeType": p.GEOM_CAPSULE, "radius": solid.radius, "height": solid.length},
            "plane": {"shapeType": p.GEOM_PLANE, "planeNormal": [0.0, 0.0, 1.0]},
        }
        return int(p.createCollisionShape(**kinds[solid.kind], physicsClientId=self._client)), solid.pose

    def _read(self) -> None:
        states = self._p.getJointStates(self._body, self._moving, physicsClientId=self._client)
        q, qd, _, torque = zip(*states, strict=True)
        n = len(self._arm_joints)
        self._state, self._motor_torque = (np.array(q[:n]), np.array(qd[:n])), torque[:n]
        self._held_state = list(q[n:]), list(qd[n:])

    def _link_pose(self, link: int) -> Array:
        """Pose of a link's frame (not of its centre of mass) in the root's frame."""
        if link == -1:
            return np.eye(4)
        state = self._p.getLinkState(self._body, link, computeForwardKinematics=True, physicsClientId=self._client)
        x, y, z = state[4]
        xx, xy, xz, yx, yy, yz, zx, zy, zz = self._p.getMatrixFromQuaternion(state[5])
        return np.array((xx, xy, xz, x, yx, yy, yz, y, zx, zy, zz, z, 0.0, 0.0, 0.0, 1.0)).reshape(4, 4)


def _pybullet() -> ModuleType:
    try:
        with quiet():
            return importlib.import_module("pybullet")
    except ImportError:
        raise MissingDependency(
            f"pybullet is not installed for this Python {sys.version_info.major}.{sys.version_info.minor}. "
            'Install it: pip install "dmpcpp[bullet]", compiled where this Python has no wheel; or take MuJoCo: '
            "simulator='mujoco', pip install \"dmpcpp[mujoco]\"."
        ) from None
