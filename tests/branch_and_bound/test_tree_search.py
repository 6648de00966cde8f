"""Our branch and bound: the optimum by enumeration, a valid bound at every stop, and no cycle that nobody flies."""

import dataclasses
import time

import numpy as np
import pytest

from mamttsp import InputError, build_graph, check, generate
from mamttsp.backends import Options, clarabel
from mamttsp.branch_and_bound.tree_search import TreeSearch
from mamttsp.flow import read_flow
from mamttsp.formulations import build_formulation
from mamttsp.timing import best_tours
from tests import meetings
from tests.examples import instance, still
from tests.oracle import optimum

EXACT = Options(gap=1e-6)
#: some of these are better off with two agents, some need many nodes
CASES = [(2, 60, 2, 1), (3, 20, 2, 3), (3, 40, 1, 2), (4, 20, 1, 3), (4, 20, 3, 2), (4, 60, 1, 6), (4, 60, 2, 1)]
LARGER = generate(5, 60, 2, seed=2)
MEETINGS = [meetings.passing(miss) for miss in (0.0, 1e-6, 1e-4, 1e-2, 0.5)]
MEETINGS += [meetings.three_at_one_point(), meetings.two_on_one_path()]


def _solve(problem, options=EXACT, modeler="cvxpy", prune=False):
    return clarabel.solve(build_formulation("micp", modeler, build_graph(problem, prune), problem.n_agents), options)


def _length(problem, answer, prune=False):
    """Return the length of the tours in the answer's flow, checked."""
    graph = build_graph(problem, prune)
    paths, cycles = read_flow(graph, answer.flow)
    assert not cycles
    return check(problem, best_tours(graph, [list(path) for path in paths])[1])


def _assert_optimal(problem, answer, prune=False):
    assert answer.status == "optimal"
    assert answer.objective == pytest.approx(optimum(problem), rel=1e-6)
    assert answer.objective * (1 - 1.1e-6) <= answer.bound <= optimum(problem) * (1 + 1e-9)
    assert _length(problem, answer, prune) == pytest.approx(answer.objective, rel=1e-9)


@pytest.mark.parametrize("modeler", ["cvxpy", "pyomo"])
@pytest.mark.parametrize("n, window, m, seed", CASES)
def test_the_optimum_is_that_of_enumeration(n, window, m, seed, modeler):
    problem = generate(n, window, m, seed)
    _assert_optimal(problem, _solve(problem, modeler=modeler))


@pytest.mark.parametrize("n, window, m, seed", CASES)
def test_pruning_changes_nothing(n, window, m, seed):
    problem = generate(n, window, m, seed)
    _assert_optimal(problem, _solve(problem, prune=True), prune=True)


@pytest.mark.parametrize("problem", MEETINGS)
def test_no_cycle_that_nobody_flies(problem):
    _assert_optimal(problem, _solve(problem))


def test_cuts_are_counted():
    assert _solve(MEETINGS[0]).cuts >= 1
    assert _solve(instance(still(10, 0))).cuts == 0


@pytest.mark.parametrize("stop", range(1, 12, 2))
def test_ctrl_c_leaves_a_valid_bound(stop):
    def interrupt(progress):
        if progress.nodes >= stop:
            raise KeyboardInterrupt

    _assert_valid(_solve(LARGER, dataclasses.replace(EXACT, progress=interrupt)))


@pytest.mark.parametrize("limit", [1e-6, 0.02, 0.05, 0.1])
def test_a_time_limit_leaves_a_valid_bound(limit):
    answer = _solve(LARGER, Options(time_limit=limit, gap=1e-6))
    if answer.status == "optimal":
        assert limit > 1e-6
        return _assert_optimal(LARGER, answer)
    _assert_valid(answer)


def test_the_limit_ends_a_node_that_has_ever_more_cuts_to_make(monkeypatch):
    monkeypatch.setattr(TreeSearch, "_cut_subtours", lambda search, y: True)
    start = time.perf_counter()
    answer = _solve(LARGER, Options(time_limit=0.5))
    assert time.perf_counter() - start < 20.0
    _assert_valid(answer)


def _assert_valid(answer):
    assert answer.status == ("unknown" if answer.flow is None else "feasible")
    assert 0.0 <= answer.bound <= optimum(LARGER) * (1 + 1e-9)
    if answer.flow is not None:
        assert _length(LARGER, answer) == pytest.approx(answer.objective, rel=1e-9)
        assert answer.objective >= optimum(LARGER) * (1 - 1e-9)


def test_progress_closes_in_on_the_optimum():
    steps = []
    answer = _solve(LARGER, dataclasses.replace(EXACT, progress=steps.append))
    assert len(steps) > 5 and [step.nodes for step in steps] == sorted(step.nodes for step in steps)
    assert all(step.bound <= optimum(LARGER) * (1 + 1e-9) for step in steps)
    lengths = [step.objective for step in steps if step.objective is not None]
    assert lengths == sorted(lengths, reverse=True) and lengths[-1] == answer.objective
    assert steps[-1].bound <= answer.bound


def test_a_wide_gap_is_kept_to():
    answer = _solve(LARGER, Options(gap=0.2))
    assert answer.status == "optimal" and answer.objective * 0.8 <= answer.bound <= optimum(LARGER)
    assert answer.nodes < _solve(LARGER).nodes


@pytest.mark.parametrize("n_agents", [1, 2])
def test_what_one_agent_cannot_fly(n_agents):
    """Two targets in opposite directions at the same time."""
    when = ((10.0, 12.0),)
    answer = _solve(instance(still(30, 0, when), still(-30, 0, when), n_agents=n_agents))
    assert answer.status == ("infeasible" if n_agents == 1 else "optimal")
    if n_agents == 1:
        assert answer.objective is answer.bound is answer.flow is None
    else:
        assert answer.objective == pytest.approx(120.0, rel=1e-6)


def test_a_target_that_nobody_reaches_is_infeasible():
    assert _solve(instance(still(5, 0), still(50, 0, ((0.0, 5.0),)))).status == "infeasible"


def test_the_same_search_every_time():
    first, second = (_solve(LARGER) for _ in range(2))
    assert first.nodes == second.nodes and first.bound == second.bound and np.array_equal(first.flow, second.flow)


def test_other_methods_are_refused():
    formulation = build_formulation("baseline", "cvxpy", build_graph(instance(still(5, 0))), 1)
    with pytest.raises(InputError, match="^method: .*solves \"micp\", found 'baseline'$"):
        clarabel.solve(formulation, EXACT)
