"""The command line: `dmpcpp demo | imitate | inspect | fit | plan | reproduce | grasp | generality | verify | view |
report | batch | check-urdf | doctor`.

Exit status: 0 verified, 2 wrong usage or input, 3 the run did not meet its checks.
"""

from dmpcpp.cli.batch import batch
from dmpcpp.cli.checking import check_urdf, doctor
from dmpcpp.cli.config import configurable
from dmpcpp.cli.generality import generality
from dmpcpp.cli.grasp import grasp
from dmpcpp.cli.group import main
from dmpcpp.cli.imitation import demo, imitate
from dmpcpp.cli.inspection import inspect
from dmpcpp.cli.learning import fit, plan
from dmpcpp.cli.report import report
from dmpcpp.cli.reproduction import reproduce
from dmpcpp.cli.verification import verify
from dmpcpp.cli.view import view

__all__ = ["main"]

_COMMANDS = (
    demo,
    imitate,
    inspect,
    fit,
    plan,
    reproduce,
    grasp,
    generality,
    verify,
    view,
    report,
    batch,
    check_urdf,
    doctor,
)

for command in _COMMANDS:
    main.add_command(configurable(command))
