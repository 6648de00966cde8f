"""Known tours that a solve begins from: looked at before, and never lost."""

import dataclasses

from .solution import INFEASIBLE
from .tours import TourError, as_tours, check
from .validation import InputError


def begin_with(instance, start):
    """Return the tours of `start`, a Solution, tours or None, as a tuple, None for None.

    InputError: it is neither, or no solution of this instance.
    """
    if start is None:
        return None
    tours = as_tours(start, "start")
    try:
        check(instance, tours)
    except TourError as error:
        first, *others = str(error).splitlines()
        more = f", and {len(others)} more" if others else ""
        raise InputError(f"start: no solution of this instance: {first}{more}") from error
    return tuple(tour for tour in tours if tour.visits)


def no_longer(instance, solution, tours, gap):
    """Return the solution, or, if its tours are longer than `tours`, which it began from, these with its bound.

    FlowError: the solution claims that no such tours exist.
    """
    # Here, because a solve without `start` by the exact method does without them.
    from .cut_loop import bound_below, status_of
    from .flow import FlowError

    if solution.status == INFEASIBLE:
        raise FlowError(f"{solution.solver} calls infeasible what the tours that it began from solve")
    length = check(instance, tours)
    if solution.objective is not None and solution.objective <= length:
        return solution
    bound = bound_below(length, solution.bound, instance.size)
    return dataclasses.replace(
        solution, tours=tours, objective=length, bound=bound, status=status_of(length, bound, gap)
    )
