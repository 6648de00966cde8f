"""The routes to the paper's two programs that need no licence, and the rows of each setting with the longest limit.

A route is a solver for each formulation. Rows are taken in pairs: an instance counts where both formulations have a
row, and the pairs of the campaign "claims" (600 s) stand in for those of "reduced" (60 s) at each setting that it has
run whole. A setting with some of its pairs only counts as not run: their mean would be of a choice of instances.
"""

import pandas as pd

from ..campaigns.rows import INSTANCE
from ..campaigns.runs import profile
from ..summaries.row_statistics import SETTING, of_runs

#: the best open solver that each formulation has, and the same solver for both
BEST_OPEN = {"micp": "clarabel", "baseline": "scip"}
ON_SCIP = {"micp": "scip", "baseline": "scip"}


def pairs_of(reduced, longer, solvers=BEST_OPEN):
    """Return the rows of both formulations on their `solvers`, with the column `wanted` more.

    reduced, longer: rows of the campaigns "reduced" and "claims", as from row_statistics.read_table; wanted: how many
    instances the campaign has at that setting.
    """
    first, second = (_pairs(rows, name, solvers) for rows, name in ((longer, "claims"), (reduced, "reduced")))
    first = first[first.groupby(SETTING)["index"].transform("size") == len(solvers) * first.wanted]
    settled = pd.MultiIndex.from_frame(first[SETTING])
    return pd.concat([first, second[~pd.MultiIndex.from_frame(second[SETTING]).isin(settled)]], ignore_index=True)


def open_route_bars(reduced, longer):
    """Return the bars of Figures 2 and 3 with the best open route of each formulation, as a DataFrame.

    A line for each `total_window_s`, `agents`, `targets` and `formulation` (the route, as "micp/clarabel") that has
    rows: `runtime_s` and `gap_percent`, the means as in the paper over `rows` of `runs` instances, `no_tours` of them
    without tours (100 % gap); `time_limit` in s. reduced, longer: as for `pairs_of`.
    """
    rows = pairs_of(reduced, longer).astype({"total_window": int, "agents": int, "n": int})
    groups = rows.assign(empty=rows.objective.isna()).groupby([*SETTING, "route"])
    table = groups.agg(
        runs=("wanted", "max"),
        rows=("index", "size"),
        no_tours=("empty", "sum"),
        runtime_s=("counted_time", "mean"),
        gap_percent=("counted_gap", "mean"),
        time_limit=("time_limit", "max"),
    )
    names = {"total_window": "total_window_s", "n": "targets", "route": "formulation"}
    return table.reset_index().rename(columns=names)


def _pairs(rows, name, solvers):
    """Return the rows of the profile `name` on the `solvers` whose instance has one for each formulation."""
    runs = [run for run in profile(name) if run.method in solvers and run.solver == solvers[run.method]]
    wanted = pd.DataFrame([(run.total_window, run.agents, run.n, run.index, run.method) for run in runs])
    wanted.columns = [*SETTING, "index", "method"]
    both = wanted.groupby([*SETTING, "index"]).method.transform("nunique") == len(solvers)
    counts = (wanted[both].groupby(SETTING).size() // len(solvers)).rename("wanted").reset_index()
    ours = of_runs(rows, runs)
    ours = ours[ours.groupby(INSTANCE).method.transform("nunique") == len(solvers)]
    return ours.merge(counts, on=SETTING)
