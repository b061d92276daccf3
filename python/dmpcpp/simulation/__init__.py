"""Physics: a joint trajectory carried out on a simulated arm, and the judgement of how it went.

``execute(arm, joints)`` gives an ``ExecutionLog``; ``log.verdict`` says what held. PyBullet and MuJoCo are imported
when they are first needed. Where no engine is named PyBullet is taken, or MuJoCo where that alone is installed; without
both ``execute`` raises ``MissingDependency``.
"""

from dmpcpp.checks import Check, Checked
from dmpcpp.robot import Disturbance
from dmpcpp.simulation._bullet import Bullet
from dmpcpp.simulation._control import Mode
from dmpcpp.simulation._default import default_simulator
from dmpcpp.simulation._execution import execute
from dmpcpp.simulation._execution_log import ContactEvent, ExecutionLog
from dmpcpp.simulation._grasp_world import GraspWorld
from dmpcpp.simulation._mujoco import MuJoCo
from dmpcpp.simulation._objects import PANDA_HAND, Box, Cylinder, Friction, ParallelGripper
from dmpcpp.simulation._path_check import PathTolerances, contacts_along, path_checks
from dmpcpp.simulation._path_clearance import CLEAR, Nearest, nearest_along
from dmpcpp.simulation._reference import Reference, from_rest_to_rest
from dmpcpp.simulation._reference import sample as sample
from dmpcpp.simulation._reference import states_at as states_at
from dmpcpp.simulation._second_opinion import AgreementTolerances, agreement
from dmpcpp.simulation._simulator import Clearance, Contact, Simulator, kind_of
from dmpcpp.simulation._torque_scaling import torque_duration_factor
from dmpcpp.simulation._verdict import Tolerances, Verdict, inertia_notes, inverse_kinematics_checks, judge

ENGINES = {"bullet": Bullet, "mujoco": MuJoCo}
"""The engines by the names of the command line."""

__all__ = [
    "CLEAR",
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
    "Mode",
    "MuJoCo",
    "Nearest",
    "ParallelGripper",
    "PathTolerances",
    "Reference",
    "Simulator",
    "Tolerances",
    "Verdict",
    "agreement",
    "contacts_along",
    "default_simulator",
    "execute",
    "from_rest_to_rest",
    "inertia_notes",
    "inverse_kinematics_checks",
    "judge",
    "kind_of",
    "nearest_along",
    "path_checks",
    "torque_duration_factor",
]
