"""The table of claims: what the paper says, what its own plots show, what our rows show, and a verdict."""

import pandas as pd

from .bars import LIMIT, our_bars, published_bars
from .certified import certified
from .open_routes import BEST_OPEN, ON_SCIP, pairs_of
from .paper_claims import CLAIMS
from .verdicts import OPEN

COLUMNS = ("section", "claim", "quotation", "rule", "published", "plot", "ours", "verdict", "reason", "scip_only")


def claim_table(published, reduced, longer, exact):
    """Return a DataFrame with a line for each claim.

    published: as from published.read_published; reduced, longer, exact: rows of the campaigns "reduced", "claims" and
    "exact", as from row_statistics.read_table. plot: whether the paper's plot agrees with its text, disagrees, or
    cannot be read; verdict: what our rows say with the best open route to each program; scip_only: what they say with
    both programs on SCIP.
    """
    plots = published_bars(published)
    ours, scip = (our_bars(pairs_of(reduced, longer, route), exact) for route in (BEST_OPEN, ON_SCIP))
    lines = [_line(claim, plots, ours, scip) for claim in CLAIMS]
    solved = pd.concat([reduced, longer], ignore_index=True)
    return pd.DataFrame([*lines, *certified(solved, exact)], columns=COLUMNS)


def _line(claim, plots, ours, scip):
    plot, found = claim.test.find(plots), claim.test.find(ours)
    reason = f"{found.counts}; {_coverage(ours, claim.test.settings)}"
    judged = plot.numbers, _agreement(plot), found.numbers, found.verdict, reason, claim.test.find(scip).verdict
    return claim.section, claim.text, claim.quotation, claim.rule, *judged


def _coverage(bars, settings):
    """Return what our numbers rest on, in words."""
    found = [bars[key] for setting in settings if (key := (*setting, "micp")) in bars]
    if not found:
        return "no rows"
    pairs, wanted = sum(bar.runs for bar in found), sum(bar.wanted for bar in found)
    limits = " and ".join(f"{limit:g}" for limit in sorted({bar.limit for bar in found}))
    missing = f"; no rows at {len(settings) - len(found)} settings" if len(found) < len(settings) else ""
    return f"{pairs} of {wanted} pairs of rows{missing}; limit {limits} s, the paper's {LIMIT:g} s"


def _agreement(plot):
    if plot.against:
        return "disagrees"
    return "cannot be read" if plot.verdict == OPEN else "agrees"
