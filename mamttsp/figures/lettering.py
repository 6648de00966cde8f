"""Words beside points: each where it covers least of lines, markers and other words."""

import itertools

import numpy as np
from matplotlib.font_manager import FontProperties

from .style import LABEL

#: how much a covered spot counts: on a word or a line that must be read, on a window, on a path
READ, WINDOWS, PATHS = 6.0, 1.5, 0.5
#: distances from the point that are tried, in points of print; farther ones cost as much as so many covered spots
_GAPS = {5.0: 0.0, 11.0: 3.0, 18.0: 8.0}
#: between two spots on a line, in points of print
_STEP = 3.0


def write_beside(ax, words, lines):
    """Write words beside points, on axes whose limits and aspect stand.

    words: (text, (x, y, ...), style) each, the first ones choose first; style: how it differs from `style.LABEL`.
    lines: (rows (x, y), weight) each: what words should not cover.
    """
    to_points = ax.transData.transform
    scale = 72.0 / ax.figure.dpi
    covered = [_spots(scale * to_points(np.asarray(rows, float)[:, :2]), weight) for rows, weight in lines]
    covered = np.vstack([np.empty((0, 3)), *covered])
    low, high = scale * ax.bbox.min, scale * ax.bbox.max
    for text, (x, y, *_), style in words:
        style = {"fontsize": "small"} | LABEL | style
        size = FontProperties(size=style["fontsize"]).get_size_in_points()
        half = np.array([0.31 * size * len(text), 0.5 * size])
        centre = scale * to_points((x, y))
        offsets, costs = _candidates(half)
        for k, offset in enumerate(offsets):
            inside = (np.abs(covered[:, :2] - centre - offset) < half + 1.0).all(axis=1)
            beyond = (centre + offset - half < low).any() or (centre + offset + half > high).any()
            costs[k] += covered[inside, 2].sum() + READ * beyond
        best = offsets[int(np.argmin(costs))]
        ax.annotate(text, (x, y), xytext=best, textcoords="offset points", **style)
        box = np.array(list(itertools.product(np.linspace(-1, 1, 7), np.linspace(-1, 1, 3)))) * half
        covered = np.vstack([covered, np.c_[centre + best + box, np.full(len(box), READ)]])


def _candidates(half):
    """Return (offsets, costs) of the middles of a word around its point, in points of print."""
    angles = np.pi / 8 * np.arange(16)
    tried = [(np.array([np.cos(a), np.sin(a)]) * (half + gap), cost) for gap, cost in _GAPS.items() for a in angles]
    return np.array([offset for offset, _ in tried]), np.array([cost for _, cost in tried])


def _spots(corners, weight):
    """Return (N, 3): spots along a line, a few points of print apart, each with its weight."""
    parts = [corners[:1]]
    for p, q in itertools.pairwise(corners):
        count = int(np.hypot(*(q - p)) // _STEP) + 1
        parts.append(p + (q - p) * (np.arange(1, count + 1) / count)[:, None])
    spots = np.vstack(parts)
    return np.c_[spots, np.full(len(spots), weight)]
