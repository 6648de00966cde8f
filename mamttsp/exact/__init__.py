"""The exact solver, `method="exact"`: proved optima of MA-MT-TSP instances without a model or a licence.

Segments are cut into pieces; relaxed routes over pieces (ng-routes with affine values, see `relaxed`) bound and
guide the growth of elementary labels (`labels`), whose routes enter a set partitioning (`partition`, `settle`);
pieces that no solution better than the incumbent can use are dropped and the rest cut finer (`search`). Every bound
holds for real tours because each step underestimates the flown distance; every incumbent is a real tour timed by the
SOCP.
"""

import math

from ..display import ProgressLog
from ..graph import build_graph
from ..options import Watch
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, Solution
from ..validation import InputError
from .heuristic import Annealing
from .search import Search

#: gaps below this are beyond the tolerance of the SOCP that times the tours
_LEAST_GAP = 1e-7


#: sets of targets are words of 64 bits
_MOST_TARGETS = 64


def solve_exact(instance, options):
    """Return a Solution of the instance, or what stands when a limit or Ctrl-C ends the run.

    options: `options.Options`; threads has no effect, verbose prints a log. InputError: more than 64 targets.
    """
    if instance.n_targets > _MOST_TARGETS:
        raise InputError(f'targets: method "exact" takes at most {_MOST_TARGETS}, found {instance.n_targets}')
    graph, targets = build_graph(instance), range(instance.n_targets)
    n_agents = min(instance.n_agents, instance.n_targets)
    progress = options.progress or (ProgressLog() if options.verbose else None)
    with Watch(options.time_limit) as clock:
        search = Search(
            graph, targets, n_agents, max(options.gap, _LEAST_GAP), clock, progress,
            annealing=Annealing(graph, targets, n_agents, options.seed),
        )  # fmt: skip
        try:
            search.run()
        except KeyboardInterrupt:  # from the progress callback; Ctrl-C itself is the clock's
            pass
    return _solution(search, clock.spent)


def _solution(search, runtime):
    standing, tours = search.standing, search.incumbent.tours()
    objective, bound, _ = standing.figures()
    if math.isinf(bound):
        status, bound = INFEASIBLE, None
    elif tours:
        status = OPTIMAL if standing.closed() else FEASIBLE
    else:
        status = UNKNOWN
    return Solution(status, objective, bound, runtime, tours, "exact", _NAME, nodes=search.labels)


_NAME = "mamttsp exact"
