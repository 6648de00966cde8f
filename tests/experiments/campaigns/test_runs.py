"""Profiles: the runs that the paper and its reproduction consist of."""

from collections import Counter
from dataclasses import asdict

import pytest

from mamttsp import InputError
from mamttsp.experiments import PROFILES, profile
from mamttsp.experiments.campaigns.rows import key_of


@pytest.mark.parametrize(
    "name, number", [("smoke", 10), ("reduced", 420), ("claims", 126), ("full", 1120), ("exact", 560)]
)
def test_each_run_is_there_once(name, number):
    runs = profile(name)
    assert len(runs) == len({key_of(asdict(run)) for run in runs}) == number
    assert [run.n for run in runs] == sorted(run.n for run in runs)


def test_full_is_the_papers_runs():
    runs = profile("full", solver="gurobi")
    assert Counter(run.method for run in runs) == {"micp": 560, "baseline": 560}
    assert Counter(run.n for run in runs) == dict.fromkeys((5, 10, 15, 20), 280)
    assert {(run.solver, run.time_limit) for run in runs} == {("gurobi", 1800)}
    panels = {(20, 1), (40, 1), (60, 1), (40, 2), (40, 3), (40, 4), (40, 5)}
    assert {(run.total_window, run.agents) for run in runs} == panels


def test_claims_runs_the_best_open_routes_for_600_s():
    runs = profile("claims")
    routes = Counter((run.n, run.method, run.solver) for run in runs)
    for n, number in ((15, 35), (20, 21)):
        assert routes[n, "micp", "clarabel"] == routes[n, "baseline", "scip"] == number
        assert routes[n, "micp", "scip"] == 7
    assert {run.index for run in runs if (run.method, run.solver) == ("micp", "scip")} == {0}
    assert {run.time_limit for run in runs} == {600}


def test_smoke_has_every_method():
    assert {run.method for run in profile("smoke")} == {"exact", "micp", "baseline", "nonconvex"}


def test_unknown_profiles_and_solvers_are_refused():
    with pytest.raises(InputError, match=f"profile: expected one of {', '.join(PROFILES)}, found 'big'"):
        profile("big")
    with pytest.raises(InputError, match='solver: only the profile "full" takes one'):
        profile("smoke", solver="scip")
    with pytest.raises(InputError, match="solver: expected one of"):
        profile("full", solver="none")
