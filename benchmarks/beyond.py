"""How far the exact solver reaches beyond the paper: two types of agents at two depots, and capacities.

    python -m benchmarks.beyond --seeds 1000 1001 ...    the runs that have no row yet, then the table

Instances are made as those of the library's series `types` and `loads`, with these seeds; windows of 40 s, each run in
a process of its own within 600 s. The rows go into paper_results/beyond.csv, the table into README.md.
"""

import argparse
import multiprocessing
import resource
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import pandas as pd
from tqdm import tqdm

from benchmarks.readme import write_section
from benchmarks.scale import PROVENANCE, markdown, phases
from mamttsp import paper_instance, solve
from mamttsp.display import Trace
from mamttsp.experiments.campaigns.provenance import provenance
from mamttsp.library import beyond_the_paper, make
from mamttsp.warm_up import ensure_compiled

RESULTS = Path(__file__).parent.parent / "paper_results" / "beyond.csv"
#: (series, targets): two types at two depots; four agents with capacities of which two are not enough
FAMILIES = (("types", 20), ("loads", 20), ("loads", 25))
KEY = ["series", "n", "seed", "time_limit"]


def run(series, n, seed, time_limit):
    """Solve an instance; return the answer, and where the time went, phase by phase in s. Compiled code is loaded
    before."""
    ensure_compiled()
    solve(paper_instance(15, 0, 40, 2))
    trace = Trace()
    solution = solve(make(beyond_the_paper(series, n, seed)), time_limit=time_limit, progress=trace)
    row = dict(zip(KEY, (series, n, seed, time_limit))) | {"status": solution.status, "tours": len(solution.tours)}
    row |= {"objective": solution.objective, "bound": solution.bound}
    row |= {"gap_percent": None if solution.gap is None else 100 * solution.gap, "solve_time_s": solution.runtime}
    row |= {"labels": solution.nodes, "columns": trace.steps[-1].columns}
    row |= {"memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1000}
    return row | {"last_phase": trace.steps[-1].phase, **phases(trace.steps)}


def runs_left(rows, seeds, time_limit):
    """Return the arguments of the runs without a row."""
    done = {tuple(row[name] for name in KEY) for row in rows}
    runs = [(*family, seed, time_limit) for seed in seeds for family in FAMILIES]
    return [arguments for arguments in runs if arguments not in done]


def summary(rows):
    """Return a DataFrame, a row for each family: runs, how many are decided, and the median and the worst time in s."""
    rows = pd.DataFrame(rows)
    decided = rows.status.isin(("optimal", "infeasible"))
    groups = rows.assign(decided=decided).groupby(["series", "n"])
    return groups.agg(
        runs=("seed", "size"), decided=("decided", "sum"), median_s=("solve_time_s", "median"),
        worst_s=("solve_time_s", "max"), worst_gap_percent=("gap_percent", "max"), memory_mb=("memory_mb", "max"),
    ).reset_index()  # fmt: skip


def table(rows):
    """Yield the lines of the tables, their conditions first."""
    one = pd.DataFrame(rows).iloc[0]
    yield f"Windows of 40 s, limit {one.time_limit:g} s, gap to close 0.01 %, one thread; {one.cpu}."
    yield from ("", markdown(summary(rows)), "")
    shown = ["series", "n", "seed", "status", "tours", "objective", "gap_percent", "solve_time_s", "rounds", "labels"]
    yield markdown(pd.DataFrame(rows).sort_values(KEY, kind="stable")[shown])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    parser.add_argument("--seeds", type=int, nargs="+", required=True, help="instances of each family")
    parser.add_argument("--time-limit", type=float, default=600.0, help="s for each run")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time")
    given = parser.parse_args()
    rows = pd.read_csv(given.results).to_dict("records") if given.results.exists() else []
    about = {name: value for name, value in provenance(given.jobs).items() if name in PROVENANCE}
    fresh = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(given.jobs, mp_context=fresh, max_tasks_per_child=1) as pool:
        left = [pool.submit(run, *arguments) for arguments in runs_left(rows, given.seeds, given.time_limit)]
        for done in tqdm(as_completed(left), total=len(left), unit="run"):
            rows.append(done.result() | about)
            pd.DataFrame(rows).to_csv(given.results, index=False)
    if given.results == RESULTS:
        write_section("beyond.py", list(table(rows)))


if __name__ == "__main__":
    main()
