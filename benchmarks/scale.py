"""How far the exact solver reaches: more targets than the paper has, and what stops it there.

    python -m benchmarks.scale            the runs that have no row in paper_results/scale.csv yet, then the table

Windows of 40 s, each run in a process of its own within 600 s; the table goes into README.md. The horizon grows with n,
or no single agent could fly the random tour that the windows come from.
"""

import argparse
import multiprocessing
import resource
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import pandas as pd
from tqdm import tqdm

from benchmarks.readme import write_section
from mamttsp import generate, paper_instance, solve
from mamttsp.display import Trace
from mamttsp.experiments.campaigns.provenance import provenance

RESULTS = Path(__file__).parent.parent / "paper_results" / "scale.csv"
#: (targets, agents, horizon in s, straight pieces of a path)
SIZES = ((25, 3, 200, 6), (25, 5, 200, 6), (30, 3, 250, 7), (30, 5, 250, 7), (40, 3, 400, 11), (40, 5, 400, 11))
SIZES = (*SIZES, (50, 10, 500, 14))
KEY = ["n", "agents", "horizon", "pieces", "seed", "time_limit"]
PHASES = ("heuristic", "prices", "elimination", "labels", "routes", "settle")
PROVENANCE = ("version", "commit", "jobs", "cpu", "cores", "python")


def run(n, agents, horizon, pieces, seed, time_limit):
    """Solve an instance; return the answer, and where the time went, phase by phase in s. Compiled code is loaded
    before."""
    solve(paper_instance(15, 0, 40, 2))
    trace = Trace()
    instance = generate(n, 40, agents, seed=seed, horizon=horizon, n_pieces=pieces)
    solution = solve(instance, time_limit=time_limit, progress=trace)
    row = dict(zip(KEY, (n, agents, horizon, pieces, seed, time_limit))) | {"status": solution.status}
    row |= {"objective": solution.objective, "bound": solution.bound, "gap_percent": 100 * solution.gap}
    row |= {"solve_time_s": solution.runtime, "labels": solution.nodes, "columns": trace.steps[-1].columns}
    row |= {"memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1000}
    return row | {"last_phase": trace.steps[-1].phase, **phases(trace.steps)}


def phases(steps):
    """Return {rounds, PHASE_s...}: how many rounds, and the seconds at each phase, as a step is told at its end."""
    spent, before = dict.fromkeys(PHASES, 0.0), 0.0
    for step in steps:
        spent[step.phase] = spent.get(step.phase, 0.0) + step.time - before
        before = step.time
    rounds = sum(step.phase == "prices" for step in steps)
    return {"rounds": rounds} | {f"{phase}_s": round(seconds, 2) for phase, seconds in spent.items()}


def runs_left(rows, seeds, time_limit):
    """Return the arguments of the runs without a row."""
    done = {tuple(row[name] for name in KEY) for row in rows}
    runs = [(*size, seed, time_limit) for seed in seeds for size in SIZES]
    return [arguments for arguments in runs if arguments not in done]


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


def markdown(rows):
    formats = [{"gap_percent": ".3f", "objective": ".2f"}.get(name, ".1f") for name in rows]
    return rows.astype(object).to_markdown(index=False, floatfmt=formats)  # whole numbers stay whole


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    parser.add_argument("--seeds", type=int, nargs="*", default=(0, 1), help="instances of each size")
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
    write_section("scale.py", list(table(rows)))


if __name__ == "__main__":
    main()
