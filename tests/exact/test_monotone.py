"""Longer windows or another agent never raise the optimum: no bound passes an objective of the poorer instance."""

import pytest

from mamttsp import paper_instance, solve

INSTANCES = [(5, 0), (5, 1), (5, 7), (10, 5)]
MANY = [(n, index) for n in (5, 10, 15, 20) for index in range(20)]
GAP = 1e-4


def _assert_falls(problems):
    """Solve ever richer instances; their optima, known to within the gap, must not rise."""
    solutions = [solve(problem, gap=GAP) for problem in problems]
    assert all(solution.status == "optimal" for solution in solutions)
    for k, poorer in enumerate(solutions):
        for richer in solutions[k + 1 :]:
            assert richer.bound <= poorer.objective
            assert richer.objective <= poorer.objective * (1 + GAP)


@pytest.mark.parametrize("n, index", INSTANCES)
def test_longer_windows_never_raise_the_optimum(n, index):
    _assert_falls([paper_instance(n, index, window) for window in (20, 40, 60)])


@pytest.mark.parametrize("n, index", INSTANCES)
def test_more_agents_never_raise_the_optimum(n, index):
    _assert_falls([paper_instance(n, index, 40, m) for m in (1, 2, 3)])


@pytest.mark.slow
@pytest.mark.parametrize("n, index", MANY)
def test_neither_raises_the_optimum_of_any_paper_instance(n, index):
    _assert_falls([paper_instance(n, index, window) for window in (20, 40, 60)])
    _assert_falls([paper_instance(n, index, 40, m) for m in (1, 2, 3, 4, 5)])
