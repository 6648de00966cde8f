"""Tours in motion: the plane at one moment, and a film of such moments that plays in a page without a kernel."""

import base64
import hashlib
import io
import re

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.animation import FuncAnimation
from PIL import Image

from ..instance import Instance
from ..tours import agents_of, as_tours
from ..validation import counted, number, of_type, positive
from .canvas import canvas
from .depots import depots
from .plan import target_parts
from .recording import PER_SECOND, Film, few_colours
from .style import COLOURS, MARKERS, PATH, WINDOW

#: matplotlib's player takes its buttons' pictures from the network; these signs need none, and are in most fonts
_SIGNS = {"minus": "−", "plus": "+", "pause": "||", "play": "▶", "play fa-flip-horizontal": "◀"}
_SIGNS |= {"fast-backward": "|◀", "step-backward": "◀|", "step-forward": "|▶", "fast-forward": "▶|"}


def moment_view(instance, tours, time, ax=None, unit="units"):
    """Draw the plane at `time` in s: targets, agents and what these have flown so far; return the axes.

    A target is a dot on its grey path: filled while one of its windows is open, hollow before and after, gone once it
    is visited. Thick and yellow are the parts of the path in open windows. Agents move at constant speed on each leg.
    tours: a Solution, or a sequence of Tour; unit: of lengths, as the axes name it, such as "km". InputError: not an
    Instance, no tours, a time that is no number, or no axes.

    >>> from mamttsp import generate
    >>> from mamttsp.figures import moment_view
    >>> moment_view(generate(n_targets=3, total_window=20, seed=1), tours=[], time=10).get_title()
    '10 s: 0 of 3 targets visited'
    """
    of_type("instance", instance, Instance)
    tours, time = as_tours(tours), number("time", time)
    ax = canvas(ax, (6, 5.4), dpi=72)
    visited = {visit.target for tour in tours for visit in tour.visits if visit.time <= time}
    for u, path, in_windows in target_parts(instance):
        ax.plot(*path[:, :2].T, **PATH)
        if u not in visited:
            now = [window for window in in_windows if window[0, 2] <= time <= window[-1, 2]]
            _draw_target(ax, u, instance.targets[u].position(time), now)
    for k, tour in enumerate(tours):
        times, stops = _stops(instance, tour)
        flown = np.vstack([stops[times < time], _between(times, stops, time)])
        ax.plot(*flown.T, color=COLOURS[k % len(COLOURS)], linewidth=1.8, zorder=4)
        style = {"marker": MARKERS[k % len(MARKERS)], "color": COLOURS[k % len(COLOURS)], "linestyle": "none"}
        ax.plot(*flown[-1:].T, markersize=9, zorder=7, label=f"tour {k}", **style)
    places = [place for place, _, _ in depots(instance)]
    for place, style, _ in depots(instance):
        ax.plot(*place, **style)
    corners = np.vstack([*places, *(target.points for target in instance.targets)])
    margin = 0.04 * instance.size
    low, high = corners.min(axis=0) - margin, corners.max(axis=0) + margin
    ax.set(xlabel=f"x ({unit})", ylabel=f"y ({unit})", xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    ax.set_title(f"{time:.0f} s: {len(visited)} of {counted(instance.n_targets, 'target')} visited")
    return ax


def film(instance, tours, step=3.0, unit="units"):
    """Return a Film of the tours: moments `step` seconds apart, from the start until the last agent is back.

    It plays without a kernel and without the network; where scripts are off, its first picture stands there. The same
    tours give the same bytes. tours: a Solution, or a sequence of Tour; unit: of lengths, as the axes name it, such as
    "km". InputError: not an Instance, no tours, or a step that is not above 0.

    >>> from mamttsp import generate, solve
    >>> from mamttsp.figures import film
    >>> instance = generate(n_targets=3, total_window=20, seed=1)
    >>> shown = film(instance, solve(instance).tours, step=50)
    >>> "animation" in shown.html
    True
    """
    of_type("instance", instance, Instance)
    tours, step = as_tours(tours), positive("step", step)
    last = max((tour.return_time for tour in tours), default=0.0)
    ax = plt.figure(figsize=(6, 5.4), dpi=72).add_subplot()

    def draw(time):
        ax.clear()
        moment_view(instance, tours, time, ax, unit)

    moments = step * np.arange(np.ceil(last / step) + 1)
    page = FuncAnimation(ax.figure, draw, moments, init_func=lambda: None).to_jshtml(
        fps=PER_SECOND, default_mode="once"
    )
    plt.close(ax.figure)
    page = page.replace("\\\n", "")  # pictures come in lines of 76 characters
    frames = re.findall(r'frames\[\d+\] = "data:image/png;base64,([^"]*)"', page)
    return Film(_self_contained(page), tuple(map(base64.b64decode, frames)))


def _draw_target(ax, u, place, open_windows):
    """Draw a target that waits for its visit at `place`, and the parts of its path in open windows."""
    for window in open_windows:
        ax.plot(*window[:, :2].T, **WINDOW)
    face = "0.25" if open_windows else "white"
    ax.plot(*place, "o", markersize=8, color="0.25", markerfacecolor=face, zorder=5)
    ax.annotate(str(u), place, xytext=(7, 7), textcoords="offset points", fontsize=9)


def _stops(instance, tour):
    """Return (times, stops): when and where (rows x, y) the agent's legs end, the depot first and last."""
    entry = agents_of(instance, tour)
    times = [0.0, *(visit.time for visit in tour.visits), tour.return_time]
    home = entry.end if tour.visits else entry.depot
    return np.array(times), np.array([entry.depot, *(visit.position for visit in tour.visits), home])


def _between(times, stops, time):
    return np.array([np.interp(time, times, stops[:, axis]) for axis in (0, 1)])


def _self_contained(page):
    """Return the player's page without random names and foreign files, with its first picture in its place."""
    page = re.sub(r"<link[^>]*>", "", page)
    page = re.sub(r"(?<=data:image/png;base64,)[^\"]*", lambda found: _small(found[0]), page)
    page = re.sub(r'<i class="fa fa-([^"]*)"></i>', lambda found: _SIGNS[found[1]], page)
    random_name = re.search(r"_anim_img(\w+)", page)[1]
    page = page.replace(random_name, hashlib.sha256(page.replace(random_name, "").encode()).hexdigest()[:12])
    first = re.search(r'frames\[0\] = "([^"]*)"', page)[1]
    page = page.replace("width: 374px", "width: min(374px, 90%)")  # the slider fits a phone too
    start = f'<img alt="The tours from above, in motion" style="max-width: 100%; height: auto" src="{first}" '
    return page.replace("<img ", start, 1)


def _small(picture):
    """Return a PNG picture (base64) with few colours, which takes a third of the room."""
    small = io.BytesIO()
    few_colours(Image.open(io.BytesIO(base64.b64decode(picture)))).save(small, "png", optimize=True)
    return base64.b64encode(small.getvalue()).decode()
