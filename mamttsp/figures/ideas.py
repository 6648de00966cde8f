"""The ideas behind the formulations: what fractions cost, perspectives, sizes, and where local methods stop."""

import matplotlib.pyplot as plt
import numpy as np

from .style import COLOURS, LINES, MARKERS


def charge_view(distance, size, ax=None):
    """Draw what a fraction of an edge costs in either convex program, against its flow y, and return the axes.

    distance: of the edge's ends, in units; size: R, the big-M. The baseline's (8)-(10) ask for
    l >= distance - R (1 - y), the perspectives (25), (26), (28), (29) for l >= y distance, ends held where they are.
    """
    ax = ax or plt.figure(figsize=(6, 4), layout="constrained").add_subplot()
    free = max(0.0, 1.0 - distance / size)
    ax.plot([0.0, 1.0], [0.0, distance], color=COLOURS[0], label="perspective: y d")
    big_m = {"color": COLOURS[1], "linestyle": "--", "label": "big-M: max(0, d - R (1 - y))"}
    ax.plot([0.0, free, 1.0], [0.0, 0.0, distance], **big_m)
    ax.plot([0.0, 1.0], [0.0, distance], "o", color="black", label="what a whole y costs")
    ax.set(xlabel="flow y on the edge", ylabel="least length l (units)")
    ax.legend(loc="upper left", frameon=False)
    return ax


def perspective_view(graph, i, shares=(0.25, 0.5, 0.75, 1.0), ax=None):
    """Draw the sets y X_i of node i, in one coordinate of space and time, for some shares y, and return the axes.

    X_i is the segment that (x, t) can be on; y X_i is the same segment drawn y times as far from the origin, and all
    of them together fill a cone.
    """
    ax = ax or plt.figure(figsize=(6, 5), layout="constrained").add_subplot()
    ends = np.array([[graph.p_lo[i][0], graph.t_lo[i]], [graph.p_hi[i][0], graph.t_hi[i]]])
    ax.fill(*np.vstack([[0.0, 0.0], ends]).T, color="0.92", zorder=0, label="all shares from 0 to 1")
    for k, y in enumerate(shares):
        style = {"color": COLOURS[k % len(COLOURS)], "linestyle": LINES[-k % len(LINES)], "linewidth": 2.0}
        ax.plot(*(y * ends).T, **style, label=f"y = {y:g}")
    ax.plot(0.0, 0.0, "o", color="black", label="y = 0")
    ax.set(xlabel="z_p, first coordinate (units)", ylabel="z_t (s)")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def sizes_view(sizes, ax=None):
    """Draw how many variables formulations have for 1, 2, ... agents, and return the axes.

    sizes: dict from the name of a formulation to its numbers of variables, for m = 1, 2, ...
    """
    ax = ax or plt.figure(figsize=(6, 4), layout="constrained").add_subplot()
    for k, (name, numbers) in enumerate(sizes.items()):
        agents = range(1, len(numbers) + 1)
        ax.plot(agents, numbers, color=COLOURS[k], linestyle=LINES[k], marker=MARKERS[k], label=name)
        ax.set_xticks(agents)
    ax.set(xlabel="agents m", ylabel="variables")
    ax.set_ylim(bottom=0)
    ax.legend(loc="upper left", frameon=False)
    return ax


def descent_view(runs, optimum, ax=None):
    """Draw where a local method started and where it stopped, one column a run, and return the axes.

    runs: list of lists of lengths (units), from the first to the last; optimum: the proved optimum.
    """
    ax = ax or plt.figure(figsize=(7, 4), layout="constrained").add_subplot()
    runs = sorted(runs, key=lambda lengths: (round(lengths[-1], 6), lengths[0]))
    starts, ends = ([lengths[k] for lengths in runs] for k in (0, -1))
    number = range(1, len(runs) + 1)
    ax.vlines(number, ends, starts, color="0.75", zorder=1)
    ax.plot(number, starts, "o", color=COLOURS[5], label="start")
    ax.plot(number, ends, "s", color=COLOURS[1], label="stop")
    ax.axhline(optimum, color="black", linestyle="--", linewidth=1.0, label="proved optimum")
    ax.set(xlabel="start (a flyable route each)", ylabel="length (units)")
    ax.legend(loc="upper left", frameon=False)
    return ax
