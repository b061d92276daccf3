"""The command line: `dmpcpp demo | imitate | inspect | fit | plan | reproduce | grasp | generality | run | verify |
view | report | batch | arms | check-urdf | doctor | fetch | record | tag | example`.

Exit status: 0 verified, 2 wrong usage or input, 3 the run did not meet its checks.
"""

from dmpcpp.cli._arms import arms
from dmpcpp.cli._batch import batch
from dmpcpp.cli._checking import check_urdf, doctor
from dmpcpp.cli._config import configurable
from dmpcpp.cli._example import example
from dmpcpp.cli._fetch import fetch
from dmpcpp.cli._generality import generality
from dmpcpp.cli._grasp import grasp
from dmpcpp.cli._group import main
from dmpcpp.cli._imitation import demo, imitate
from dmpcpp.cli._inspection import inspect
from dmpcpp.cli._learning import fit, plan
from dmpcpp.cli._record import record
from dmpcpp.cli._reproduction import reproduce
from dmpcpp.cli._run import run
from dmpcpp.cli._show import report, view
from dmpcpp.cli._tag import tag
from dmpcpp.cli._verification import verify

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
    run,
    verify,
    view,
    report,
    batch,
    arms,
    check_urdf,
    doctor,
    fetch,
    record,
    tag,
    example,
)

for command in _COMMANDS:
    main.add_command(configurable(command))
