"""What the rows of campaigns say together: means by setting, times of several routes side by side, true gaps.

A route is a method with its solver, "micp/scip" or "exact". Whatever ends without a proved gap counts at its limit,
crashes too; and its % gap counts as 100 if it has no tours or no bound, since no length is below 0.
"""

import dataclasses

import numpy as np
import pandas as pd
from scipy.stats import gmean

from ..campaigns.rows import COLUMNS, INSTANCE, KEY, SIZES, read_rows

SETTING = ["total_window", "agents", "n"]
_NUMBERS = [*INSTANCE, "time_limit", "objective", "bound", "gap_percent", "runtime_s", "build_time_s", "solve_time_s"]
_NUMBERS += ["nodes", "subtour_cuts", "memory_mb", *SIZES, "threads"]


def read_table(path):
    """Return the rows of a results file as a DataFrame: numbers for numbers, and more columns.

    route; solved: the gap was proved; counted_time: the solver's run time in s, counted at the limit unless solved;
    counted_gap: % gap, at most 100, and 100 without tours or bound. InputError: no such file, or not the columns of
    this version.
    """
    rows = pd.DataFrame(read_rows(path), columns=COLUMNS)
    rows[_NUMBERS] = rows[_NUMBERS].apply(pd.to_numeric).astype(float)
    solved = rows.status == "optimal"
    more = {"solved": solved, "counted_time": rows.runtime_s.where(solved, rows.time_limit)}
    return _with_route(rows).assign(**more, counted_gap=rows.gap_percent.fillna(100.0).clip(upper=100.0))


def of_runs(rows, runs):
    """Return those rows that are of one of the runs, so at most one for each instance and route of a profile."""
    return rows.merge(_keys(runs), on=list(KEY))


def by_setting(rows, runs, shift=1.0):
    """Return a DataFrame with a line for each window, number of agents, n and route that `runs` hold.

    rows: as from read_table; runs: what there should be, a list of Run. runs, rows, solved, no_tours: how many there
    should be, there are, were proved, found nothing. runtime_s and gap_percent: arithmetic means, as in the paper;
    runtime_geometric_s: the geometric mean of run time + shift, minus shift (both in s), which a few long runs do not
    rule. The means are NaN unless all runs have a row.
    """
    both = _with_route(_keys(runs)).merge(rows.drop(columns="route"), how="left", on=list(KEY))
    groups = both.assign(empty=both.status.notna() & both.objective.isna()).groupby([*SETTING, "route"], sort=False)
    table = groups.agg(
        runs=("index", "size"),
        rows=("status", "count"),
        solved=("solved", "sum"),
        no_tours=("empty", "sum"),
        runtime_s=("counted_time", _mean),
        gap_percent=("counted_gap", _mean),
        runtime_geometric_s=("counted_time", lambda times: gmean(times + shift) - shift),
    )
    return table.astype({"solved": int})


def side_by_side(rows):
    """Return the times in s of the whole solve: a line for each instance that all routes in `rows` have a row for.

    A column for each route; inf where it proved nothing within the smallest time limit among the rows.
    """
    within = rows.solved & (rows.solve_time_s <= rows.time_limit.min())
    times = rows.assign(time=rows.solve_time_s.where(within, np.inf))
    return times.pivot(index=INSTANCE, columns="route", values="time").dropna()


def true_gaps(rows, exact):
    """Return the rows whose optimum is certified, with `optimum`, `incumbent_percent` and `bound_percent` more.

    exact: rows of the exact method. How far a run's tours are above the optimum, and its bound below, in % of the
    optimum. Tours that were not found are NaN; no bound is the bound 0. The optimum is certain to 0.01 %.
    """
    optima = exact[exact.solved].groupby(INSTANCE).objective.min().rename("optimum")
    known = rows.join(optima, on=INSTANCE, how="inner")
    above, below = known.objective - known.optimum, known.optimum - known.bound.fillna(0.0).clip(lower=0.0)
    return known.assign(incumbent_percent=100 * above / known.optimum, bound_percent=100 * below / known.optimum)


def bound_over_optimum(relaxed, exact):
    """Return the relaxed rows whose optimum is certified, as a data frame with `optimum` (units) and `ratio` more.

    relaxed, exact: paths or files of the two results files; ratio: relaxed bound over certified optimum, at most 1.
    """
    relaxed, exact = pd.read_csv(relaxed), pd.read_csv(exact)
    optima = exact[exact["status"] == "optimal"].rename(columns={"objective": "optimum"})
    joined = relaxed[[*INSTANCE, "method", "bound"]].merge(optima[[*INSTANCE, "optimum"]], on=INSTANCE)
    return joined.assign(ratio=joined["bound"] / joined["optimum"])


def conditions(rows):
    """Return what rows are to be compared under, as one line: solvers, limit, threads and machine, as far as known."""
    limits, threads = (_listed(rows[name].dropna().map("{:g}".format)) for name in ("time_limit", "threads"))
    limit, on = limits and f"limit {limits} s", threads and f"threads {threads}"
    return ", ".join(filter(None, (_listed(rows.solver_version), limit, on, _listed(rows.cpu)))) or "no rows"


def _keys(runs):
    return pd.DataFrame([dataclasses.asdict(run) for run in runs], columns=KEY).fillna("")


def _with_route(rows):
    return rows.assign(route=rows.method + np.where(rows.solver == "", "", "/" + rows.solver))


def _mean(values):
    return values.mean(skipna=False)


def _listed(texts):
    return " and ".join(sorted(set(texts) - {""}))
