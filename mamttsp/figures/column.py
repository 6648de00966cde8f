"""What drawings for one printed column (3.5 in, 88 mm) share: type size, routes' names, colours, lines and markers."""

import matplotlib.pyplot as plt
from matplotlib.colors import to_rgba

from .style import COLOURS, LINES, MARKERS

WIDTH = 3.5
#: matplotlib's settings; `@plt.rc_context(COLUMN)` applies them to all that a function draws
COLUMN = {"font.size": 7, "axes.titlesize": 7, "figure.titlesize": 7, "legend.fontsize": 6.5, "axes.linewidth": 0.6}
COLUMN |= {"lines.linewidth": 1.1, "lines.markersize": 3.5, "hatch.linewidth": 0.5, "patch.linewidth": 0.6}
COLUMN |= {"xtick.labelsize": 6.5, "ytick.labelsize": 6.5, "axes.labelpad": 2.0}
_ORDER = ("micp", "baseline", "micp/clarabel", "exact", "nonconvex")
_HATCHES = ("", "/////", "....", "xxxxx", "")
_NAMES = {"micp": "MICP", "scip": "SCIP", "clarabel": "Clarabel", "gurobi": "Gurobi"}


def column_axes(height):
    """Return the axes of a new figure, a column wide and `height` inches high."""
    return plt.figure(figsize=(WIDTH, height), layout="constrained").add_subplot()


def legend_above(ax):
    """Put the axes' legend, if anything is in it, above them, where it covers nothing."""
    if ax.get_legend_handles_labels()[0]:
        ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2, frameon=False)


def route_name(route):
    """Return how legends name a route: "micp/scip" is "MICP, SCIP"."""
    return ", ".join(_NAMES.get(part, part) for part in route.split("/"))


def in_order(routes):
    """Return routes without repetition, in the same order in every drawing."""
    return sorted(set(routes), key=_number)


def line_style(route):
    """Return a route's colour, line style and marker, the same in every drawing."""
    number = _number(route)
    return {"color": COLOURS[number], "linestyle": LINES[number], "marker": MARKERS[number]}


def bar_style(route):
    """Return a route's tint, colour and hatch: lighter than its line, which stays readable on top."""
    number = _number(route)
    return {"facecolor": to_rgba(COLOURS[number], 0.3), "edgecolor": COLOURS[number], "hatch": _HATCHES[number]}


def _number(route):
    return _ORDER.index(route if route in _ORDER else route.split("/")[0])
