"""The exact solver, `method="exact"`: proved optima of MA-MT-TSP instances without a model or a licence."""

import contextlib

import numpy as np

from ..display import ProgressLog
from ..graph import build_graph
from ..options import Watch
from ..solution import FEASIBLE, INFEASIBLE, OPTIMAL, UNKNOWN, Solution
from .fleet import Fleet
from .parameters import Parameters
from .ruin_and_recreate import Annealing
from .search import Search

#: gaps below this are beyond the tolerance of the SOCP that times the tours
_LEAST_GAP = 1e-7


def solve_exact(instance, options, parameters=None):
    """Return a Solution of the instance, or what stands when a limit or Ctrl-C ends the run.

    options: `options.Options`; threads is 1, verbose prints a log. parameters: None for the defaults.
    """
    graph, parameters = build_graph(instance), parameters or Parameters()
    fleet = Fleet.of(graph)
    progress = options.progress or (ProgressLog() if options.verbose else None)
    with Watch(options.time_limit) as clock:
        annealing = Annealing(graph, range(instance.n_targets), fleet, parameters, options.seed)
        start = [_segments(graph, tour) for tour in options.start or ()]
        search = Search(graph, fleet, max(options.gap, _LEAST_GAP), clock, parameters, annealing, progress, start)
        with contextlib.suppress(KeyboardInterrupt):  # from the progress callback; Ctrl-C itself is the clock's
            search.run()
    return _solution(search, clock.spent)


def _segments(graph, tour):
    """Return the route of a tour: the segment of each visit in its agent's layer, that whose time is nearest."""
    other = graph.layer != (tour.agent or 0)
    late = [
        np.maximum(graph.t_lo - v.time, v.time - graph.t_hi) + 1e9 * (other | (graph.tau != v.target))
        for v in tour.visits
    ]
    return tuple(int(np.argmin(off)) for off in late)


def _solution(search, runtime):
    standing, tours = search.standing, search.incumbent.tours()
    objective, bound, _ = standing.figures()
    if standing.infeasible:
        status, bound = INFEASIBLE, None
    elif tours:
        status = OPTIMAL if standing.closed() else FEASIBLE
    else:
        status = UNKNOWN
    return Solution(status, objective, bound, runtime, tours, "exact", _NAME, nodes=search.labels)


_NAME = "mamttsp exact"
