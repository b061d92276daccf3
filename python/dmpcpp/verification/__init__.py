"""A joint log of a real arm held against the plan that it carried out: the measures and checks of a simulated run.

``verify(arm, plan, log)`` finds out when in the log the plan began, and gives a ``Verification``.
"""

from dmpcpp.verification._joint_log import JointLog
from dmpcpp.verification._lag import estimate_lag
from dmpcpp.verification._log_files import read_log
from dmpcpp.verification._verify import Verification, verify

__all__ = ["JointLog", "Verification", "estimate_lag", "read_log", "verify"]
