"""What a formulation of the paper says when it is solved once, as printed, without cuts."""

import dataclasses

from .backends.answer import answer_in_time
from .flow import read_flow, targets_of
from .solution import Solution
from .timing import best_tours


@dataclasses.dataclass(frozen=True)
class PaperSolution(Solution):
    """The claim of a plain paper model, which need not be true of any tours.

    status, objective and bound are the model's own. paths: the targets along each path from the depot; cycles: the
    targets of each cycle that misses the depot, flown by nobody. `tours` is empty if there is a cycle, or a path that
    only the solver's tolerance lets through: then the claim is false, or at least unproved.

    >>> from mamttsp import generate, solve
    >>> claim = solve(generate(n_targets=3, total_window=20, seed=1), method="micp", solver="scip", subtour_cuts=False)
    >>> claim.cycles, sorted(target for path in claim.paths for target in path)
    ((), [0, 1, 2])
    """

    paths: tuple[tuple[int, ...], ...] = ()
    cycles: tuple[tuple[int, ...], ...] = ()


def paper_solution(formulation, run, options, clock):
    """Solve a formulation once with a back end's `run` and return the PaperSolution; clock: began before the model."""
    answer, graph = answer_in_time(run, formulation, options, clock), formulation.graph
    paths, cycles = ((), ()) if answer.flow is None else read_flow(graph, answer.flow)
    found = best_tours(graph, [list(path) for path in paths]) if paths and not cycles else None
    return PaperSolution(
        status=answer.status,
        objective=answer.objective,
        bound=answer.bound,
        runtime=answer.runtime,
        tours=() if found is None else tuple(found[1]),
        method=formulation.method,
        solver=answer.solver,
        modeler=formulation.modeler,
        build_time=formulation.build_time,
        nodes=answer.nodes,
        subtour_cuts=answer.cuts,
        paths=targets_of(graph, paths),
        cycles=targets_of(graph, cycles),
    )
