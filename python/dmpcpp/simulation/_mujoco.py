"""MuJoCo behind the ``Simulator`` interface: the second opinion, an engine that nothing here was tuned for.

It gets the same repaired URDF as ``Bullet``. Its defaults are changed where they are no rigid-body dynamics or
write files: joint damping is stepped explicitly, no step is undone when it fails, no warning goes to a log file.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import tempfile
from collections.abc import Iterator, Sequence
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
from dmpcpp.simulation._simulator import FLOOR, GRAVITY, Clearance, Contact, checked_time_step, refused
from dmpcpp.simulation._solids import Solid, quaternion_of, solid_of

_FLOOR_DRAWN = 10.0  # m; a plane collides everywhere, its size is only drawn
_COMPILER = '<mujoco><compiler fusestatic="false" strippath="false" boundmass="1e-12" boundinertia="1e-14"/></mujoco>'
"""In the URDF: a link that is fixed to another keeps its name, a mesh its folder, and a link without mass between two
joints gets one that no torque shows, as no moving body may be without."""
_SURROUNDINGS = "dmpcpp_surroundings"  # a body of their own: the root link of a URDF may be called "world"
_GROUND = "dmpcpp_ground"


class MuJoCo:
    """An arm on a fixed base in MuJoCo, in a world of its own.

    Joints that are not the arm's are fixed in the middle of their range. MuJoCo has no motors inside its step:
    ``servo`` gives the torque that its own inverse dynamics asks for, clipped at the effort limit.

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
    disturbance : Disturbance, optional
        In what this arm differs from ``arm``; ``inverse_dynamics`` knows nothing of its damping and friction.
    obstacles : sequence of Box or Obstacle
        Fixed things in the arm's way.

    Raises
    ------
    MissingDependency
        mujoco is not installed.
    InvalidArgument
        The URDF cannot be simulated; the message says why.
    """

    def __init__(
        self,
        arm: Arm,
        time_step: float,
        *,
        floor: float | Literal["auto"] | None = "auto",
        ignored: Sequence[tuple[str, str]] = (),
        disturbance: Disturbance | None = None,
        obstacles: Sequence[Box | Obstacle] = (),
    ) -> None:
        """Load the arm into a world of its own."""
        self.arm, self.time_step = arm, checked_time_step(time_step)
        refuse_names(obstacles, links_of(arm))
        self.obstacles = tuple(thing.name for thing in obstacles)
        self._m = _mujoco()
        self.name = f"MuJoCo {importlib.metadata.version('mujoco')}"
        around = Surroundings(floor, tuple(ignored))
        self.contact_rules = contact_rules(arm, around)
        disturbance = disturbance or Disturbance()
        with tempfile.TemporaryDirectory(prefix="dmpcpp-") as folder:
            description = describe(arm, Path(folder), disturbance=disturbance, only_the_arm_moves=True)
            self._description = description
            self.levers = Levers(parsed(description.text), arm.joint_names, description.aliases)
            still = frozenset(map(description.in_engine, self.contact_rules.still))
            self.floor = floor_height(description.text, arm, around, still)
            self._model = self._compile(description, obstacles)
        self.inertia_repairs = description.repairs
        self.unjudged_links = description.unjudged
        self._damping = self._model.dof_damping.copy()
        self._model.dof_damping[:] += disturbance.damping
        self._model.dof_frictionloss[:] = disturbance.friction
        self._find_joints()
        self._pairs = list(self._colliding_pairs())
        self._limit = np.minimum(arm.effort_limit, np.finfo(np.float64).max)
        self.reset(np.zeros(arm.joint_count), np.zeros(arm.joint_count))

    # ---- Simulator ---------------------------------------------------------------------------------------

    def reset(self, position: Array, velocity: Array) -> None:
        """Put the arm into a state."""
        self._m.mj_resetData(self._model, self._data)
        self._q[self._order], self._qd[self._order] = position, velocity
        self._look()

    def state(self) -> tuple[Array, Array]:
        """Position and velocity after the last step."""
        return self._q[self._order], self._qd[self._order]

    def inverse_dynamics(
        self,
        acceleration: Array,
        position: Array | None = None,
        velocity: Array | None = None,
    ) -> Array:
        """Torque for an acceleration of the arm's joints, by recursive Newton-Euler."""
        data = self._thought
        data.qpos[self._order] = self._q[self._order] if position is None else position
        data.qvel[self._order] = self._qd[self._order] if velocity is None else velocity
        data.qacc[self._order] = acceleration
        self._m.mj_kinematics(self._model, data)
        self._m.mj_comPos(self._model, data)
        self._m.mj_comVel(self._model, data)
        self._m.mj_rne(self._model, data, 1, self._torque)
        torque: Array = (self._torque + self._damping * data.qvel)[self._order]
        return torque

    def apply_torque(self, torque: Array) -> None:
        """Torque of the next step."""
        self._applied[self._order] = torque

    def servo(self, velocity: Array) -> None:
        """Torque that reaches the velocity within the step, clipped."""
        position, now = self.state()
        torque = self.inverse_dynamics((velocity - now) / self.time_step, position, now)
        torque += (self._model.dof_damping - self._damping)[self._order] * now
        self.apply_torque(np.clip(torque, -self._limit, self._limit))

    def servo_torque(self) -> Array:
        """Torque that ``servo`` gave."""
        torque: Array = self._applied[self._order]
        return torque

    def step(self) -> None:
        """Advance by semi-implicit Euler and look where everything is."""
        # mj_step does the same, but it undoes a step that is not finite and writes a log file about it.
        self._m.mj_fwdActuation(self._model, self._data)
        self._m.mj_fwdAcceleration(self._model, self._data)
        self._m.mj_fwdConstraint(self._model, self._data)
        self._m.mj_Euler(self._model, self._data)
        self._look()

    def tool_pose(self) -> Array:
        """Pose of the tip in the base frame, by MuJoCo."""
        tip = self._pose(self._tip)
        return tip if self._base_is_root else np.linalg.inv(self._pose(self._base)) @ tip

    def masses(self) -> dict[str, float]:
        """Masses of the links."""
        model = self._model
        return {self._description.link(str(model.body(k).name)): float(model.body_mass[k]) for k in range(model.nbody)}

    def contacts(self) -> list[Contact]:
        """The deepest contact of every pair that overlaps."""
        if self._data.ncon == 0:
            return []
        found = self._data.contact
        deepest: dict[tuple[str, str], float] = {}
        for (one, other), distance in zip(found.geom.tolist(), found.dist.tolist(), strict=True):
            if distance < 0.0:
                pair = self._names_of(one, other)
                deepest[pair] = max(deepest.get(pair, 0.0), -distance)
        return [Contact(*pair, depth) for pair, depth in sorted(deepest.items())]

    def contacts_at(self, position: Array) -> list[Contact]:
        """Contacts with the arm put at a position."""
        self.reset(position, np.zeros_like(position))
        return self.contacts()

    def clearances_at(self, position: Array, within: float) -> list[Clearance]:
        """Distances of every pair that may collide, with the arm put at a position."""
        self.reset(position, np.zeros_like(position))
        nearest: dict[tuple[str, str], float] = {}
        for one, other in self._pairs:
            distance = float(self._m.mj_geomDistance(self._model, self._data, one, other, within, None))
            if distance < within:
                pair = self._names_of(one, other)
                nearest[pair] = min(nearest.get(pair, within), distance)
        return [Clearance(*pair, distance) for pair, distance in sorted(nearest.items())]

    def close(self) -> None:
        """Nothing is left behind: MuJoCo's memory goes with the object."""

    def __enter__(self) -> Self:
        """The world."""
        return self

    def __exit__(self, *failure: object) -> None:
        """Close it."""
        self.close()

    # ---- setting up --------------------------------------------------------------------------------------

    def _compile(self, description: RobotDescription, obstacles: Sequence[Box | Obstacle]) -> Any:
        m = self._m
        try:
            with quiet():  # older ones write warnings to the terminal
                model = self._spec(description, obstacles).compile()
        except (ValueError, m.FatalError) as error:
            raise refused("MuJoCo", self.arm, "bullet", " ".join(str(error).split())) from None
        model.opt.timestep = self.time_step
        model.opt.gravity[:] = 0.0, 0.0, GRAVITY
        model.opt.integrator = m.mjtIntegrator.mjINT_EULER
        # Which pairs may touch the contact rules say, not MuJoCo's own rule about parents and children.
        model.opt.disableflags |= int(m.mjtDisableBit.mjDSBL_EULERDAMP) | int(m.mjtDisableBit.mjDSBL_FILTERPARENT)
        return model

    def _spec(self, description: RobotDescription, obstacles: Sequence[Box | Obstacle]) -> Any:
        spec = self._m.MjSpec.from_string(description.text.replace("</robot>", f"{_COMPILER}</robot>"))
        bodies = {body.name for body in spec.bodies}
        for pair in sorted(tuple(sorted(pair)) for pair in self.contact_rules.left_out if FLOOR not in pair):
            a, b = map(description.in_engine, pair)
            if bodies >= {a, b}:
                spec.add_exclude(bodyname1=a, bodyname2=b)
        self._add_surroundings(spec, obstacles)
        return spec

    def _add_surroundings(self, spec: Any, obstacles: Sequence[Box | Obstacle]) -> None:
        kinds, still = self._m.mjtGeom, spec.worldbody.add_body(name=_SURROUNDINGS)
        if self.floor is not None:
            ground, size = spec.worldbody.add_body(name=_GROUND), [_FLOOR_DRAWN, _FLOOR_DRAWN, 1.0]
            ground.add_geom(name=FLOOR, type=kinds.mjGEOM_PLANE, size=size, pos=[0.0, 0.0, self.floor])
            for link in sorted(self.contact_rules.off_floor):
                spec.add_exclude(bodyname1=self._description.in_engine(link), bodyname2=_GROUND)
        for thing in obstacles:
            solid = solid_of(thing)
            x, y, z, w = quaternion_of(solid.pose)
            still.add_geom(
                name=thing.name,
                type={
                    "sphere": kinds.mjGEOM_SPHERE,
                    "box": kinds.mjGEOM_BOX,
                    "capsule": kinds.mjGEOM_CAPSULE,
                    "plane": kinds.mjGEOM_PLANE,
                }[solid.kind],
                size=_mujoco_size(solid),
                pos=solid.pose[:3, 3].tolist(),
                quat=[w, x, y, z],
            )

    def _find_joints(self) -> None:
        """Index joints and links by name; take all memory."""
        model = self._model
        self._data, self._thought = self._m.MjData(model), self._m.MjData(model)
        self._order = np.array([model.jnt_dofadr[model.joint(name).id] for name in self.arm.joint_names])
        self._q, self._qd, self._applied = self._data.qpos, self._data.qvel, self._data.qfrc_applied
        self._torque = np.empty(model.nv)
        in_engine = self._description.in_engine
        self._base, self._tip = (model.body(in_engine(name)).id for name in (self.arm.base, self.arm.tip))
        self._base_is_root = bool(np.array_equal(self._base_pose(), np.eye(4)))

    def _base_pose(self) -> Array:
        self._m.mj_kinematics(self._model, self._data)
        is_fixed = self._model.body_weldid[self._base] == 0
        return self._pose(self._base) if is_fixed else np.zeros((4, 4))

    def _colliding_pairs(self) -> Iterator[tuple[int, int]]:
        """Geoms that may touch: not of links that the contact rules leave out, and not two that never move."""
        model, rules = self._model, self.contact_rules
        left_out = rules.left_out | {frozenset((link, _GROUND)) for link in rules.off_floor}
        still = model.body_weldid[model.geom_bodyid] == 0
        for one, other in combinations(range(model.ngeom), 2):
            bodies = frozenset(self._body_of(geom) for geom in (one, other))
            if not (still[one] and still[other]) and len(bodies) == 2 and bodies not in left_out:
                yield one, other

    # ---- reading -----------------------------------------------------------------------------------------

    def _look(self) -> None:
        """All that follows from position and velocity, contacts included."""
        self._m.mj_fwdPosition(self._model, self._data)
        self._m.mj_fwdVelocity(self._model, self._data)

    def _pose(self, body: int) -> Array:
        pose = np.eye(4)
        pose[:3, :3] = self._data.xmat[body].reshape(3, 3)
        pose[:3, 3] = self._data.xpos[body]
        return pose

    def _names_of(self, one: int, other: int) -> tuple[str, str]:
        """The links of two geoms, what stands in the world last."""
        names = [self._name_of(geom) for geom in (one, other)]
        around = [self._body_of(geom) in (_SURROUNDINGS, _GROUND) for geom in (one, other)]
        if any(around):
            return (names[1], names[0]) if around[0] else (names[0], names[1])
        first, last = sorted(names)
        return first, last

    def _name_of(self, geom: int) -> str:
        body = self._body_of(geom)
        return str(self._model.geom(geom).name) if body in (_SURROUNDINGS, _GROUND) else body

    def _body_of(self, geom: int) -> str:
        return self._description.link(str(self._model.body(int(self._model.geom_bodyid[geom])).name))


def _mujoco_size(solid: Solid) -> list[float]:
    return {
        "sphere": [solid.radius, 0.0, 0.0],
        "box": list(solid.half),
        "capsule": [solid.radius, 0.5 * solid.length, 0.0],
        "plane": [_FLOOR_DRAWN, _FLOOR_DRAWN, 1.0],
    }[solid.kind]


def _mujoco() -> ModuleType:
    try:
        return importlib.import_module("mujoco")
    except ImportError:
        raise MissingDependency('mujoco is not installed. Install the extra: pip install "dmpcpp[mujoco]".') from None
