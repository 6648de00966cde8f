"""The drawings of the exact solver's steps hold what they say."""

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.colors import to_hex

from mamttsp import Progress, Visit, build_graph
from mamttsp.exact.pieces import all_arcs, even_cuts, make_pieces
from mamttsp.figures import (
    COLOURS,
    alive_view,
    ascent_view,
    relaxed_view,
    tangents_view,
    tilt_view,
    trace_view,
)
from tests.examples import instance, moving, still

INSTANCE = instance(moving((10, 0), (0, 0.5), [(10, 30)]), still(0, 20, [(0, 60)]))
STEPS = [
    Progress(0.5, None, 10.0, None, 0, "prices"),
    Progress(1.0, 30.0, 10.0, 2 / 3, 0, "labels"),
    Progress(2.0, 25.0, 20.0, 0.2, 9, "routes"),
    Progress(4.0, 25.0, 25.0, 0.0, 9, "routes"),
]


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


@pytest.fixture
def graph():
    return build_graph(INSTANCE)


def _named(ax):
    """Return {label: (N, 2) points} of the lines in the legend."""
    return {line.get_label(): line.get_xydata() for line in ax.lines if not line.get_label().startswith("_")}


def test_a_trace_against_time():
    lines = _named(trace_view(STEPS))
    assert lines["bound"].tolist() == [[0.5, 10], [1, 10], [2, 20], [4, 25]]
    assert lines["incumbent"][1:].tolist() == [[1, 30], [2, 25], [4, 25]] and np.isnan(lines["incumbent"][0, 1])


def test_a_trace_against_reports_names_phases_where_they_begin():
    ax = trace_view(STEPS, against="report")
    assert _named(ax)["bound"][:, 0].tolist() == [1, 2, 3, 4]
    assert [label.get_text() for label in ax.get_xticklabels()] == ["1 prices", "2 labels", "3 routes"]


def test_times_do_not_show_in_a_trace_against_reports(tmp_path):
    later = [Progress(10 * s.time, s.objective, s.bound, s.gap, s.nodes, s.phase) for s in STEPS]
    for name, steps in (("one", STEPS), ("two", later)):
        trace_view(steps, against="report").figure.savefig(tmp_path / f"{name}.png")
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()


def test_relaxed_times_leave_bars_where_a_visit_jumps(graph):
    ax = relaxed_view(INSTANCE, graph, [1, 2], arrive=[20.0, 40.0], leave=[12.0, 40.0])
    assert _named(ax)["jump of a visit"].tolist() == [[10, 10], [10, 6]]
    arrows = [(text.xyann, text.xy) for text in ax.texts if getattr(text, "arrow_patch", None)]
    assert [np.round([p, q], 6).tolist() for p, q in arrows] == [
        [[0, 0], [10, 10]], [[10, 6], [0, 20]], [[0, 20], [0, 0]],
    ]  # fmt: skip
    assert not any(text.get_text().startswith("agent") for text in ax.get_legend().get_texts())


def test_a_price_tilts_both_costs_and_leaves_their_sum():
    times = np.array([0.0, 1.0, 2.0])
    costs = np.array([9.0, 7.0, 6.0]), np.array([1.0, 2.0, 4.0])
    flat, tilted = (_named(tilt_view(times, *costs, best=1, price=price)) for price in (0.0, 1.5))
    assert flat["so far"][:, 1].tolist() == [2, 0, -1] and flat["to go"][:, 1].tolist() == [-1, 0, 2]
    assert tilted["so far"][:, 1].tolist() == [0.5, 0, 0.5] and tilted["to go"][:, 1].tolist() == [0.5, 0, 0.5]
    assert flat["sum"].tolist() == tilted["sum"].tolist()


def test_the_lowest_points_of_costs_that_are_partly_infinite_are_marked():
    ax = tilt_view(np.array([0.0, 1.0, 2.0]), np.array([np.inf, 5.0, 4.0]), np.array([1.0, 2.0, np.inf]), best=1)
    dots = [line.get_xydata()[0].tolist() for line in ax.lines if len(line.get_xydata()) == 1]
    assert dots == [[2, -1], [0, -1], [1, 0]]


def test_tangents_touch_the_distance_in_the_middle_and_stay_below(graph):
    pieces = make_pieces(graph, *even_cuts(graph, graph.V_seg, 5.0), range(2))
    q = int(np.flatnonzero(pieces.segment == 1)[0])
    arcs = all_arcs(pieces)
    ax = tangents_view(pieces, arcs, graph, q, 2)
    distance, *tangents = (line.get_xydata() for line in ax.lines)
    drawn = arcs.head[(arcs.tail == q) & (pieces.segment[arcs.head] == 2)]
    assert len(tangents) == len(drawn) > 5  # no leg leads back in time, and none is drawn
    ends = np.vstack(tangents)
    assert (ends[:, 1] <= np.interp(ends[:, 0], *distance.T) + 1e-9).all()
    middle = tangents[-1].mean(axis=0)
    assert middle[1] == pytest.approx(np.interp(middle[0], *distance.T))


def test_bounds_rise_from_evaluation_to_evaluation():
    ax = ascent_view({"short": [1.0, 2.0], "long": [2.0, 3.0]}, optimum=4.0)
    assert _named(ax)["long"].tolist() == [[1, 2], [2, 3]] and set(_named(ax)["optimum"][:, 1]) == {4.0}


def test_pieces_are_bars_on_the_rows_of_their_targets(graph):
    pieces = make_pieces(graph, *even_cuts(graph, graph.V_seg, 20.0), range(2))
    alive = pieces.target == 0
    ax = alive_view(pieces, alive, [Visit(0, 12.0, (10.0, 1.0))])
    bars = {
        (round(p.get_y() + 0.25), p.get_x(), p.get_width())
        for p in ax.patches
        if to_hex(p.get_facecolor()).upper() == COLOURS[0]
    }
    assert bars == {(0, 10.0, 20.0)} and len(ax.patches) == len(pieces.a) == 4
    assert _named(ax)["visit of the best tour"].tolist() == [[12, 0]]
