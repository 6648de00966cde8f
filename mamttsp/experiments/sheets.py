"""The figures of the experiments from tables of rows, each with a caption that says under what its runs were made."""

import matplotlib.pyplot as plt
import pandas as pd

from ..figures.canvas import canvas
from ..figures.column import COLUMN, WIDTH, caption_below
from ..figures.gaps import true_gap_view
from ..figures.plan import plan_view
from ..figures.profiles import cactus_view, profile_view
from ..figures.relaxed_bounds import relaxation_view
from ..figures.runtimes import panels_view, time_scale
from ..generate import paper_instance
from ..tours import check
from ..validation import InputError
from .campaigns.rows import tours_of
from .campaigns.runs import profile
from .claims.open_routes import open_route_bars, pairs_of
from .summaries.published import CONDITIONS
from .summaries.row_statistics import by_setting, conditions, of_runs, side_by_side, true_gaps

_PAIR = ("micp/scip", "baseline/scip")


def published_sheets(rows):
    """Yield the paper's Figures 2 and 3 from its published numbers."""
    note = "Digitised; dotted bar: not above this; hollow marker: partly hidden."
    yield from paper_sheets(rows, "published", "Published", lambda _: f"{CONDITIONS}; means of 20 instances. {note}")


def our_sheets(reduced):
    """Yield the same figures from our rows of SCIP. A bar is drawn if all of its runs have a row."""
    rows = reduced[reduced.route.isin(_PAIR)]
    table = by_setting(rows, [run for run in profile("reduced") if run.solver == "scip"]).reset_index()
    names = {"total_window": "total_window_s", "n": "targets", "route": "formulation"}

    yield from paper_sheets(table.rename(columns=names), "ours", "Ours", _caption(rows))


def open_sheets(reduced, longer):
    """Yield the same figures with the best open route to each program; longer: rows of the campaign `claims`."""
    bars = open_route_bars(reduced, longer)
    yield from paper_sheets(bars, "open", "Best open routes", _caption(pairs_of(reduced, longer)))


def _caption(rows):
    """Return the caption of a figure of these rows, as a function of its bars."""

    def caption(bars):
        whole = f"{(bars.rows == bars.runs).sum()} of {len(bars)} bars have all their rows"
        counted = f"runs without a proof count at the limit, {bars.no_tours.sum()} without tours at 100 % gap"
        instances = " and ".join(map(str, sorted(set(bars.runs))))
        return f"{conditions(rows)}; means of {instances} instances. {whole}; {counted}."

    return caption


def paper_sheets(rows, name, whose, caption):
    """Yield (file name, axes) of Figures 2 (one agent, by window) and 3 (windows of 40 s, by agents), on one scale.

    rows: as for runtimes.panels_view, of both figures; name: "ours" for paper-fig-2-ours; whose: begins the title;
    caption: function from the rows of a figure to what stands below it.
    """
    parts = {
        2: ("one agent", rows[rows.agents == 1], "total_window_s"),
        3: ("windows of 40 s", rows[rows.agents > 1], "agents"),
    }
    for number, (what, part, by) in parts.items():
        axes = panels_view(part, by, f"{whose}: {what}", caption(part), time_scale(rows))
        yield f"paper-fig-{number}-{name}", axes[0]


def comparison_sheets(reduced, exact):
    """Yield the drawings of all methods side by side, all held to the smallest limit among them."""
    rows = pd.concat([reduced, of_runs(exact, profile("exact"))])
    times, limit = side_by_side(rows), rows.time_limit.min()
    caption = f"{len(times)} instances with a row of every method; {conditions(rows.assign(time_limit=limit))}."
    for name, ax in (("cactus", cactus_view(times, limit)), ("profile", profile_view(times))):
        caption_below(ax.figure, caption)
        yield f"experiments-{name}", ax


@plt.rc_context(COLUMN)
def true_gaps_sheet(reduced, exact):
    """Draw how far tours and bounds of SCIP's runs are from the certified optima."""
    ours = reduced[reduced.route.isin(_PAIR)]
    rows = true_gaps(ours, exact)
    upper, lower = plt.figure(figsize=(WIDTH, 4.4), layout="constrained").subplots(2)
    true_gap_view(rows, "incumbent_percent", ax=upper)
    true_gap_view(rows, "bound_percent", ax=lower)
    known = f"{len(rows)} of {len(ours)} runs have a certified optimum"
    caption_below(upper.figure, f"{conditions(ours)}. {known}. Numbers on top: runs without tours.")
    return upper


@plt.rc_context(COLUMN)
def relaxation_sheet(bounds, known, predecessor):
    """Draw relaxed bounds over certified optima by window and by agents, and the predecessor's published ones.

    bounds: rows of relaxations; known: those whose optimum is certified, with the ratio.
    """
    parts = {
        "One agent": (known[known.agents == 1], "total_window"),
        "Windows of 40 s": (known[known.total_window == 40], "agents"),
        "Published: the predecessor, one agent": (predecessor, "total_window"),
    }
    axes = plt.figure(figsize=(WIDTH, 6.6), layout="constrained").subplots(len(parts))
    for ax, (title, (rows, by)) in zip(axes, parts.items()):
        relaxation_view(rows, by, ax=ax)
        ax.set_title(title)
        ax.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    axes[-1].set_ylabel("relaxed bound / best bound")
    solvers = conditions(bounds)
    caption_below(axes[0].figure, f"{len(known)} of {len(bounds)} relaxations have a certified optimum. {solvers}.")
    return axes[0]


@plt.rc_context(COLUMN)
def idle_agent_sheet(exact, path):
    """Draw the first optimum of three agents, 10 targets and windows of 40 s in which one stays at the depot."""
    for _, row in exact[exact.solved & (exact.n == 10) & (exact.total_window == 40) & (exact.agents == 3)].iterrows():
        tours = tours_of(row)
        if sum(bool(tour.visits) for tour in tours) == 2:
            break
    else:
        raise InputError(
            f"{path}: no row with n 10, total_window 40, agents 3 has an optimum that leaves one agent idle"
        )
    instance = paper_instance(10, int(row["index"]), 40, 3)
    length = check(instance, tours)
    ax = plan_view(instance, tours, ax=canvas(None, (WIDTH, 4.2)))
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, frameon=False)
    ax.set_title(f"10 targets, windows of 40 s: optimal tours, {length:.1f} units")
    return ax
