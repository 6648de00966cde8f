"""Looking at an answer: every visit is a row, and `plot` draws what the plan view draws."""

import subprocess
import sys

import matplotlib.pyplot as plt
import pytest

import mamttsp
from mamttsp import InputError, Solution, Tour, Visit
from tests.examples import agents, general, instance, moving, still

INSTANCE = instance(moving((10, 0), (0, 0.2), [(5, 15), (30, 50)]), still(0, 20, [(0, 60)]), n_agents=3)
TOURS = (Tour((Visit(1, 6.0, (0.0, 20.0)),), 11.0), Tour((), 0.0), Tour((Visit(0, 10.0, (10.0, 2.0)),), 30.0))
SOLUTION = Solution("feasible", 60.4, None, 1.0, TOURS, "exact", "none")


@pytest.fixture(autouse=True)
def close_figures():
    yield
    plt.close("all")


def test_each_visit_is_a_row():
    frame = mamttsp.visits(INSTANCE, SOLUTION)
    assert list(frame.columns) == ["tour", "order", "target", "time", "x", "y", "leg_length", "waited"]
    assert frame.iloc[0].tolist() == [0, 0, 1, 6.0, 0.0, 20.0, 20.0, 1.0]
    length = 104**0.5
    assert frame.iloc[1].tolist() == pytest.approx([2, 0, 0, 10.0, 10.0, 2.0, length, 10 - length / 4])


def test_a_visit_of_a_fast_agent_from_its_own_depot():
    unlike = general(*INSTANCE.targets, types=[agents(1), agents(1, (0.0, 50.0), 8.0)])
    row = mamttsp.visits(unlike, [Tour((Visit(1, 6.0, (0.0, 20.0)),), 11.0, agent=1)]).iloc[0]
    assert row.leg_length == 30.0 and row.waited == pytest.approx(6.0 - 30.0 / 8.0)


def test_legs_and_ways_home_make_the_length():
    drawn = mamttsp.generate(n_targets=6, total_window=40, n_agents=2, seed=1)
    solution = mamttsp.solve(drawn, method="micp", solver="scip")
    frame = mamttsp.visits(drawn, solution)
    home = sum(float(((tour.visits[-1].position - drawn.depot) ** 2).sum()) ** 0.5 for tour in solution.tours)
    assert frame.leg_length.sum() + home == pytest.approx(mamttsp.check(drawn, solution))
    assert sorted(frame.target) == list(range(6)) and (frame.waited >= 0).all()


def test_tours_do_as_well_and_nobody_has_no_rows():
    assert mamttsp.visits(INSTANCE, TOURS).equals(mamttsp.visits(INSTANCE, SOLUTION))
    assert mamttsp.visits(INSTANCE, []).shape == (0, 8)


def test_plot_draws_the_plan_with_or_without_tours():
    empty, flown = ([text.get_text() for text in mamttsp.plot(INSTANCE, tours).texts] for tours in (None, SOLUTION))
    assert empty == ["0", "0", "1"] and sum(" s" in word for word in flown) == 2
    ax = plt.figure().add_subplot()
    assert mamttsp.plot(INSTANCE, SOLUTION, ax=ax) is ax


def test_what_is_no_axes_is_not_drawn_on():
    with pytest.raises(mamttsp.InputError, match="^ax: expected Axes, found int 3$"):
        mamttsp.plot(INSTANCE, SOLUTION, ax=3)


@pytest.mark.parametrize("look", [mamttsp.visits, mamttsp.plot])
@pytest.mark.parametrize(
    "given, message", [(({}, []), "instance: expected Instance"), ((INSTANCE, 3), "tours: expected")]
)
def test_a_wrong_type_is_one_line(look, given, message):
    with pytest.raises(InputError, match=f"^{message}[^\\n]*\\Z"):
        look(*given)


def test_figures_are_there_after_the_import_and_cost_nothing_before():
    code = "import sys, mamttsp; print('matplotlib.pyplot' in sys.modules, mamttsp.figures.plan_view.__name__)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["False", "plan_view"]


def test_a_name_that_is_not_there_is_an_attribute_error():
    with pytest.raises(AttributeError, match="has no attribute 'figure'"):
        mamttsp.figure
