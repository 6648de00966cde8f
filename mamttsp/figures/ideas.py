"""The ideas behind the formulations: what fractions cost, perspectives, sizes, and where local methods stop."""

import numpy as np

from .canvas import canvas
from .style import method_style, route_name, shades


def charge_view(distance, size, ax=None):
    """Draw what a fraction of an edge costs in either convex program, against its flow y, and return the axes.

    distance: of the edge's ends, in units; size: R, the big-M. The baseline's (8)-(10) ask for
    l >= distance - R (1 - y), the perspectives (25), (26), (28), (29) for l >= y distance, ends held where they are.
    """
    ax = canvas(ax, (6, 4))
    free = max(0.0, 1.0 - distance / size)
    perspective, big_m = (method_style(method) | {"marker": ""} for method in ("micp", "baseline"))
    ax.plot([0.0, 1.0], [0.0, distance], **perspective, label="perspective: y d")
    ax.plot([0.0, free, 1.0], [0.0, 0.0, distance], **big_m, label="big-M: max(0, d - R (1 - y))")
    ax.plot([0.0, 1.0], [0.0, distance], "o", color="black", label="what a whole y costs")
    ax.set(xlabel="flow y on the edge", ylabel="least length l (units)")
    ax.legend(loc="upper left", frameon=False)
    return ax


def perspective_view(graph, i, shares=(0.25, 0.5, 0.75, 1.0), ax=None):
    """Draw the sets y X_i of node i, in one coordinate of space and time, for some shares y, and return the axes.

    X_i is the segment that (x, t) can be on; y X_i is the same segment drawn y times as far from the origin, and all
    of them together fill a cone.
    """
    ax = canvas(ax, (6, 5))
    ends = np.array([[graph.p_lo[i][0], graph.t_lo[i]], [graph.p_hi[i][0], graph.t_hi[i]]])
    ax.fill(*np.vstack([[0.0, 0.0], ends]).T, color="0.92", zorder=0, label="all shares from 0 to 1")
    for y, colour in zip(shares, shades("micp", len(shares))):
        ax.plot(*(y * ends).T, color=colour, linewidth=3.0, solid_capstyle="butt")
        ax.annotate(f"$y = {y:g}$", y * ends.mean(axis=0), xytext=(9, 0), textcoords="offset points", va="center")
    ax.plot(0.0, 0.0, "o", color="black")
    ax.annotate("$y = 0$", (0.0, 0.0), xytext=(-9, 9), textcoords="offset points", ha="right")
    ax.set(xlabel="$y$ times the position's first coordinate, $z_p$ (units)", ylabel="$y$ times the time, $z_t$ (s)")
    ax.margins(x=0.15)  # room for words
    ax.legend(loc="best", frameon=False)
    return ax


def sizes_view(sizes, ax=None):
    """Draw how many variables formulations have for 1, 2, ... agents, and return the axes.

    sizes: dict from a formulation, "micp", to its numbers of variables, for m = 1, 2, ...
    """
    ax = canvas(ax, (6, 4))
    for method, numbers in sizes.items():
        agents = range(1, len(numbers) + 1)
        ax.plot(agents, numbers, **method_style(method), label=route_name(method))
        ax.set_xticks(agents)
    ax.set(xlabel="agents m", ylabel="variables")
    ax.set_ylim(bottom=0)
    ax.legend(loc="upper left", frameon=False)
    return ax


def descent_view(runs, optimum, ax=None):
    """Draw where a local method for the nonconvex program started and stopped, one column a run, and return the axes.

    runs: list of lists of lengths (units), from the first to the last; optimum: the proved optimum.
    """
    ax = canvas(ax, (7, 4))
    runs = sorted(runs, key=lambda lengths: (round(lengths[-1], 6), lengths[0]))
    starts, ends = ([lengths[k] for lengths in runs] for k in (0, -1))
    number = range(1, len(runs) + 1)
    ax.vlines(number, ends, starts, color="0.75", zorder=1)
    dots = method_style("nonconvex") | {"linestyle": "none"}
    ax.plot(number, starts, **dots, markerfacecolor="white", label="start")
    ax.plot(number, ends, **dots, label="stop")
    ax.axhline(optimum, color="black", linestyle="--", linewidth=1.0, label="proved optimum")
    ax.set(xlabel="start (a flyable route each)", ylabel="length (units)")
    ax.legend(loc="upper left", frameon=False)
    return ax
