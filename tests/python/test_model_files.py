"""Model files of every version: what was written once is read for ever, to the last bit, and means the same motion."""

import json
import multiprocessing
import pickle
import re
from pathlib import Path

import dmpcpp
import numpy as np
import pytest
from dmpcpp import InvalidArgument

FOLDER = Path(__file__).parents[1] / "data" / "models"
SEQUENCES = sorted(FOLDER.glob("v*/*_sequence.json"))
DISTRIBUTIONS = sorted(FOLDER.glob("v*/*_distribution.json"))
OTHERS = {*SEQUENCES, *DISTRIBUTIONS, *FOLDER.glob("v*/motions.json")}
GOLDEN = sorted(path for path in FOLDER.glob("v*/*.json") if path not in OTHERS)
SCHEMA = (Path(__file__).parents[2] / "docs" / "model-file.md").read_text()


def names(paths):
    return [f"{path.parent.name}/{path.stem}" for path in paths]


@pytest.mark.parametrize("path", GOLDEN, ids=names(GOLDEN))
def test_a_golden_file_loads_bit_for_bit(path):
    """Python's own JSON reader, correctly rounded, is the oracle."""
    model, written = dmpcpp.load(path), json.loads(path.read_text())
    assert (model.weights == np.array(written["weights"])).all()
    assert model.duration == written["duration"]
    for end in ("start", "goal"):
        assert (getattr(model, end) == np.array(written[end])).all()
    for name, value in written["options"].items():
        read = getattr(model.options, name)
        assert getattr(read, "name", read) == value, name


@pytest.mark.parametrize("path", GOLDEN, ids=names(GOLDEN))
def test_a_golden_file_means_the_motion_it_always_meant(path):
    expected = json.loads((path.parent / "motions.json").read_text())[path.stem]
    plan = dmpcpp.load(path).rollout_at(np.linspace(0.0, 2.0, 5), duration=2.0)
    place = next(getattr(plan, name) for name in ("pose", "rotation", "position") if hasattr(plan, name))
    np.testing.assert_allclose(place, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("path", SEQUENCES, ids=names(SEQUENCES))
def test_a_golden_sequence_loads_bit_for_bit_and_means_the_motion_it_always_meant(path):
    loaded = dmpcpp.load(path)
    assert dmpcpp.to_json(loaded) == path.read_text()
    expected = json.loads((path.parent / "motions.json").read_text())[path.stem]
    moved = loaded.rollout_at(np.linspace(0.0, 8.0, 9)).pose
    np.testing.assert_allclose(moved, expected, rtol=0, atol=1e-8)


@pytest.mark.parametrize("path", DISTRIBUTIONS, ids=names(DISTRIBUTIONS))
def test_a_golden_distribution_loads_bit_for_bit_and_means_what_it_always_meant(path):
    loaded = dmpcpp.load(path)
    assert dmpcpp.to_json(loaded) == path.read_text()
    expected = json.loads((path.parent / "motions.json").read_text())[path.stem]
    np.testing.assert_allclose(loaded.sample(seed=1, samples=9).pose, expected, rtol=0, atol=1e-9)


def test_every_enumerator_stands_in_a_golden_file_and_in_the_schema():
    text = "".join(path.read_text() for path in GOLDEN)
    enums = ("Kernels", "Regression", "Scaling", "OrientationForm", "LogBranch", "Derivatives", "Start", "Integrator")
    # A fit decides what "automatic" stands for; only a file made by hand can hold it.
    for value in (value.name for enum in enums for value in getattr(dmpcpp, enum)):
        assert value == "automatic" or f'"{value}"' in text, value
        assert f"`{value}`" in SCHEMA, value


def test_every_key_of_a_file_stands_in_the_schema():
    for path in GOLDEN:
        written = json.loads(path.read_text())
        for key in (*written, *written["options"]):
            assert f"`{key}`" in SCHEMA, key


def test_an_unknown_newer_version_is_refused_with_the_reason(tmp_path):
    text = GOLDEN[0].read_text()
    newer = tmp_path / "newer.json"
    newer.write_text(re.sub(r'"version": \d+', '"version": 1000', text, count=1))
    with pytest.raises(InvalidArgument, match=r"newer\.json: version: 1000, expected 1 to 4\..*newer dmpcpp: update"):
        dmpcpp.load(newer)


def arm() -> dmpcpp.Arm:
    text = """<robot name="two"><link name="a"/><link name="b"/><link name="c"/>
      <joint name="turn" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
      <joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>
        <limit lower="0" upper="1" velocity="1" effort="1"/></joint></robot>"""
    return dmpcpp.Arm.from_urdf(text, folder="/meshes").with_limits(velocity=[2.0, 0.3])


def test_an_arm_goes_through_a_pickle_with_its_limits_and_its_folder():
    before = arm()
    after = pickle.loads(pickle.dumps(before))
    for name in ("name", "base", "tip", "folder", "urdf", "joint_names", "warnings"):
        assert getattr(after, name) == getattr(before, name)
    for name in ("lower", "upper", "velocity_limit", "effort_limit"):
        assert (getattr(after, name) == getattr(before, name)).all()
    assert (after.forward_kinematics([0.3, 0.7]) == before.forward_kinematics([0.3, 0.7])).all()


def carry_out(model: dmpcpp.PoseDmp, robot: dmpcpp.Arm) -> tuple[bytes, bytes]:
    """What another process makes of a model and an arm."""
    return model.rollout(dt=0.05).pose.tobytes(), robot.forward_kinematics([0.3, 0.7]).tobytes()


def test_other_processes_get_models_and_arms_and_answer_alike():
    model = dmpcpp.load(FOLDER / "v1" / "pose_dmp-default.json")
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        answers = pool.starmap(carry_out, [(model, arm())] * 4)
    assert set(answers) == {carry_out(model, arm())}
