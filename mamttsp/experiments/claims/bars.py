"""The bars of the paper's Figures 2 and 3, published and ours, as numbers that claims can be held against.

A number is an interval (low, high): a published one is known to a pixel or as "below", one of ours exactly.
"""

import dataclasses
import math

from ..campaigns.rows import INSTANCE
from ..summaries.row_statistics import true_gaps

COMPARED = ("micp", "baseline")
#: the paper's limit in s
LIMIT = 1800.0
#: % above the optimum that counts as none: the solvers' own gap limit
_PROVED = 0.01
#: one pixel in s: in panel 2a, and in the others
_PIXEL_2A, _PIXEL = 0.3, 4.0
#: one pixel in % gap: the axes are taken to be equally high, 100 % where the run time has its limit
_PIXEL_GAP = 100 * _PIXEL / LIMIT


@dataclasses.dataclass(frozen=True)
class Bar:
    """A formulation at a setting: means of run time (s, at most the limit) and % gap, as (low, high), and as read.

    limit: s; runs: how many instances the means are of, wanted: how many there should be; stopped: the share of runs
    that reached the limit, None if unknown; optimal: the number of runs whose tours are certified to be optimal, None
    if unknown.
    """

    runtime: tuple
    gap: tuple
    runtime_read: str
    gap_read: str
    limit: float
    runs: int
    wanted: int
    stopped: float | None = None
    optimal: int | None = None


def published_bars(rows):
    """Return {(total_window, agents, n, method): Bar} of the published numbers, as from published.read_published."""
    return {
        (row.total_window_s, row.agents, row.targets, row.formulation): Bar(
            _read(row.runtime_s, _PIXEL_2A if row.figure == "2a" else _PIXEL, LIMIT),
            _read(row.gap_percent, _PIXEL_GAP, 100.0),
            row.runtime_s,
            row.gap_percent,
            LIMIT,
            runs=20,
            wanted=20,
            stopped=1.0 if row.runtime_s == f"{LIMIT:g}" else None,
        )
        for row in rows.itertuples()
    }


def our_bars(rows, exact, wanted, solver="scip"):
    """Return the same of our rows, over the instances for which both formulations have a row.

    rows, exact: as from row_statistics.read_table; wanted: instances at each setting. Without a pair there is no bar.
    """
    ours = rows[(rows.solver == solver) & rows.method.isin(COMPARED)]
    pairs = ours[ours.groupby(INSTANCE).method.transform("nunique") == len(COMPARED)]
    keys = [*INSTANCE, "method"]
    known = true_gaps(pairs, exact).reset_index(drop=True)
    pairs = pairs.merge(known[[*keys, "incumbent_percent"]], how="left", on=keys)
    return {
        (int(window), int(agents), int(n), method): _bar(group, wanted)
        for (window, agents, n, method), group in pairs.groupby(["total_window", "agents", "n", "method"])
    }


def _bar(rows, wanted):
    runtime, gap = rows.counted_time.mean(), rows.counted_gap.mean()
    above = rows.incumbent_percent.where(rows.objective.notna(), math.inf)  # without tours: far above any optimum
    return Bar(
        (runtime, runtime),
        (gap, gap),
        f"{runtime:.3g}",
        f"{gap:.3g}",
        rows.time_limit.max(),
        len(rows),
        wanted,
        stopped=float((~rows.solved).mean()),
        optimal=None if above.isna().any() else int((above <= _PROVED).sum()),
    )


def _read(text, pixel, most):
    """Return the interval that a digitised number stands for; 0 is on the axis, and the limit is the limit."""
    if text.startswith("<"):
        return 0.0, float(text[1:])
    value = float(text.lstrip("~"))
    return (value, value) if value in (0.0, most) else (max(0.0, value - pixel), min(most, value + pixel))
