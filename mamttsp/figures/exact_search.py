"""How the exact solver narrows things down: bounds that rise, and pieces still alive."""

import numpy as np

from .canvas import canvas
from .style import COLOURS, LINES, MARKERS, once


def ascent_view(bounds, optimum, ax=None):
    """Draw how bounds rise with the evaluations of column generation, and return the axes.

    bounds: dict from a name to its bounds (units) after 1, 2, ... evaluations; optimum: of the instance, units.
    """
    ax = canvas(ax, (6, 4))
    for k, (name, values) in enumerate(bounds.items()):
        numbers = range(1, len(values) + 1)
        ax.plot(numbers, values, color=COLOURS[k], linestyle=LINES[k], marker=MARKERS[k], label=name)
    ax.axhline(optimum, color="black", linewidth=1.0, linestyle="--", label="optimum")
    ax.set(xlabel="evaluations", ylabel="bound (units)")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax


def alive_view(pieces, alive, visits=(), ax=None):
    """Draw the pieces in time, a row for each target, those `alive` (Q,) in blue, and return the axes.

    visits: `tours.Visit`s, each a star on the row of its target.
    """
    ax = canvas(ax, (8, 3.5))
    for name, which, colour in (("dropped", ~alive, "0.85"), ("alive", alive, COLOURS[0])):
        row, a, b = pieces.target[which], pieces.a[which], pieces.b[which]
        ax.barh(row, b - a, left=a, height=0.5, color=colour, edgecolor="white", linewidth=0.5, label=name)
    for k, visit in enumerate(visits):
        ax.plot(visit.time, visit.target, "*", color=COLOURS[4], markersize=11, **once(k, "visit of the best tour"))
    ax.set(xlabel="time (s)", ylabel="target", yticks=np.unique(pieces.target), xlim=(0, pieces.horizon))
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, frameon=False)
    return ax
