"""Solve every setting of the paper by the exact method: 80 instances with {20, 40, 60} s windows and one agent, and
with 40 s windows and two to five agents. Rows are appended to a CSV file as runs finish; what has a row is not run
again.

    python benchmarks/exact.py --jobs 2                            all 560 settings, then the table
    python benchmarks/exact.py --sizes 5 10 --indices 0-1          a handful
    python benchmarks/exact.py --start                             first solves: nothing compiled, and new process

Each job has a worker process of its own, warmed up by a small instance; a worker that dies leaves a row with the status
"crashed". Times are wall time of `solve`. memory_mb is the most memory that the worker had used by the end of the run.
"""

import argparse
import csv
import multiprocessing
import os
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from importlib import metadata
from pathlib import Path
from threading import local

from tqdm import tqdm

from mamttsp import generate, paper_instance, solve
from mamttsp.generate import PAPER_INDICES, PAPER_SIZES
from mamttsp.versions import processor

RESULTS = Path(__file__).parent.parent / "paper_results" / "exact.csv"
#: (total window in s, agents)
GROUPS = ((20, 1), (40, 1), (60, 1), (40, 2), (40, 3), (40, 4), (40, 5))
KEY = ("n", "index", "total_window", "agents")
ANSWER = ("status", "objective", "bound", "gap", "runtime_s", "nodes", "memory_mb")
COLUMNS = (*KEY, *ANSWER, "time_limit", "version", "machine")


def warm_up():
    """Load the compiled code, for one agent and for several; leave Ctrl-C to the parent, or runs would end early."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for n_agents in (1, 2):
        solve(generate(6, 40, n_agents))


def run(setting, time_limit):
    """Solve a setting (n, index, total window, agents); return its answer as a row's fields."""
    n, index, total_window, agents = setting
    problem = paper_instance(n, index, total_window, agents)
    start = time.perf_counter()
    solution = solve(problem, time_limit=time_limit)
    runtime = time.perf_counter() - start
    proved = solution.status, solution.objective, solution.bound, solution.gap
    return dict(zip(ANSWER, (*proved, round(runtime, 3), solution.nodes, memory())))


def memory():
    """Return the most memory that this process has used, in MB."""
    unit = 1024**2 if sys.platform == "darwin" else 1024
    return round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit)


class Worker(local):
    """The worker process of each thread, started anew after it died."""

    pool = None

    def answer(self, setting, time_limit):
        self.pool = self.pool or ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), warm_up)
        try:
            return self.pool.submit(run, setting, time_limit).result()
        except BrokenProcessPool:
            self.pool = None
            return {"status": "crashed"}


def campaign(settings, path, jobs, time_limit):
    """Run the settings that have no row yet, and append a row for each as it finishes."""
    done = {tuple(int(row[name]) for name in KEY) for row in read(path)}
    left = [setting for setting in settings if setting not in done]
    machine = f"{processor()}, {os.cpu_count()} cores, {jobs} jobs"
    about = {"time_limit": time_limit, "version": version(), "machine": machine}
    worker, fresh = Worker(), not path.exists()
    with path.open("a", newline="", encoding="utf-8") as file, ThreadPoolExecutor(jobs) as threads:
        rows = csv.DictWriter(file, COLUMNS)
        if fresh:
            rows.writeheader()
        running = {threads.submit(worker.answer, setting, time_limit): setting for setting in left}
        try:
            for future in tqdm(as_completed(running), total=len(left), unit="run"):
                rows.writerow(dict(zip(KEY, running[future])) | future.result() | about)
                file.flush()
        except BaseException:
            threads.shutdown(wait=False, cancel_futures=True)
            for process in multiprocessing.active_children():
                process.terminate()
            raise


def version():
    """Return the package's version, and the commit where there is one."""
    command, here = ["git", "rev-parse", "--short", "HEAD"], Path(__file__).parent
    commit = subprocess.run(command, cwd=here, capture_output=True, text=True)
    return "+".join(filter(None, (metadata.version("mamttsp"), commit.stdout.strip())))


def read(path):
    """Return the rows of a results file, none if there is no file yet."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def table(rows):
    """Return the lines of a table: runs, certified, median and worst time and worst gap of each group."""
    yield "| n | window (s) | agents | runs | certified | median (s) | worst (s) | worst gap (%) | memory (MB) |"
    yield "|--:" * 9 + "|"
    groups = {}
    for row in rows:
        groups.setdefault(tuple(int(row[name]) for name in ("n", "total_window", "agents")), []).append(row)
    for (n, window, agents), group in sorted(groups.items()):
        times, gaps, sizes = (numbers(group, name) for name in ("runtime_s", "gap", "memory_mb"))
        certified = sum(row["status"] == "optimal" for row in group)
        median, slowest = (f"{of(times):.2f}" if times else "-" for of in (statistics.median, max))
        gap = f"{100 * max(gaps):.3f}" if len(gaps) == len(group) else "-"
        size = f"{max(sizes):.0f}" if sizes else "-"
        yield f"| {n} | {window} | {agents} | {len(group)} | {certified} | {median} | {slowest} | {gap} | {size} |"


def numbers(rows, name):
    """Return the numbers of a column, without the runs that have none."""
    return [float(row[name]) for row in rows if row[name]]


def first_solves():
    """Yield lines: the first and second solve of a new process, without and with the compiled code on disk."""
    with tempfile.TemporaryDirectory() as cache:
        for label in ("nothing compiled", "new process, compiled"):
            environment = os.environ | {"NUMBA_CACHE_DIR": cache}
            command = [sys.executable, __file__, "--two"]
            answer = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
            yield f"{label}: {answer.stdout.strip()}"


def two_solves():
    """Print the times of two solves of one instance in this process, and the memory used."""
    times = []
    for _ in range(2):
        start = time.perf_counter()
        solve(paper_instance(10, 0, 40, 2))
        times.append(time.perf_counter() - start)
    print(f"first solve {times[0]:.1f} s, second {times[1]:.1f} s, {memory()} MB")


def _indices(text):
    first, _, last = text.partition("-")
    return range(int(first), int(last or first) + 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=int, nargs="+", default=PAPER_SIZES, choices=PAPER_SIZES, help="targets")
    parser.add_argument("--indices", type=_indices, default=PAPER_INDICES, help="instances of each size, e.g. 0-4")
    parser.add_argument("--time-limit", type=float, default=300.0, help="seconds for each run")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time")
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    parser.add_argument("--start", action="store_true", help="measure first solves instead")
    parser.add_argument("--two", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.two:
        return two_solves()
    if given.start:
        return print("\n".join(first_solves()))
    settings = [(n, index, *group) for n in given.sizes for group in GROUPS for index in given.indices]
    campaign(settings, given.results, given.jobs, given.time_limit)
    print("\n".join(table(read(given.results))))


if __name__ == "__main__":
    main()
