"""The one reader of robot descriptions: encodings, xacro, other formats; loader and check-urdf agree."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from dmpcpp import InvalidArgument, arms, urdf_check
from dmpcpp.errors import FileError

from tests.python.command import run
from tests.python.urdfs import INERTIAL, chain, joint, link, robot

XACRO = (
    '<robot name="own" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    '<xacro:property name="length" value="0.3"/>{body}</robot>'
)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-32", "latin-1"])
@pytest.mark.parametrize("declared", [True, False])
def test_every_encoding_is_read_by_loader_and_check_alike(encoding: str, declared: bool, tmp_path: Path) -> None:
    text = robot(chain(6, prefix="fü_" if encoding != "latin-1" or declared else ""))
    head = f'<?xml version="1.0" encoding="{encoding.removesuffix("-sig").removesuffix("-le")}"?>\n' if declared else ""
    path = tmp_path / "own.urdf"
    path.write_bytes((head + text).encode(encoding))
    arm = arms.load(path)
    assert arm.joint_count == 6
    report = urdf_check.check(path)
    assert report.ok, report.defects
    assert report.arm is not None and report.arm.joint_names == arm.joint_names


@pytest.mark.parametrize(
    ("text", "word"),
    [
        ("<mujoco model='x'><worldbody/></mujoco>", "an MJCF file of MuJoCo"),
        ("<?xml version='1.0'?>\n<!-- <robot> -->\n<sdf version='1.9'/>", "an SDF file of Gazebo"),
        ("#usda 1.0\ndef Xform 'robot' {}", "a USD file"),
        ("<COLLADA/>", "a COLLADA mesh"),
    ],
)
def test_another_format_is_called_by_its_name(text: str, word: str, tmp_path: Path) -> None:
    path = tmp_path / "own.urdf"
    path.write_text(text)
    with pytest.raises(InvalidArgument, match=word):
        arms.load(path)
    (defect,) = urdf_check.check(path).defects
    assert word in defect.what and defect.fatal


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    for way in (arms.load, urdf_check.check):
        with pytest.raises(FileError, match=r"nothing\.urdf"):
            way(tmp_path / "nothing.urdf")


def test_a_leftover_of_xacro_is_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "own.urdf"
    path.write_text(XACRO.format(body=robot(chain(6)).split("\n", 1)[1].removesuffix("</robot>\n")))
    assert arms.load(path).joint_count == 6
    (defect,) = urdf_check.check(path).defects
    assert "xacro" in defect.what and not defect.fatal


def test_a_xacro_is_expanded_with_its_arguments_and_includes(tmp_path: Path) -> None:
    pytest.importorskip("xacrodoc", reason="needs the extra xacro")
    package = tmp_path / "own_description"
    (package / "urdf").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>own_description</name></package>")
    body = robot(chain(6)).split("\n", 1)[1].removesuffix("</robot>\n")
    macro = f'<xacro:macro name="arm" params="length">{body}</xacro:macro>'
    (package / "urdf" / "macro.xacro").write_text(XACRO.format(body=macro))
    path = package / "urdf" / "own.urdf.xacro"
    for include in ("macro.xacro", "$(find own_description)/urdf/macro.xacro"):
        path.write_text(XACRO.format(body=f'<xacro:include filename="{include}"/><xacro:arm length="${{length}}"/>'))
        assert arms.load(path).joint_count == 6
        assert urdf_check.check(path).ok


def test_a_xacro_that_cannot_be_expanded_is_one_error_with_the_command(tmp_path: Path) -> None:
    path = tmp_path / "own.urdf.xacro"
    path.write_text(XACRO.format(body='<xacro:include filename="missing.xacro"/><xacro:arm/>'))
    told = run("check-urdf", path.name, cwd=tmp_path)
    assert told.returncode == 3
    assert told.stdout.count("error  ") == 1
    assert "xacro own.urdf.xacro > own.urdf" in told.stdout
    done = run("demo", "--arm", path.name, cwd=tmp_path)
    assert done.returncode == 2
    assert "xacro own.urdf.xacro > own.urdf" in done.stderr


def test_without_the_package_that_expands_the_message_names_it(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "xacrodoc", None)
    path = tmp_path / "own.xacro"
    path.write_text(XACRO.format(body="<xacro:arm/>"))
    with pytest.raises(InvalidArgument, match=r"xacro own\.xacro > own\.urdf, .*dmpcpp\[xacro\]"):
        arms.load(path)


BROKEN = link("table", INERTIAL + '<collision><geometry><mesh filename="table.stl"/></geometry></collision>')


@pytest.mark.parametrize(
    ("extra", "fatal"),
    [
        (BROKEN + joint("t", "fixed", "base", "table"), False),
        (BROKEN + joint("t", "fixed", "l6", "table"), True),
        (link("wheel") + joint("w", "revolute", "base", "wheel", more='<limit effort="1" velocity="1"/>'), False),
    ],
)
def test_what_stops_a_run_is_an_error_and_what_it_survives_a_warning(extra: str, fatal: bool, tmp_path: Path) -> None:
    path = tmp_path / "own.urdf"
    path.write_text(robot(chain(6), extra))
    report = urdf_check.check(path, tip="l6")
    assert report.defects
    assert any(defect.fatal for defect in report.defects) == fatal
    done = run("demo", "--arm", path.name, "--tip", "l6", "--no-report", cwd=tmp_path)
    assert done.returncode == (2 if fatal else 0), done.stdout + done.stderr
    if "table" in extra and not fatal:
        assert "not judged: contacts of table, no mesh" in done.stdout.replace("\n", " ")
