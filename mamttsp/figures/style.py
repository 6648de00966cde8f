"""What all drawings share: colours, line styles and markers, and how a drawing is saved."""

import os
from pathlib import Path

from matplotlib import rc_context
from matplotlib.axes import Axes

from ..validation import InputError, of_type

#: agents in turn: colours that the colour-blind can tell apart (Okabe and Ito), line styles and markers that need none
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9")
LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1)))
MARKERS = ("o", "s", "^", "D", "v")
PATH = {"color": "0.65", "linewidth": 1.0, "zorder": 1}
WINDOW = {"color": "#F5C45E", "linewidth": 5.0, "solid_capstyle": "butt", "zorder": 2}
DEPOT = {"color": "black", "marker": "*", "markersize": 14, "linestyle": "none", "zorder": 6}
_BOX = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.7}
LABEL = {"fontsize": 9, "ha": "center", "va": "center", "zorder": 7, "bbox": _BOX}
#: what a format would otherwise write of the day
_NO_DATE = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}


def save(ax, path, dpi=150):
    """Write the figure that holds `ax` to `path`, in the format of its suffix; each time the same bytes.

    Without a suffix, to path.pdf, to print, and path.png, to look at. dpi: pixels an inch where there are pixels.
    InputError: no axes, no path, a suffix that matplotlib does not know, or a file that cannot be written.

    >>> import mamttsp
    >>> ax = mamttsp.plot(mamttsp.generate(n_targets=3, total_window=20, seed=1))
    >>> mamttsp.figures.save(ax, "plan.doc")
    Traceback (most recent call last):
        ...
    mamttsp.validation.InputError: plan.doc: expected one of .pdf, .png, .svg or another suffix that matplotlib knows
    """
    of_type("ax", ax, Axes)
    path = Path(of_type("path", path, (str, os.PathLike)))
    known = ax.figure.canvas.get_supported_filetypes()
    if path.suffix and path.suffix[1:].lower() not in known:
        raise InputError(f"{path}: expected one of .pdf, .png, .svg or another suffix that matplotlib knows")
    for file in [path] if path.suffix else [Path(f"{path}.pdf"), Path(f"{path}.png")]:
        try:
            with rc_context({"svg.hashsalt": "mamttsp"}):
                ax.figure.savefig(file, dpi=dpi, metadata=_NO_DATE.get(file.suffix.lower()))
        except OSError as error:
            raise InputError(f"{file}: cannot be written: {error.strerror}") from error


def once(k, label):
    """Return the legend's label for the first of its kind only."""
    return {"label": label} if k == 0 else {}
