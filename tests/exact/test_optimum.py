"""The exact solver finds and proves what enumeration finds, and agrees with the paper's MICP."""

import pytest

from mamttsp import generate, solve
from tests.exact.certificates import assert_brackets, assert_certified
from tests.exact.enumeration import optimum

SMALL = [(n, w, m, seed) for n, seed in ((5, 20), (6, 21), (7, 22), (7, 23)) for w in (20, 40, 60) for m in (1, 2, 3)]
TIGHT = [(5, 40, 2, 1), (6, 60, 1, 2), (7, 20, 3, 3), (8, 40, 1, 4), (9, 40, 2, 5)]
LARGER = [(8, 20, 3, 1), (9, 60, 1, 2), (10, 40, 2, 3), (10, 20, 1, 4)]
MANY = [(n, w, m, seed) for n in (6, 7, 8, 9, 10) for w in (20, 40, 60) for m in (1, 2, 3) for seed in range(5)]
#: small windows, where the branch and bound closes within seconds
MICP = [(8, 20, 1, 5), (8, 20, 3, 5), (9, 20, 2, 6), (10, 20, 3, 7)]
MANY_MICP = [(n, w, m, seed) for n in (8, 9, 10) for w in (20, 40) for m in (1, 3) for seed in (8, 9)]
#: beyond enumeration: with many agents and small windows the MICP closes as well
BEYOND_MICP = [(11, 20, 3, 1), (12, 20, 3, 2), (13, 20, 5, 1), (14, 20, 5, 2), (15, 20, 5, 1)]


@pytest.mark.parametrize("n, window, m, seed", SMALL + LARGER)
def test_the_optimum_is_that_of_enumeration(n, window, m, seed):
    problem = generate(n, window, m, seed)
    assert_certified(problem, optimum(problem))


@pytest.mark.parametrize("n, window, m, seed", TIGHT)
def test_a_gap_of_a_millionth_is_proved(n, window, m, seed):
    problem = generate(n, window, m, seed)
    assert_certified(problem, optimum(problem), gap=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("gap", [1e-4, 1e-6])
@pytest.mark.parametrize("n, window, m, seed", MANY)
def test_the_optimum_is_that_of_enumeration_on_many_instances(n, window, m, seed, gap):
    problem = generate(n, window, m, seed)
    assert_certified(problem, optimum(problem), gap)


def _assert_agrees_with_micp(problem, solver, time_limit):
    """Return whether the MICP closed; what both prove must not contradict each other in any case."""
    micp = solve(problem, "micp", solver=solver, time_limit=time_limit)
    exact = solve(problem)
    assert exact.status == "optimal" and exact.bound <= micp.objective
    assert micp.bound <= exact.objective * (1 + 1e-6)  # a conic solver's bound holds to its tolerance
    if micp.status == "optimal":
        assert exact.objective == pytest.approx(micp.objective, rel=2e-4)
    return micp.status == "optimal"


@pytest.mark.parametrize("n, window, m, seed", MICP)
def test_the_optimum_is_that_of_the_micp(n, window, m, seed):
    assert _assert_agrees_with_micp(generate(n, window, m, seed), "clarabel", 60)


@pytest.mark.slow
@pytest.mark.timeout(150 * len(MANY_MICP))  # all may take their limit, and building them
@pytest.mark.parametrize("solver", ["clarabel", "scip"])
def test_the_optimum_is_that_of_the_micp_wherever_it_closes(solver):
    closed = [_assert_agrees_with_micp(generate(*setting), solver, 120) for setting in MANY_MICP]
    assert sum(closed) >= len(closed) / 2


@pytest.mark.slow
@pytest.mark.timeout(330 * len(BEYOND_MICP))
@pytest.mark.parametrize("solver", ["clarabel", "scip"])
def test_the_optimum_is_that_of_the_micp_beyond_enumeration(solver):
    closed = [_assert_agrees_with_micp(generate(*setting), solver, 300) for setting in BEYOND_MICP]
    assert sum(closed) >= (len(closed) if solver == "clarabel" else 2)


def test_another_seed_of_the_solver_leads_to_the_same_optimum():
    problem = generate(8, 40, 2, seed=9)
    expected = optimum(problem)
    for seed in range(4):
        solution = solve(problem, seed=seed)
        assert_brackets(problem, solution, expected)
        assert solution.status == "optimal"


@pytest.mark.parametrize("n, window, m", [(7, 40, 3), (10, 40, 1), (10, 20, 2), (15, 20, 4)])
def test_the_same_seed_gives_the_same_run(n, window, m):
    problem = generate(n, window, m, seed=2)
    first, second = (solve(problem, seed=5) for _ in range(2))
    for field in ("status", "objective", "bound", "tours", "nodes"):
        assert getattr(first, field) == getattr(second, field)
