"""Types of agents and loads in the exact method: what an answer says, where it begins, and when there is none."""

import dataclasses

from mamttsp import Agents, Instance, generate, solve
from mamttsp.exact import Parameters, solve_exact
from mamttsp.options import Options
from tests.exact.certificates import assert_certificate
from tests.examples import agents, general, still
from tests.general_instances import random_general
from tests.oracle import optimum


def test_what_binds_nothing_changes_nothing():
    plain = generate(8, 40, 2, seed=5)
    heavy = [dataclasses.replace(target, demand=1.0) for target in plain.targets]
    roomy = Instance(heavy, agents=[Agents(2, (0, 0), 4.0, capacity=8.0)], horizon=plain.horizon, R=plain.R)
    one, other = solve(plain), solve(roomy)
    assert (one.objective, one.bound, one.nodes) == (other.objective, other.bound, other.nodes)
    assert [tour.agent for tour in other.tours] == [0] * len(one.tours)


def test_a_search_begins_with_the_tours_of_unlike_agents():
    problem = random_general(4, 3, 0, 40)
    best, steps = solve(problem), []
    again = solve_exact(problem, Options(start=best.tours, progress=steps.append), Parameters(annealing=0.0))
    assert steps[0].phase == "heuristic" and steps[0].objective <= best.objective * (1 + 1e-9)
    assert_certificate(problem, again, optimum(problem))


def test_demands_beyond_all_capacities_are_said():
    targets = [still(x, 1, demand=1.0) for x in range(4)]
    solution = solve(general(*targets, types=[agents(1, capacity=3.0)]))
    assert (solution.status, solution.tours) == ("infeasible", ())
    assert solution.reason == "the demands of all targets, 4, exceed the capacities of all agents, 3"


def test_demands_that_no_division_fits_are_proved_to():
    targets = [still(x, 1, demand=2.0) for x in (-1, 0, 1)]
    assert solve(general(*targets, types=[agents(2, capacity=3.0)])).status == "infeasible"
    assert solve(general(*targets, types=[agents(2, capacity=4.0)])).status == "optimal"


def test_demands_that_fit_but_for_rounding_fit():
    targets = [still(x, 1, demand=0.1) for x in (-1, 0, 1)]
    assert 0.1 + 0.1 + 0.1 > 0.3
    solution = solve(general(*targets, types=[agents(1, capacity=0.3)]))
    assert solution.status == "optimal" and len(solution.tours) == 1


def test_a_target_too_heavy_for_one_type_is_left_to_the_other():
    near, far = agents(1, (0.0, 0.0), capacity=1.0), agents(1, (50.0, 0.0), capacity=5.0)
    problem = general(still(1, 0, demand=2.0), still(2, 0, demand=1.0), types=[near, far])
    solution = solve(problem)
    served = {visit.target: tour.agent for tour in solution.tours for visit in tour.visits}
    assert served[0] == 1
    assert_certificate(problem, solution, optimum(problem))
