"""The exact solver, `method="exact"`: proved optima of MA-MT-TSP instances without a model or a licence.

Segments are cut into pieces; relaxed routes over pieces (ng-routes with affine values, see `relaxed`) bound and guide the
growth of elementary labels (`labels`), whose routes enter a set partitioning (`partition`, `settle`); pieces that no
solution better than the incumbent can use are dropped and the rest cut finer (`search`). Every bound holds for real
tours because each step underestimates the flown distance; every incumbent is a real tour timed by the SOCP.
"""

import math

from ..graph import build_graph
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, Solution
from ..tours import check
from .search import Clock, Search

#: gaps below this are beyond the tolerance of the SOCP that times the tours
_LEAST_GAP = 1e-7


def solve_exact(instance, options):
    """Return a checked Solution of the instance, or what stands when a limit or KeyboardInterrupt ends the run.

    options: `backends.answer.Options`; threads and verbose have no effect.
    """
    clock = Clock(options.time_limit)
    graph = build_graph(instance)
    gap = max(options.gap, _LEAST_GAP)
    search = Search(graph, range(instance.n_targets), instance.n_agents, gap, clock, options.progress, options.seed)
    try:
        search.find_first()
        search.run()
    except KeyboardInterrupt:
        pass
    return _solution(instance, search, clock.elapsed())


def _solution(instance, search, runtime):
    tours = search.incumbent.tours()
    if tours:
        check(instance, tours)
        status = OPTIMAL if search.closed() else FEASIBLE
        return Solution(status, search.incumbent.objective, search.bound, runtime, tours, "exact", _NAME, nodes=search.labels)
    status = INFEASIBLE if math.isinf(search.bound) else UNKNOWN
    bound = None if math.isinf(search.bound) else search.bound
    return Solution(status, None, bound, runtime, (), "exact", _NAME, nodes=search.labels)


_NAME = "mamttsp exact"
