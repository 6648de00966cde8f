"""How far the exact solver reaches: more targets than the paper has, and what stops it there.

    python -m benchmarks.scale            the runs that have no row in paper_results/scale.csv yet, then the table

Windows of 40 s, each run in a process of its own within 600 s; the table goes into README.md. The horizon grows with n,
or no single agent could fly the random tour that the windows come from.
"""

import argparse
from pathlib import Path

import pandas as pd

from benchmarks.readme import write_section
from benchmarks.solves import add_rows, answer, markdown, read_rows, without_row
from mamttsp import generate

RESULTS = Path(__file__).parent.parent / "paper_results" / "scale.csv"
#: (targets, agents, horizon in s, straight pieces of a path)
SIZES = ((25, 3, 200, 6), (25, 5, 200, 6), (30, 3, 250, 7), (30, 5, 250, 7), (40, 3, 400, 11), (40, 5, 400, 11))
SIZES = (*SIZES, (50, 10, 500, 14))
KEY = ["n", "agents", "horizon", "pieces", "seed", "time_limit"]


def run(n, agents, horizon, pieces, seed, time_limit):
    """Solve an instance; return its row, see `solves.answer`."""
    instance = generate(n, 40, agents, seed=seed, horizon=horizon, n_pieces=pieces)
    return dict(zip(KEY, (n, agents, horizon, pieces, seed, time_limit))) | answer(instance, time_limit)


def runs_left(rows, seeds, time_limit):
    """Return the arguments of the runs without a row."""
    return without_row([(*size, seed, time_limit) for seed in seeds for size in SIZES], rows, KEY)


def table(rows):
    """Yield the lines of the table, its conditions first."""
    rows = pd.DataFrame(rows).sort_values(KEY, kind="stable")
    rows["labels"] = (rows.labels / 1e6).round(1)
    rows = rows.rename(columns={"labels": "labels_millions"})
    one = rows.iloc[0]
    yield f"Windows of 40 s, limit {one.time_limit:g} s, gap to close 0.01 %, one thread; {one.cpu}."
    shown = ["n", "agents", "horizon", "seed", "status", "objective", "gap_percent", "solve_time_s", "rounds"]
    shown += ["labels_millions", "columns", "memory_mb", "last_phase"]
    yield from ("", markdown(rows[shown]), "", "Where the time went, in s:", "")
    phases = [name for name in rows if name.endswith("_s") and name != "solve_time_s"]  # those of the rows' version
    yield markdown(rows[["n", "agents", "seed", *phases]])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    parser.add_argument("--seeds", type=int, nargs="*", default=(0, 1), help="instances of each size")
    parser.add_argument("--time-limit", type=float, default=600.0, help="s for each run")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time")
    given = parser.parse_args()
    rows = read_rows(given.results)
    left = runs_left(rows, given.seeds, given.time_limit)
    rows = add_rows(given.results, rows, run, left, given.jobs)
    write_section("scale.py", list(table(rows)))


if __name__ == "__main__":
    main()
