"""Arms by name: what is here, what can be had and from where, with limits of makers; nothing is fetched unasked."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest
from dmpcpp import InvalidArgument, arms
from dmpcpp.errors import FileError, MissingDependency

from tests.python.command import run
from tests.python.urdfs import chain, robot

TABLE = """
REPOSITORIES = {
    "own-repository": Repository(url="https://nowhere.invalid/own.git", commit="0", cache_path="own"),
}
"""
MODULE = """
from os import getenv as _getenv
from os import path as _path
from ._cache import clone_to_cache as _clone_to_cache
REPOSITORY_PATH: str = _clone_to_cache("own-repository", commit=_getenv("ROBOT_DESCRIPTION_COMMIT", None))
PACKAGE_PATH: str = _path.join(REPOSITORY_PATH, "own_description")
{path}
"""


@pytest.fixture
def descriptions(tmp_path: Path, monkeypatch) -> Path:
    """A package robot_descriptions of our own that breaks when anybody imports it, and a cache."""
    package = tmp_path / "site" / "robot_descriptions"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "_repositories.py").write_text(TABLE)
    urdf = 'URDF_PATH: str = _path.join(PACKAGE_PATH, "own.urdf")'
    (package / "own_arm_description.py").write_text(MODULE.format(path=urdf))
    (package / "own_arm_mj_description.py").write_text(MODULE.format(path="MJCF_PATH: str = 'own.xml'"))
    for name in [name for name in sys.modules if name.split(".")[0] == "robot_descriptions"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.syspath_prepend(str(package.parent))
    monkeypatch.setenv("ROBOT_DESCRIPTIONS_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_what_the_cache_holds_is_not_cloned_again_and_a_failed_clone_is_one_sentence(descriptions: Path) -> None:
    """The package breaks when it is imported, as it does without a network."""
    package = next(Path(entry) for entry in sys.path if (Path(entry) / "robot_descriptions").is_dir())
    broken = "raise RuntimeError(\"Cmd('git') failed\\n  stderr: 'fatal: no such host'\")\n"
    (package / "robot_descriptions" / "own_arm_description.py").write_text(broken)
    with pytest.raises(
        FileError, match=r"own_arm_description: cannot be cloned into '.*cache' \(fatal: no such host\)"
    ):
        arms.fetch("own_arm_description")
    urdf = 'URDF_PATH: str = _path.join(PACKAGE_PATH, "own.urdf")'
    (package / "robot_descriptions" / "own_arm_description.py").write_text(MODULE.format(path=urdf))
    folder = descriptions / "own" / "own_description"
    folder.mkdir(parents=True)
    (folder / "own.urdf").write_text(robot(chain(6)))
    assert arms.fetch("own_arm_description") == folder / "own.urdf"
    with pytest.raises(MissingDependency, match="has no other_description"):
        arms.fetch("other_description")


@pytest.mark.parametrize("name", ["own_arm", "OWN-ARM", "ownarm", "robot_descriptions:own_arm", "own_arm_description"])
def test_an_arm_of_robot_descriptions_is_read_from_its_cache(name: str, descriptions: Path) -> None:
    with pytest.raises(MissingDependency, match=r"not on this machine.*dmpcpp arms --fetch own_arm"):
        arms.load(name)
    assert not descriptions.exists()
    folder = descriptions / "own" / "own_description"
    folder.mkdir(parents=True)
    (folder / "own.urdf").write_text(robot(chain(6)))
    arm = arms.load(name)
    assert (arm.name, arm.tip, arm.joint_count) == ("own", "l6", 6)
    assert Path(arm.folder) == folder
    assert arms.load(name, tip="l4").joint_count == 4


def test_an_unknown_name_lists_the_nearest_with_where_they_come_from() -> None:
    with pytest.raises(InvalidArgument, match=r"'ur5ee' is not known. Nearest are ur5e \(airo-models\), ") as refused:
        arms.load("ur5ee")
    assert str(refused.value).split(";")[0].count("(") == 3


@pytest.mark.parametrize("name", ["panda", "PANDA", "Pan_da", "x-Arm6", "IIWA"])
def test_case_dashes_and_underscores_do_not_count(name: str) -> None:
    pytest.importorskip("pybullet_data")
    assert arms.load(name).joint_count in (6, 7)


def test_a_known_arm_takes_another_base_and_tip_and_keeps_its_makers_limits() -> None:
    pytest.importorskip("pybullet_data")
    whole, part = arms.find("iiwa"), arms.find("iiwa", tip="lbr_iiwa_link_4")
    assert part.joint_count == 4
    np.testing.assert_array_equal(part.velocity_limit, whole.velocity_limit[:4])
    assert part.limit_sources["effort"] == whole.limit_sources["effort"][:4]


def test_every_name_is_one_and_says_where_it_comes_from() -> None:
    keys = [listed.name.replace("_", "").lower() for listed in arms.listed()]
    assert len(set(keys)) == len(keys)
    for listed in arms.listed():
        assert listed.places
        assert all(place.licence and place.command for place in listed.places)
        assert not listed.limits or listed.limits in arms.MAKERS


def test_makers_limits_are_those_of_one_arm_each_and_name_their_source() -> None:
    used = {listed.limits for listed in arms.listed() if listed.limits}
    assert len(used) >= 10
    for name, limits in arms.MAKERS.items():
        counts = {
            len(values) for kind in ("velocity", "acceleration", "jerk", "effort") if (values := getattr(limits, kind))
        }
        assert len(counts) == 1, name
        assert len(limits.source) > 20


@pytest.mark.parametrize(
    ("name", "package"), [("ur5e", "airo_models"), ("xarm7", "cmeel"), ("gen3", "cmeel"), ("so101", "cmeel")]
)
def test_listed_arms_load_where_their_package_is_installed(name: str, package: str) -> None:
    if not next(one for one in arms.listed() if one.name == name).found():
        pytest.skip(f"needs the package of {name}")
    arm = arms.load(name)
    assert arm.choice
    maker = next(one for one in arms.listed() if one.name == name).limits
    if maker:
        np.testing.assert_allclose(arm.velocity_limit, arms.MAKERS[maker].velocity)
        assert {source.name for source in arm.limit_sources["velocity"]} == {"maker"}


def test_the_command_lists_names_packages_and_licences(tmp_path: Path) -> None:
    rows = json.loads(run("arms", "--json", cwd=tmp_path).stdout)
    assert {"name", "here", "path", "package", "licence", "limits", "get"} <= set(rows[0])
    assert all(row["here"] or row["get"] for row in rows)
    told = run("arms", cwd=tmp_path).stdout
    assert f"of {len(rows)} are on this machine" in told
    assert "BSD-3-Clause" in told
    refused = run("arms", "--fetch", "nobody", cwd=tmp_path)
    assert refused.returncode == 2
    assert "--fetch: 'nobody'" in refused.stderr
