"""Physics: a joint trajectory carried out on a simulated arm, and the judgement of how it went.

``execute(arm, joints)`` gives an ``ExecutionLog``; ``log.verdict`` says what held. PyBullet is imported when
it is first needed; without it ``execute`` raises ``MissingDependency``.
"""

from dmpcpp.simulation.bullet import Bullet
from dmpcpp.simulation.execution import contacts_along, execute
from dmpcpp.simulation.execution_log import ContactEvent, ExecutionLog
from dmpcpp.simulation.grasp_world import GraspWorld
from dmpcpp.simulation.gripper import PANDA_HAND, ParallelGripper
from dmpcpp.simulation.objects import Cylinder, Friction
from dmpcpp.simulation.simulator import Contact, Simulator
from dmpcpp.simulation.torque_scaling import torque_duration_factor
from dmpcpp.simulation.verdict import Check, Tolerances, Verdict, judge

__all__ = [
    "PANDA_HAND",
    "Bullet",
    "Check",
    "Contact",
    "ContactEvent",
    "Cylinder",
    "ExecutionLog",
    "Friction",
    "GraspWorld",
    "ParallelGripper",
    "Simulator",
    "Tolerances",
    "Verdict",
    "contacts_along",
    "execute",
    "judge",
    "torque_duration_factor",
]
