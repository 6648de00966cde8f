"""One run in a process of its own: a crash, or memory beyond the limit, costs that run and nothing else."""

import contextlib
import dataclasses
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

import psutil

WORKER = (sys.executable, "-m", "mamttsp.experiments.campaigns.worker")
#: s between two looks at a process, and s beyond twice its time limit after which it is ended
_POLL, _GRACE = 0.1, 120.0
_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS"), "1")


def run_apart(run, memory_limit, stop, command=None):
    """Return the row's fields for a run, or None if `stop` (an Event) ended it.

    memory_limit: MB of resident memory; command: reads the run and writes the answer, as `worker` does (default: this
    machine's `WORKER`).
    Statuses beside those of a Solution: "crashed" (the process died), "memory" (it passed the limit), "overrun" (far
    beyond the time limit it was still running) and "error" (an exception, see `message`).
    """
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = _start(run, command or WORKER, out, err)
        try:
            verdict, memory = _watch(process, memory_limit, time.monotonic() + 2 * run.time_limit + _GRACE, stop)
        finally:
            process.kill()
            process.wait()
        if verdict == "stopped":
            return None
        answer = {"status": verdict} if verdict else _answer(process.returncode, _content(out), _content(err))
    return answer | {"memory_mb": round(memory), "memory_limit_mb": memory_limit}


def _start(run, command, out, err):
    # A session of its own: Ctrl-C reaches the campaign only, else the run would take it for its time limit.
    where = {"stdout": out, "stderr": err, "env": os.environ | _ONE_THREAD, "start_new_session": True}
    process = subprocess.Popen(command, stdin=subprocess.PIPE, **where)
    with contextlib.suppress(BrokenPipeError):  # it died already, and its exit status tells
        process.stdin.write(json.dumps(dataclasses.asdict(run) | {"campaign": os.getpid()}).encode())
        process.stdin.close()
    return process


def _watch(process, memory_limit, deadline, stop):
    """Wait for the process; return why it has to be ended, None if it ended by itself, and its peak memory in MB."""
    most = 0.0
    while process.poll() is None:
        with contextlib.suppress(psutil.Error):  # it may end between two looks
            most = max(most, psutil.Process(process.pid).memory_info().rss / 2**20)
        if most > memory_limit:
            return "memory", most
        if time.monotonic() > deadline:
            return "overrun", most
        if stop.is_set():
            return "stopped", most
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(_POLL)
    return None, most


def _answer(returncode, out, err):
    if returncode == 0:
        return json.loads(out)
    how = signal.Signals(-returncode).name if returncode < 0 else f"exit status {returncode}"
    last = err.strip().splitlines()[-1:]
    return {"status": "crashed", "message": ": ".join([how, *last])[:200]}


def _content(file):
    file.seek(0)
    return file.read().decode(errors="replace")
