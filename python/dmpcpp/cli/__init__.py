"""The command line: `dmpcpp demo`, `dmpcpp imitate`, `dmpcpp inspect`, `dmpcpp reproduce`, `dmpcpp verify`.

Exit status: 0 verified, 2 wrong usage or input, 3 the run did not meet its checks.
"""

from dmpcpp.cli.group import main
from dmpcpp.cli.imitation import demo, imitate
from dmpcpp.cli.inspection import inspect
from dmpcpp.cli.reproduction import reproduce
from dmpcpp.cli.verification import verify

__all__ = ["main"]

for command in (demo, imitate, inspect, reproduce, verify):
    main.add_command(command)
