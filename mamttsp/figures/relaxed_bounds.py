"""Relaxed bounds: how much of the optimum they reach, how they fall, and the flow that attains one."""

import numpy as np

from .canvas import canvas
from .lettering import READ, write_beside
from .plan import draw_targets, window_numbers
from .style import DEPOT, LINES, method_style, route_name, shades

#: how far an edge of a flow is bent, as a part of its length
_BEND = 0.15
_NAMES = {"total_window": "windows of {} s", "agents": "{} agents"}


def relaxation_view(rows, by="total_window", ax=None):
    """Draw relaxed bounds as parts of the optimum against the number of targets, and return the axes.

    rows: data frame with columns n, method, ratio and `by`, "total_window" or "agents": a line for each of its values
    joins the MICP's means, in shades of its colour; a bar on each reaches from the least to the largest. All baselines
    are one line.
    """
    ax = canvas(ax, (6, 4))
    new, old = (rows[rows["method"] == method] for method in ("micp", "baseline"))
    colours = shades("micp", new[by].nunique())
    for k, (value, group) in enumerate(new.groupby(by)):
        parts = group.groupby("n")["ratio"].agg(["mean", "min", "max"])
        n, mean = parts.index + 0.25 * (k - 1), parts["mean"]  # side by side, or the bars would hide each other
        ax.vlines(n, parts["min"], parts["max"], color=colours[k], alpha=0.5)
        style = method_style("micp") | {"color": colours[k], "linestyle": LINES[k]}
        ax.plot(n, mean, **style, label="MICP, " + _NAMES[by].format(value).replace("1 agents", "1 agent"))
    zero = old.groupby("n")["ratio"].mean()
    ax.plot(zero.index, zero, **method_style("baseline"), label="baseline, all")
    ax.set(xlabel="targets n", ylabel="relaxed bound / optimum", ylim=(-0.03, 1.03), xticks=sorted(set(rows["n"])))
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 0.04), fontsize=9, frameon=False)
    return ax


def growth_view(windows, optima, bounds, ax=None):
    """Draw optimum and relaxed bounds of one instance against the length of its windows, and return the axes.

    windows: (K,) total length in s; optima: (K,) units; bounds: dict from a formulation, or a variant such as
    "micp without (22)", to (K,) units.
    """
    ax = canvas(ax, (6, 4))
    ax.plot(windows, optima, color="black", label="optimum")
    for name, lengths in bounds.items():
        ax.plot(windows, lengths, **method_style(name), label=route_name(name))
    ax.set(xlabel="total window of each target (s)", ylabel="length (units)", ylim=(-0.03 * max(optima), None))
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def flow_view(instance, y, tails, heads, ax=None):
    """Draw a fractional flow from above, and return the axes.

    y: (K,) flows; tails, heads: (K, 2) where each edge begins and ends. An edge is as thick as its flow, with an
    arrowhead in its middle, and bent to the right, so that one there and one back are two: solid for (almost) whole
    flows, dashed for fractions, with its flow beside it from 0.1 on. The parts of the targets' paths in windows are
    thick and yellow, each with its target's number.
    """
    ax = canvas(ax, (8, 7))
    lines, shares = draw_targets(ax, instance), []
    ax.plot(*instance.depot, **DEPOT, label="depot")
    colour = method_style("micp")["color"]
    kinds = {True: ("-", "whole flow"), False: ((0, (4, 1)), "fraction")}
    for share, tail, head in zip(y, tails, heads):
        way = _bent(tail, head)
        middle, turn = way[len(way) // 2], np.degrees(np.arctan2(*(head - tail)[::-1])) - 90
        ax.plot(*way.T, color=colour, linestyle=kinds[share > 0.99][0], linewidth=0.5 + 2.0 * share, zorder=3)
        style = {"markersize": 5 + 4 * share, "color": colour, "linestyle": "none", "zorder": 4}
        ax.plot(*middle, marker=(3, 0, turn), **style)
        lines.append((way, READ))
        if share >= 0.1:
            shares.append((f"{share:.2f}", middle, {"color": colour}))
    for line, name in kinds.values():
        ax.plot([], [], color=colour, linestyle=line, linewidth=2.0, label=name)
    ax.set(xlabel="x (units)", ylabel="y (units)", aspect="equal")
    ax.apply_aspect()
    write_beside(ax, [*window_numbers(instance), *shares], lines)
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def _bent(tail, head):
    """Return (21, 2): points on a curve from tail to head, bent to the right of the straight way."""
    x, y = head - tail
    control = (tail + head) / 2 + _BEND * np.array([y, -x])
    s = np.linspace(0.0, 1.0, 21)[:, None]
    return (1 - s) ** 2 * tail + 2 * s * (1 - s) * control + s**2 * head
