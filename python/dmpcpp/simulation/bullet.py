"""PyBullet behind the ``Simulator`` interface, with its traps closed.

Its defaults are not rigid-body dynamics: inertias are taken from the collision shapes unless
URDF_USE_INERTIA_FROM_FILE is set, every link is damped by 0.04, and every joint starts with a motor on.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import sys
import tempfile
from pathlib import Path
from types import ModuleType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from dmpcpp._core import Arm
from dmpcpp.errors import InvalidArgument, MissingDependency
from dmpcpp.simulation.quiet import quiet
from dmpcpp.simulation.robot_description import RobotDescription, describe
from dmpcpp.simulation.simulator import FLOOR, Contact

_GRAVITY = -9.81  # m/s^2 along z of the URDF's root
_UNLIMITED_TORQUE = 1e6  # Nm, for a joint whose URDF states no effort: Bullet wants a finite number


class Bullet:
    """An arm on a fixed base in PyBullet, headless, in a world of its own.

    Parameters
    ----------
    arm : Arm
        Its URDF is loaded with the root at the world's origin; gravity points along -z of the root.
    time_step : float
        [s], > 0.
    floor : float or None
        Height of the ground [m] in the root's frame; None for no ground.
    visuals : bool
        Load what is only drawn as well.

    Raises
    ------
    MissingDependency
        pybullet is not installed.
    InvalidArgument
        The URDF can not be simulated; the message says why.

    Notes
    -----
    Collision shapes are the URDF's collision meshes as a few convex pieces each (``convex_pieces``): a
    contact can come a little early, never too late.
    """

    def __init__(self, arm: Arm, time_step: float, *, floor: float | None = 0.0, visuals: bool = False) -> None:
        """Load the arm into a world of its own."""
        if not (np.isfinite(time_step) and time_step > 0.0):
            raise InvalidArgument(f"time_step: {time_step}, expected a positive number of seconds.")
        self.arm = arm
        self.time_step = float(time_step)
        self._p = _pybullet()
        with quiet():
            self._client: int = self._p.connect(self._p.DIRECT)
        self.name = f"PyBullet {importlib.metadata.version('pybullet')}"
        try:
            self._set_up(floor, visuals)
        except BaseException:
            self.close()
            raise

    def _set_up(self, floor: float | None, visuals: bool) -> None:
        options = {"numSolverIterations": 100, "deterministicOverlappingPairs": 1}
        self._p.setPhysicsEngineParameter(self.time_step, **options, physicsClientId=self._client)
        self._p.setGravity(0.0, 0.0, _GRAVITY, physicsClientId=self._client)
        with tempfile.TemporaryDirectory(prefix="dmpcpp-") as folder:
            description = describe(self.arm, Path(folder), visuals=visuals)
            self._body = self._load(description.text, Path(folder, "arm.urdf"))
        self.repaired_links = description.repaired_links
        self._find_joints()
        self._switch_off_damping_and_motors()
        self._ignore_overlaps(description)
        if floor is not None:
            self._add_floor(floor, description)

    # ---- Simulator ---------------------------------------------------------------------------------------

    def reset(self, position: NDArray[np.float64], velocity: NDArray[np.float64]) -> None:
        """Put the arm into a state."""
        for joint, q, qd in zip(self._arm_joints, position.tolist(), velocity.tolist(), strict=True):
            self._p.resetJointState(self._body, joint, q, qd, physicsClientId=self._client)
        self._read()

    def state(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Position and velocity, as read after the last step."""
        return self._state

    def inverse_dynamics(self, acceleration: NDArray[np.float64]) -> NDArray[np.float64]:
        """Torque for an acceleration of the arm's joints, the others held."""
        accelerations = self._at_rest.copy()
        for i, value in zip(self._of_arm, acceleration.tolist(), strict=True):
            accelerations[i] = value
        torque = self._p.calculateInverseDynamics(
            self._body, self._q, self._qd, accelerations, physicsClientId=self._client
        )
        # Bullet steps with the joint damping of the URDF but leaves it out of its inverse dynamics.
        return np.array([torque[i] + self._damping[i] * self._qd[i] for i in self._of_arm])

    def apply_torque(self, torque: NDArray[np.float64]) -> None:
        """Torque of the next step."""
        self._p.setJointMotorControlArray(
            self._body,
            self._arm_joints,
            self._p.TORQUE_CONTROL,
            forces=torque.tolist(),
            physicsClientId=self._client,
        )

    def servo(self, position: NDArray[np.float64]) -> None:
        """One step of Bullet's position motors: gain 1 reaches the target unless the torque is capped."""
        self._p.setJointMotorControlArray(
            self._body,
            self._arm_joints,
            self._p.POSITION_CONTROL,
            targetPositions=position.tolist(),
            forces=self._servo_limit,
            positionGains=self._unit_gains,
            velocityGains=self._unit_gains,
            physicsClientId=self._client,
        )

    def servo_torque(self) -> NDArray[np.float64]:
        """Torque that the motors gave in the last step."""
        return np.array([self._motor_torque[i] for i in self._of_arm])

    def step(self) -> None:
        """Advance and read the joints."""
        self._p.stepSimulation(physicsClientId=self._client)
        self._read()

    def tool_pose(self) -> NDArray[np.float64]:
        """Pose of the tip in the base frame, by Bullet."""
        tip = self._link_pose(self._tip)
        return tip if self._base == -1 else np.linalg.inv(self._link_pose(self._base)) @ tip

    def contacts(self) -> list[Contact]:
        """The deepest contact of every pair that overlaps."""
        points = self._p.getContactPoints(self._body, physicsClientId=self._client)
        deepest: dict[tuple[str, str], float] = {}
        for point in points:
            if point[8] < 0.0:  # a positive distance is a near miss inside Bullet's contact margin
                pair = self._names_of(point)
                deepest[pair] = max(deepest.get(pair, 0.0), -point[8])
        return [Contact(*pair, depth) for pair, depth in sorted(deepest.items())]

    def contacts_at(self, position: NDArray[np.float64]) -> list[Contact]:
        """Contacts with the arm put at a position."""
        self.reset(position, np.zeros_like(position))
        self._p.performCollisionDetection(physicsClientId=self._client)
        return self.contacts()

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

    def _load(self, urdf: str, path: Path) -> int:
        p = self._p
        path.write_text(urdf, encoding="utf-8")
        options = {"useFixedBase": True, "flags": p.URDF_USE_INERTIA_FROM_FILE | p.URDF_USE_SELF_COLLISION}
        with quiet() as heard:
            try:
                return int(p.loadURDF(str(path), **options, physicsClientId=self._client))
            except p.error as error:
                reason = " ".join(heard().split()) or str(error)
        raise InvalidArgument(f"arm.urdf: PyBullet can not load '{self.arm.name}': {reason}")

    def _find_joints(self) -> None:
        """Index joints and links by name: Bullet has its own order, with fingers and fixed joints in it."""
        p, client, body = self._p, self._client, self._body
        infos = [p.getJointInfo(body, i, physicsClientId=client) for i in range(self._joint_count())]
        self._link_names = {info[0]: info[12].decode() for info in infos}
        self._link_names[-1] = p.getBodyInfo(body, physicsClientId=client)[0].decode()
        self._links = {name: index for index, name in self._link_names.items()}
        self._base, self._tip = self._links[self.arm.base], self._links[self.arm.tip]
        self._index_moving([info for info in infos if info[2] != p.JOINT_FIXED])
        self._refuse_folded_joints(infos)

    def _index_moving(self, moving: list[Any]) -> None:
        """Where the arm's joints are among all that move."""
        names = [info[1].decode() for info in moving]
        self._moving = [info[0] for info in moving]
        self._damping = [info[6] for info in moving]
        self._at_rest = [0.0] * len(moving)
        self._of_arm = [names.index(name) for name in self.arm.joint_names]
        self._arm_joints = [self._moving[k] for k in self._of_arm]
        self._held = [info for k, info in enumerate(moving) if k not in self._of_arm]
        self._unit_gains = [1.0] * len(self._arm_joints)
        self._servo_limit = np.minimum(self.arm.effort_limit, _UNLIMITED_TORQUE).tolist()

    def _refuse_folded_joints(self, infos: list[Any]) -> None:
        """A mimic joint between base and tip moves with its master in ``Arm``, but would be held here."""
        link = self._tip
        while link not in (self._base, -1):
            info = infos[link]
            if info[2] != self._p.JOINT_FIXED and info[0] not in self._arm_joints:
                raise InvalidArgument(
                    f"arm: joint '{info[1].decode()}' between '{self.arm.base}' and '{self.arm.tip}' mimics "
                    "another; PyBullet can not couple them. Choose a base and a tip without it."
                )
            link = info[16]

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

    def _ignore_overlaps(self, description: RobotDescription) -> None:
        """Let links overlap that touch by construction: rigidly joined, or on either side of a joint."""
        for pair in description.neighbours:
            a, b = (self._links[name] for name in pair)
            self._p.setCollisionFilterPair(self._body, self._body, a, b, 0, physicsClientId=self._client)

    def _add_floor(self, height: float, description: RobotDescription) -> None:
        p, client = self._p, self._client
        shape = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client)
        self._floor = p.createMultiBody(0.0, shape, basePosition=[0.0, 0.0, height], physicsClientId=client)
        root = self._link_names[-1]
        standing = next(group for group in description.rigid_groups if root in group)
        for link in standing:
            p.setCollisionFilterPair(self._floor, self._body, -1, self._links[link], 0, physicsClientId=client)

    # ---- reading -----------------------------------------------------------------------------------------

    def _read(self) -> None:
        states = self._p.getJointStates(self._body, self._moving, physicsClientId=self._client)
        self._q, self._qd, _, self._motor_torque = zip(*states, strict=True)
        of_arm = [states[i] for i in self._of_arm]
        self._state = np.array([s[0] for s in of_arm]), np.array([s[1] for s in of_arm])

    def _link_pose(self, link: int) -> NDArray[np.float64]:
        """Pose of a link's frame (not of its centre of mass) in the root's frame."""
        if link == -1:
            return np.eye(4)
        state = self._p.getLinkState(self._body, link, computeForwardKinematics=True, physicsClientId=self._client)
        x, y, z = state[4]
        r = self._p.getMatrixFromQuaternion(state[5])
        return np.array([(*r[:3], x), (*r[3:6], y), (*r[6:], z), (0.0, 0.0, 0.0, 1.0)])

    def _names_of(self, point: Any) -> tuple[str, str]:
        link = self._link_names[point[3]]
        other = self._link_names[point[4]] if point[2] == self._body else FLOOR
        return (link, other) if other == FLOOR or link <= other else (other, link)


def _pybullet() -> ModuleType:
    try:
        with quiet():
            return importlib.import_module("pybullet")
    except ImportError:
        raise MissingDependency(
            f"pybullet is not installed for this Python {sys.version_info.major}.{sys.version_info.minor}. "
            'Install the extra: pip install "dmpcpp[sim]". Its newest wheels are for Python 3.11.'
        ) from None
