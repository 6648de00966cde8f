"""Drawings. Each takes `ax=None`, draws on it or on a figure of its own, and returns the axes."""

from .graph import graph_view, reach_view
from .ideas import charge_view, descent_view, perspective_view, sizes_view
from .style import COLOURS, LINES, MARKERS, save
from .tours import plan_view, space_time_view

__all__ = [
    "COLOURS",
    "LINES",
    "MARKERS",
    "charge_view",
    "descent_view",
    "graph_view",
    "perspective_view",
    "plan_view",
    "reach_view",
    "save",
    "sizes_view",
    "space_time_view",
]
