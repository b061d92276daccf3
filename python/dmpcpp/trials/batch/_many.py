"""Many tasks over any executor of `concurrent.futures`."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import Executor, Future
from contextlib import closing

from dmpcpp.errors import InvalidArgument
from dmpcpp.trials._processes import workers
from dmpcpp.trials.batch._task import Outcome, Task, carry_out, kept

__all__ = ["imitate_many"]

Progress = Callable[[int, int, int], None]
"""Called as progress(done, not passed among them, total)."""


def imitate_many(
    work: Sequence[Task], *, executor: Executor | None = None, jobs: int = 1, progress: Progress | None = None
) -> list[Outcome]:
    """Carry out tasks, and return their outcomes in the order of the tasks.

    Parameters
    ----------
    work : sequence of Task
        Those whose folder holds their outcome already, of the same recording and options, are not made again. After
        an error they are.
    executor : concurrent.futures.Executor, optional
        Where they run, `distributed.Client.get_executor()` for a cluster; by default processes of this machine. It is
        not shut down.
    jobs : int
        Processes at a time where no executor is given.
    progress : callable, optional

    Raises
    ------
    InvalidArgument
        jobs below 1, or two tasks with one folder.
    FileError
        An outcome cannot be written.
    """
    if jobs < 1:
        raise InvalidArgument(f"jobs: {jobs}, expected 1 or more.")
    _refuse_shared_folders(work)
    done = {task.folder: outcome for task in work if (outcome := kept(task)) and outcome.verdict != "error"}
    missing = [task for task in work if task.folder not in done]
    tell = progress or (lambda done, bad, total: None)
    tell(len(done), _bad(done), len(work))
    with closing(_outcomes(missing, executor, jobs)) as outcomes:
        for outcome in outcomes:
            done[outcome.folder] = outcome
            tell(len(done), _bad(done), len(work))
    return [done[task.folder] for task in work]


def _refuse_shared_folders(work: Sequence[Task]) -> None:
    seen: dict[str, int] = {}
    for k, task in enumerate(work):
        if task.folder in seen:
            raise InvalidArgument(
                f"work[{k}].folder: '{task.folder}' is that of work[{seen[task.folder]}], expected one of its own."
            )
        seen[task.folder] = k


def _bad(done: dict[str, Outcome]) -> int:
    return sum(not outcome.ok for outcome in done.values())


def _outcomes(missing: list[Task], executor: Executor | None, jobs: int) -> Generator[Outcome]:
    if not missing:
        return
    if executor is not None:
        yield from _collected(executor, missing)
        return
    with workers(min(jobs, len(missing))) as pool:
        yield from _collected(pool, missing)


def _collected(executor: Executor, missing: list[Task]) -> Iterator[Outcome]:
    """Give outcomes as they come; on the way out, what has not begun is cancelled."""
    futures = [executor.submit(carry_out, task) for task in missing]
    try:
        yield from (future.result() for future in _as_completed(futures))
    finally:
        for future in futures:
            future.cancel()


def _as_completed(futures: list[Future[Outcome]]) -> Iterator[Future[Outcome]]:
    """Like that of `concurrent.futures`, for futures of other libraries too: they share `add_done_callback` alone."""
    import queue

    finished: queue.SimpleQueue[Future[Outcome]] = queue.SimpleQueue()
    for future in futures:
        future.add_done_callback(finished.put)
    for _ in futures:
        yield finished.get()
