"""Every path of the search, forced by its constants on instances that enumeration solves."""

import dataclasses
import functools
import itertools

import pytest

from mamttsp import Progress, generate
from mamttsp.exact import Parameters, solve_exact
from mamttsp.options import Options
from mamttsp.warm_up import ensure_compiled
from tests.exact.certificates import assert_brackets, assert_certificate, assert_sound
from tests.exact.enumeration import optimum
from tests.exact.paths import FORCED, UNSETTLED
from tests.general_instances import random_general
from tests.meetings import passing, three_at_one_point, two_on_one_path
from tests.oracle import optimum as general_optimum

#: (targets, total window, agents, seed)
GENERATED = ((3, 60, 1, 0), (4, 40, 2, 1), (5, 60, 1, 2), (5, 40, 2, 3), (6, 60, 3, 4), (6, 20, 2, 5), (6, 60, 2, 6))
#: (targets, types of agents, seed)
UNLIKE = ((4, 2, 0), (5, 1, 0), (5, 3, 4))
INSTANCES = {
    **{
        f"{n} targets, {w} s, {m} agents, seed {seed}": functools.partial(generate, n, w, m, seed=seed)
        for n, w, m, seed in GENERATED
    },
    "two pass each other": functools.partial(passing, 0.0),
    "three at one point": three_at_one_point,
    "two on one path": two_on_one_path,
    **{
        f"{n} targets, {K} types, seed {seed}": functools.partial(random_general, n, K, seed, 40)
        for n, K, seed in UNLIKE
    },
}


@functools.cache
def _known(name):
    problem = INSTANCES[name]()
    return problem, (optimum if problem.plain else general_optimum)(problem)


#: three at one point: a kink where they meet, so that without settling the gap closes to first order only
_OPEN = {(path, "three at one point") for path in UNSETTLED}


@pytest.fixture(scope="module", autouse=True)
def compiled():
    """Compiling is no part of a time limit."""
    ensure_compiled()


@pytest.mark.parametrize("name", INSTANCES)
@pytest.mark.parametrize("path", FORCED)
def test_every_path_leads_to_the_optimum(path, name):
    problem, known = _known(name)
    limit = 3.0 if (path, name) in _OPEN else 60.0
    solution = solve_exact(problem, Options(gap=1e-4, time_limit=limit), Parameters(**FORCED[path]))
    if (path, name) in _OPEN:
        assert_brackets(problem, solution, known)
        assert solution.bound >= 0.999 * known
    else:
        assert_certificate(problem, solution, known)


def test_a_round_that_cannot_cut_is_not_repeated():
    steps = []
    options = Options(gap=1e-4, time_limit=5.0, progress=steps.append)
    solve_exact(three_at_one_point(), options, Parameters(few_sets=0))
    bounds = [step.bound for step in steps if step.phase == "prices"]
    assert bounds.count(max(bounds)) <= 4


def _phases(problem, parameters):
    steps = []
    solve_exact(problem, Options(gap=1e-6, time_limit=60.0, progress=steps.append), parameters)
    assert all(isinstance(step, Progress) for step in steps)
    return [step.phase for step in steps]


def test_the_paths_are_those_that_are_meant():
    problem = generate(6, 60, 2, seed=6)
    usual = _phases(problem, Parameters())
    assert "settle" in usual and "labels" not in usual
    assert "labels" in _phases(problem, Parameters(**FORCED["no enumeration fits at first"]))
    lower = _phases(passing(0.0), Parameters(**FORCED["only parts of the gap are enumerated"]))
    assert ("labels", "routes") in itertools.pairwise(lower)
    shorter = _phases(problem, Parameters(**FORCED["split as soon as shorter pieces were tried"]))
    assert shorter.count("elimination") > usual.count("elimination")
    assert "settle" not in _phases(problem, Parameters(few_sets=0))


def test_parameters_are_not_changed_by_a_run():
    parameters = Parameters()
    before = dataclasses.astuple(parameters)
    assert_sound(problem := generate(3, 40, 1, seed=1), solve_exact(problem, Options(), parameters))
    assert dataclasses.astuple(parameters) == before
    with pytest.raises(dataclasses.FrozenInstanceError):
        parameters.ng_size = 1


def test_the_routes_of_a_settled_choice_are_taken():
    """Even if there was no time for a choice among the routes known."""
    instance = generate(10, 60, 3, seed=4)
    hardly = Parameters(**FORCED["hardly a choice among known routes"])
    solution = solve_exact(instance, Options(gap=1e-4, time_limit=60), hardly)
    assert_certificate(instance, solution, solve_exact(instance, Options(gap=1e-6)).objective)
