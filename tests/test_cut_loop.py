"""The rounds of cuts, played with a scripted back end, so that each case comes for sure."""

import numpy as np
import pytest

from mamttsp import FlowError, build_graph
from mamttsp.backends import Answer, Options, Progress
from mamttsp.cut_loop import solve_without_cycles
from mamttsp.formulations import build_formulation
from mamttsp.options import Clock
from tests.examples import instance, still

LINE = instance(still(10, 0), still(20, 0), still(30, 0))
TOUR, CYCLE = ((0, 1, 2, 3, 4),), ((0, 1, 4), (2, 3, 2))


def _play(problem, *answers, options=Options(), method="micp"):
    """Solve with a back end that gives these answers: (status, bound, routes or None), the last one again and again."""
    formulation = build_formulation(method, "pyomo", build_graph(problem), problem.n_agents)
    edges = formulation.graph.edges.tolist()
    seen = []

    def run(formulation, options):
        status, bound, routes = answers[min(len(seen), len(answers) - 1)]
        seen.append(options)
        if status == "interrupted":
            raise KeyboardInterrupt
        flow = None if routes is None else np.zeros(len(edges))
        for route in routes or ():
            for edge in zip(route[:-1], route[1:]):
                flow[edges.index(list(edge))] = 1.0
        if options.progress:
            options.progress(Progress(0.5, None, bound, None, 1, "script"))
        return Answer(status, None if flow is None else 1.0, bound, flow, 10, 0.5, "script 1")

    return solve_without_cycles(formulation, run, options, Clock(options.time_limit)), formulation, seen


def test_a_tour_is_timed_and_its_length_is_the_objective():
    solution, _, seen = _play(LINE, ("optimal", 60.0, TOUR))
    assert solution.status == "optimal" and solution.objective == pytest.approx(60.0)
    assert solution.subtour_cuts == 0 and len(seen) == 1


def test_a_cycle_is_cut_and_the_model_solved_again():
    solution, formulation, _ = _play(LINE, ("optimal", 20.0, CYCLE), ("optimal", 60.0, TOUR))
    assert solution.status == "optimal" and solution.subtour_cuts == 1
    assert solution.nodes == 20 and solution.runtime == pytest.approx(1.0)
    (cut,) = formulation.model.subtour_cuts.values()
    y = formulation.model.y
    for edge in y:
        y[edge].value = edge in {(2, 3), (3, 2)}
    assert cut.slack() < 0


def test_every_rounds_bound_holds_so_the_greatest_stands():
    solution, _, _ = _play(LINE, ("optimal", 58.0, CYCLE), ("feasible", 41.0, TOUR))
    assert solution.bound == 58.0 and solution.status == "feasible"


def test_a_limit_with_a_cycle_in_hand_gives_the_bound_and_no_tours():
    solution, _, _ = _play(LINE, ("optimal", 20.0, CYCLE), ("feasible", 30.0, CYCLE))
    assert (solution.status, solution.bound, solution.tours, solution.objective) == ("unknown", 30.0, (), None)


def test_the_time_limit_is_shared_by_all_rounds():
    solution, _, seen = _play(LINE, ("optimal", 20.0, CYCLE), options=Options(time_limit=1.0))
    limits = [options.time_limit for options in seen]
    assert solution.status == "unknown"
    assert 1.0 >= limits[0] > limits[-1] and limits == sorted(limits, reverse=True)


def test_no_time_left_is_unknown_and_no_round():
    formulation, seen = build_formulation("micp", "pyomo", build_graph(LINE), 1), []
    solution = solve_without_cycles(formulation, lambda *_: seen.append(1), Options(), Clock(1e-9))
    assert (solution.status, solution.tours, seen) == ("unknown", (), [])


def test_ctrl_c_between_rounds_keeps_the_bound(monkeypatch):
    def interrupt(formulation, targets):
        raise KeyboardInterrupt

    monkeypatch.setattr("mamttsp.formulations.Formulation.add_subtour_cut", interrupt)
    solution, _, seen = _play(LINE, ("optimal", 20.0, CYCLE))
    assert (solution.status, solution.bound, solution.tours, len(seen)) == ("unknown", 20.0, (), 1)


def test_ctrl_c_in_a_back_end_that_does_not_help_itself_keeps_the_bound():
    solution, _, seen = _play(LINE, ("optimal", 20.0, CYCLE), ("interrupted", None, None))
    assert (solution.status, solution.bound, len(seen)) == ("unknown", 20.0, 2)


def test_progress_goes_on_from_round_to_round():
    reports = []
    _play(LINE, ("optimal", 20.0, CYCLE), ("optimal", 60.0, TOUR), options=Options(progress=reports.append))
    assert [report.time >= 0.5 for report in reports] == [True, True] and reports[1].time > reports[0].time


def test_infeasible_and_unknown_pass_through():
    assert _play(LINE, ("infeasible", None, None))[0].status == "infeasible"
    solution = _play(LINE, ("unknown", 12.0, None))[0]
    assert (solution.status, solution.bound) == ("unknown", 12.0)


def test_a_path_that_only_a_tolerance_lets_through_is_cut():
    """From (40, 0), at 10 at the earliest, it takes 20 to (-40, 0), where the window closes just before 30."""
    late = instance(still(40, 0, [(10, 10.5)]), still(-40, 0, [(29.0, 29.9999)]), still(0, 10), n_agents=2)
    bad, good = ((0, 1, 2, 3, 4),), ((0, 1, 4), (0, 2, 3, 4))
    solution, formulation, _ = _play(late, ("optimal", 1.0, bad), ("optimal", 1.0, good))
    assert solution.subtour_cuts == 1 and len(solution.tours) == 2
    (cut,) = formulation.model.subtour_cuts.values()
    y = formulation.model.y
    for edge in y:
        y[edge].value = edge in {(0, 1), (1, 2), (2, 3)}
    assert cut.slack() < 0
    y[1, 2].value = 0
    assert cut.slack() >= 0


def test_the_gap_is_judged_on_the_tours_real_length():
    assert _play(LINE, ("optimal", 59.0, TOUR))[0].status == "feasible"
    assert _play(LINE, ("optimal", 59.0, TOUR), options=Options(gap=0.02))[0].status == "optimal"
    assert _play(LINE, ("feasible", 60.0, TOUR))[0].status == "optimal"


@pytest.mark.parametrize("gap", [0.0, 1e-6, 1e-4, 0.02])
def test_no_gap_above_the_one_asked_for_is_optimal(gap):
    for missing, status in ((gap, "optimal"), (gap + 5e-6, "feasible")):
        solution, _, seen = _play(LINE, ("optimal", 60.0 * (1 - missing * (1 - 1e-9)), TOUR), options=Options(gap=gap))
        assert solution.status == status, missing
        assert (solution.gap <= gap) == (status == "optimal")


@pytest.mark.parametrize("gap", [0.0, 1e-6, 1e-4, 0.02])
def test_a_solver_is_asked_for_a_little_less_so_that_its_tolerance_does_not_open_the_gap_again(gap):
    (asked,) = _play(LINE, ("optimal", 60.0, TOUR), options=Options(gap=gap))[2]
    assert gap / 2 <= asked.gap <= max(gap - 1e-5, gap / 2)


def test_a_bound_above_the_tours_is_clipped_within_tolerance_and_else_an_error():
    solution = _play(LINE, ("optimal", 60.0003, TOUR))[0]
    assert solution.bound == solution.objective
    with pytest.raises(FlowError, match="bound 60.1 is above the length 60"):
        _play(LINE, ("optimal", 60.1, TOUR))
