"""What a solver's tolerance lets through, where two targets pass each other 0.05 units apart."""

import pytest

from mamttsp import build_graph
from mamttsp.formulations import build_formulation
from mamttsp.formulations.points import recover
from mamttsp.formulations.residuals import residuals
from mamttsp.study.meetings import passing
from mamttsp.study.tolerance import solve_with_tolerance
from tests.oracle import optimum

NEAR = passing(0.05)


def solved(method, **settings):
    formulation = build_formulation(method, "pyomo", build_graph(NEAR), 1)
    status, length = solve_with_tolerance(formulation, **settings)
    assert status == "optimal" and formulation.model.length() == pytest.approx(length)
    return formulation, length


def test_the_big_m_lets_a_cycle_through_at_scips_own_tolerance():
    formulation, length = solved("baseline", feastol=1e-6)
    assert length == pytest.approx(20.0, abs=0.01) and len(recover(formulation).cycles) == 1
    assert residuals(formulation.model)["norm"] > 0.04


@pytest.mark.parametrize(
    "method, settings",
    [
        ("baseline", {"feastol": 1e-7}),
        ("baseline", {"feastol": 1e-6, "presolve": False}),
        ("micp", {"feastol": 1e-6}),
        ("nonconvex", {"feastol": 1e-6}),
    ],
)
def test_it_does_not_without_presolve_or_with_less_tolerance_nor_do_the_others(method, settings):
    formulation, length = solved(method, **settings)
    assert length == pytest.approx(optimum(NEAR), rel=2e-4) and recover(formulation).cycles == ()
