"""Our branch and bound over Clarabel's relaxations, for the MICP of either modeler."""

import clarabel

from ..branch_and_bound.tree_search import TreeSearch
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, known_length
from ..validation import InputError
from .answer import Answer

_VERSION = f"clarabel {clarabel.__version__}"


def solve(formulation, options):
    """Solve a MICP of either modeler and return the Answer, its incumbent made of tours that can be flown.

    Cycles that miss the depot are cut off as they turn up (Answer.cuts). The search has nothing random in it, so
    options.seed does nothing. InputError: another method than "micp".
    """
    if formulation.method != "micp":
        raise InputError(f'method: the branch and bound on clarabel solves "micp", found {formulation.method!r}')
    search = TreeSearch(formulation, options)
    try:
        finished = search.run()
    except KeyboardInterrupt:
        finished = False
    return _answer(search, finished)


def _answer(search, finished):
    """Return the Answer as things stand."""
    known = search.best.flow is not None
    if finished:
        status = OPTIMAL if known else INFEASIBLE
    else:
        status = FEASIBLE if known else UNKNOWN
    return Answer(
        status=status,
        objective=known_length(search.best.length),
        bound=known_length(search.bound),
        flow=search.best.flow,
        nodes=search.nodes,
        runtime=search.spent,
        solver=_VERSION,
        cuts=search.cuts,
    )
