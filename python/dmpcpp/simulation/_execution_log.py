"""What an execution leaves behind: every step, as wanted and as measured."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from dmpcpp._core import Arm, JointTrajectory
from dmpcpp._typing import Array
from dmpcpp.metrics import StageErrors, compare
from dmpcpp.robot import POSE, Disturbance, Follow, InertiaRepair, repaired_links
from dmpcpp.simulation._dynamics_check import DynamicsMismatch
from dmpcpp.simulation._simulator import Contact
from dmpcpp.simulation._verdict import Verdict, judge

_KNOWS_ALL = "the controller knows the simulated masses exactly; model errors, delay and friction are not in it"
_RECORDED = (
    "recorded by the robot: where the tool was is the forward kinematics of the measured joints; the arm's "
    "calibration, its flexing and contacts are not in the log"
)
_MOTORS = "the engine's motors are constraints solved inside the step; only kinematics and the torque cap are tested"


@dataclass(frozen=True)
class ContactEvent:
    """A contact at one step of an execution.

    Attributes
    ----------
    step : int
    time : float
        [s]
    contact : Contact
    """

    step: int
    time: float
    contact: Contact


@dataclass(frozen=True)
class ExecutionLog:
    """A joint trajectory as an arm carried it out: N steps of n joints.

    Attributes
    ----------
    arm : Arm
    joints : JointTrajectory
        What was to be carried out.
    simulator : str
        Engine and version.
    mode : str
        "computed_torque", "position", "position_velocity", "velocity", or "recorded" on a real arm;
        ``caveat`` says what it cannot see.
    rate : float
        Control steps a second [Hz].
    motion : slice
        The steps of the trajectory itself, without lead-in, lead-out and settling.
    planned_steps : int
        Steps that were wanted; fewer were done if the state left the finite numbers.
    inertia_repairs : tuple of InertiaRepair
        Links whose inertia was not physical and was replaced, and bodies that state none.
    time : (N,) s
        0 at the first sample of the trajectory; the lead-in is negative.
    desired_position, position : (N, n) rad
    desired_velocity, velocity : (N, n) rad/s
    torque_demand, torque : (N, n) Nm
        What the controller asked for, and what was given after clipping at the effort limit.
    desired_tool_pose : (N, 4, 4)
        By ``arm.forward_kinematics`` (KDL), in the frame of ``arm.base``.
    tool_pose : (N, 4, 4)
        By the simulator's own kinematics.
    contacts : tuple of ContactEvent
    disturbance : Disturbance
        What the controller did not know.
    follow : Follow
        The part of the tool's pose that is judged: the part that the arm follows.
    dynamics : DynamicsMismatch
        How far the masses and gravity torques of the controller's model are from KDL's.
    """

    arm: Arm
    joints: JointTrajectory
    simulator: str
    mode: str
    rate: float
    motion: slice
    planned_steps: int
    inertia_repairs: tuple[InertiaRepair, ...]
    time: Array
    desired_position: Array
    position: Array
    desired_velocity: Array
    velocity: Array
    torque_demand: Array
    torque: Array
    desired_tool_pose: Array
    tool_pose: Array
    contacts: tuple[ContactEvent, ...]
    disturbance: Disturbance = field(default_factory=Disturbance)
    follow: Follow = POSE
    dynamics: DynamicsMismatch = field(default_factory=DynamicsMismatch)

    @property
    def repaired_links(self) -> tuple[str, ...]:
        """Links whose inertia was replaced."""
        return repaired_links(self.inertia_repairs)

    @property
    def caveat(self) -> str:
        """What this mode cannot see."""
        if self.mode == "recorded":
            return _RECORDED
        unknown = f"the controller does not know of {self.disturbance}" if self.disturbance != Disturbance() else ""
        if self.mode != "computed_torque":
            return f"{_MOTORS}; {unknown}" if unknown else _MOTORS
        return unknown or _KNOWS_ALL

    @cached_property
    def errors(self) -> StageErrors:
        """Tool pose as executed against FK of the joint trajectory, over the motion itself."""
        return compare(self.desired_tool_pose[self.motion], self.tool_pose[self.motion])

    @cached_property
    def verdict(self) -> Verdict:
        """What held and what did not, by the default tolerances; ``judge(log, tolerances)`` takes others."""
        return judge(self)
