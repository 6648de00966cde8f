"""Cactus plots, performance profiles and true gaps hold the shares that can be counted by hand."""

import math

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

from mamttsp.figures import COLOURS, cactus_view, profile_view, true_gap_view

#: the last instance is solved by nobody, and the baseline solves the first two only
TIMES = pd.DataFrame(
    {
        "micp/scip": [1.0, 4.0, 30.0, math.inf],
        "baseline/scip": [2.0, 2.0, math.inf, math.inf],
        "exact": [math.inf] * 4,
    }
)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def _curves(ax):
    """Return a function from x to y for each line of the legend."""
    lines = {line.get_label(): line for line in ax.lines}
    assert all(line.get_drawstyle() == "steps-post" for line in lines.values())
    return {
        name: lambda x, line=line: line.get_ydata()[np.searchsorted(line.get_xdata(), x, "right") - 1]
        for name, line in lines.items()
    }


def test_a_cactus_counts_what_is_solved_by_a_time():
    ax = cactus_view(TIMES, limit=60)
    curves = _curves(ax)
    assert list(curves) == ["MICP, SCIP", "baseline, SCIP", "exact"]
    assert [curves["MICP, SCIP"](t) for t in (0.9, 1.0, 3.9, 4.0, 29.0, 30.0, 60.0)] == [0, 1, 1, 2, 2, 3, 3]
    assert [curves["baseline, SCIP"](t) for t in (1.9, 2.0, 60.0)] == [0, 2, 2]
    assert curves["exact"](60.0) == 0
    assert ax.get_xlim() == (0.5, 60) and ax.get_ylabel() == "instances solved (of 4)"


def test_a_profile_is_the_share_within_a_multiple_of_the_quickest():
    curves = _curves(profile_view(TIMES))
    assert [curves["MICP, SCIP"](x) for x in (1.0, 1.9, 2.0, 3.9)] == [0.5, 0.5, 0.75, 0.75]
    assert [curves["baseline, SCIP"](x) for x in (1.0, 1.9, 2.0, 3.9)] == [0.25, 0.25, 0.5, 0.5]
    assert curves["exact"](3.9) == 0


@pytest.mark.parametrize("view", [lambda times, **ax: cactus_view(times, 60, **ax), profile_view])
def test_no_instances_and_axes_from_elsewhere(view):
    ax = plt.figure().add_subplot()
    assert view(TIMES[:0], ax=ax) is ax and not [line for line in ax.lines if len(line.get_xdata())]


def test_a_route_looks_the_same_whatever_it_is_drawn_beside():
    alone, together = (cactus_view(times, 60).lines for times in (TIMES[["baseline/scip"]], TIMES))
    assert alone[0].get_color() == together[1].get_color() == COLOURS[1]
    assert alone[0].get_marker() == together[1].get_marker()


GAPS = pd.DataFrame(
    [
        *((5, "micp/scip", gap, 10 * gap) for gap in (0.0, 1.0, 4.0)),
        (5, "baseline/scip", math.nan, 100.0),
        (10, "baseline/scip", 20.0, 30.0),
    ],
    columns=["n", "route", "incumbent_percent", "bound_percent"],
)


def _points(ax, number):
    lines = [line for line in ax.lines if line.get_color() == COLOURS[number] and line.get_linestyle() == "None"]
    return [list(line.get_ydata()) for line in lines if len(line.get_xdata())]


def test_each_run_with_tours_is_a_point_and_the_others_are_counted():
    ax = true_gap_view(GAPS, "incumbent_percent")
    assert _points(ax, 0) == [[0, 1, 4]] and _points(ax, 1) == [[20]]
    assert [text.get_text() for text in ax.texts] == ["1"]
    medians = [line.get_ydata()[0] for line in ax.lines if line.get_color() == "black" and np.ptp(line.get_xdata())]
    assert medians == [1, 20]


def test_bounds_are_drawn_for_runs_without_tours_too():
    ax = true_gap_view(GAPS, "bound_percent")
    assert _points(ax, 0) == [[0, 10, 40]] and _points(ax, 1) == [[100], [30]]
    assert not ax.texts and [label.get_text() for label in ax.get_xticklabels()] == ["5", "10"]
    assert ax.get_ylabel() == "bound below optimum (%)"


def test_the_number_of_a_group_without_any_tours_is_in_view():
    rows = pd.concat([GAPS, pd.DataFrame({"n": [15], "route": ["baseline/scip"], "incumbent_percent": [math.nan]})])
    ax = true_gap_view(rows, "incumbent_percent")
    places, (left, right) = [text.xy[0] for text in ax.texts], ax.get_xlim()
    assert len(places) == 2 and all(left < place < right for place in places)
