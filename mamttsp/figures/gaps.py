"""How far the incumbents and bounds of time-limited runs are from certified optima."""

import matplotlib.pyplot as plt
import numpy as np

from .canvas import canvas
from .column import COLUMN, WIDTH, legend_above
from .style import bar_style, in_order, method_style, route_name

#: % of the optimum; below the certificate's own tolerance the axis is linear
RESOLUTION = 0.01
_SIDES = {"incumbent_percent": "tours above optimum (%)", "bound_percent": "bound below optimum (%)"}


@plt.rc_context(COLUMN)
def true_gap_view(rows, side, ax=None):
    """Draw a box for each n and route over its runs, each run a marker, and return the axes.

    rows: a DataFrame with `n`, `route`, and the side's column; side: "incumbent_percent" or "bound_percent", in % of
    the optimum. A box holds the middle half of the runs, its line is the median, and the number above counts the runs
    without tours, which have no marker. The axis is logarithmic above 0.01 %, and linear below it.
    """
    ax = canvas(ax, (WIDTH, 2.4))
    sizes, routes = sorted(set(rows.n)), in_order(rows.route)
    for k, route in enumerate(routes):
        for place, n in enumerate(sizes, start=1):
            values = rows[(rows.route == route) & (rows.n == n)][side]
            _box(ax, place + (k - (len(routes) - 1) / 2) * 0.8 / len(routes), values, route, 0.7 / len(routes))
    ax.set_yscale("symlog", linthresh=RESOLUTION, linscale=0.5)
    ax.set(xlabel="targets", ylabel=_SIDES[side], ylim=(-RESOLUTION / 2, 300), yticks=[0, 0.01, 0.1, 1, 10, 100])
    ax.set_yticklabels(["0", "0.01", "0.1", "1", "10", "100"])
    ax.set_xticks(range(1, len(sizes) + 1), [f"{n:g}" for n in sizes])
    ax.set_xlim(0.5, len(sizes) + 0.5)  # room for a number without a box
    for route in routes:
        ax.plot([], [], **_points(route), label=route_name(route))
    legend_above(ax)
    return ax


def _box(ax, place, values, route, width):
    found = values.dropna()
    if len(found) < len(values):
        ax.annotate(f"{len(values) - len(found)}", (place, 150), ha="center", fontsize=5.5, color="0.35")
    if found.empty:
        return
    style = {"boxprops": bar_style(route), "medianprops": {"color": "black"}, "showfliers": False, "showcaps": False}
    ax.boxplot([found], positions=[place], widths=width, patch_artist=True, manage_ticks=False, whis=0, **style)
    ax.plot(place + np.linspace(-0.4, 0.4, len(found)) * width, np.sort(found), **_points(route))


def _points(route):
    return method_style(route) | {"linestyle": "none", "markersize": 2.6, "markeredgewidth": 0.0}
