"""Stopped by a time limit or Ctrl-C, the exact solver returns in time checked tours and a bound that holds."""

import itertools
import sys

import pytest

from mamttsp import generate, paper_instance, solve
from mamttsp.exact import Parameters, solve_exact
from mamttsp.options import Options, Watch
from tests.exact.certificates import assert_brackets, assert_sound
from tests.exact.enumeration import optimum
from tests.exact.paths import FORCED
from tests.exact.processes import solving

LIMITS = (0.1, 0.5, 2.0)
SPREAD = [(10, 60, 3), (15, 40, 2), (15, 60, 1), (20, 20, 5), (20, 40, 1), (20, 60, 2)]
#: elsewhere a process cannot be sent Ctrl-C alone
needs_signals = pytest.mark.skipif(sys.platform == "win32", reason="Ctrl-C goes to all processes of a console")
SETTINGS = [(n, w, m, index) for n in (10, 15, 20) for w in (20, 40, 60) for m in (1, 2, 3, 5) for index in (1, 2)]


def _assert_runs_agree(problem, limits):
    """No run's bound passes the shortest tours of all runs; return the runs."""
    runs = [solve(problem, time_limit=limit) for limit in limits]
    for run in runs:
        assert_sound(problem, run)
    assert max(run.bound for run in runs) <= min((run.objective for run in runs if run.tours), default=float("inf"))
    return runs


@pytest.mark.parametrize("n, window, m", SPREAD)
def test_the_bound_holds_at_every_time_limit(n, window, m):
    _assert_runs_agree(paper_instance(n, 0, window, m), LIMITS)


@pytest.mark.parametrize("limit", LIMITS)
@pytest.mark.parametrize("window, m", [(20, 1), (60, 2)])
def test_the_known_optimum_lies_between_bound_and_objective_at_every_time_limit(window, m, limit):
    problem = generate(10, window, m, seed=31)
    assert_brackets(problem, solve(problem, time_limit=limit), optimum(problem))


@pytest.mark.slow
@pytest.mark.parametrize("n, window, m, index", SETTINGS)
def test_the_bound_holds_at_every_time_limit_and_in_a_long_run(n, window, m, index):
    *_, long = _assert_runs_agree(paper_instance(n, index, window, m), (*LIMITS, 300.0))
    assert long.status == "optimal"


def test_a_limit_that_leaves_a_gap_is_not_called_optimal():
    problem = paper_instance(20, 0, 60, 2)
    solution = solve(problem, time_limit=0.5, gap=1e-6)
    assert solution.status in ("feasible", "unknown") and (solution.gap is None or solution.gap > 1e-6)


@pytest.mark.parametrize("path", ["pieces get much shorter", "no set is settled"])
def test_whenever_time_is_up_what_stands_is_returned(monkeypatch, path):
    """Up at the k-th question for the time that is left, at ever greater k."""
    problem, statuses, k = generate(6, 60, 2, seed=1), set(), 0
    expected = optimum(problem)
    while "optimal" not in statuses and k < 300:
        k, asked = k + 1 + k // 50, itertools.count()
        monkeypatch.setattr(Watch, "left", property(lambda _, k=k, asked=asked: 0.0 if next(asked) >= k else 60.0))
        solution = solve_exact(problem, Options(time_limit=60.0), Parameters(**FORCED[path]))
        assert_brackets(problem, solution, expected)
        statuses.add(solution.status)
    assert "feasible" in statuses


class _Interrupt:
    """A progress callback that is interrupted at its k-th call, like a user who watches it."""

    def __init__(self, k):
        self.calls, self.k = 0, k

    def __call__(self, progress):
        self.calls += 1
        if self.calls == self.k:
            raise KeyboardInterrupt


@pytest.mark.parametrize("n, window, m, seed", [(8, 40, 1, 1), (8, 60, 2, 1)])
def test_interrupted_at_any_report_it_returns_what_stands(n, window, m, seed):
    problem = generate(n, window, m, seed)
    expected = optimum(problem)
    for k in range(1, 1000):
        interrupt = _Interrupt(k)
        solution = solve(problem, progress=interrupt)
        assert_brackets(problem, solution, expected)
        if interrupt.calls < k:  # it ran to its end
            break
    assert k > 2 and solution.status == "optimal"


@pytest.mark.parametrize("seconds", [0.05, 0.4, 1.3])
def test_interrupted_at_any_moment_it_returns_what_stands(ctrl_c, seconds):
    solve(generate(5, 20, 2, seed=0))  # so that the code is compiled and what is interrupted is the search
    problem = paper_instance(20, 1, 60, 2)
    ctrl_c(seconds)
    solution = solve(problem, gap=1e-6)
    assert_sound(problem, solution)
    assert solution.status != "optimal"


def test_no_bound_rests_on_times_that_were_not_optimised(monkeypatch):
    """Where the SOCP gives no answer, tours keep their earliest times: they can be flown, but prove nothing."""
    problem = generate(6, 60, 2, seed=1)
    expected = optimum(problem)
    monkeypatch.setattr("mamttsp.timing._solve_times", lambda graph, route: (None, 0.0))
    assert_brackets(problem, solve(problem, time_limit=1.0), expected)


# --- How soon a run ends ---------------------------------------------------------------------------------------------


def sized(n, m):
    """Return an instance of n targets with 10 s for each, 150 s at least."""
    return generate(n, 40, m, seed=1, horizon=max(150, 10 * n), n_pieces=max(4, n // 4))


def _assert_kept(process, problem, limit):
    """Return the Solution of a run that ends within half a second and a twentieth of its limit."""
    solution, late = process.run(limit)
    assert late <= 0.05 * limit + 0.5
    assert_sound(problem, solution)
    return solution


def _assert_interrupted(process, problem, seconds):
    """Press Ctrl-C after so many s; the answer comes within a second and holds."""
    solution, late = process.run(600.0, interrupted=seconds)
    assert late <= 1.0 and solution.status in ("feasible", "unknown")
    assert_sound(problem, solution)


def _moments(problem, limit):
    """Watch a run; return {phase: the middle, in s, of where it took longest}."""
    steps, found = [], {}
    solve(problem, time_limit=limit, gap=1e-6, progress=steps.append)
    for before, after in itertools.pairwise(steps):
        found[after.phase] = max(found.get(after.phase, (0.0, 0.0)), (after.time - before.time, after.time))
    return {phase: end - took / 2 for phase, (took, end) in found.items()}


@needs_signals
def test_a_time_limit_is_kept_and_ctrl_c_is_heard_with_many_targets(tmp_path):
    problem = sized(50, 10)
    with solving(problem, tmp_path) as process:
        _assert_kept(process, problem, 2.0)
        _assert_interrupted(process, problem, 1.0)


@pytest.mark.slow
@pytest.mark.parametrize("n, m", [(10, 1), (20, 1), (20, 5), (50, 1), (50, 10), (100, 2), (100, 20)])
def test_a_time_limit_is_kept_at_every_size(tmp_path, n, m):
    problem = sized(n, m)
    with solving(problem, tmp_path) as process:
        for limit in (2.0, 10.0):
            solution = _assert_kept(process, problem, limit)
    assert n < 50 or m == 1 or solution.bound > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("n, m", [(25, 1), (20, 5), (50, 10), (100, 20)])
def test_a_time_limit_is_kept_in_every_phase(tmp_path, n, m):
    problem = sized(n, m)
    moments = _moments(problem, 60.0)
    assert {"prices", "elimination"} <= moments.keys()
    with solving(problem, tmp_path) as process:
        for moment in moments.values():
            _assert_kept(process, problem, moment)


@pytest.mark.slow
@needs_signals
@pytest.mark.parametrize("n, m", [(50, 1), (64, 12), (100, 20)])
def test_ctrl_c_is_heard_within_a_second_at_every_size(tmp_path, n, m):
    problem = sized(n, m)
    with solving(problem, tmp_path) as process:
        for seconds in (0.3, 3.0, 8.0, 20.0, 45.0):
            _assert_interrupted(process, problem, seconds)
