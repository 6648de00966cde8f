"""A formulation solved once by SCIP with a tolerance of one's own: for studying what a tolerance lets through."""

import pyscipopt

from ..backends.scip_models import from_pyomo, ipopt_options


def solve_with_tolerance(formulation, feastol, presolve=True):
    """Solve a Pyomo formulation once as it stands, load SCIP's point into its model, and return (status, objective).

    feastol: by how much SCIP may violate a row, and by how much a whole number may be none (SCIP's own default is
    1e-6); presolve: let SCIP rewrite the model first. status: SCIP's own word. There is no limit of time: for small
    instances only.
    """
    scip, load, _ = from_pyomo(formulation.model)
    with ipopt_options() as path:
        scip.setParam("nlpi/ipopt/optfile", str(path))
        scip.setParam("limits/gap", 1e-4)
        scip.setParam("numerics/feastol", feastol)
        if not presolve:
            scip.setPresolve(pyscipopt.SCIP_PARAMSETTING.OFF)
        scip.optimize()
    load(scip.getBestSol())
    # SCIP calls a gap of 1e-4 a limit that it has reached; for us it is what we asked for.
    return scip.getStatus().replace("gaplimit", "optimal"), scip.getObjVal()
