"""What all drawings share: colours, line styles and markers, and how a drawing is saved."""

#: agents in turn: colours that the colour-blind can tell apart (Okabe and Ito), line styles and markers that need none
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9")
LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1)))
MARKERS = ("o", "s", "^", "D", "v")
PATH = {"color": "0.65", "linewidth": 1.0, "zorder": 1}
WINDOW = {"color": "#F5C45E", "linewidth": 5.0, "solid_capstyle": "butt", "zorder": 2}
DEPOT = {"color": "black", "marker": "*", "markersize": 14, "linestyle": "none", "zorder": 6}
_BOX = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.7}
LABEL = {"fontsize": 9, "ha": "center", "va": "center", "zorder": 7, "bbox": _BOX}


def save(ax, path, dpi=150):
    """Write the figure that holds `ax` to path.pdf, to print, and path.png, to look at; each time the same bytes.

    dpi: pixels an inch of the PNG.
    """
    ax.figure.savefig(f"{path}.pdf", metadata={"CreationDate": None})
    ax.figure.savefig(f"{path}.png", dpi=dpi)


def once(k, label):
    """Return the legend's label for the first of its kind only."""
    return {"label": label} if k == 0 else {}
