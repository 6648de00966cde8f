"""Who solves what, and what happens where a solver is missing or has no licence."""

import sys
import types

import pytest

from mamttsp import InputError, SolverUnavailable, solve
from mamttsp.backends import METHODS, SOLVERS, backend, choose
from tests.examples import instance, still

PACKAGES = {
    "copt": "coptpy",
    "gurobi": "gurobipy",
    "highs": "highspy",
    "mosek": "mosek",
    "scip": "pyscipopt",
    "xpress": "xpress",
}


@pytest.mark.parametrize("method", METHODS)
def test_every_method_has_an_open_default(method):
    modeler, solver = choose(method)
    assert solver in ("scip", "clarabel") and method in SOLVERS[solver][modeler]


def test_what_is_asked_for_is_kept():
    assert choose("micp", "pyomo", "scip") == ("pyomo", "scip")
    assert choose("micp", solver="copt") == ("cvxpy", "copt")
    assert choose("micp", plain=True)[1] == "scip"
    assert choose("baseline", "cvxpy") == ("cvxpy", "scip")


def test_a_method_is_required():
    with pytest.raises(InputError, match="method: expected one of"):
        choose(None)


@pytest.mark.parametrize("solver, package", PACKAGES.items())
def test_a_missing_package_is_one_sentence(solver, package, monkeypatch):
    for module in [name for name in sys.modules if name.startswith("mamttsp.backends.")]:
        if module.rsplit(".", 1)[1].startswith((solver, "highs_master", "scip_models")):
            monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, package, None)
    with pytest.raises(SolverUnavailable, match=f"solver: {solver} is not installed") as caught:
        backend(solver)
    assert "\n" not in str(caught.value)


class _GurobiError(Exception):
    def __init__(self, errno, message):
        super().__init__(message)
        self.errno = errno


def _gurobi(errno, message):
    """Return stand-ins for gurobipy whose environment fails with this error, as Gurobi's does without a licence."""

    def environment(params):
        raise _GurobiError(errno, message)

    codes = {"NO_LICENSE": 10009, "SIZE_LIMIT_EXCEEDED": 10010, "CLOUD": 10028, "NETWORK": 10022}
    constants = types.SimpleNamespace(Error=types.SimpleNamespace(**codes), INTEGER="I", CONTINUOUS="C")
    module = types.ModuleType("gurobipy")
    module.GRB, module.GurobiError, module.Env = constants, _GurobiError, environment
    module.gurobi = types.SimpleNamespace(version=lambda: (13, 0, 0))
    return module


@pytest.fixture
def fake_gurobi(monkeypatch):
    def install(errno, message):
        monkeypatch.setitem(sys.modules, "gurobipy", _gurobi(errno, message))
        monkeypatch.delitem(sys.modules, "mamttsp.backends.gurobi", raising=False)

    yield install
    sys.modules.pop("mamttsp.backends.gurobi", None)


@pytest.mark.parametrize("errno, message", [(10009, "No Gurobi license found"), (10010, "Model too large")])
def test_no_licence_or_one_too_small_is_one_sentence(errno, message, fake_gurobi):
    fake_gurobi(errno, message)
    with pytest.raises(SolverUnavailable, match=f"solver: gurobi cannot solve .*{message}"):
        solve(instance(still(1, 0)), "micp", "cvxpy", "gurobi")


def test_other_errors_of_a_solver_are_not_called_licence_trouble(fake_gurobi):
    fake_gurobi(10001, "Out of memory")
    with pytest.raises(_GurobiError, match="Out of memory"):
        solve(instance(still(1, 0)), "micp", "cvxpy", "gurobi")
