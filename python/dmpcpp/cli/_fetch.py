"""`dmpcpp fetch`."""

from __future__ import annotations

import click


@click.command()
def fetch() -> None:
    """Download the arms and motions that ship with PyBullet, where PyBullet itself is not installed.

    `dmpcpp demo` needs them; with the extra mujoco it then runs in MuJoCo. 100 MB are downloaded and 140 MB kept,
    beside the packages of this Python, or in the user's cache (~/.cache/dmpcpp) where those are read-only.

    Example: dmpcpp fetch
    """
    from dmpcpp import _pybullet_data

    there = _pybullet_data.find()
    click.echo(f"already there: {there}" if there else f"fetched: {_pybullet_data.fetch()}")
