"""Relaxed bounds: how much of the optimum they reach, how they fall, and the flow that attains one."""

import matplotlib.pyplot as plt
import numpy as np

from .plan import target_parts
from .style import COLOURS, LABEL, LINES, MARKERS, once

_NAMES = {"total_window": "windows of {} s", "agents": "{} agents"}


def relaxation_view(rows, by="total_window", ax=None):
    """Draw relaxed bounds as parts of the optimum against the number of targets, and return the axes.

    rows: data frame with columns n, method, ratio and `by`, "total_window" or "agents": a line for each of its values
    joins the MICP's means, a bar on each reaches from the least to the largest. All baselines are one grey line.
    """
    ax = ax or plt.figure(figsize=(6, 4), layout="constrained").add_subplot()
    new, old = (rows[rows["method"] == method] for method in ("micp", "baseline"))
    for k, (value, group) in enumerate(new.groupby(by)):
        parts = group.groupby("n")["ratio"].agg(["mean", "min", "max"])
        n, mean = parts.index + 0.25 * (k - 1), parts["mean"]  # side by side, or the bars would hide each other
        ax.vlines(n, parts["min"], parts["max"], color=COLOURS[k], alpha=0.5)
        style = {"color": COLOURS[k], "linestyle": LINES[k], "marker": MARKERS[k]}
        ax.plot(n, mean, **style, label=_NAMES[by].format(value).replace("1 agents", "1 agent"))
    zero = old.groupby("n")["ratio"].mean()
    ax.plot(zero.index, zero, color="0.45", marker="x", label="baseline, all")
    ax.set(xlabel="targets n", ylabel="relaxed bound / optimum", ylim=(-0.03, 1.03), xticks=sorted(set(rows["n"])))
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 0.04), ncols=2, fontsize=9, frameon=False)
    return ax


def growth_view(windows, optima, bounds, ax=None):
    """Draw optimum and relaxed bounds of one instance against the length of its windows, and return the axes.

    windows: (K,) total length in s; optima: (K,) units; bounds: dict from a name to (K,) units.
    """
    ax = ax or plt.figure(figsize=(6, 4), layout="constrained").add_subplot()
    for k, (name, lengths) in enumerate({"optimum": optima, **bounds}.items()):
        ax.plot(windows, lengths, color=("black", *COLOURS)[k], linestyle=LINES[k], marker=MARKERS[k], label=name)
    ax.set(xlabel="total window of each target (s)", ylabel="length (units)", ylim=(-0.03 * max(optima), None))
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def flow_view(instance, y, tails, heads, ax=None):
    """Draw a fractional flow from above, and return the axes.

    y: (K,) flows; tails, heads: (K, 2) where each edge begins and ends. A line is as thick as its flow: blue and solid
    for (almost) whole ones, orange and dashed for fractions. Grey are the parts of the targets' paths in windows, with
    the target's number.
    """
    ax = ax or plt.figure(figsize=(6, 5.4), layout="constrained").add_subplot()
    for u, _, in_windows in target_parts(instance):
        for window in in_windows:
            ax.plot(*window[:, :2].T, color="0.8", linewidth=5, zorder=1)
            ax.annotate(str(u), window[:, :2].mean(axis=0), **LABEL)
    whole = np.asarray(y) > 0.99
    for group, colour, line in ((whole, COLOURS[0], "-"), (~whole, COLOURS[1], "--")):
        for k, (share, tail, head) in enumerate(zip(y[group], tails[group], heads[group])):
            name = once(k, "whole" if line == "-" else "fraction")
            ax.plot(*np.c_[tail, head], color=colour, linestyle=line, linewidth=0.3 + 3.0 * share, zorder=3, **name)
    ax.plot(*instance.depot, color="black", marker="*", markersize=14, linestyle="none", zorder=6, label="depot")
    ax.set(xlabel="x (units)", ylabel="y (units)", aspect="equal")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax
