"""The bars of the paper's Figures 2 and 3, published and ours, as numbers that claims can be held against.

A number is an interval (low, high). A published one is known to a pixel or as "below". One of ours is open where a run
was stopped before the paper's limit, or has no tours.
"""

import dataclasses

from ..campaigns.rows import INSTANCE
from ..summaries.row_statistics import true_gaps

#: the paper's limit in s
LIMIT = 1800.0
#: one pixel in s: in panel 2a, and in the others
_PIXEL_2A, _PIXEL = 0.3, 4.0
#: one pixel in % gap: the axes are taken to be equally high, 100 % where the run time has its limit
_PIXEL_GAP = 100 * _PIXEL / LIMIT


@dataclasses.dataclass(frozen=True)
class Bar:
    """A formulation at a setting: means of run time (s) and % gap, as (low, high), and as read.

    runtime: what the mean may be with the paper's limit: a run that a shorter one stopped takes from that to the
    paper's. gap: at the limit of the rows; a run without tours has at least the gap that its bound would leave to
    the best tours there are. limit: s; runs, wanted, stopped, without: how many instances the means are of, how many
    there should be, how many were stopped (0 in the plots, which count them at the paper's limit), how many have no
    tours.
    """

    runtime: tuple
    gap: tuple
    runtime_read: str
    gap_read: str
    limit: float
    runs: int
    wanted: int
    stopped: int = 0
    without: int = 0

    @property
    def cut_short(self):
        """Tell whether runs were stopped that would have gone on in the paper."""
        return self.stopped > 0 and self.limit < LIMIT


def published_bars(rows):
    """Return {(total_window, agents, n, method): Bar} of the published numbers, as from published.read_published."""
    return {
        (row.total_window_s, row.agents, row.targets, row.formulation): Bar(
            _read(row.runtime_s, _PIXEL_2A if row.figure == "2a" else _PIXEL, LIMIT),
            _read(row.gap_percent, _PIXEL_GAP, 100.0),
            f"{row.runtime_s} s",
            f"{row.gap_percent} %",
            LIMIT,
            runs=20,
            wanted=20,
        )
        for row in rows.itertuples()
    }


def our_bars(pairs, exact):
    """Return the same of our rows.

    pairs: as from open_routes.pairs_of; exact: rows of the exact method, whose optima say what a bound leaves where
    there are no tours.
    """
    keys = [*INSTANCE, "method"]
    certified = true_gaps(pairs, exact).reset_index(drop=True)
    known = pairs.merge(certified[[*keys, "bound_percent"]], how="left", on=keys)
    groups = known.groupby(["total_window", "agents", "n", "method"])
    return {(int(window), int(agents), int(n), method): _bar(rows) for (window, agents, n, method), rows in groups}


def _bar(rows):
    without, stopped, limit = rows.objective.isna(), int((~rows.solved).sum()), rows.time_limit.max()
    runtime, least_gap = rows.counted_time.mean(), rows.counted_gap.where(~without, rows.bound_percent.fillna(0.0))
    gap_read = f"no tours in {without.sum()} of {len(rows)}, at least " * bool(without.any())
    going_on = max(LIMIT - limit, 0.0) * stopped / len(rows)
    gap = least_gap.mean(), rows.counted_gap.mean()
    return Bar(
        (runtime, runtime + going_on),
        gap,
        f"{runtime:.3g} s" + f" ({stopped} of {len(rows)} stopped)" * bool(stopped),
        f"{gap_read}{gap[0]:.3g} %",
        limit,
        len(rows),
        int(rows.wanted.max()),
        stopped=stopped,
        without=int(without.sum()),
    )


def _read(text, pixel, most):
    """Return the interval that a digitised number stands for; 0 is on the axis, and the limit is the limit."""
    if text.startswith("<"):
        return 0.0, float(text[1:])
    value = float(text.lstrip("~"))
    return (value, value) if value in (0.0, most) else (max(0.0, value - pixel), min(most, value + pixel))
