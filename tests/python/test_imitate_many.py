"""Many recordings at once: one bad file does not stop the others, a stopped batch goes on, a cluster gives the same."""

import csv
import json
from concurrent.futures import ThreadPoolExecutor

import pytest
from dmpcpp import batch
from dmpcpp.errors import FileError, InvalidArgument
from dmpcpp.trials.batch import _many as many

from tests.python.command import run, write_hand

pytest.importorskip("pybullet_data")


@pytest.fixture(scope="module")
def takes(tmp_path_factory):
    """Two good recordings and a bad one."""
    folder = tmp_path_factory.mktemp("takes")
    write_hand(folder / "a.npz", turn=0.2)
    write_hand(folder / "b.npz", turn=0.5)
    (folder / "bad.npz").write_bytes(b"no recording")
    return folder


def test_one_bad_file_does_not_stop_the_others_and_the_next_run_goes_on(takes, tmp_path):
    stated = ("batch", takes, "--quat-order", "xyzw", "--arm", "iiwa", "--jobs", 2, "--out", "out", "--json")
    done = run(*stated, cwd=tmp_path)
    assert done.returncode == 3, done.stderr
    found = json.loads(done.stdout)
    assert (found["pass"], found["fail"], found["error"]) == (2, 0, 1)
    assert "bad.npz" in next(o["cause"] for o in found["outcomes"] if o["verdict"] == "error")
    with (tmp_path / "out" / "outcomes.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["verdict"] for row in rows] == ["pass", "pass", "error"]
    assert float(rows[0]["ik_to_executed_position_rmse"]) < 5e-4
    page = (tmp_path / "out" / "index.html").read_text()
    assert "2 of 3 passed" in page and "http" not in page.replace("http-equiv", "")

    made = (tmp_path / "out" / "a.npz" / "summary.json").stat().st_mtime_ns
    again = run(*stated, cwd=tmp_path)
    assert json.loads(again.stdout) == found
    assert (tmp_path / "out" / "a.npz" / "summary.json").stat().st_mtime_ns == made


def quick(task):
    """Stand in for the work where only the order of things is looked at."""
    return batch.Outcome(task.file, task.folder, task.arm, "pass", "", {}, 1.0, 0.0, task.fingerprint())


def test_outcomes_come_in_the_order_of_the_tasks_from_any_executor(takes, tmp_path, monkeypatch):
    monkeypatch.setattr(many, "carry_out", quick)
    work, told = batch.tasks(takes, tmp_path), []
    with ThreadPoolExecutor(3) as executor:
        outcomes = batch.imitate_many(work, executor=executor, progress=lambda *numbers: told.append(numbers))
    assert [outcome.file for outcome in outcomes] == [task.file for task in work]
    assert told[0] == (0, 0, 3) and told[-1] == (3, 0, 3)


def test_a_task_is_another_when_its_options_or_its_recording_change(tmp_path):
    write_hand(tmp_path / "a.npz")
    task = batch.Task(str(tmp_path / "a.npz"), "out")
    same = batch.Task(str(tmp_path / "a.npz"), "out")
    assert task.fingerprint() == same.fingerprint()
    assert batch.Task(task.file, "out", options={"seed": 1}).fingerprint() != task.fingerprint()
    before = task.fingerprint()
    write_hand(tmp_path / "a.npz", count=90)
    assert task.fingerprint() != before


def test_wrong_batches_are_refused(takes, tmp_path):
    with pytest.raises(FileError, match="the folder does not exist"):
        batch.tasks(tmp_path / "nowhere", tmp_path)
    with pytest.raises(InvalidArgument, match=r"\*\.bvh"):
        batch.tasks(takes, tmp_path, pattern="*.bvh")
    with pytest.raises(InvalidArgument, match="jobs: 0"):
        batch.imitate_many([], jobs=0)
    task = batch.Task("a", "out")
    with pytest.raises(InvalidArgument, match=r"work\[1\]\.folder"):
        batch.imitate_many([task, task])


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_a_cluster_of_two_workers_gives_what_one_process_gives(takes, tmp_path):
    distributed = pytest.importorskip("distributed")
    how = {"arm": "iiwa", "reading": {"quat_order": "xyzw"}}
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        far = batch.imitate_many(batch.tasks(takes, tmp_path / "far", **how), executor=client.get_executor())
    near = batch.imitate_many(batch.tasks(takes, tmp_path / "near", **how), jobs=1)
    assert [o.verdict for o in far] == [o.verdict for o in near] == ["pass", "pass", "error"]
    assert [o.errors for o in far] == [o.errors for o in near]
