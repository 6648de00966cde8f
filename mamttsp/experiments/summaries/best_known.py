"""The best that is known of each setting: its shortest tours, its best bound, and which routes found them."""

import json

import numpy as np
import pandas as pd

from ...generate import paper_instance
from ...tours import TourError, check
from ...validation import InputError
from ..campaigns.rows import INSTANCE, tours_of

COLUMNS = (*INSTANCE, "objective", "objective_by", "bound", "bound_by", "gap_percent", "tours")
#: relative differences that count as equal: of lengths, and of a bound above a length, which solvers' tolerances allow
_EQUAL, _TOLERANCE = 1e-6, 1e-4


def best_known(rows):
    """Return a DataFrame with a line for each setting among `rows`, which are as from row_statistics.read_table.

    objective: least total length (units); objective_by: the routes whose tours are as short, to one part in a
    million; bound, bound_by: the same for the best lower bound, and none is above the objective; gap_percent: % gap
    between the two; tours: JSON, as in a solution file. What nobody found is NaN, and "[]".

    InputError: a bound contradicts tours, so that a row is wrong.
    """
    lines = [_best(setting, group) for setting, group in rows.groupby(INSTANCE)]
    return pd.DataFrame(lines, columns=COLUMNS)


def verify(line):
    """Check a line of best_known against its instance; TourError says what is wrong with it."""
    where = _where([line[name] for name in INSTANCE])
    instance = paper_instance(int(line["n"]), int(line["index"]), line["total_window"], int(line["agents"]))
    try:
        length = check(instance, tours_of(line))
    except TourError as error:
        raise TourError(f"{where}: {error}") from error
    if not abs(line["objective"] - length) <= 1e-9 * length:
        raise TourError(f"{where}: objective {line['objective']}, but the tours' length is {length:.9f}")
    if not 0 <= line["bound"] <= line["objective"]:
        raise TourError(f"{where}: bound {line['bound']} is not between 0 and the objective {line['objective']}")
    gap = 100 * (1 - line["bound"] / line["objective"])
    if not abs(line["gap_percent"] - gap) <= 1e-9:
        raise TourError(f"{where}: gap_percent {line['gap_percent']}, but objective and bound say {gap:.9f}")


def _best(setting, rows):
    objective, bound = rows.objective.min(), rows.bound.max()
    if bound > objective * (1 + _TOLERANCE):
        who = f"{_routes(rows, rows.bound == bound)} against {_routes(rows, rows.objective == objective)}"
        raise InputError(
            f"{_where(setting)}: the bound {bound} is above the length {objective} ({who}); one of them is wrong"
        )
    shortest, proved = rows[rows.objective == objective].tours, np.fmin(bound, objective)
    return dict(
        zip(INSTANCE, setting),
        objective=objective,
        objective_by=_routes(rows, rows.objective <= objective * (1 + _EQUAL)),
        bound=proved,
        bound_by=_routes(rows, rows.bound >= bound * (1 - _EQUAL)),
        gap_percent=100 * (1 - proved / objective),
        tours=shortest.iloc[0] if len(shortest) else json.dumps([]),
    )


def _where(setting):
    return ", ".join(f"{name} {value:g}" for name, value in zip(INSTANCE, setting))


def _routes(rows, chosen):
    return " ".join(sorted(set(rows.route[chosen])))
