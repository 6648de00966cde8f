"""Runs that need no solver: a script in the place of the worker, and campaigns with it in processes of their own."""

import contextlib
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import psutil

from mamttsp.experiments import Run, read_rows
from mamttsp.experiments.campaigns.process import WORKER

FAKE_WORKER = (sys.executable, str(Path(__file__).with_name("fake_worker.py")))
#: a campaign on runs 0 to N-1, which the script does in S seconds each
_CAMPAIGN = """
import signal, sys
from mamttsp.experiments import Run, campaign
signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background job is started without it
path, number, seconds, scheduler, *command = sys.argv[1:]
runs = [Run(5, index, 20, 1, "fake", None, None, float(seconds)) for index in range(int(number))]
where = {"scheduler": scheduler} if scheduler else {"jobs": 2}
left = campaign(runs, path, quiet=True, command=command, **where)
print(len(left))
"""


def fake_run(index, time_limit=0.01):
    """Return a run that the script answers after `time_limit` seconds."""
    return Run(5, index, 20, 1, "fake", None, None, time_limit)


def start_campaign(path, number, seconds, command=FAKE_WORKER, scheduler=""):
    """Start a campaign on `number` fake runs of `seconds` each in a process of its own."""
    arguments = [sys.executable, "-c", _CAMPAIGN, str(path), str(number), str(seconds), scheduler, *command]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(arguments, **pipes, start_new_session=True)


def wait_for_rows(path, number, process, seconds=60):
    """Wait until the file has `number` rows; fail if the process ends before."""
    wait_until(lambda: process.poll() is not None or (path.exists() and len(read_rows(path)) >= number), seconds)
    assert process.poll() is None, process.stderr.read()


def wait_until(holds, seconds=60):
    """Wait until `holds()`; fail if that takes too long."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, "it did not happen in time"
        time.sleep(0.02)


def children(process, number=1):
    """Return the processes that do the runs of a campaign or a cluster's worker, once there are `number` of them."""
    parent = psutil.Process(process.pid)
    wait_until(lambda: len(_workers(parent)) >= number)
    return _workers(parent)


def _workers(parent):
    """A campaign starts git as well, for a moment."""
    found = []
    for child in parent.children():
        with contextlib.suppress(psutil.Error):  # it may end while it is looked at
            if child.cmdline()[1:2] == [FAKE_WORKER[1]] or child.cmdline()[1:] == list(WORKER[1:]):
                found.append(child)
    return found


def indices(path):
    """Return the instances that have a row, sorted."""
    return sorted(int(row["index"]) for row in read_rows(path))


@contextlib.contextmanager
def largest_file(size):
    """As if the disk were full: no file may grow beyond `size` bytes, and a write that does is done in part."""
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, handler)
