"""The public address of `dmpcpp.trials.generality`."""

from dmpcpp._address import share
from dmpcpp.trials.generality import *  # noqa: F403

share(__name__, "dmpcpp.trials.generality")
