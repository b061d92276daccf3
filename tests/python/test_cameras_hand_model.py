"""The hand model: obtained once, checked by its sums, named where it is missing."""

import hashlib
from zipfile import ZipFile

import pytest
from click.testing import CliRunner
from dmpcpp import cameras, doctor
from dmpcpp.cameras import _hand_model
from dmpcpp.cli import main
from dmpcpp.errors import InvalidArgument, MissingDependency

NETS = {"palm_detection_full.tflite": b"a palm", "hand_landmark_full.tflite": b"a hand"}


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    sums = {name: hashlib.sha256(content).hexdigest() for name, content in NETS.items()}
    monkeypatch.setattr(_hand_model, "_SUMS", sums)


def wheel(folder, contents=NETS, licence=True):
    path = folder / "mediapipe-0.10.21-py3-none-any.whl"
    with ZipFile(path, "w") as archive:
        for name, content in contents.items():
            archive.writestr(f"mediapipe/modules/{name}", content)
        if licence:
            archive.writestr("mediapipe-0.10.21.dist-info/LICENSE", "Apache License")
    return path


def test_the_networks_and_their_licence_are_kept_in_the_users_cache(tmp_path):
    folder = cameras.get_hand_model(wheel(tmp_path))
    assert folder == tmp_path / "cache" / "dmpcpp" / "hand-model"
    assert sorted(path.name for path in folder.iterdir()) == ["LICENSE", *sorted(NETS)]
    assert [path.read_bytes() for path in cameras.net_files()] == list(NETS.values())


def test_another_version_of_a_network_is_refused_and_nothing_kept(tmp_path):
    other = wheel(tmp_path, {**NETS, "hand_landmark_full.tflite": b"another"})
    with pytest.raises(InvalidArgument, match=r"hand_landmark_full\.tflite is another version"):
        cameras.get_hand_model(other)
    assert not (tmp_path / "cache").exists()


@pytest.mark.parametrize("content", [b"", b"no zip"])
def test_a_file_that_is_no_wheel_is_refused(tmp_path, content):
    path = tmp_path / "a.whl"
    path.write_bytes(content)
    with pytest.raises(InvalidArgument, match="no wheel"):
        cameras.get_hand_model(path)


def test_a_wheel_without_the_networks_is_refused(tmp_path):
    with pytest.raises(InvalidArgument, match=r"holds no palm_detection_full\.tflite"):
        cameras.get_hand_model(wheel(tmp_path, {}))


def test_where_they_are_missing_the_command_is_named(tmp_path):
    with pytest.raises(MissingDependency, match="dmpcpp doctor --get hand-model"):
        cameras.net_files()
    part = next(part for part in doctor.examine().parts if part.name == "hand model")
    assert (part.ok, part.needed, part.to_do) == (False, False, "dmpcpp doctor --get hand-model")


def test_a_damaged_file_is_not_run(tmp_path):
    folder = cameras.get_hand_model(wheel(tmp_path))
    (folder / "palm_detection_full.tflite").write_bytes(b"half")
    with pytest.raises(MissingDependency, match="Obtain it anew"):
        cameras.net_files()


def test_the_command_takes_a_wheel_and_says_where_it_put_them(tmp_path):
    run = CliRunner().invoke(main, ["doctor", "--get", "hand-model", "--wheel", str(wheel(tmp_path))])
    assert (run.exit_code, run.output) == (0, f"hand model: {tmp_path / 'cache' / 'dmpcpp' / 'hand-model'}\n")
    alone = CliRunner().invoke(main, ["doctor", "--wheel", "a.whl"])
    assert alone.exit_code == 2
    assert "--get hand-model" in alone.output
