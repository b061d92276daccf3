"""`--config`: a run is repeated from the file beside its results alone."""

import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from dmpcpp.cli import _config as config
from dmpcpp.cli import main
from dmpcpp.show.report._record import RunRecord, write_record

from tests.python.command import run, write_hand

pytest.importorskip("pybullet_data")


def test_a_fit_is_repeated_from_its_config_alone_from_any_folder(tmp_path):
    write_hand(tmp_path / "hand.npz")
    stated = ("hand.npz", "--quat-order", "xyzw", "--end", "1.5", "--basis-count", "31", "--no-smooth")
    assert run("fit", *stated, "--out", "a/reach.json", cwd=tmp_path).returncode == 0
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    again = run("fit", "--config", "../a/reach.config.toml", "--out", "b.json", cwd=elsewhere)
    assert again.returncode == 0, again.stderr
    assert (elsewhere / "b.json").read_bytes() == (tmp_path / "a" / "reach.json").read_bytes()


def test_the_command_line_wins_over_the_file(tmp_path):
    write_hand(tmp_path / "hand.npz")
    (tmp_path / "mine.toml").write_text('[fit]\nfiles = ["hand.npz"]\nquat-order = "xyzw"\nbasis-count = 20\n')
    done = run("fit", "--config", "mine.toml", "--basis-count", "40", "--json", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert '"basis_count": 40' in done.stdout
    assert "basis-count = 40" in (tmp_path / "model.config.toml").read_text()


def test_options_are_called_in_a_file_as_on_the_command_line():
    for command in main.commands.values():
        for key in config._keys(command):
            options = {option.lstrip("-") for parameter in command.params for option in parameter.opts}
            assert key in options, f"{command.name}: {key}"
    assert config._keys(main.commands["imitate"])["export"] == "formats"


def test_an_interrupted_run_leaves_nothing_half_written(tmp_path):
    process = subprocess.Popen(
        [sys.executable, "-m", "dmpcpp", "demo", "--out", "out"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a shell's background jobs ignore it
    )
    maps = Path(f"/proc/{process.pid}/maps")
    while "pybullet" not in maps.read_text():  # in the middle of its work
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=120)
    assert process.returncode == 130 and "interrupted" in said and "Traceback" not in said
    assert not list(tmp_path.rglob("*")), "something was left behind"


def test_a_file_whose_writing_is_interrupted_is_not_there(tmp_path, monkeypatch):
    from dmpcpp import arms

    def interrupted(path, **arrays):
        Path(path).write_bytes(b"half")
        raise KeyboardInterrupt

    monkeypatch.setattr(np, "savez_compressed", interrupted)
    nothing = np.zeros((2, 2))
    record = RunRecord(arms.find("panda"), *[nothing] * 9, errors=())
    with pytest.raises(KeyboardInterrupt):
        write_record(tmp_path / "execution.npz", record)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("written", "said"),
    [("file = 3", "wrong.toml: file: 3, expected path"), ('file = "x"\nbasis-count = "many"', "--basis-count")],
)
def test_a_value_of_another_type_is_refused_with_its_place(tmp_path, written, said):
    (tmp_path / "wrong.toml").write_text(f"[imitate]\n{written}\n")
    done = run("imitate", "--config", "wrong.toml", cwd=tmp_path)
    assert done.returncode == 2
    assert said in done.stderr
