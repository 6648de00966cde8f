"""What all drawings share: the methods' palette, colours, line styles and markers, and how a drawing is saved."""

from pathlib import Path

from matplotlib import rc_context, rcParams, rcParamsDefault
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb, to_rgba
from matplotlib.patheffects import withStroke

from ..validation import InputError, file_path, of_type, positive

#: agents in turn: colours that the colour-blind can tell apart (Okabe and Ito), line styles and markers that need none
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9")
LINES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1)))
MARKERS = ("o", "s", "^", "D", "v")
PATH = {"color": "0.65", "linewidth": 1.0, "zorder": 1}
WINDOW = {"color": "#F5C45E", "linewidth": 5.0, "solid_capstyle": "butt", "zorder": 2}
DEPOT = {"color": "black", "marker": "*", "markersize": 14, "linestyle": "none", "zorder": 6}
#: a thin white rim keeps a word readable on a line, and the line too
LABEL = {"ha": "center", "va": "center", "zorder": 7, "path_effects": [withStroke(linewidth=1.6, foreground="white")]}
#: methods in the order of legends; black is left for optima
_METHODS = {
    name: {"color": colour, "linestyle": line, "marker": marker}
    for name, colour, line, marker in zip(
        ("micp", "baseline", "micp/clarabel", "exact", "nonconvex"), (*COLOURS[:4], COLOURS[5]), LINES, MARKERS
    )
}
_HATCHES = dict(zip(_METHODS, ("", "/////", "....", "xxxxx", "")))
_NAMES = {"micp": "MICP", "scip": "SCIP", "clarabel": "Clarabel", "gurobi": "Gurobi"}
#: what a format would otherwise write of the day
_NO_DATE = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}


def method_style(route):
    """Return the colour, line style and marker of a method, the same in every drawing.

    route: a method, "micp", or a method with its solver, "micp/scip". Words behind it, "micp without (22)", make a
    variant: dotted and hollow.
    """
    variant = {"linestyle": ":", "markerfacecolor": "white"} if " " in route else {}
    return _METHODS[_method(route)] | variant


def bar_style(route):
    """Return a route's tint, colour and hatch: lighter than its line, which stays readable on top."""
    colour = method_style(route)["color"]
    return {"facecolor": to_rgba(colour, 0.3), "edgecolor": colour, "hatch": _HATCHES[_method(route)]}


def shades(route, count):
    """Return `count` colours for settings of one method, from light to its own."""
    parts = [1.0] if count == 1 else [0.4 + 0.6 * k / (count - 1) for k in range(count)]
    own = to_rgb(_METHODS[_method(route)]["color"])
    return [tuple(1.0 - part * (1.0 - c) for c in own) for part in parts]


def route_name(route):
    """Return how legends name a route: "micp/scip" is "MICP, SCIP"."""
    method, *words = route.split(" ")
    return " ".join([", ".join(_NAMES.get(part, part) for part in method.split("/")), *words])


def in_order(routes):
    """Return routes without repetition, in the same order in every drawing."""
    return sorted(dict.fromkeys(routes), key=lambda route: list(_METHODS).index(_method(route)))


def _method(route):
    """Return the entry of the palette that a route has: its own, or its method's."""
    route = route.split(" ")[0]
    return route if route in _METHODS else route.split("/")[0]


def in_print(style):
    """Return a style with its widths and sizes in proportion to the lines that matplotlib draws at present.

    So a drawing for a printed column, whose lines are thinner, is the same drawing, smaller.
    """
    scale = rcParams["lines.linewidth"] / rcParamsDefault["lines.linewidth"]
    return style | {name: scale * style[name] for name in ("linewidth", "markersize") if name in style}


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
    path, dpi = file_path("path", path), positive("dpi", dpi)
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
