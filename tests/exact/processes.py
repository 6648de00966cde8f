"""A process that solves, watched from outside: what it still computes once it was told to stop.

Counted is its processor time, which on an idle machine is the time that passes, and which a busy one does not lengthen.
"""

import contextlib
import signal
import subprocess
import sys
import time

import psutil

from mamttsp import Solution

#: The first solve loads what is compiled, so that what is stopped later is the search.
_SOLVE = """
import sys

from mamttsp import Instance, solve

problem = Instance.read(sys.argv[1])
solve(problem, time_limit=0.5)
for limit in sys.stdin:
    print("search", flush=True)
    solve(problem, gap=1e-6, time_limit=float(limit)).write(sys.argv[2])
    print("done", flush=True)
"""


class Process:
    """A running process; see `solving`."""

    def __init__(self, popen, answer):
        self.popen, self.answer, self.watched = popen, answer, psutil.Process(popen.pid)

    def _spent(self):
        spent = self.watched.cpu_times()
        return spent.user + spent.system

    def _expect(self, line):
        assert self.popen.stdout.readline() == f"{line}\n"

    def run(self, limit, interrupted=None):
        """Solve with a time limit in s, perhaps with Ctrl-C pressed after so many s; return (Solution, late): the s
        that it computed after the limit or the key."""
        print(limit, file=self.popen.stdin, flush=True)
        self._expect("search")
        time.sleep(limit if interrupted is None else interrupted)
        before = self._spent()
        if interrupted is not None:
            self.popen.send_signal(signal.SIGINT)
        self._expect("done")
        return Solution.read(self.answer), self._spent() - before


@contextlib.contextmanager
def solving(problem, folder):
    """Return a Process that solves the problem as often as it is told, with files in a folder."""
    problem.write(folder / "instance.json")
    arguments = sys.executable, "-c", _SOLVE, str(folder / "instance.json"), str(folder / "solution.json")
    with subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as popen:
        yield Process(popen, folder / "solution.json")
        popen.stdin.close()
    assert popen.returncode == 0
