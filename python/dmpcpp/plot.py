"""The public address of `dmpcpp.show.plot`."""

from dmpcpp._address import share
from dmpcpp.show.plot import *  # noqa: F403

share(__name__, "dmpcpp.show.plot")
