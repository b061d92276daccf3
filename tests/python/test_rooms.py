"""The rooms of the Python package: what users import stays where it was."""

import importlib
import warnings

import pytest

ROOMS = {
    "arms": "robot.arms",
    "urdf_check": "robot.urdf_check",
    "plot": "show.plot",
    "scene": "show.scene",
    "report": "show.report",
    "view": "show.view",
    "batch": "trials.batch",
    "generality": "trials.generality",
    "reproduction": "trials.reproduction",
}


@pytest.mark.parametrize(("address", "room"), ROOMS.items())
def test_a_public_address_is_the_module_in_its_room(address, room):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = importlib.import_module(f"dmpcpp.{address}")
    assert found is importlib.import_module(f"dmpcpp.{room}")
