"""Physics: a joint trajectory carried out on a simulated arm, and the judgement of how it went.

``execute(arm, joints)`` gives an ``ExecutionLog``; ``log.verdict`` says what held. PyBullet and
MuJoCo are imported when they are first needed; without them ``execute`` raises ``MissingDependency``.
"""

from dmpcpp.simulation.bullet import Bullet
from dmpcpp.simulation.check import Check, Checked
from dmpcpp.simulation.disturbance import Disturbance
from dmpcpp.simulation.execution import execute
from dmpcpp.simulation.execution_log import ContactEvent, ExecutionLog
from dmpcpp.simulation.grasp_world import GraspWorld
from dmpcpp.simulation.gripper import PANDA_HAND, ParallelGripper
from dmpcpp.simulation.mujoco import MuJoCo
from dmpcpp.simulation.objects import Cylinder, Friction
from dmpcpp.simulation.obstacles import Box
from dmpcpp.simulation.path_check import PathTolerances, contacts_along, path_checks
from dmpcpp.simulation.reference import Reference, from_rest_to_rest
from dmpcpp.simulation.second_opinion import AgreementTolerances, agreement
from dmpcpp.simulation.simulator import Clearance, Contact, Simulator
from dmpcpp.simulation.torque_scaling import torque_duration_factor
from dmpcpp.simulation.verdict import Tolerances, Verdict, judge

ENGINES = {"bullet": Bullet, "mujoco": MuJoCo}
"""The engines by the names of the command line."""

__all__ = [
    "ENGINES",
    "PANDA_HAND",
    "AgreementTolerances",
    "Box",
    "Bullet",
    "Check",
    "Checked",
    "Clearance",
    "Contact",
    "ContactEvent",
    "Cylinder",
    "Disturbance",
    "ExecutionLog",
    "Friction",
    "GraspWorld",
    "MuJoCo",
    "ParallelGripper",
    "PathTolerances",
    "Reference",
    "Simulator",
    "Tolerances",
    "Verdict",
    "agreement",
    "contacts_along",
    "execute",
    "from_rest_to_rest",
    "judge",
    "path_checks",
    "torque_duration_factor",
]
