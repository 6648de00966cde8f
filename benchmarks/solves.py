"""Solves of the exact method that become rows of a CSV file, each in a process of its own."""

import multiprocessing
import resource
from concurrent.futures import ProcessPoolExecutor, as_completed

import pandas as pd
from tqdm import tqdm

from mamttsp import paper_instance, solve
from mamttsp.display import Trace
from mamttsp.experiments.campaigns.provenance import provenance

PHASES = ("heuristic", "prices", "elimination", "labels", "routes", "settle")
PROVENANCE = ("version", "commit", "jobs", "cpu", "cores", "python")


def answer(instance, time_limit):
    """Solve an instance; return the answer, and where the time went, phase by phase in s, as a dict. Compiled code is
    loaded before."""
    solve(paper_instance(15, 0, 40, 2))
    trace = Trace()
    solution = solve(instance, time_limit=time_limit, progress=trace)
    row = {"status": solution.status, "objective": solution.objective, "bound": solution.bound}
    row |= {"gap_percent": None if solution.gap is None else 100 * solution.gap, "solve_time_s": solution.runtime}
    row |= {"labels": solution.nodes, "columns": trace.steps[-1].columns, "tours": len(solution.tours)}
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


def without_row(runs, rows, key):
    """Return those of the runs, arguments named by `key`, that are in no row yet."""
    done = {tuple(row[name] for name in key) for row in rows}
    return [arguments for arguments in runs if arguments not in done]


def add_rows(path, rows, run, runs, jobs):
    """Call run(*arguments) for each of the runs, so many at the same time, and write the file after each; return all
    rows."""
    about = {name: value for name, value in provenance(jobs).items() if name in PROVENANCE}
    fresh = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, mp_context=fresh, max_tasks_per_child=1) as pool:
        left = [pool.submit(run, *arguments) for arguments in runs]
        for done in tqdm(as_completed(left), total=len(left), unit="run"):
            rows = [*rows, done.result() | about]
            pd.DataFrame(rows).to_csv(path, index=False)
    return rows


def read_rows(path, **text):
    """Return the rows of a CSV file as dicts, [] if there is none; text: see `pandas.read_csv`."""
    return pd.read_csv(path, **text).to_dict("records") if path.exists() else []


def markdown(rows):
    """Return a DataFrame as a table in Markdown."""
    formats = [{"gap_percent": ".3f", "objective": ".2f"}.get(name, ".1f") for name in rows]
    return rows.astype(object).to_markdown(index=False, floatfmt=formats)  # whole numbers stay whole
