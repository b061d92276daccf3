"""The public address of `dmpcpp.trials.reproduction`."""

from dmpcpp._address import share
from dmpcpp.trials.reproduction import *  # noqa: F403

share(__name__, "dmpcpp.trials.reproduction")
