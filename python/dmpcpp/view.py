"""The public address of `dmpcpp.show.view`."""

from dmpcpp._address import share
from dmpcpp.show.view import *  # noqa: F403

share(__name__, "dmpcpp.show.view")
