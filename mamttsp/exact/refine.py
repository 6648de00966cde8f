"""Finer pieces: those still in use are cut into shorter parts, the incumbent's visit times in the middle of theirs."""

import math

import numpy as np


def finer(cut, used, width, centre):
    """Return (cut, origin): the pieces `used` (indices) cut into parts of about `width` s, and which piece each is of.

    cut: (segment (Q,), a (Q,), b (Q,)): segments and ends of pieces; centre: {segment: visit time in s}.
    """
    segment, a, b = cut
    rows, origin = [], []
    for q in used:
        for start, end in split(a[q], b[q], width, centre.get(int(segment[q]))):
            rows.append((segment[q], start, end))
            origin.append(q)
    return tuple(np.array(part) for part in zip(*rows)), origin


def split(a, b, width, centre=None):
    """Return (start, end) pairs that cut [a, b] into parts of about `width`, one of them around `centre` if that is
    inside."""
    if centre is None or not a < centre < b:
        points = np.linspace(a, b, max(1, math.ceil((b - a) / width - 1e-9)) + 1)
    else:
        steps = np.arange(math.floor((a - centre) / width), math.ceil((b - centre) / width) + 1) - 0.5
        inner = centre + steps * width
        points = np.r_[a, inner[(inner > a + 0.1 * width) & (inner < b - 0.1 * width)], b]
    return zip(points[:-1], points[1:])
