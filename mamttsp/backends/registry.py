"""Which back end solves which formulation of which modeler, and which one is taken when nobody says."""

from ..formulations import METHODS, MODELERS
from ..validation import InputError, brief

_CONIC = ("baseline", "micp")

#: solver -> modeler -> the methods it solves so; the modeler taken by default comes first
SOLVERS = {
    "scip": {"pyomo": METHODS, "cvxpy": _CONIC},
    "clarabel": {"cvxpy": ("micp",), "pyomo": ("micp",)},
    "highs": {"cvxpy": _CONIC},
    "gurobi": {"pyomo": METHODS, "cvxpy": _CONIC},
    "xpress": {"pyomo": METHODS, "cvxpy": _CONIC},
    "copt": {"cvxpy": _CONIC},
    "mosek": {"cvxpy": _CONIC},
}
#: by method: the open solvers in order of speed
_DEFAULTS = {"baseline": ("scip",), "nonconvex": ("scip",), "micp": ("clarabel", "scip")}
#: those that can begin from known tours
STARTS = ("clarabel", "scip", "highs", "gurobi")
#: cuts cycles off on its own, so it cannot solve a model of the paper as it stands
_ALWAYS_CUTS = "clarabel"


def choose(method, modeler=None, solver=None, plain=False, start=False):
    """Return (modeler, solver) for a method, with the default for each that is None.

    plain: the paper's model is to be solved as it stands, without cuts; start: from known tours. InputError: an unknown
    name, or a solver that does not solve this method with this modeler, or does not so.
    """
    _check_known("method", method, METHODS)
    _check_known("modeler", modeler, (*MODELERS, None))
    _check_known("solver", solver, (*SOLVERS, None))
    if plain and solver == _ALWAYS_CUTS:
        raise InputError(f"subtour_cuts: {solver} always cuts; for the plain model take another solver, such as scip")
    if start and solver not in (*STARTS, None):
        raise InputError(f"start: {solver} begins from no tours here; {', '.join(STARTS)} do")
    defaults = [name for name in _DEFAULTS[method] if not (plain and name == _ALWAYS_CUTS)]
    for candidate in [solver] if solver else defaults:
        for built_with, methods in SOLVERS[candidate].items():
            if method in methods and modeler in (None, built_with):
                return built_with, candidate
    if solver is None:
        raise InputError(f"modeler: {modeler} cannot state method {method}; use pyomo")
    routes = "; ".join(f"{m} {', '.join(methods)}" for m, methods in SOLVERS[solver].items())
    wanted = f"{method} with {modeler}" if modeler else method
    raise InputError(f"solver: {solver} does not solve {wanted}; it solves: {routes}")


def _check_known(name, value, known):
    if value not in known:
        raise InputError(f"{name}: expected one of {', '.join(filter(None, known))}, found {brief(value)}")
