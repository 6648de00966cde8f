"""Run times as bars and % gaps as lines on a second axis, as in the paper's Figures 2 and 3."""

import matplotlib.pyplot as plt
import numpy as np

from .column import COLUMN, WIDTH, bar_style, column_axes, in_order, line_style, route_name

#: where a value is missing, where it is only a bound ("<10"), and where it is read with doubt ("~0.5")
_MISSING = {"rotation": 90, "ha": "center", "va": "bottom", "fontsize": 5.5, "color": "0.35"}
_BOUND = {"facecolor": "white", "linestyle": ":", "hatch": ""}


@plt.rc_context(COLUMN)
def runtime_gap_view(rows, ax=None):
    """Draw bars (run time in s) and lines (% gap, on a second axis at the right) by targets, and return the axes.

    rows: a DataFrame with `targets`, `formulation`, `runtime_s` and `gap_percent`; the latter two are numbers or texts
    as in published.csv: a bar that is only known to be below is hollow, a marker that is read with doubt too. A value
    that is missing is written as missing in the place of its bar.
    """
    ax = ax or column_axes(2.2)
    gaps, sizes = ax.twinx(), list(dict.fromkeys(rows.targets))
    names = in_order(rows.formulation)
    for k, name in enumerate(names):
        ours = rows[rows.formulation == name].set_index("targets").reindex(sizes)
        places = np.arange(len(sizes)) + 0.4 * (k - (len(names) - 1) / 2)
        _bars(ax, places, ours.runtime_s, name)
        _line(gaps, places, ours.gap_percent, name)
    ax.set(xlabel="targets", ylabel="run time (s)", xticks=range(len(sizes)), xticklabels=sizes)
    ax.set_xlim(-0.6, len(sizes) - 0.4)
    ax.set_ylim(0, 1.08 * max([1.0, *rows.runtime_s.map(_value).dropna()]))
    ax.locator_params(axis="y", nbins=4)
    gaps.set(ylabel="% gap", ylim=(-4, 108))
    return ax


@plt.rc_context(COLUMN)
def panels_view(rows, by, title, axes=None):
    """Draw a runtime_gap_view for each value of a column, and return the list of axes.

    rows: as for runtime_gap_view; by: "total_window_s" for the paper's Fig. 2, "agents" for Fig. 3; title: what the
    runs are to be compared under, on top of the figure.
    """
    values = list(dict.fromkeys(rows[by]))
    if axes is None:
        lines = -(-len(values) // 2)
        figure, grid = plt.subplots(lines, 2, figsize=(WIDTH, 0.7 + 1.6 * lines), layout="constrained")
        axes = list(grid.flat)[: len(values)]
        for spare in grid.flat[len(values) :]:
            spare.set_axis_off()
    for k, (ax, value) in enumerate(zip(axes, values)):
        runtime_gap_view(rows[rows[by] == value], ax=ax)
        ax.set_title(f"({'abcdefgh'[k]}) {_panel_name(by, value)}")
        if k % 2:
            ax.set_ylabel("")
        elif k + 1 < len(values):  # the panel beside it says it
            ax.figure.axes[-1].set_ylabel("")
    figure = axes[0].figure
    figure.suptitle(title)
    place = {"loc": "outside lower center", "ncols": 2} if len(values) % 2 == 0 else {"loc": "lower right"}
    figure.legend(handles=_handles(in_order(rows.formulation)), frameon=False, **place)
    return axes


def _bars(ax, places, runtimes, name):
    for x, text in zip(places, runtimes):
        if np.isnan(_value(text)):
            ax.text(x, 0.02, "missing", transform=ax.get_xaxis_transform(), **_MISSING)
            continue
        ax.bar(x, _value(text), 0.36, **bar_style(name) | (_BOUND if str(text).startswith("<") else {}))


def _line(ax, places, gaps, name):
    style, values = line_style(name), gaps.map(_value).to_numpy()
    ax.plot(places, values, **style)
    doubtful = gaps.astype(str).str.startswith("~").to_numpy()
    ax.plot(places[doubtful], values[doubtful], **style | {"linestyle": "none"}, markerfacecolor="white")


def _value(text):
    """Return a number, or a text such as "<10" or "~0.5", as a float."""
    return float(str(text).lstrip("<~"))


def _panel_name(by, value):
    return f"windows {value:g} s" if by == "total_window_s" else f"{value:g} agents"


def _handles(names):
    """Return the legend's entries: a bar and a line for each formulation."""
    bars = [plt.Rectangle((0, 0), 1, 1, **bar_style(name), label=f"{route_name(name)}: time") for name in names]
    lines = [plt.Line2D([], [], **line_style(name), label=f"{route_name(name)}: % gap") for name in names]
    return [*bars, *lines]
