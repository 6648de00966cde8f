"""The road of a certificate: a bound that rises step by step, tours that get shorter, and the optimum between them."""

import numpy as np

from .canvas import canvas
from .style import COLOURS, LABEL

_STEPS = (
    "cut time\ninto pieces",
    "relaxed routes\nand prices",
    "drop what\ncannot matter",
    "list the routes\nthat are left",
    "choose,\nand settle",
)
_OBJECTIVE, _BOUND = "objective: the best tours found", "bound: no tours are shorter"
_BOX = {"boxstyle": "round,pad=0.45", "facecolor": "white", "linewidth": 1.3}
_ARROW = {"arrowstyle": "-|>", "linewidth": 1.3, "shrinkA": 0, "shrinkB": 0}


def road_view(sections=(), ax=None):
    """Draw the steps of the exact solver below the optimum, its tours above it, and return the axes.

    sections: names of where each of the five steps is told, written below them.
    """
    ax = canvas(ax, (9, 4.6))
    x, optimum = np.arange(len(_STEPS)), 3.4
    bound = np.array([1.4, 2.4, 2.4, 3.0, optimum])
    length = np.array([4.4, 3.9, 3.9, 3.6, optimum])
    ax.axhline(optimum, color="black", linewidth=1.0, linestyle=":")
    ax.text(-0.7, optimum + 0.1, "optimum", ha="left", va="bottom")
    ax.step(x, length, where="post", color=COLOURS[1], marker="s", label=_OBJECTIVE)
    ax.step(x, bound, where="post", color=COLOURS[0], linestyle="--", marker="o", label=_BOUND)
    ax.fill_between(x, bound, length, step="post", color="0.93", zorder=0)
    ax.text(1.5, 2.9, "gap", LABEL)
    ax.text(1.1, length[1] + 0.1, _OBJECTIVE, va="bottom", fontsize=9, color=COLOURS[1])
    ax.text(1.1, bound[1] - 0.12, _BOUND, va="top", fontsize=9, color=COLOURS[0])
    for k, step in enumerate(_STEPS):
        where = "\n" + sections[k] if sections else ""
        ax.text(x[k], 0.0, step + where, ha="center", va="center", fontsize=9, bbox=_BOX | {"edgecolor": COLOURS[0]})
        if k in (1, 3, 4):  # these steps prove a bound
            ax.annotate("", (x[k], bound[k] - 0.12), (x[k], 0.55), arrowprops=_ARROW | {"color": COLOURS[0]})
        if k:
            ax.annotate("", (x[k] - 0.44, 0.0), (x[k] - 0.56, 0.0), arrowprops=_ARROW | {"color": "black"})
    tours = "look for tours: ruin and recreate at first, then the routes that the other steps meet"
    ax.text(1.5, 5.4, tours, ha="center", va="center", fontsize=9, bbox=_BOX | {"edgecolor": COLOURS[1]})
    for k in (0, 1, 3):
        ax.annotate("", (x[k], length[k] + 0.12), (x[k], 5.1), arrowprops=_ARROW | {"color": COLOURS[1]})
    _back(ax, 4.0, 1.0, "too much is left: remember more, add cuts, or cut the pieces that are left finer")
    ax.set(xlim=(-0.75, 4.75), ylim=(-1.6, 5.8))
    ax.axis("off")
    return ax


def _back(ax, start, end, words):
    """Draw an arrow below the steps from one of them back to another, with words on it."""
    ax.plot([start, start, end], [-0.6, -1.1, -1.1], color="black", linewidth=1.3)
    ax.annotate("", (end, -0.6), (end, -1.1), arrowprops=_ARROW | {"color": "black"})
    ax.text((start + end) / 2, -1.2, words, ha="center", va="top", fontsize=9)
