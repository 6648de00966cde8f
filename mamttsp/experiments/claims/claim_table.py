"""The table of claims: what the paper says, what its own plots show, what our rows show, and a verdict."""

import pandas as pd

from .bars import LIMIT, our_bars, published_bars
from .certified import certified
from .paper_claims import CLAIMS
from .verdicts import OPEN

COLUMNS = ("section", "claim", "published", "plot", "ours", "verdict", "reason")


def claim_table(published, reduced, exact, instances=5):
    """Return a DataFrame with a line for each claim.

    published: as from published.read_published; reduced, exact: rows as from row_statistics.read_table; instances: at
    each setting of `reduced`. plot: whether the paper's plot agrees with its text, disagrees, or cannot be read;
    verdict: what our rows say: one of verdicts.HOLDS, DIRECTION, DIFFERS, OPEN.
    """
    plots, ours = published_bars(published), our_bars(reduced, exact, instances)
    lines = [_line(claim, plots, ours, instances) for claim in CLAIMS]
    return pd.DataFrame([*lines, *certified(reduced, exact)], columns=COLUMNS)


def _line(claim, plots, ours, instances):
    plot, found = claim.find(plots), claim.find(ours)
    reason = f"{found.counts}; {_coverage(ours, len(plots), instances)}"
    return claim.section, claim.text, plot.numbers, _agreement(plot), found.numbers, found.verdict, reason


def _coverage(ours, settings, instances):
    """Return what our numbers rest on, in words."""
    pairs, wanted = sum(bar.runs for bar in ours.values()) // 2, settings // 2 * instances
    limits = sorted({bar.limit for bar in ours.values()})
    limit = f"; limit {' and '.join(f'{one:g}' for one in limits)} s, the paper's {LIMIT:g} s" if limits else ""
    return ("all rows there" if pairs == wanted else f"only {pairs} of {wanted} pairs of rows are there") + limit


def _agreement(plot):
    if plot.against:
        return "disagrees"
    return "cannot be read" if plot.verdict == OPEN else "agrees"
