"""What each constant of the exact solver is worth: the same solves with other values of it.

    python -m benchmarks.constants     the values that have no row yet, then the table

Processor time on instances that the solver was developed on, in one process, as the geometric mean of the ratios to the
time with the default, so that 1.2 is a fifth slower; a solve that its limit of 60 s ends counts as 60 s. The rows go
into paper_results/constants.csv, the table into README.md.
"""

import argparse
import dataclasses
import time
from pathlib import Path

import numpy as np
import pandas as pd
from tqdm import tqdm

from benchmarks.readme import write_section
from benchmarks.solves import PROVENANCE, markdown
from mamttsp import generate, load
from mamttsp.exact import Parameters, solve_exact
from mamttsp.experiments.campaigns.provenance import provenance
from mamttsp.options import Options
from mamttsp.warm_up import ensure_compiled

RESULTS = Path(__file__).parent.parent / "paper_results" / "constants.csv"
LIMIT = 60.0
#: other values of each constant: a smaller and a larger one, or none of what it does
VARIED = {
    "ng_size": (6, 10),
    "longest_cycle": (3, 8),
    "columns": (15, 60),
    "columns_each": (2, 10),
    "box": (0.1, 1.0),
    "most_steps": (40, 160),
    "most_columns": (1000, 10_000),
    "idle_steps": (10, 40),
    "converged": (0.02, 0.1),
    "few_entries": ((), (8,), (3,)),
    "few_targets": (10, 100),
    "dropped": (0.0, 0.95),
    "piece": (0.2, 0.7),
    "pieces_each": (4, 16),
    "first_pieces": (200, 5000),
    "crowded_pieces": (500, 5000),
    "annealing": (1.0, 5.0),
    "annealing_share": (0.01, 0.1),
    "grid": (12, 48),
    "grid_slack": (0.0, 1.0),
    "grid_charges": ((0.0,), (0.5,), (8.0,), (0.5, 0.0, 2.0, 8.0)),
    "removed": (5.0, 20.0),
    "string": (10.0, 60.0),
    "radial": (0.0, 1.0),
    "shuffled": (0.0, 1.0),
    "blink": (0.0, 0.05),
    "heat": (0.005, 0.05),
    "near": (0.003, 0.03),
    "timed": (0, 20),
    "enumeration": (0.1, 0.8),
    "enumeration_alone": (1.5, 13.0),
    "early_work": (0.1, 1.0),
    "least_extensions": (1000, 100_000),
    "prices": (0, 12, 48),
    "apart": (0.05, 0.3),
    "drawn": (0.1, 1.0),
    "prices_share": (0.3, 3.0),
    "parts": ((), (0.25,)),
    "parts_work": (0.1, 1.0),
    "narrower": (0.6, 1.0),
    "worthwhile": (0.02, 0.2),
    "whole": (0.001, 0.1),
    "whole_routes": (0.02, 0.3),
    "cuts": (5, 40),
    "violation": (0.005, 0.1),
    "choice_share": (0.01, 0.2),
    "choice_columns": (200, 5000),
    "choice_cuts": (10, 100),
    "choice_most_cuts": (50, 800),
    "choice_few": (20_000, 10**7),
    "few_sets": (1000, 10**7),
    "few_sequences": (100, 10_000),
    "more_sequences": (1.0, 4.0),
    "finer": (1.5, 4.0),
    "finer_after_routes": (2.0, 6.0),
}


def instances():
    """Return {name: instance} of those that the solver was developed on."""
    named = {
        f"n{n}-i{index:02}-w{w}-m{m}": load(f"n{n}-i{index:02}-w{w}", n_agents=m)
        for n, index, w, m in ((20, 2, 60, 1), (20, 6, 60, 1), (20, 0, 40, 2), (15, 1, 40, 2))
    }
    longer = generate(30, 40, 5, seed=5, horizon=250, n_pieces=7)
    return named | {"seed 103": generate(20, 60, 1, seed=103), "30 targets, seed 5": longer}


def seconds(instance, **changed):
    """Return the processor time in s of a solve with these constants changed, LIMIT if it was not done by then."""
    began = time.process_time()
    solution = solve_exact(instance, Options(time_limit=LIMIT), dataclasses.replace(Parameters(), **changed))
    return time.process_time() - began if solution.status == "optimal" else LIMIT


def measure(name, value, defaults, among):
    """Return the row of a constant's value; defaults: {instance: s with all defaults}."""
    spent = {key: seconds(instance, **{name: value}) for key, instance in among.items()}
    ratios = [spent[key] / defaults[key] for key in among]
    return {
        "constant": name, "value": str(value), "default": str(getattr(Parameters(), name)),
        "ratio": float(np.exp(np.mean(np.log(ratios)))), "least": min(ratios), "most": max(ratios),
        "stopped": sum(s == LIMIT for s in spent.values()),
    }  # fmt: skip


def table(rows):
    """Yield the lines of the table, its conditions first."""
    rows = pd.DataFrame(rows)
    where = f"{len(instances())} instances, limit {LIMIT:g} s; {rows.cpu.iloc[0]}"
    yield f"Processor time over that with the default; {where}."
    shown = rows[["constant", "default", "value", "ratio", "least", "most", "stopped"]]
    yield from ("", markdown(shown.round(2).astype({"stopped": int})))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--constants", nargs="+", choices=VARIED, default=list(VARIED), help="default: all")
    parser.add_argument("--results", type=Path, default=RESULTS, help="the CSV file to append to")
    given = parser.parse_args()
    rows = (
        pd.read_csv(given.results, dtype={"value": str, "default": str}).to_dict("records")
        if given.results.exists()
        else []
    )
    done, among = {(row["constant"], row["value"]) for row in rows}, instances()
    left = [(name, value) for name in given.constants for value in VARIED[name]]
    left = [(name, value) for name, value in left if (name, str(value)) not in done]
    about = {name: value for name, value in provenance(1).items() if name in PROVENANCE}
    ensure_compiled()
    defaults = {key: min(seconds(instance) for _ in range(2)) for key, instance in among.items()}
    for name, value in tqdm(left, unit="value"):
        rows.append(measure(name, value, defaults, among) | about)
        pd.DataFrame(rows).to_csv(given.results, index=False)
    if given.results == RESULTS:
        write_section("constants.py", list(table(rows)))


if __name__ == "__main__":
    main()
