"""The bars and lines of the paper's Figures 2 and 3 stand where the numbers say."""

import matplotlib.pyplot as plt
import pandas as pd
import pytest
from matplotlib.colors import to_hex

from mamttsp.figures import COLOURS, panels_view, runtime_gap_view
from mamttsp.figures.runtimes import time_scale

COLUMNS = ["total_window_s", "agents", "targets", "formulation", "runtime_s", "gap_percent"]
PUBLISHED = pd.DataFrame(
    [
        (20, 1, 5, "micp", "<10", "0"),
        (20, 1, 5, "baseline", "30", "0"),
        (20, 1, 10, "micp", "40", "~0.5"),
        (20, 1, 10, "baseline", "1800", "73.5"),
    ],
    columns=COLUMNS,
)


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def _bars(ax, number):
    return [bar for bar in ax.patches if to_hex(bar.get_edgecolor()).upper() == COLOURS[number]]


def _heights(ax, number):
    return [bar.get_height() for bar in _bars(ax, number)]


def test_a_bar_is_as_high_as_its_run_time():
    ax = runtime_gap_view(PUBLISHED)
    assert _heights(ax, 0) == [10, 40] and _heights(ax, 1) == [30, 1800]
    assert ax.get_yscale() == "log" and ax.get_ylim()[0] == 1 and ax.get_ylim()[1] > 1800
    places = [bar.get_center()[0] for bar in (*_bars(ax, 0), *_bars(ax, 1))]
    assert places == pytest.approx([-0.2, 0.8, 0.2, 1.2])


def test_no_marker_covers_a_bar():
    ax = runtime_gap_view(PUBLISHED)
    gaps = ax.figure.axes[-1]
    ax.figure.draw_without_rendering()
    top = max(bar.get_window_extent().y1 for bar in ax.patches)
    marks = [gaps.transData.transform(spot)[1] for line in gaps.lines for spot in line.get_xydata()]
    assert marks and min(marks) > top + 4  # a marker's half height, in pixels


def test_every_bar_can_be_seen_also_beside_one_at_the_limit():
    rows = PUBLISHED.assign(runtime_s=["<1", "1.5", "1800", "1800"])
    assert time_scale(rows) == (0.1, 1800)
    ax = runtime_gap_view(rows)
    ax.figure.draw_without_rendering()
    assert min(bar.get_window_extent().height for bar in ax.patches) > 20


def test_without_any_run_time_there_is_a_scale_all_the_same():
    assert time_scale(PUBLISHED.assign(runtime_s=float("nan"))) == (0.1, 1.0)


def test_a_line_goes_through_the_gaps_on_an_axis_in_percent():
    ax = runtime_gap_view(PUBLISHED)
    gaps = ax.figure.axes[-1]
    drawn = {line.get_color(): list(line.get_ydata()) for line in gaps.lines if line.get_linestyle() != "None"}
    assert drawn == {COLOURS[0]: [0, 0.5], COLOURS[1]: [0, 73.5]}
    assert gaps.get_ylim()[1] > 100 and gaps.get_ylabel() == "% gap" and ax.get_ylabel() == "run time (s)"


def test_a_bar_that_is_only_bounded_is_hollow_and_so_is_a_marker_in_doubt():
    ax = runtime_gap_view(PUBLISHED)
    assert [bar.get_facecolor() == (1, 1, 1, 1) for bar in _bars(ax, 0)] == [True, False]
    hollow = [
        line for line in ax.figure.axes[-1].lines if line.get_markerfacecolor() == "white" and len(line.get_xdata())
    ]
    assert [line.get_ydata().tolist() for line in hollow] == [[0.5]]


def test_a_missing_value_is_called_missing_and_has_no_bar():
    ours = PUBLISHED.assign(runtime_s=[1.0, 2.0, float("nan"), 4.0], gap_percent=[0.0, 1.0, float("nan"), 3.0])
    ax = runtime_gap_view(ours)
    assert _heights(ax, 0) == [1] and _heights(ax, 1) == [2, 4]
    assert [(text.get_text(), text.get_position()[0]) for text in ax.texts] == [("missing", pytest.approx(0.8))]


def test_a_size_that_only_one_formulation_has_is_missing_for_the_other():
    ax = runtime_gap_view(PUBLISHED[:3])
    assert _heights(ax, 1) == [30] and [text.get_text() for text in ax.texts] == ["missing"]


@pytest.mark.parametrize(
    "by, values, names",
    [
        ("total_window_s", (20, 40, 60), ["(a) windows 20 s", "(b) windows 40 s", "(c) windows 60 s"]),
        ("agents", (2, 3, 4, 5), ["(a) 2 agents", "(b) 3 agents", "(c) 4 agents", "(d) 5 agents"]),
    ],
)
def test_there_is_a_panel_for_each_value(by, values, names):
    rows = pd.concat(PUBLISHED.assign(**{by: value, "runtime_s": [1, 2, 3, 10 * value]}) for value in values)
    axes = panels_view(rows, by, "Ours", "Solver, limit, machine")
    assert [ax.get_title() for ax in axes] == names
    assert [_heights(ax, 1) for ax in axes] == [[2, 10 * value] for value in values]
    assert len({ax.get_ylim() for ax in axes}) == 1
    figure = axes[0].figure
    assert [text.get_text() for text in figure.texts] == ["Solver, limit, machine"]
    (legend,) = figure.legends
    assert legend.get_title().get_text() == "Ours"
    assert [text.get_text() for text in legend.get_texts()] == ["MICP", "baseline"]
    figure.draw_without_rendering()
    (caption,), boxes = figure.texts, [ax.get_tightbbox() for ax in axes]
    assert caption.get_window_extent().y1 < min(box.y0 for box in boxes)
    assert legend.get_window_extent().y0 > max(box.y1 for box in boxes)
    assert (
        figure.get_tightbbox().y0 * figure.dpi <= caption.get_window_extent().y0
    )  # a notebook shows no more than that


def test_panels_have_the_scale_that_they_are_given():
    (ax,) = panels_view(PUBLISHED, "agents", "Ours", scale=(0.01, 1e4))
    assert ax.get_ylim()[0] == 0.01 and ax.get_ylim()[1] > 1e4


def test_panels_are_drawn_on_the_axes_they_are_given():
    axes = plt.figure(layout="constrained").subplots(2)
    both = pd.concat([PUBLISHED, PUBLISHED.assign(agents=2)])
    assert list(panels_view(both, "agents", "", axes=list(axes))) == list(axes) and len(plt.get_fignums()) == 1
