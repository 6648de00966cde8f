"""The relaxed bound of an instance: the paper's MICPs without the demand that y is whole, solved by Clarabel."""

import dataclasses
import math

import numpy as np

from .conic_solver import claims_infeasible, dual_point, minimise
from .formulations import build_formulation, graph_for
from .validation import InputError

CONIC_METHODS = ("micp", "baseline")


@dataclasses.dataclass(frozen=True, eq=False)
class ContinuousRelaxation:
    """A continuous relaxation and its answer.

    bound: proved lower bound in units on the length of all tours, infinity if even the relaxation is infeasible;
    values: dict from the name of a variable to the array of its values, edges (or nodes) first.
    """

    bound: float
    values: dict


def relax(instance, method="micp", modeler="cvxpy", prune=False):
    """Return a lower bound (units) on the total length of all tours: the optimum of the continuous relaxation.

    method: "micp" or "baseline", whose relaxation is 0; modeler: "cvxpy" or "pyomo"; prune: leave out edges that no
    agent can fly. Infinity if even the relaxation is infeasible. InputError: an unknown method or modeler.
    """
    if method not in CONIC_METHODS:
        raise InputError(f"method: expected one of {', '.join(CONIC_METHODS)} for a relaxation, found {method!r}")
    return relaxation(build_formulation(method, modeler, graph_for(method, instance, prune))).bound


def relaxation(formulation):
    """Solve the continuous relaxation of a built Formulation, "micp" or "baseline", and return its answer.

    It takes the model as it is: what has been added or switched off counts. The bound is proved by Clarabel's dual
    point, residual included (see conic_solver): it is a little below the relaxation's optimum, by up to about
    1e-6 of it, and never above.
    """
    graph, n_agents = formulation.graph, formulation.n_agents
    program = formulation.conic_program().relaxed()
    size = program.n_zero, program.n_nonneg
    answer = minimise(program.c, program.A, program.b, *size)
    x, z = np.array(answer.x), dual_point(answer, *size)
    values = {name: x[columns] for name, columns in program.columns.items()}
    if claims_infeasible(answer) and _proved(0 * program.c, program, z, graph, n_agents) > 0:
        return ContinuousRelaxation(math.inf, values)
    bound = _proved(program.c, program, z, graph, n_agents)
    return ContinuousRelaxation(max(0.0, float(bound)), values)  # lengths are not negative


def _proved(c, program, z, graph, n_agents):
    """Return -b z + the least value of r x, with r = c + A' z, over what the variables can be at an optimum."""
    r = c + program.A.T @ z
    excess = np.abs(r) * _magnitudes(program, graph, n_agents)
    if "alpha" not in program.columns:
        return -program.b @ z - excess.sum()
    # The MICP's edge variables are at most y_e times their magnitudes, and the y_e sum up to n + alpha.
    alpha = program.columns["alpha"]
    edges = [columns.reshape(len(graph.edges), -1) for name, columns in program.columns.items() if name != "alpha"]
    worst = max(sum(excess[columns].sum(axis=1) for columns in edges))
    return -program.b @ z - (graph.n_targets + n_agents) * worst - excess[alpha].sum()


def _magnitudes(program, graph, n_agents):
    """Return a bound on the absolute value of each column, at an optimum where no l is longer than it must be."""
    T = graph.horizon
    farthest = max(np.abs(graph.p_lo).max(), np.abs(graph.p_hi).max())
    load = graph.room.max()
    bounds = {
        "y": 1.0,
        "alpha": n_agents,
        "q": load,
        "t": T,
        "z_t": T,
        "z_t_prime": T,
        "z_p": farthest,
        "z_p_prime": farthest,
    }
    magnitudes = np.full(len(program.c), graph.size + graph.R)  # l, l_xy and l_bar, which is at most l + R
    for name in bounds.keys() & program.columns.keys():
        magnitudes[program.columns[name]] = bounds[name]
    return magnitudes
