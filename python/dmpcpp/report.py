"""The public address of `dmpcpp.show.report`."""

from dmpcpp._address import share
from dmpcpp.show.report import *  # noqa: F403

share(__name__, "dmpcpp.show.report")
