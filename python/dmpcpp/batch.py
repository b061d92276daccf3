"""The public address of `dmpcpp.trials.batch`."""

from dmpcpp._address import share
from dmpcpp.trials.batch import *  # noqa: F403

share(__name__, "dmpcpp.trials.batch")
