"""`dmpcpp example`: small files to type along with, the same bytes each time, read without a question left."""

import numpy as np
import pytest
from click.testing import CliRunner
from dmpcpp import examples, recordings
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument

WRITTEN = sorted(set(examples.EXAMPLES) - {"log"})


@pytest.mark.parametrize("name", WRITTEN)
def test_an_example_is_small_and_the_same_each_time(name, tmp_path):
    first = examples.write(name, tmp_path / "a")
    second = examples.write(name, tmp_path / "b")
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes()
        assert one.stat().st_size < 33_000


def test_the_list_names_every_example_and_its_files():
    done = CliRunner().invoke(main, ["example"])
    assert done.exit_code == 0
    for name, example in examples.EXAMPLES.items():
        assert name in done.output
        assert all(file in done.output for file in example.files)


def test_a_file_with_other_contents_is_replaced_only_when_asked(tmp_path):
    path = tmp_path / "reach.bvh"
    path.write_text("mine")
    with pytest.raises(InvalidArgument, match=r"reach\.bvh: is there already with other contents\. Replace it with"):
        examples.write("reach", tmp_path)
    assert path.read_text() == "mine"
    examples.write("reach", tmp_path, overwrite=True)
    assert path.read_text().startswith("HIERARCHY")
    examples.write("reach", tmp_path)  # the same contents are no conflict


def test_the_command_names_the_option_that_replaces(tmp_path):
    (tmp_path / "reach.bvh").write_text("mine")
    done = CliRunner().invoke(main, ["example", "reach", "--out", str(tmp_path)])
    assert done.exit_code == 2 and "Replace it with --overwrite." in done.output
    assert CliRunner().invoke(main, ["example", "reach", "--out", str(tmp_path), "--overwrite"]).exit_code == 0


def test_one_take_that_is_in_the_way_leaves_the_others_unwritten(tmp_path):
    (tmp_path / "takes").mkdir()
    (tmp_path / "takes" / "reach_3.csv").write_text("mine")
    with pytest.raises(InvalidArgument):
        examples.write("takes", tmp_path)
    assert [path.name for path in (tmp_path / "takes").iterdir()] == ["reach_3.csv"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["nothing"], ["'nothing'", "reach, takes"]),
        (["log"], ["--run", "missing"]),
        (["reach", "--run", "somewhere"], ["--run", "somewhere"]),
        (["log", "--run", "nowhere"], ["joints.csv", "folder of a verified run"]),
    ],
)
def test_what_cannot_be_written_says_what_to_do(arguments, words, tmp_path):
    done = CliRunner().invoke(main, ["example", *arguments, "--out", str(tmp_path)])
    assert done.exit_code == 2
    assert all(word in done.output for word in words), done.output
    assert list(tmp_path.iterdir()) == []


def test_the_unknown_name_is_refused_in_python_too(tmp_path):
    with pytest.raises(InvalidArgument, match="name: 'x'"):
        examples.write("x", tmp_path)


def read(name, tmp_path, file=None, **stated):
    paths = examples.write(name, tmp_path)
    return recordings.load(paths[0] if file is None else tmp_path / file, **stated)


def test_the_reach_is_a_reach_of_two_seconds(tmp_path):
    reach = read("reach", tmp_path, body="RightHand", unit="cm")
    assert reach.duration == pytest.approx(2.0, abs=1e-4)
    way = np.linalg.norm(reach.position[-1] - reach.position[0])
    assert 0.15 < way < 0.6
    speed = np.linalg.norm(np.diff(reach.position, axis=0), axis=1)
    assert speed[0] < 0.02 * speed.max() > speed[-1]  # from rest to rest


def test_the_screw_turns_by_one_and_a_half_turns(tmp_path):
    screw = read("screw", tmp_path)
    steps = np.einsum("tji,tjk->tik", screw.rotation[:-1], screw.rotation[1:])
    turned = np.arctan2(steps[:, 1, 0], steps[:, 0, 0]).sum()
    assert turned == pytest.approx(3 * np.pi, abs=0.01)


def test_the_phone_has_lost_samples_and_the_stirring_six_rounds(tmp_path):
    phone = read("phone", tmp_path)
    assert np.diff(phone.time).max() > 0.1
    stir = read("stir", tmp_path)
    around = np.unwrap(np.arctan2(stir.position[25:195, 1] - 0.0, stir.position[25:195, 0] - 0.45))
    assert (around[-1] - around[0]) / (2 * np.pi) == pytest.approx(5.6, abs=0.1)


def test_a_session_has_five_reaches(tmp_path):
    from dmpcpp import motion

    assert len(motion.segments(read("session", tmp_path))) == 10  # there and back
