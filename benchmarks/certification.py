"""Tell how fast the exact solver is: tables from the committed rows of campaigns, and its first solves.

    python -m benchmarks.certification            tables of exact.csv, reduced.csv and longer.csv, into README.md
    python -m benchmarks.certification --start    first solves: nothing compiled, and new process

The rows themselves, in paper_results/, come from `python -m mamttsp campaign --profile exact` and `--profile reduced`,
and from `longer.py`.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil

from benchmarks.readme import write_section
from mamttsp import paper_instance, solve
from mamttsp.experiments.campaigns.rows import INSTANCE
from mamttsp.experiments.summaries.row_statistics import conditions, read_table

RESULTS = Path(__file__).parent.parent / "paper_results"
_FORMATS = (".0f", ".0f", ".0f", ".0f", ".0f", ".2f", ".2f", ".4f", ".0f")


def certified(rows):
    """Return a DataFrame: of each n, window and number of agents, how many are certified, and how soon."""
    groups = rows.groupby(["n", "total_window", "agents"])
    return groups.agg(
        runs=("solved", "size"),
        certified=("solved", "sum"),
        median_s=("solve_time_s", "median"),
        worst_s=("solve_time_s", "max"),
        worst_gap_percent=("gap_percent", "max"),
        memory_mb=("memory_mb", "max"),
    )


def ratios(exact, others):
    """Return a DataFrame: of each route and n, time of the route over time of the exact method, instance by instance.

    A run of the route that proved nothing counts with the time it took, so such a ratio is a lower bound. slower: runs
    in which the exact method took longer than a run of the route that did prove its optimum.
    """
    exact_time = exact[exact.solved].set_index(INSTANCE).solve_time_s.rename("exact_s")
    both = others.join(exact_time, on=INSTANCE, how="inner")
    both["ratio"] = both.solve_time_s / both.exact_s
    both["slower"] = both.solved & (both.ratio < 1.0)
    groups = both.groupby(["route", "n"])
    return groups.agg(
        runs=("ratio", "size"),
        solved=("solved", "sum"),
        median_ratio=("ratio", "median"),
        least_ratio=("ratio", "min"),
        slower=("slower", "sum"),
    )


def tables(folder):
    """Yield the lines of the tables, each with the conditions of its rows."""
    exact = read_table(folder / "exact.csv")
    yield f'Certified by `method="exact"`; {conditions(exact)}.'
    yield from ("", certified(exact).reset_index().to_markdown(index=False, floatfmt=_FORMATS))
    for name in ("reduced.csv", "longer.csv"):
        others = read_table(folder / name)
        yield from ("", f'Time over the time of `method="exact"`, of `{name}`; {conditions(others)}.', "")
        yield ratios(exact, others).reset_index().astype({"n": int}).to_markdown(index=False, floatfmt=".1f")


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
    memory = psutil.Process().memory_info().rss / 1e6
    print(f"first solve {times[0]:.1f} s, second {times[1]:.1f} s, {memory:.0f} MB")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=RESULTS, help="folder of the three files")
    parser.add_argument("--start", action="store_true", help="measure first solves instead")
    parser.add_argument("--two", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.two:
        return two_solves()
    if given.start:
        return print("\n".join(first_solves()))
    write_section("certification.py", list(tables(given.results)))


if __name__ == "__main__":
    main()
