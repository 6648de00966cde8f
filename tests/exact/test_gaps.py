"""Beyond enumeration, runs at wide gaps: no bound is above the optimum that a run at a millionth certifies."""

import pytest

from mamttsp import Agents, check, generate, solve
from tests.exact.certificates import assert_sound

GAPS = (0.1, 0.03, 0.01)
#: (targets, total window, agents, seed)
FEW = [(11, 40, 1, 1), (13, 40, 3, 2), (15, 20, 2, 3)]
MANY = [(n, w, m, seed) for n in range(11, 16) for w in (20, 40, 60) for m in (1, 2, 4) for seed in (4, 5)]


def _assert_bounds_hold(problem):
    """Solve at a gap of a millionth, then at wide gaps, with another seed of the solver each."""
    certified = solve(problem, gap=1e-6)
    assert certified.status == "optimal" and check(problem, certified.tours) == certified.objective
    assert certified.objective - certified.bound <= 1e-6 * certified.objective * (1 + 1e-9)
    for seed, gap in enumerate(GAPS):
        solution = solve(problem, gap=gap, seed=seed)
        assert_sound(problem, solution)
        assert solution.status == "optimal" and solution.gap <= gap
        assert solution.bound <= certified.objective and solution.objective >= certified.bound


@pytest.mark.parametrize("n, window, m, seed", FEW)
def test_no_bound_at_a_wide_gap_is_above_the_optimum(n, window, m, seed):
    _assert_bounds_hold(generate(n, window, m, seed))


def test_nor_with_types_and_capacities():
    agents = [Agents(2, (0, 0), 4.0, capacity=5.0), Agents(1, (20, -20), 5.0, end=(0, 0), capacity=6.0)]
    _assert_bounds_hold(generate(11, 40, seed=7, agents=agents, demands=1.0))


@pytest.mark.slow
@pytest.mark.parametrize("n, window, m, seed", MANY)
def test_no_bound_at_a_wide_gap_is_above_the_optimum_on_many_instances(n, window, m, seed):
    _assert_bounds_hold(generate(n, window, m, seed))
