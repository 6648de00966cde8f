"""How far the exact solver reaches: more targets than the paper has, and what stops it there.

    python benchmarks/scale.py --results paper_results/scale.csv       the runs that have no row yet, one after another

Windows of 40 s, instances 0 to 2 of each size (`--instances`), each in this process within `--time-limit` s. The
horizon grows with n, or no single agent could fly the random tour that the windows come from.
"""

import argparse
from pathlib import Path

import pandas as pd
import psutil
from tqdm import tqdm

from mamttsp import generate, solve
from mamttsp.trace import Trace
from mamttsp.versions import processor

#: (targets, agents, horizon in s, straight pieces of a path)
SIZES = ((25, 3, 200, 6), (25, 5, 200, 6), (30, 3, 250, 7), (30, 5, 250, 7), (40, 3, 400, 11), (40, 5, 400, 11))
SIZES = (*SIZES, (50, 10, 500, 14))
KEY = ["n", "agents", "horizon", "seed", "time_limit"]


def run(n, agents, horizon, n_pieces, seed, time_limit):
    """Solve an instance; return its row: the answer, and where the time went, phase by phase in s."""
    trace = Trace()
    instance = generate(n, 40, agents, seed=seed, horizon=horizon, n_pieces=n_pieces)
    solution = solve(instance, time_limit=time_limit, progress=trace)
    row = dict(zip(KEY, (n, agents, horizon, seed, time_limit))) | {"status": solution.status}
    row |= {"objective": solution.objective, "bound": solution.bound, "gap": solution.gap}
    row |= {"runtime_s": round(solution.runtime, 2), "labels": solution.nodes, "columns": trace.steps[-1].columns}
    row |= {"memory_mb": round(psutil.Process().memory_info().rss / 1e6), **_phases(trace)}
    return row | {"machine": processor()}


def _phases(trace):
    """Return {phase_s: seconds} in which the search was at each phase: a step is told at its end."""
    steps = pd.DataFrame([(step.phase, step.time) for step in trace], columns=["phase", "time"])
    spent = steps.time.diff().fillna(steps.time).groupby(steps.phase).sum()
    return {f"{phase}_s": round(seconds, 1) for phase, seconds in spent.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--results", type=Path, required=True, help="the CSV file to append to")
    parser.add_argument("--instances", type=int, default=3, help="instances of each size")
    parser.add_argument("--time-limit", type=float, default=600.0, help="s for each run")
    given = parser.parse_args()
    rows = pd.read_csv(given.results).to_dict("records") if given.results.exists() else []
    done = {tuple(row[name] for name in KEY) for row in rows}
    for seed in tqdm(range(given.instances), unit="seed"):
        for n, agents, horizon, n_pieces in SIZES:
            if (n, agents, horizon, seed, given.time_limit) not in done:
                rows.append(run(n, agents, horizon, n_pieces, seed, given.time_limit))
                pd.DataFrame(rows).to_csv(given.results, index=False)


if __name__ == "__main__":
    main()
