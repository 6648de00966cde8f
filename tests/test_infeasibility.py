"""Reasons for having no solution: true by enumeration, complete for one and two targets, and said in words."""

import dataclasses
import itertools
import math
import re

import numpy as np
import pytest

from mamttsp import Agents, Instance, Target, solve
from mamttsp.infeasibility import NO_SHORT_REASON, _few_followers, why_infeasible
from tests.examples import HORIZON, MAX_SPEED, instance, still
from tests.oracle import optimum


def crowded(n_targets, n_agents, seed):
    """Return an instance whose windows are so short and far apart that it often has no solution."""
    rng = np.random.default_rng(seed)
    targets = []
    for _ in range(n_targets):
        p, v, start = rng.uniform(-45, 45, 2), rng.uniform(-0.7, 0.7, 2), rng.uniform(0, 52)
        targets.append(Target([0, 60], [p, p + 60 * v], [(start, start + 3)]))
    return Instance(targets, n_agents, (0.0, 0.0), MAX_SPEED, 60.0)


def agents_needed(made):
    """Return the fewest agents that can visit all targets, by enumeration; infinity if no number can."""
    counts = range(1, made.n_targets + 1)
    return next((m for m in counts if math.isfinite(optimum(made.with_agents(m)))), math.inf)


@pytest.mark.parametrize("seed", range(25))
def test_a_reason_is_true(seed):
    made = crowded(4, 1, seed)
    fewest = agents_needed(made)
    for m in range(1, 5):
        reason = why_infeasible(made.with_agents(m))
        assert reason is None or m < fewest
        if reason and (claimed := re.search(r"(\d) agents are needed, there (?:is|are) (\d)$", reason)):
            assert int(claimed[2]) == m < int(claimed[1]) <= fewest
        elif reason:
            for u in map(int, re.findall(r"target (\d)", reason)):
                alone = Instance([made.targets[u]], 4, made.depot, MAX_SPEED, made.horizon)
                assert math.isinf(optimum(alone))


def test_the_instances_above_have_solutions_and_none_and_reasons_of_each_kind():
    reasons = [why_infeasible(crowded(4, m, seed)) for seed in range(25) for m in (1, 2, 3)]
    words = ("no agent can be at", "back by the horizon", "no agent can visit two")
    assert None in reasons and all(any(word in reason for reason in reasons if reason) for word in words)


@pytest.mark.parametrize("seed", range(40))
def test_of_one_or_two_targets_every_reason_is_found(seed):
    for n_targets in (1, 2):
        made = crowded(n_targets, 1, 100 + seed)
        assert (why_infeasible(made) is None) == math.isfinite(optimum(made))


def test_a_target_that_is_too_far_is_named_with_its_last_window():
    made = instance(still(10, 0), still(40, 0, [(0, 2), (5, 9)]))
    assert why_infeasible(made) == "no agent can be at target 1 in a window, the last of which closes at 9 s"


def test_a_target_that_is_too_late_is_named_with_the_horizon():
    made = instance(still(40, 0, [(95, 100)]), still(10, 0))
    assert why_infeasible(made) == "no agent that visits target 0 can be back by the horizon, 100 s"


def test_several_such_targets_are_listed_and_many_are_counted():
    far = [still(40, y, [(0, 9)]) for y in range(8)]
    assert why_infeasible(instance(*far[:2], n_agents=9)).count(";") == 1
    assert why_infeasible(instance(*far, n_agents=9)).endswith("; 2 more")


def test_targets_that_exclude_each_other_are_named():
    apart = [still(10, 0), still(40, 0, [(20, 21)]), still(-40, 0, [(20, 21)])]
    assert (
        why_infeasible(instance(*apart))
        == "no agent can visit two of the targets 1, 2: 2 agents are needed, there is 1"
    )
    assert why_infeasible(instance(*apart, n_agents=2)) is None
    apart.append(still(0, 40, [(20, 21)]))
    reason = "no agent can visit two of the targets 1, 2, 3: 3 agents are needed, there are 2"
    assert why_infeasible(instance(*apart, n_agents=2)) == reason


def star():
    """Two early targets, far from each other, and a late one that can follow either."""
    return instance(still(20, 0, [(10, 11)]), still(-20, 0, [(10, 11)]), still(0, 20, [(50, 51)]))


def test_followers_are_counted_where_exclusion_does_not_suffice():
    """Targets 0, 1, 2 can be followed by 3 alone, so that two of them end their tours, though 0 and 3, say, fit in one
    tour and 0 and 4 as well; and nothing follows 3 or 4."""
    follows = np.zeros((5, 5), dtype=bool)
    follows[[0, 1, 2, 0], [3, 3, 3, 4]] = True
    needed, why = _few_followers(follows)
    assert needed == 3 == min(_paths(order, follows) for order in itertools.permutations(range(5)))
    assert why == "at most 2 of the 5 targets can be visited right after another one, each after a different one"
    assert _few_followers(np.zeros((3, 3), dtype=bool))[0] == 3


def _paths(order, follows):
    """Return into how many tours an order of targets falls apart."""
    return 1 + sum(not follows[u, v] for u, v in itertools.pairwise(order))


@pytest.mark.parametrize("method", [{"method": "exact"}, {"method": "micp", "solver": "scip"}])
def test_a_solve_says_why(method, tmp_path):
    solution = solve(star(), **method)
    assert solution.status == "infeasible" and "targets 0, 1" in solution.reason
    assert str(solution).splitlines()[1] == f"reason        {solution.reason}"
    solution.write(tmp_path / "solution.json")
    assert type(solution).read(tmp_path / "solution.json") == solution


def test_a_plain_model_says_why():
    claim = solve(star(), method="micp", solver="scip", subtour_cuts=False)
    assert claim.status == "infeasible" and "targets 0, 1" in claim.reason


def test_where_there_is_no_short_reason_that_is_said():
    # One agent can visit any two of them in 100 s, but not all three.
    made = instance(still(90, 0), still(0, 90), still(-90, 0))
    assert math.isfinite(optimum(instance(*made.targets[:2]))) and math.isinf(optimum(made))
    assert why_infeasible(made) is None
    solution = solve(made)
    assert (solution.status, solution.reason) == ("infeasible", NO_SHORT_REASON)


def test_a_solution_has_no_reason():
    assert solve(instance(still(10, 0))).reason is None and HORIZON == 100.0


def test_types_of_agents_are_told_apart():
    """One type is quick and carries little, the other slow and carries much."""
    agents = [Agents(1, (0, 0), 8.0, capacity=1.0), Agents(1, (0, 0), 4.0, capacity=5.0)]
    far, heavy = still(40, 0, [(5, 6)]), dataclasses.replace(still(10, 0), demand=4.0)

    def why(*targets):
        return why_infeasible(Instance(targets, agents=agents, horizon=HORIZON))

    assert why(far, heavy) is None
    assert why(dataclasses.replace(far, demand=2.0)).startswith("no agent can be at target 0 in a window")
    assert why(dataclasses.replace(far, demand=9.0)) == "no agent has the capacity for target 0, of demand 9"
    light = [dataclasses.replace(still(x, 5), demand=0.9) for x in range(7)]
    assert why(*light) == "the demands of all targets, 6.3, exceed the capacities of all agents, 6"
    assert why(heavy, heavy, heavy).startswith("no agent can visit two of the targets 0, 1, 2: 3 agents are needed")
