"""Run times as bars and % gaps as lines above them, with the numbers of the paper's Figures 2 and 3."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.legend_handler import HandlerTuple

from .canvas import canvas
from .column import COLUMN, WIDTH, caption_below
from .style import bar_style, in_order, method_style, route_name

#: where a value is missing, where it is only a bound ("<10"), and where it is read with doubt ("~0.5")
_MISSING = {"rotation": 90, "ha": "center", "va": "bottom", "fontsize": 5.5, "color": "0.35"}
_BOUND = {"facecolor": "white", "linestyle": ":", "hatch": ""}
#: parts of the axes' height: bars end below, lines lie above, where they cover no bar
_BARS, _GAPS = 0.62, (0.70, 0.96)


@plt.rc_context(COLUMN)
def runtime_gap_view(rows, scale=None, ax=None):
    """Draw bars (run time in s, logarithmic) and above them lines (% gap) by targets, and return the axes.

    rows: a DataFrame with `targets`, `formulation`, `runtime_s` and `gap_percent`; the latter two are numbers or texts
    as in published.csv: a bar that is only known to be below is hollow, a marker that is read with doubt too. A value
    that is missing is written as missing in the place of its bar. formulation: a method or a route, "micp/scip".
    scale: the lowest and the highest run time of the axis in s, as time_scale returns them.
    """
    ax = canvas(ax, (WIDTH, 2.6))
    gaps, sizes = ax.twinx(), list(dict.fromkeys(rows.targets))
    names = in_order(rows.formulation)
    ax.set_yscale("log")
    for k, name in enumerate(names):
        ours = rows[rows.formulation == name].set_index("targets").reindex(sizes)
        places = np.arange(len(sizes)) + 0.4 * (k - (len(names) - 1) / 2)
        _bars(ax, places, ours.runtime_s, name)
        _line(gaps, places, ours.gap_percent, name)
    ax.set(xlabel="targets", xticks=range(len(sizes)), xticklabels=sizes)
    ax.set_xlim(-0.6, len(sizes) - 0.4)
    low, high = scale or time_scale(rows)
    ax.set_ylim(low, low * (high / low) ** (1 / _BARS))
    decades = 10.0 ** np.arange(np.log10(low), np.log10(high) + 1e-9)
    ax.set_yticks(decades, [f"{decade:g}" for decade in decades])
    ax.yaxis.set_minor_locator(plt.NullLocator())
    ax.set_ylabel("run time (s)", y=_BARS / 2)
    bottom, top = _GAPS
    ax.axhline(low * (high / low) ** ((_BARS + bottom) / 2 / _BARS), color="0.8", linewidth=0.6)
    gaps.set(ylim=(-100 * bottom / (top - bottom), 100 * (1 - bottom) / (top - bottom)), yticks=[0, 50, 100])
    gaps.set_ylabel("% gap", y=(bottom + top) / 2)
    return ax


@plt.rc_context(COLUMN)
def panels_view(rows, by, title, caption="", scale=None, axes=None):
    """Draw a runtime_gap_view for each value of a column, all with one scale, and return the list of axes.

    rows: as for runtime_gap_view; by: "total_window_s" for the paper's Fig. 2, "agents" for Fig. 3; title: a line on
    top of the legend; caption: below it, what the runs are to be compared under; scale: of more rows than these.
    """
    values = list(dict.fromkeys(rows[by]))
    if axes is None:
        lines = -(-len(values) // 2)
        figure, grid = plt.subplots(lines, 2, figsize=(WIDTH, 0.9 + 1.75 * lines), layout="constrained")
        axes = list(grid.flat)[: len(values)]
        for spare in grid.flat[len(values) :]:
            spare.set_axis_off()
    scale = scale or time_scale(rows)
    for k, (ax, value) in enumerate(zip(axes, values)):
        runtime_gap_view(rows[rows[by] == value], scale, ax=ax)
        ax.set_title(f"({'abcdefgh'[k]}) {_panel_name(by, value)}")
        if k % 2:
            ax.set_ylabel("")
        elif k + 1 < len(values):  # the panel beside it says it
            ax.figure.axes[-1].set_ylabel("")
    figure, names = axes[0].figure, in_order(rows.formulation)
    style = {"loc": "outside upper center", "ncols": 2, "frameon": False, "handlelength": 5.0}
    together = {tuple: HandlerTuple(ndivide=None, pad=0.6)}
    figure.legend(_handles(names), map(route_name, names), title=title, handler_map=together, **style)
    caption_below(figure, caption)
    return axes


def time_scale(rows):
    """Return (lowest, highest) run time in s for a logarithmic axis on which each bar of the rows can be seen."""
    times = rows.runtime_s.map(_value).dropna()
    low, high = times.min(), times.max()
    return (10.0 ** np.floor(np.log10(low / 2)), high) if len(times) else (0.1, 1.0)


def _bars(ax, places, runtimes, name):
    for x, text in zip(places, runtimes):
        if np.isnan(_value(text)):
            ax.text(x, 0.02, "missing", transform=ax.get_xaxis_transform(), **_MISSING)
            continue
        ax.bar(x, _value(text), 0.36, **bar_style(name) | (_BOUND if str(text).startswith("<") else {}))


def _line(ax, places, gaps, name):
    style, values = method_style(name), gaps.map(_value).to_numpy()
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
    bars = [plt.Rectangle((0, 0), 1, 1, **bar_style(name)) for name in names]
    return list(zip(bars, [plt.Line2D([], [], **method_style(name)) for name in names]))
