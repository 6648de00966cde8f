"""The runs of a campaign on a dask.distributed cluster: each in a process of its own, on whichever machine is free."""

import concurrent.futures
import contextlib
import time
from dataclasses import asdict

import distributed
from distributed.comm import get_address_host
from distributed.scheduler import KilledWorker

from ...validation import InputError
from .process import run_apart
from .provenance import now, provenance

#: s between two looks at the cluster, whose workers may come and go
_LOOK = 2.0
#: s to wait for the scheduler's first answer
_CONNECT = 20


def cluster_rows(runs, scheduler, memory_limit, command, bar):
    """Yield a row for each run as a worker finishes it.

    scheduler: address, such as "tcp://host:8786". As many runs are in flight as the workers have threads: a worker
    that dies has no queue, whose runs would look as if they had killed it. The scheduler sends the runs of a dead
    worker to others; a run that kills one worker after the other becomes a row with the status "crashed", without a
    machine, since none is left to ask. InputError: the cluster is not there, or no longer.
    """
    with _connected(scheduler) as client:

        def submit(run):
            futures[client.submit(run_here, run, memory_limit, command, pure=False)] = run

        futures, run = {}, next(runs, None)
        while futures or run:
            threads = sum(client.nthreads().values())
            while run and len(futures) < threads:
                submit(run)
                run = next(runs, None)
            bar.set_postfix_str(f"{len(futures)} running" if threads else "waiting for workers")
            for future in _finished(futures):
                done = futures.pop(future)
                answer = _answer(future)
                if answer is None:  # its worker took it for abandoned, when the network failed for a moment
                    submit(done)
                else:
                    yield asdict(done) | answer


def run_here(run, memory_limit, command):
    """On a worker: do a run, and return its row's fields with this machine's provenance; None if nobody waits for it.

    The run's process is the worker's child, and on Linux ends with it.
    """
    answer = run_apart(run, memory_limit, _Abandoned(), command)
    return answer and provenance(_threads_here()) | answer | {"date": now()}


class _Abandoned:
    """In the place of an Event: is set once the scheduler no longer wants the task, as when the campaign is killed."""

    def __init__(self):
        worker = distributed.get_worker()
        self._tasks, self._key = worker.state.tasks, worker.get_current_task()

    def is_set(self):
        task = self._tasks.get(self._key)
        return task is None or task.state != "executing"


def _threads_here():
    """Return how many runs share this machine at a time: the threads of all its workers."""
    here = get_address_host(distributed.get_worker().address)
    threads = distributed.get_client().nthreads()
    return sum(number for address, number in threads.items() if get_address_host(address) == here)


def _finished(futures):
    """Wait until a future is done, but no longer than to the next look; return those that are."""
    if not futures:
        time.sleep(_LOOK)
    with contextlib.suppress(TimeoutError):
        distributed.wait(list(futures), timeout=_LOOK, return_when="FIRST_COMPLETED")
    return [future for future in futures if future.done()]


def _answer(future):
    """Return the answer of a future that is done."""
    try:
        return future.result()
    except KilledWorker as error:
        message = f"killed its worker {error.allowed_failures + 1} times, at last {error.last_worker.address}"
        return {"status": "crashed", "message": message, "date": now()}
    except ImportError as error:
        raise InputError(
            f"scheduler: a worker lacks this package or a part of it ({error}); install it there"
        ) from error


@contextlib.contextmanager
def _connected(scheduler):
    """Yield a client of the scheduler; a connection that fails is one line."""
    try:
        client = distributed.Client(scheduler, timeout=_CONNECT)
    except (OSError, ValueError) as error:
        expected = "expected an address such as tcp://host:8786"
        raise InputError(f"scheduler: {expected}, no answer from {scheduler!r}") from error
    with client:
        try:
            yield client
        except (OSError, concurrent.futures.CancelledError) as error:
            kept = "the rows written so far are whole, and the same command goes on from them"
            raise InputError(f"scheduler: lost the connection to {scheduler}; {kept}") from error
