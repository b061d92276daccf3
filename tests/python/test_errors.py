"""Errors and what they carry, on their way out of a worker process: through a pickle."""

import pickle

import dmpcpp
import numpy as np
import pytest
from dmpcpp.cli import _group as group
from dmpcpp.errors import FileError, IkError, InvalidArgument, MissingDependency, NotStated

LATIN = """<?xml version="1.0" encoding="ISO-8859-1"?>
<robot name="caf\xe9"><!-- caf\xe9 --><link name="a"/><link name="b"/>
<joint name="j\xf6int" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>""".encode("latin-1")


@pytest.mark.parametrize(
    "error",
    [
        FileError("no file"),
        InvalidArgument("x: 1"),
        MissingDependency("none"),
        NotStated(("unit", "rate"), "unit: ..."),
    ],
    ids=lambda error: type(error).__name__,
)
def test_every_error_goes_through_a_pickle(error):
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert getattr(again, "names", None) == getattr(error, "names", None)


def test_a_strict_answer_goes_through_a_pickle_with_its_report(panda):
    solver = dmpcpp.InverseKinematics(panda)
    far = np.eye(4)
    far[0, 3] = 9.0
    with pytest.raises(IkError) as one:
        solver.solve(far, strict=True)
    with pytest.raises(IkError) as path:
        solver.follow(np.array([far, far]), times=[0.0, 1.0], strict=True)
    solved, followed = (pickle.loads(pickle.dumps(missed.value)) for missed in (one, path))
    assert str(solved) == str(one.value)
    assert solved.report.status == one.value.report.status
    assert solved.report.position_error == one.value.report.position_error
    assert (solved.report.joints == one.value.report.joints).all()
    assert followed.report.summary() == path.value.report.summary()
    batch = solver.solve_many(np.array([far, solver.arm.forward_kinematics(solver.middle)]))
    again = pickle.loads(pickle.dumps(batch))
    assert again.status == batch.status
    assert (again.joints == batch.joints).all()


def test_a_urdf_in_another_encoding_is_read_named_and_sent(tmp_path):
    """Its bytes are kept as Python keeps those of file names."""
    path = tmp_path / "latin.urdf"
    path.write_bytes(LATIN)
    arm = dmpcpp.Arm.from_urdf_file(path)
    assert arm.urdf.encode("utf-8", "surrogateescape") == LATIN
    assert arm.joint_names == ["j\udcf6int"]
    again = pickle.loads(pickle.dumps(arm))
    assert again.urdf == arm.urdf
    with pytest.raises(InvalidArgument, match=r"base"):
        dmpcpp.Arm.from_urdf_file(path, base="elsewhere")


def test_an_error_of_the_system_is_said_with_its_file_and_without_its_number(tmp_path):
    with pytest.raises(OSError) as missing:
        (tmp_path / "none").read_text()
    assert group._message(missing.value) == f"{tmp_path}/none: No such file or directory."
    assert group._message(FileError("a.json: cannot be read.")) == "a.json: cannot be read."
