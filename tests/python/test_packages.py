"""Where the packages of `package://` and `model://` are found, and what is never taken."""

from __future__ import annotations

from pathlib import Path

import pytest
from dmpcpp import InvalidArgument, arms
from dmpcpp.robot import find_mesh

from tests.python.urdfs import INERTIAL, chain, joint, link, robot

MESH = "package://own_description/meshes/part.stl"


def package(root: Path, name: str, *, manifest: str | None = None, inside: str = "meshes/part.stl") -> Path:
    folder = root / name
    (folder / inside).parent.mkdir(parents=True, exist_ok=True)
    (folder / inside).write_text("solid")
    if manifest is not None:
        (folder / "package.xml").write_text(f"<package><name>{manifest}</name></package>")
    return folder


@pytest.fixture(autouse=True)
def _no_workspace(monkeypatch) -> None:
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GAZEBO_MODEL_PATH"):
        monkeypatch.delenv(name, raising=False)


def test_a_folder_above_is_the_package_by_its_name_or_its_manifest(tmp_path: Path) -> None:
    by_name = package(tmp_path, "own_description")
    assert find_mesh(MESH, str(by_name / "urdf")) == by_name / "meshes" / "part.stl"
    renamed = package(tmp_path / "other", "checkout", manifest="own_description")
    assert find_mesh(MESH, str(renamed / "urdf")) == renamed / "meshes" / "part.stl"
    assert find_mesh(MESH, str(tmp_path / "robots")) == by_name / "meshes" / "part.stl"


def test_a_file_of_another_package_is_never_taken(tmp_path: Path) -> None:
    foreign = package(tmp_path, "foreign", manifest="foreign")
    with pytest.raises(InvalidArgument, match=r"no package 'own_description'.*State package_path=own_description=DIR"):
        find_mesh(MESH, str(foreign / "urdf"), "l1")
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "part.stl").write_text("solid")
    with pytest.raises(InvalidArgument, match=rf"It is in '{tmp_path}'; if .*package_path=own_description={tmp_path}"):
        find_mesh(MESH, str(foreign / "urdf"), "l1")
    with pytest.raises(InvalidArgument, match="no mesh 'meshes/part.stl'"):
        find_mesh("meshes/part.stl", str(tmp_path / "robots" / "own"))


def test_ros_and_ament_paths_come_before_the_folders_above(tmp_path: Path, monkeypatch) -> None:
    above = package(tmp_path, "own_description")
    ament = package(tmp_path / "install" / "share", "own_description")
    ros = package(tmp_path / "src", "own_description")
    here = str(above / "urdf")
    assert find_mesh(MESH, here) == above / "meshes" / "part.stl"
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{tmp_path / 'nothing'}:{tmp_path / 'install'}")
    assert find_mesh(MESH, here) == ament / "meshes" / "part.stl"
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    assert find_mesh(MESH, here) == ros / "meshes" / "part.stl"


def test_models_are_found_by_gazebos_path(tmp_path: Path, monkeypatch) -> None:
    model = package(tmp_path / "models", "own_description")
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(tmp_path / "models"))
    assert find_mesh(MESH.replace("package", "model"), "/nowhere") == model / "meshes" / "part.stl"


def test_paths_without_a_package(tmp_path: Path) -> None:
    folder = package(tmp_path, "own", manifest="own")
    (folder / "urdf").mkdir()
    mesh = folder / "meshes" / "part.stl"
    for name in (str(mesh), f"file://{mesh}", f"file:{mesh}", "../meshes/part.stl", "..\\meshes\\part.stl"):
        assert find_mesh(name, str(folder / "urdf")).resolve() == mesh
    assert find_mesh("meshes/part.stl", str(folder / "urdf")) == mesh  # of its own package
    assert find_mesh("../meshes/PART.STL", str(folder / "urdf")).resolve() == mesh


def test_a_stated_package_goes_before_all(tmp_path: Path, monkeypatch) -> None:
    body = INERTIAL + f'<collision><geometry><mesh filename="{MESH}"/></geometry></collision>'
    (tmp_path / "robots").mkdir()
    path = tmp_path / "robots" / "own.urdf"
    path.write_text(robot(chain(6), link("part", body), joint("p", "fixed", "l6", "part")))
    first, second = (package(tmp_path / k, "own_description") for k in ("one", "two"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "two"))
    for stated in (f"own_description={first}", str(tmp_path / "one"), str(first)):
        assert f'filename="{first}/meshes/part.stl"' in arms.load(path, package_path=[stated]).urdf
    assert MESH in arms.load(path).urdf
    assert second.is_dir()
    with pytest.raises(InvalidArgument, match="package_path: 'x=/nowhere'"):
        arms.load(path, package_path=["x=/nowhere"])
