"""How many instances each route solves within a time (cactus plot), or within a multiple of the quickest's time."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator, PercentFormatter
from scipy.stats import CensoredData, ecdf

from .canvas import canvas
from .column import COLUMN, WIDTH, legend_above
from .style import in_order, method_style, route_name


@plt.rc_context(COLUMN)
def cactus_view(times, limit, ax=None):
    """Draw how many instances each route has solved by a time (s, logarithmic), and return the axes.

    times: a DataFrame, an instance a line and a route a column, in s; inf where it was not solved within `limit` s.
    """
    ax = canvas(ax, (WIDTH, 2.8))
    _steps(ax, times, len(times), start=times.to_numpy().min(initial=limit) / 2, end=limit)
    ax.set(xscale="log", xlabel="wall time of the whole solve (s)", ylabel=f"instances solved (of {len(times)})")
    ax.set_ylim(0, max(1.0, 1.03 * len(times)))
    ax.yaxis.set_major_locator(MaxNLocator("auto", integer=True))
    return ax


@plt.rc_context(COLUMN)
def profile_view(times, ax=None):
    """Draw the performance profile of Dolan and Moré, and return the axes.

    It shows for which share of the instances a route's time is at most a multiple (logarithmic) of the time of the
    instance's quickest route. times: as for cactus_view; an instance that no route solved lowers every curve.
    """
    ax = canvas(ax, (WIDTH, 2.8))
    ratios = times.div(times.min(axis=1), axis=0).fillna(np.inf)  # inf / inf: nobody solved it
    worst = ratios.replace(np.inf, 1.0).to_numpy().max(initial=1.0)
    _steps(ax, ratios, 1.0, start=1.0, end=max(2.0, 2 * worst))
    ax.set(xscale="log", xlabel="time as a multiple of the quickest", ylabel="instances", ylim=(0, 1.03))
    ax.yaxis.set_major_formatter(PercentFormatter(1.0))
    return ax


def _steps(ax, values, whole, start, end):
    """Draw the share of each column that is at most x, times `whole`, from x = start to end."""
    for route in in_order(values.columns) if len(values) else ():
        column = values[route]
        finite = np.isfinite(column)
        known = ecdf(CensoredData.right_censored(column.where(finite, end), ~finite)).cdf
        x = np.unique([start, *column[finite], end])
        style = method_style(route) | {"markevery": max(1, len(x) // 8), "drawstyle": "steps-post"}
        ax.plot(x, whole * known.evaluate(x), **style, label=route_name(route))
    ax.set_xlim(start, end)
    legend_above(ax)
