"""Many recordings, each executed by an arm: in processes or on a cluster, resumable; a bad file stops no other.

>>> from dmpcpp import batch
>>> work = batch.tasks("clips", "out", arm="panda")                        # doctest: +SKIP
>>> outcomes = batch.imitate_many(work, jobs=2)                            # doctest: +SKIP
>>> batch.write_tables(outcomes, "out")                                    # doctest: +SKIP

On a cluster: `batch.imitate_many(work, executor=distributed.Client(address).get_executor())`; the folders of recordings
and of results must be the same files for every worker.
"""

from dmpcpp.trials.batch._many import imitate_many
from dmpcpp.trials.batch._table import first_line as first_line
from dmpcpp.trials.batch._table import summary, write_tables
from dmpcpp.trials.batch._task import Outcome, Task, carry_out, tasks

__all__ = ["Outcome", "Task", "carry_out", "imitate_many", "summary", "tasks", "write_tables"]
