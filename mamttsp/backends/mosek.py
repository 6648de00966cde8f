"""MOSEK, when installed: cvxpy formulations as a conic program (cones only as such, not as Pyomo writes them)."""

import mosek
import numpy as np

from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN
from .answer import licence_trouble
from .lifted import Found, solve_lifted

_VERSION = "mosek {}.{}".format(*mosek.Env.getversion()[:2])
_INFEASIBLE = (mosek.solsta.prim_infeas_cer, mosek.prosta.prim_infeas, mosek.prosta.prim_infeas_or_unbounded)


def solve(formulation, options):
    """Solve a cvxpy formulation; SolverUnavailable without a licence."""
    try:
        return solve_lifted(formulation, options, _run)
    except mosek.Error as error:
        if error.errno // 100 == 10:  # MOSEK numbers its licence errors from 1000 to 1099
            raise licence_trouble("mosek", error.msg) from error
        raise


def _run(program, cones, options, clock):
    with mosek.Task() as task:
        if options.verbose:
            task.set_Stream(mosek.streamtype.log, lambda text: print(text, end=""))
        _load(task, program, cones)
        task.putdouparam(mosek.dparam.mio_tol_rel_gap, options.gap)
        task.putintparam(mosek.iparam.num_threads, options.threads)
        task.putintparam(mosek.iparam.mio_seed, options.seed % 2**31)
        if clock.left is not None:
            task.putdouparam(mosek.dparam.optimizer_max_time, clock.left)
        task.optimize()
        status, point = _read(task)
        nodes = task.getintinf(mosek.iinfitem.mio_num_branch)
        return Found(status, point, task.getdouinf(mosek.dinfitem.mio_obj_bound), nodes, _VERSION)


def _load(task, program, cones):
    rows, columns = program.A.shape
    task.appendvars(columns)
    task.appendcons(rows)
    task.putclist(range(columns), program.c)
    below, above = np.isfinite(program.lower), np.isfinite(program.upper)
    kinds = np.array([[mosek.boundkey.fr, mosek.boundkey.up], [mosek.boundkey.lo, mosek.boundkey.ra]], dtype=object)
    lower, upper = np.where(below, program.lower, 0.0), np.where(above, program.upper, 0.0)
    task.putvarboundlist(range(columns), list(kinds[below.astype(int), above.astype(int)]), lower, upper)
    entries = program.A.tocoo()
    task.putaijlist(entries.row, entries.col, entries.data)
    senses = [mosek.boundkey.fx if sense == "=" else mosek.boundkey.up for sense in program.senses]
    task.putconboundlist(range(rows), senses, program.b, program.b)
    whole = np.flatnonzero(program.integer)
    task.putvartypelist(whole, [mosek.variabletype.type_int] * len(whole))
    for cone in cones:
        task.appendcone(mosek.conetype.quad, 0.0, cone)
    task.putobjsense(mosek.objsense.minimize)


def _read(task):
    """Return (status, point or None) of the integer solution."""
    which = mosek.soltype.itg
    if not task.solutiondef(which):
        return UNKNOWN, None
    status = task.getsolsta(which)
    if status == mosek.solsta.integer_optimal:
        return OPTIMAL, task.getxx(which)
    if status == mosek.solsta.prim_feas:
        return FEASIBLE, task.getxx(which)
    infeasible = status in _INFEASIBLE or task.getprosta(which) in _INFEASIBLE
    return (INFEASIBLE if infeasible else UNKNOWN), None
