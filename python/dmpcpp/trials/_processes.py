"""Worker processes that end with the work they were begun for, however that ends."""

from __future__ import annotations

import multiprocessing
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager

__all__ = ["workers"]


@contextmanager
def workers(count: int) -> Iterator[ProcessPoolExecutor]:
    """Give an executor of up to `count` processes of this machine.

    Where the block is left by an exception (an interruption too, or a generator that is closed), what runs is ended at
    once: nobody would fetch it. Otherwise it is waited for.
    """
    others = set(multiprocessing.active_children())
    # Spawned, not forked: a simulator's threads do not survive a fork.
    pool = ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn"))
    try:
        yield pool
    except BaseException:
        for worker in set(multiprocessing.active_children()) - others:
            worker.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)
