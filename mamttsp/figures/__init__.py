"""Drawings. Each takes `ax=None`, draws on it or on a figure of its own, and returns the axes.

>>> import mamttsp
>>> ax = mamttsp.figures.space_time_view(mamttsp.generate(n_targets=3, total_window=20, seed=1))
>>> ax.get_zlabel()
'time (s)'
"""

from .animation import film, moment_view
from .exact_search import alive_view, ascent_view
from .gaps import true_gap_view
from .graph_drawing import graph_view, reach_view
from .ideas import charge_view, descent_view, perspective_view, sizes_view
from .plan import plan_view, space_time_view
from .priced_times import relaxed_view, tangents_view, tilt_view
from .profiles import cactus_view, profile_view
from .recording import Film
from .relaxed_bounds import flow_view, growth_view, relaxation_view
from .road import road_view
from .runtimes import panels_view, runtime_gap_view
from .sliders import explore
from .style import COLOURS, LINES, MARKERS, save
from .trace import trace_view
from .validity import cycle_view, leak_view

__all__ = [
    "COLOURS",
    "LINES",
    "MARKERS",
    "Film",
    "alive_view",
    "ascent_view",
    "cactus_view",
    "charge_view",
    "cycle_view",
    "descent_view",
    "explore",
    "film",
    "flow_view",
    "graph_view",
    "growth_view",
    "leak_view",
    "moment_view",
    "panels_view",
    "perspective_view",
    "plan_view",
    "profile_view",
    "reach_view",
    "relaxation_view",
    "relaxed_view",
    "road_view",
    "runtime_gap_view",
    "save",
    "sizes_view",
    "space_time_view",
    "tangents_view",
    "tilt_view",
    "trace_view",
    "true_gap_view",
]
