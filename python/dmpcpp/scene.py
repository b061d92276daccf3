"""The public address of `dmpcpp.show.scene`."""

from dmpcpp._address import share
from dmpcpp.show.scene import *  # noqa: F403

share(__name__, "dmpcpp.show.scene")
