"""A campaign: the runs that have no row yet, several at a time, here or on a cluster, each appended as it finishes."""

import contextlib
import threading
import warnings
from dataclasses import asdict
from functools import partial

from joblib import Parallel, delayed

from ...backends import backend
from ...validation import InputError, file_path, listed, of_type, positive, whole
from .bar import campaign_bar
from .process import run_apart
from .provenance import now, provenance
from .results import Results
from .rows import key_of
from .runs import Run

#: MB of resident memory for each run
MEMORY_LIMIT = 4000


def campaign(runs, path, jobs=None, memory_limit=MEMORY_LIMIT, quiet=False, command=None, scheduler=None):
    """Do the runs that have no row in the CSV file `path`, and return the runs that have none at the end.

    Those are runs that another campaign on the same file has in flight: campaigns share a file and its work.
    jobs: runs at the same time, each with one thread (default: 1); memory_limit: MB for each run; quiet: no progress
    bar; command: what a run's process executes. scheduler: address of a dask.distributed cluster that does the runs,
    as many at a time as its workers have threads. A campaign that was killed goes on from its rows when it is called
    again.

    InputError: a bad argument, a solver that is not installed, a file that is not ours or cannot be written, or a
    cluster that is not there.

    >>> import tempfile
    >>> from mamttsp.experiments import campaign, profile, read_rows
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     left = campaign(profile("smoke")[1:2], f"{folder}/rows.csv", quiet=True)
    ...     (row,) = read_rows(f"{folder}/rows.csv")
    >>> left, row["method"], row["status"]
    ([], 'micp', 'optimal')
    """
    runs, path = listed("runs", runs, Run), file_path("path", path)
    rows_of = _in_processes(jobs) if scheduler is None else _on_cluster(scheduler, jobs)
    positive("memory_limit", memory_limit)
    for solver in {run.solver for run in runs} - {None}:
        backend(solver)
    with Results(path) as results:
        left = _without_row(runs, results)
        with campaign_bar(len(runs), len(runs) - len(left), quiet) as bar:
            ours = (run for run in left if results.claim(key_of(asdict(run))))
            rows = rows_of(ours, memory_limit=memory_limit, command=command, bar=bar)
            with contextlib.closing(rows):  # whatever goes wrong here, the processes are ended
                for row in rows:
                    results.append(row)
                    bar.update()
        return _without_row(runs, results)


def _in_processes(jobs):
    return partial(rows_apart, jobs=whole("jobs", 1 if jobs is None else jobs, 1))


def _on_cluster(scheduler, jobs):
    of_type("scheduler", scheduler, str)
    if jobs is not None:
        raise InputError(f"jobs: a cluster does as many runs at a time as its workers have threads, found {jobs}")
    try:
        from .cluster import cluster_rows
    except ImportError as error:
        raise InputError(f"scheduler: {error}; install it with: pip install distributed") from error
    return partial(cluster_rows, scheduler=scheduler)


def _without_row(runs, results):
    done = results.keys()
    return [run for run in runs if key_of(asdict(run)) not in done]


def rows_apart(runs, jobs, memory_limit, bar, command=None):
    """Yield a row for each run as it finishes, `jobs` at a time. Each thread waits for the process of a run, so threads
    are enough. Whoever stops early closes it, and the processes are ended."""
    about, stop, running = provenance(jobs), threading.Event(), _Running(bar)

    def row(run):
        with running:
            answer = run_apart(run, memory_limit, stop, command)
        return answer and asdict(run) | about | answer | {"date": now()}

    parallel = Parallel(jobs, backend="threading", return_as="generator_unordered", pre_dispatch="n_jobs", batch_size=1)
    finished = parallel(delayed(row)(run) for run in runs)
    try:
        yield from filter(None, finished)
    finally:
        stop.set()
        with warnings.catch_warnings(action="ignore", category=UserWarning):  # joblib's, of runs that were ended
            finished.close()
        running.wait_for_none()


class _Running:
    """Counts the runs in flight and shows their number beside the bar: a context manager around each."""

    def __init__(self, bar):
        self._bar, self._count, self._changed = bar, 0, threading.Condition()

    def __enter__(self):
        self._add(1)

    def __exit__(self, *exception):
        self._add(-1)

    def wait_for_none(self):
        """Wait until the runs in flight are ended: at the program's end their threads would leave them behind."""
        with self._changed:
            self._changed.wait_for(lambda: self._count == 0)

    def _add(self, change):
        with self._changed:
            self._count += change
            self._changed.notify_all()
            self._bar.set_postfix_str(f"{self._count} running")
