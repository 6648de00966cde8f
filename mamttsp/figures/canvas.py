"""Where a drawing goes: on the axes that were given, or on a figure of its own."""

import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from ..validation import InputError, of_type


def canvas(ax, size, dpi=None, **subplot):
    """Return `ax`, or if it is None the axes of a new figure.

    size: width and height of that figure in inches; dpi: its pixels an inch; subplot: arguments of `add_subplot`.
    InputError: `ax` is not axes, or flat where those of space and time are needed.
    """
    if ax is None:
        return plt.figure(figsize=size, dpi=dpi, layout="constrained").add_subplot(**subplot)
    of_type("ax", ax, Axes)
    if subplot.get("projection", ax.name) != ax.name:
        raise InputError(f'ax: expected axes with projection="{subplot["projection"]}", found flat ones')
    return ax
