"""`dmpcpp arms`: the arms that have a name, what is on this machine, and where the others can be had."""

from __future__ import annotations

import json
from typing import Any

import click

from dmpcpp.errors import InvalidArgument


@click.command("arms")
@click.option(
    "--fetch", "wanted", metavar="NAME", help="Clone the description of an arm into robot_descriptions' cache."
)
@click.option("--json", "as_json", is_flag=True, help="Print the list as JSON instead of the table.")
def arms(wanted: str | None, as_json: bool) -> None:
    """List the arms that --arm takes by name: what is on this machine, what can be had, from where, which licence.

    Case, dashes and underscores of a name do not count. Every arm of the package robot_descriptions has its name, too.
    Nothing is fetched without --fetch.

    Example: dmpcpp arms
    """
    from dmpcpp.robot import arms as library

    if wanted is not None:
        click.echo(f"fetched: {_fetched(wanted)}")
        return
    rows = [_row(listed) for listed in library.listed()]
    if as_json:
        click.echo(json.dumps(rows, indent=2))
        return
    _print(rows)


def _fetched(name: str) -> str:
    from dmpcpp.robot import arms as library

    module = library.description_of(name)
    if module is None:
        raise InvalidArgument(f"--fetch: '{name}', expected an arm of robot_descriptions, which has to be installed.")
    return str(library.fetch(module))


def _row(listed: Any) -> dict[str, Any]:
    there = listed.found()
    place = there[0] if there else listed.places[0]
    maker = listed.maker
    return {
        "name": listed.name,
        "here": there is not None,
        "path": str(there[1]) if there else None,
        "package": place.package,
        "licence": place.licence,
        "limits": f"of {maker.source}" if maker else "of the URDF",
        "get": None if there else ", or ".join(dict.fromkeys(one.command for one in listed.places)),
    }


def _print(rows: list[dict[str, Any]]) -> None:
    width = max(len(row["name"]) for row in rows)
    for row in rows:
        where = f"here, {row['package']}" if row["here"] else f"not here; {row['get']}"
        click.echo(f"{row['name']:{width}}  {where} ({row['licence']}); limits {row['limits']}")
    here = sum(row["here"] for row in rows)
    click.echo(f"{here} of {len(rows)} are on this machine; the path of a URDF or xacro file works as well")
