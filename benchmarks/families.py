"""How far the exact solver reaches on families of instances: neighbours of the paper's recipe, windows that crowd, wide
windows, types of agents, capacities.

    python -m benchmarks.families FAMILY --seeds 1000 1001 ...    the runs that have no row yet, then the tables

FAMILY is one of FAMILIES below, each seed one instance; each run is a process of its own. The rows go into
paper_results/families.csv, the tables into README.md.
"""

import argparse
import functools
from pathlib import Path

import pandas as pd

from benchmarks.readme import write_section
from benchmarks.solves import add_rows, answer, markdown, read_rows, without_row
from mamttsp import generate
from mamttsp.library import beyond_the_paper, make, parameters

RESULTS = Path(__file__).parent.parent / "paper_results" / "families.csv"
KEY = ["family", "seed", "time_limit"]


def _in_library(name, n_agents, seed):
    """The instance of the library's series of that name with this seed, which is its index for those in the library."""
    return make(parameters()[name.format(0)] | {"seed": seed}).with_agents(n_agents)


def _beyond(series, n, seed):
    return make(beyond_the_paper(series, n, seed))


#: by name: what makes the instance of a seed; seeds of the library's series are its indices
FAMILIES = {
    "n20-w60-m1": lambda seed: generate(20, 60, 1, seed=seed),
    "n20-w40-m2": lambda seed: generate(20, 40, 2, seed=seed),
    **{
        f"crowded-n{n}-w{w}-m{m}": functools.partial(_in_library, f"crowded-n{n}-i{{:02}}-w{w}", m)
        for n in (20, 25)
        for w in (40, 60)
        for m in (1, 3)
    },
    **{
        f"loose-n{n}-w{w}-m2": functools.partial(_in_library, f"loose-n{n}-i{{:02}}-w{w}", 2)
        for n in (10, 15, 20)
        for w in (37, 75)
    },
    "scale-n64-m12": functools.partial(_in_library, "scale-n64-i{:02}-w40", 12),
    "scale-n100-m20": functools.partial(_in_library, "scale-n100-i{:02}-w40", 20),
    "types-n20": functools.partial(_beyond, "types", 20),
    "loads-n20": functools.partial(_beyond, "loads", 20),
    "loads-n25": functools.partial(_beyond, "loads", 25),
}


def open_at_once(instance):
    """Return how many targets' windows are open at a time, in the mean over the time in which any is."""
    windows = [window for target in instance.targets for window in target.windows]
    starts, ends = zip(*windows)
    return sum(end - start for start, end in windows) / (max(ends) - min(starts))


def run(family, seed, time_limit):
    """Solve an instance; return its row, see `solves.answer`."""
    instance = FAMILIES[family](seed)
    row = dict(zip(KEY, (family, seed, time_limit))) | {"open_at_once": round(open_at_once(instance), 2)}
    return row | answer(instance, time_limit)


def runs_left(rows, families, seeds, time_limit):
    """Return the arguments of the runs without a row."""
    return without_row([(family, seed, time_limit) for family in families for seed in seeds], rows, KEY)


def summary(rows):
    """Return a DataFrame, a row for each family and limit: runs, how many are decided, and the median and the worst
    time in s."""
    rows = pd.DataFrame(rows)
    decided = rows.status.isin(("optimal", "infeasible"))
    groups = rows.assign(decided=decided).groupby(["family", "time_limit"], sort=False)
    return groups.agg(
        open_at_once=("open_at_once", "mean"), runs=("seed", "size"), decided=("decided", "sum"),
        median_s=("solve_time_s", "median"), worst_s=("solve_time_s", "max"),
        worst_gap_percent=("gap_percent", "max"), memory_mb=("memory_mb", "max"),
    ).reset_index()  # fmt: skip


def table(rows):
    """Yield the lines of the tables, their conditions first."""
    rows = pd.DataFrame(rows)
    yield f"Gap to close 0.01 %, one thread, {rows.jobs.max()} runs at a time; {rows.cpu.iloc[0]}."
    yield from ("", markdown(summary(rows)), "", "The ten that took longest:", "")
    shown = ["family", "seed", "status", "objective", "gap_percent", "solve_time_s", "rounds", "labels", "memory_mb"]
    yield markdown(rows.sort_values("solve_time_s", ascending=False, kind="stable").head(10)[shown])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("families", nargs="+", choices=FAMILIES, metavar="FAMILY", help=", ".join(FAMILIES))
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    parser.add_argument("--seeds", type=int, nargs="+", required=True, help="instances of each family")
    parser.add_argument("--time-limit", type=float, default=600.0, help="s for each run")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time")
    given = parser.parse_args()
    rows = read_rows(given.results)
    left = runs_left(rows, given.families, given.seeds, given.time_limit)
    rows = add_rows(given.results, rows, run, left, given.jobs)
    if given.results == RESULTS:
        write_section("families.py", list(table(rows)))


if __name__ == "__main__":
    main()
