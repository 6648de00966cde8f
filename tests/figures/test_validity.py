"""The drawings of the hole in the proof hold what they say."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

from mamttsp import Tour, Visit
from mamttsp.figures import cycle_view, leak_view, save
from mamttsp.study.meetings import passing

HOME = Tour((Visit(0, 2.5, (10.0, 0.0)),), 5.0)
CYCLE = (Visit(1, 50.0, (60.0, 0.0)), Visit(2, 50.0, (60.0, 0.0)))


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def lines(ax):
    return {line.get_label(): line.get_xydata() for line in ax.lines if not line.get_label().startswith("_")}


def test_a_cycle_is_a_loop_where_the_targets_meet():
    ax = cycle_view(passing(), [HOME], [CYCLE])
    drawn = lines(ax)
    assert drawn["tour 0"].tolist() == [[0, 0], [10, 2.5], [0, 5]]
    assert drawn["cycle that nobody flies"].tolist() == [[60, 50]]
    assert sum(getattr(text, "arrow_patch", None) is not None for text in ax.texts) == 2
    assert [text.get_text() for text in ax.texts if text.get_text()] == ["0", "1", "2"]


def test_without_a_cycle_there_is_no_loop():
    ax = cycle_view(passing(), [HOME])
    assert "cycle that nobody flies" not in lines(ax)
    assert not [text for text in ax.texts if getattr(text, "arrow_patch", None)]


def test_claims_are_drawn_against_the_miss():
    ax = leak_view([0.01, 0.1, 1.0], {"baseline": [20, 20, 120], "micp": [119, 120, 121]}, [119, 120, 121], 0.5)
    drawn = lines(ax)
    assert drawn["claimed by baseline"].tolist() == [[0.01, 20], [0.1, 20], [1, 120]]
    assert np.array_equal(drawn["true optimum"], drawn["claimed by MICP"])
    assert ax.get_xscale() == "log" and ax.get_ylim()[0] == 0
    (limit,) = [data for label, data in drawn.items() if "tolerance" in label]
    assert set(limit[:, 0]) == {0.5}


@pytest.mark.parametrize(
    "draw", [lambda ax: cycle_view(passing(), ax=ax), lambda ax: leak_view([1], {}, [1], 1, ax=ax)]
)
def test_it_draws_on_the_axes_it_is_given(draw):
    ax = plt.figure().add_subplot()
    assert draw(ax) is ax and len(plt.get_fignums()) == 1


def test_a_saved_loop_is_the_same_each_time(tmp_path):
    for name in ("one", "two"):
        save(cycle_view(passing(), [HOME], [CYCLE]), tmp_path / name)
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()
