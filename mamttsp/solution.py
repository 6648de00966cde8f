"""Solution: the answer of every method and back end, its statuses and its JSON file."""

import dataclasses
import json
import math
import os
from typing import Any, Self

from .jsonfile import check_header, read_json, require, write_json
from .solution_table import html_table, table
from .tours import Tour
from .validation import InputError, is_number

FORMAT = "mamttsp-solution"
#: 2 says of each tour which type of agent flies it
VERSIONS = (1, 2)

OPTIMAL = "optimal"
FEASIBLE = "feasible"
INFEASIBLE = "infeasible"
UNKNOWN = "unknown"
STATUSES = (OPTIMAL, FEASIBLE, INFEASIBLE, UNKNOWN)


@dataclasses.dataclass(frozen=True)
class Solution:
    """What a solve found and proved.

    status: "optimal" (the gap asked for is proved), "feasible" (it is not: a limit or Ctrl-C came first, or the search
    is at its end and its accuracy proves no more), "infeasible" (proved) or "unknown" (a limit or Ctrl-C came first,
    nothing found). objective: total length of the tours, None without tours; bound: proved lower bound on every
    solution, None if none is known; runtime: solver's wall time in s; build_time: time to build and hand over the
    model. tours: tuple of Tour; nodes: branch-and-bound nodes; subtour_cuts: cuts added against cycles that nobody
    flies. reason: of an infeasible instance, why it is, or that nothing short says so; None else.

    >>> from mamttsp import Solution
    >>> solution = Solution("feasible", objective=125.0, bound=100.0, runtime=60.0, tours=(), method="", solver="")
    >>> solution.gap
    0.2
    >>> Solution.from_dict(solution.to_dict()) == solution
    True
    """

    status: str
    objective: float | None
    bound: float | None
    runtime: float
    tours: tuple[Tour, ...]
    method: str
    solver: str
    modeler: str | None = None
    build_time: float = 0.0
    nodes: int | None = None
    subtour_cuts: int = 0
    reason: str | None = None

    @property
    def gap(self) -> float | None:
        """(objective - bound) / objective as a fraction, None if either is unknown.

        An optimum of 0 is known to within 1e-8 of the instance's size; this ratio may then be 1, though all is proved.
        """
        return relative_gap(self.objective, self.bound)

    def __str__(self) -> str:
        """The table that the command line prints; targets and tours are numbered from 0."""
        return table(self)

    def _repr_html_(self) -> str:
        return html_table(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON object of the file format."""
        return {
            "format": FORMAT,
            "version": 1 if all(tour.agent is None for tour in self.tours) else 2,
            "status": self.status,
            "method": self.method,
            "modeler": self.modeler,
            "solver": self.solver,
            "objective": self.objective,
            "bound": self.bound,
            "gap": self.gap,
            "runtime_s": self.runtime,
            "build_time_s": self.build_time,
            "nodes": self.nodes,
            "subtour_cuts": self.subtour_cuts,
            "reason": self.reason,
            "tours": [tour.to_dict() for tour in self.tours],
        }

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Build a solution from the JSON object; InputError names the field that is wrong."""
        check_header(data, FORMAT, VERSIONS)
        require(data, "", "status", "method", "solver", "objective", "bound", "runtime_s", "tours")
        if data["status"] not in STATUSES:
            raise InputError(f"status: expected one of {', '.join(STATUSES)}, found {json.dumps(data['status'])}")
        if not isinstance(data["tours"], list):
            raise InputError("tours: expected a list of tours")
        tours = tuple(Tour.from_dict(tour, f"tours[{k}]") for k, tour in enumerate(data["tours"]))
        unnamed = [k for k, tour in enumerate(tours) if tour.agent is None]
        if data["version"] == 2 and unnamed:
            raise InputError(f"tours[{unnamed[0]}].agent: missing; version 2 numbers the type of each tour's agent")
        return cls(
            status=data["status"],
            objective=_number(data, "objective"),
            bound=_number(data, "bound"),
            runtime=_number(data, "runtime_s"),
            tours=tours,
            method=data["method"],
            solver=data["solver"],
            modeler=data.get("modeler"),
            build_time=data.get("build_time_s", 0.0),
            nodes=data.get("nodes"),
            subtour_cuts=data.get("subtour_cuts", 0),
            reason=data.get("reason"),
        )

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the solution as JSON."""
        write_json(self.to_dict(), path)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Self:
        """Read a solution file; InputError starts with the file's name."""
        return read_json(path, cls.from_dict)


def relative_gap(objective: float | None, bound: float | None) -> float | None:
    """Return (objective - bound) / objective, 0 where both agree, None if either is unknown."""
    if objective is None or bound is None:
        return None
    if objective <= bound:
        return 0.0
    return (objective - bound) / objective


def known_length(value: float | None) -> float | None:
    """Return a length or a bound on it as a float of at least 0, or None for infinity and what solvers use as such."""
    if value is None or not math.isfinite(value) or abs(value) >= 1e20:
        return None
    return max(float(value), 0.0)


def _number(data, field):
    value = data[field]
    if value is not None and not is_number(value):
        raise InputError(f"{field}: expected a finite number or null, found {json.dumps(value)}")
    return value
