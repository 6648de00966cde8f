"""Looking at an answer: its visits as a table to compute with, and the plan as a picture."""

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from .instance import Instance
from .tours import HasTours, Tour, agents_of, as_tours
from .validation import of_type

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

_COLUMNS = ("tour", "order", "target", "time", "x", "y", "leg_length", "waited")
#: less than this, relative to the horizon, is a rounding error of times and no wait
_INSTANT = 1e-9


def visits(instance: Instance, solution: Iterable[Tour] | HasTours) -> "pandas.DataFrame":
    """Return a pandas DataFrame with a row for each visit, tour by tour in order.

    solution: a Solution, or tours. tour, order, target: numbers from 0, order along the tour; time: s; x, y: where, in
    units; leg_length: units flown from the depot or the visit before; waited: s by which the leg took longer than at
    full speed. The way home is no row: it ends at the tour's return_time. InputError: not an Instance, or no tours.

    >>> import mamttsp
    >>> parked = mamttsp.Target(times=[0, 10], points=[[3, 4], [3, 4]], windows=[[2, 8]])
    >>> instance = mamttsp.Instance([parked], n_agents=1, depot=(0, 0), max_speed=4, horizon=10)
    >>> tour = mamttsp.Tour((mamttsp.Visit(0, 2.5, (3.0, 4.0)),), return_time=4.0)
    >>> print(mamttsp.visits(instance, [tour]))
       tour  order  target  time    x    y  leg_length  waited
    0     0      0       0   2.5  3.0  4.0         5.0    1.25
    """
    import pandas  # here: reading and solving instances does not need it

    of_type("instance", instance, Instance)
    return pandas.DataFrame(list(_rows(instance, as_tours(solution))), columns=_COLUMNS)


def plot(
    instance: Instance,
    solution: Iterable[Tour] | HasTours | None = None,
    ax: "Axes | None" = None,
    unit: str = "units",
) -> "Axes":
    """Draw an instance from above, with the tours of a solution if there is one, and return the axes.

    `mamttsp.figures` has more drawings, and `figures.save` to write one to a file. solution: a Solution, or tours; ax:
    axes to draw on, None for a new figure; unit: of lengths, as the axes name it, such as "km". InputError: not an
    Instance, no tours, or no axes.

    >>> import mamttsp
    >>> ax = mamttsp.plot(mamttsp.generate(n_targets=3, total_window=20, seed=1))
    >>> ax.get_xlabel()
    'x (units)'
    """
    from .figures import plan_view  # here: matplotlib takes its time

    return plan_view(instance, () if solution is None else solution, ax=ax, unit=unit)


def _rows(instance, tours):
    for k, tour in enumerate(tours):
        entry = agents_of(instance, tour)
        place, time = entry.depot, 0.0
        for order, visit in enumerate(tour.visits):
            length = float(np.linalg.norm(np.subtract(visit.position, place)))
            waited = visit.time - time - length / entry.max_speed
            waited *= waited > _INSTANT * instance.horizon
            yield k, order, visit.target, visit.time, *visit.position, length, waited
            place, time = visit.position, visit.time
