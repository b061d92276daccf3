"""The command line: `dmpcpp demo | imitate | inspect | reproduce | grasp | generality | verify`.

Exit status: 0 verified, 2 wrong usage or input, 3 the run did not meet its checks.
"""

from dmpcpp.cli.generality import generality
from dmpcpp.cli.grasp import grasp
from dmpcpp.cli.group import main
from dmpcpp.cli.imitation import demo, imitate
from dmpcpp.cli.inspection import inspect
from dmpcpp.cli.reproduction import reproduce
from dmpcpp.cli.verification import verify

__all__ = ["main"]

for command in (demo, imitate, inspect, reproduce, grasp, generality, verify):
    main.add_command(command)
