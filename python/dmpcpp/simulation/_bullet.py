"""PyBullet behind the ``Simulator`` interface."""

from __future__ import annotations

from typing import Any

import numpy as np

from dmpcpp._typing import Array
from dmpcpp.simulation._bullet_world import BulletWorld
from dmpcpp.simulation._simulator import FLOOR, Clearance, Contact


class Bullet(BulletWorld):
    """An arm on a fixed base in PyBullet, headless, in a world of its own.

    Parameters
    ----------
    arm : Arm
        Its URDF is loaded with the root at the world's origin; gravity points along -z of the root.
    time_step : float
        [s], > 0.
    floor : float, "auto" or None
        Height of the ground [m] in the root's frame; None for no ground; "auto": 0, or below the lowest collision shape
        that the arm does not move.
    ignored : sequence of (str, str)
        Pairs of links, or a link and "floor", that may touch.
    visuals : bool
        Load what is only drawn as well.
    disturbance : Disturbance, optional
        In what this arm differs from ``arm``; ``inverse_dynamics`` knows nothing of its damping and friction.
    obstacles : sequence of Box or Obstacle
        Fixed things in the arm's way.

    Raises
    ------
    MissingDependency
        pybullet is not installed.
    InvalidArgument
        The URDF cannot be simulated; the message says why.

    Notes
    -----
    Collision shapes are the URDF's collision meshes as a few convex pieces each (``convex_pieces``): a
    contact can come a little early, never too late.
    """

    # ---- Simulator ---------------------------------------------------------------------------------------

    def reset(self, position: Array, velocity: Array) -> None:
        """Put the arm into a state."""
        for joint, q, qd in zip(self._arm_joints, position.tolist(), velocity.tolist(), strict=True):
            self._p.resetJointState(self._body, joint, q, qd, physicsClientId=self._client)
        self._read()

    def state(self) -> tuple[Array, Array]:
        """Position and velocity, as read after the last step."""
        return self._state

    def inverse_dynamics(
        self,
        acceleration: Array,
        position: Array | None = None,
        velocity: Array | None = None,
    ) -> Array:
        """Torque for an acceleration of the arm's joints, the others held."""
        position = self._state[0] if position is None else position
        velocity = self._state[1] if velocity is None else velocity
        if self._dynamics is not None:
            damping = np.array([self._damping[k] for k in self._of_arm])
            return self._dynamics.inverse_dynamics(position, velocity, acceleration) + damping * velocity
        held_q, held_qd = self._held_state
        q, qd = self._in_tree_order(position, held_q), self._in_tree_order(velocity, held_qd)
        accelerations = self._in_tree_order(acceleration, self._at_rest)
        torque = self._p.calculateInverseDynamics(self._body, q, qd, accelerations, physicsClientId=self._client)
        # Bullet steps with the joint damping of the URDF but leaves it out of its inverse dynamics.
        return np.array([torque[i] + self._damping[i] * qd[i] for i in self._of_arm])

    def apply_torque(self, torque: Array) -> None:
        """Torque of the next step."""
        self._p.setJointMotorControlArray(
            self._body,
            self._arm_joints,
            self._p.TORQUE_CONTROL,
            forces=torque.tolist(),
            physicsClientId=self._client,
        )

    def servo(self, velocity: Array) -> None:
        """One step of Bullet's velocity motors: gain 1 reaches the target unless the torque is capped."""
        self._p.setJointMotorControlArray(
            self._body,
            self._arm_joints,
            self._p.VELOCITY_CONTROL,
            targetVelocities=velocity.tolist(),
            forces=self._servo_limit,
            velocityGains=self._unit_gains,
            physicsClientId=self._client,
        )

    def servo_torque(self) -> Array:
        """Torque that the motors gave in the last step."""
        return np.array(self._motor_torque)

    def step(self) -> None:
        """Advance and read the joints."""
        self._p.stepSimulation(physicsClientId=self._client)
        self._read()

    def tool_pose(self) -> Array:
        """Pose of the tip in the base frame, by Bullet."""
        tip = self._link_pose(self._tip)
        return tip if self._base == -1 else self._root_in_base() @ tip

    def masses(self) -> dict[str, float]:
        """Masses of the links; of the fixed root Bullet says 0."""
        info, client = self._p.getDynamicsInfo, self._client
        return {name: float(info(self._body, k, physicsClientId=client)[0]) for name, k in self._links.items()}

    def contacts(self) -> list[Contact]:
        """The deepest contact of every pair that overlaps."""
        points = self._p.getContactPoints(self._body, physicsClientId=self._client)
        if not points:
            return []
        deepest: dict[tuple[str, str], float] = {}
        for point in points:
            if point[8] < 0.0:  # a positive distance is a near miss inside Bullet's contact margin
                pair = self._names_of(point)
                deepest[pair] = max(deepest.get(pair, 0.0), -point[8])
        return [Contact(*pair, depth) for pair, depth in sorted(deepest.items())]

    def contacts_at(self, position: Array) -> list[Contact]:
        """Contacts with the arm put at a position."""
        self.reset(position, np.zeros_like(position))
        self._p.performCollisionDetection(physicsClientId=self._client)
        return self.contacts()

    def clearances_at(self, position: Array, within: float) -> list[Clearance]:
        """Closest points of every pair that may collide, with the arm put at a position."""
        self.reset(position, np.zeros_like(position))
        self._p.performCollisionDetection(physicsClientId=self._client)
        pairs = [(self._body, a, b) for a, b in self._self_pairs]
        pairs += [
            (other, link, -1) for other in self._others for link in self._free_links if self._may_touch(other, link)
        ]
        found = (self._clearance(*pair, within) for pair in pairs)
        return [clearance for clearance in found if clearance is not None]

    # ---- reading -----------------------------------------------------------------------------------------

    def _in_tree_order(self, of_arm: Array, of_held: list[float]) -> list[float]:
        """Values of all moving joints as Bullet's inverse dynamics wants them."""
        values: list[float] = of_arm.tolist() + of_held
        return values if self._arm_comes_first else [values[k] for k in self._tree_order]

    def _root_in_base(self) -> Array:
        return self._root_in_still_base if self._base_stands else np.linalg.inv(self._link_pose(self._base))

    def _clearance(self, other: int, link: int, other_link: int, within: float) -> Clearance | None:
        points = self._p.getClosestPoints(self._body, other, within, link, other_link, physicsClientId=self._client)
        if not points:
            return None
        nearest = min(points, key=lambda point: point[8])
        return Clearance(*self._names_of(nearest), float(nearest[8]))

    def _may_touch(self, other: int, link: int) -> bool:
        return self._others[other] != FLOOR or link not in self._off_floor

    def _names_of(self, point: Any) -> tuple[str, str]:
        link = self._link_names[point[3]]
        if point[2] != self._body:
            return link, self._others[point[2]]
        other = self._link_names[point[4]]
        return (link, other) if link <= other else (other, link)
