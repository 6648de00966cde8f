"""The faster enumeration against the plain one, on instances small enough for both."""

import math

import pytest

from mamttsp import generate
from tests.exact.enumeration import optimum as faster
from tests.examples import instance, still
from tests.meetings import passing, three_at_one_point, two_on_one_path
from tests.oracle import optimum

INSTANCES = {f"n {n} w {w} m {m}": generate(n, w, m, 11) for n in (1, 3, 4) for w in (20, 60) for m in (1, 2)} | {
    "passing": passing(0.0),
    "three at one point": three_at_one_point(),
    "two on one path": two_on_one_path(),
    "at the depot": instance(still(0, 0), still(5, 5, [(20, 20)])),
    "two appointments, one agent": instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)])),
    "two appointments, two agents": instance(still(10, 0, [(5, 6)]), still(-10, 0, [(5, 6)]), n_agents=2),
}


@pytest.mark.parametrize("problem", INSTANCES.values(), ids=INSTANCES)
def test_both_enumerations_agree(problem):
    expected = optimum(problem)
    assert faster(problem) == (expected if math.isinf(expected) else pytest.approx(expected, rel=1e-7))
