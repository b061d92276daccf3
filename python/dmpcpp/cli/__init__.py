"""The command line: `dmpcpp demo`, `dmpcpp imitate`, `dmpcpp reproduce`, `dmpcpp grasp`, `dmpcpp generality`.

Exit status: 0 verified, 2 wrong usage or input, 3 the run did not meet its checks.
"""

from dmpcpp.cli.generality import generality
from dmpcpp.cli.grasp import grasp
from dmpcpp.cli.group import main
from dmpcpp.cli.imitation import demo, imitate
from dmpcpp.cli.reproduction import reproduce

__all__ = ["main"]

for command in (demo, imitate, reproduce, grasp, generality):
    main.add_command(command)
