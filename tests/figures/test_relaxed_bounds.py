"""The drawings of relaxed bounds: means and ranges, bounds against windows, and a fractional flow."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

from mamttsp.figures import flow_view, growth_view, relaxation_view
from tests.examples import instance, moving

ROWS = pd.DataFrame(
    [(5, 20, 1, "micp", 0.9), (5, 20, 1, "micp", 0.7), (10, 20, 1, "micp", 0.6), (5, 40, 2, "micp", 0.5)]
    + [(n, 20, 1, "baseline", 0.0) for n in (5, 10)],
    columns=["n", "total_window", "agents", "method", "ratio"],
)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def _named(ax):
    return {line.get_label(): line.get_xydata() for line in ax.lines}


def test_a_line_joins_the_means_and_bars_reach_from_least_to_largest():
    ax = relaxation_view(ROWS)
    lines = _named(ax)
    assert list(lines) == ["MICP, windows of 20 s", "MICP, windows of 40 s", "baseline, all"]
    assert lines["MICP, windows of 20 s"][:, 1] == pytest.approx([0.8, 0.6])
    assert np.abs(lines["MICP, windows of 20 s"][:, 0] - [5, 10]).max() < 1
    first, _ = ax.collections[0].get_segments()
    assert first[:, 1] == pytest.approx([0.7, 0.9])
    assert lines["baseline, all"].tolist() == [[5, 0], [10, 0]]


def test_lines_by_agents_are_named_by_agents():
    assert list(_named(relaxation_view(ROWS, by="agents")))[:2] == ["MICP, 1 agent", "MICP, 2 agents"]


def test_bounds_are_drawn_below_the_optimum_from_zero():
    ax = growth_view([10, 20], [100.0, 90.0], {"micp": [80.0, 60.0], "baseline": [0.0, 0.0]})
    assert {name: line[:, 1].tolist() for name, line in _named(ax).items()} == {
        "optimum": [100, 90],
        "MICP": [80, 60],
        "baseline": [0, 0],
    }
    assert ax.get_ylim()[0] <= 0


def test_a_flow_is_as_thick_as_its_share_and_whole_edges_are_solid():
    problem = instance(moving((10, 0), (0, 0.2), [(5, 15)]))
    y, tails = np.array([1.0, 0.5, 0.05]), np.zeros((3, 2))
    ax = flow_view(problem, y, tails, tails + [0.0, 8.0])
    edges = [line for line in ax.lines if len(line.get_xydata()) == 21]
    assert all(line.get_xydata()[[0, -1]].tolist() == [[0, 0], [0, 8]] for line in edges)
    assert [line.get_linestyle() for line in edges] == ["-", "--", "--"]
    assert np.diff([line.get_linewidth() for line in edges]) == pytest.approx([-1.0, -0.9])
    assert edges[0].get_xydata()[10] == pytest.approx([0.6, 4.0])  # bent to the right, by 0.15 of its length at most
    heads = [line for line in ax.lines if isinstance(line.get_marker(), tuple)]
    assert [line.get_marker()[2] for line in heads] == [0, 0, 0] and heads[0].get_xydata()[0] == pytest.approx([0.6, 4])
    assert [text.get_text() for text in ax.texts] == ["0", "1.00", "0.50"]  # a window's number, then shares
    names = ["target's path", "time window", "depot", "whole flow", "fraction"]
    assert [text.get_text() for text in ax.get_legend().get_texts()] == names


@pytest.mark.parametrize("view, data", [(relaxation_view, (ROWS,)), (growth_view, ([10], [5.0], {}))])
def test_it_draws_on_the_axes_it_is_given(view, data):
    ax = plt.figure().add_subplot()
    assert view(*data, ax=ax) is ax and len(plt.get_fignums()) == 1
