"""Tours: an agent's visits in order; and the independent checker, which reads the instance's own data, never a graph, a
formulation or a solver."""

import dataclasses
import math
from collections.abc import Iterable
from numbers import Integral, Real
from typing import Any, Protocol, Self

import numpy as np

from .instance import Instance
from .validation import InputError, brief, counted, is_number, of_type, positive, whole

#: default tolerance of `check`, relative to the instance's size (lengths) and horizon (times)
TOLERANCE = 1e-6


class TourError(ValueError):
    """Tours that are not a solution; the message lists every violation, one a line."""


@dataclasses.dataclass(frozen=True)
class Visit:
    """A visit of `target` (from 0) at `time` in s, at `position` (x, y) in units.

    >>> from mamttsp import Visit
    >>> Visit(target=0, time=2.5, position=(3.0, 4.0))
    Visit(target=0, time=2.5, position=(3.0, 4.0))
    """

    target: int
    time: float
    position: tuple[float, float]


@dataclasses.dataclass(frozen=True)
class Tour:
    """One agent's tour: it leaves its depot at time 0, makes its visits in order and is at its end at `return_time`.

    agent: the number of the agent's type, an entry of `Instance.agents`; None where there is only one.

    >>> from mamttsp import Tour, Visit
    >>> tour = Tour((Visit(0, 2.5, (3.0, 4.0)),), return_time=4.0)
    >>> Tour.from_dict(tour.to_dict()) == tour
    True
    """

    visits: tuple[Visit, ...]
    return_time: float
    agent: int | None = None

    def to_dict(self) -> dict[str, Any]:
        visits = [{"target": v.target, "time": v.time, "position": list(v.position)} for v in self.visits]
        fields = {"visits": visits, "return_time": self.return_time}
        return fields if self.agent is None else {"agent": self.agent} | fields

    @classmethod
    def from_dict(cls, data: Any, where: str = "tour") -> Self:
        """Build a tour from the JSON object of a solution file; InputError names the field that is wrong."""
        agent = data.get("agent") if isinstance(data, dict) else None
        if agent is not None:
            whole(f"{where}.agent", agent, 0)
        try:
            visits = tuple(_visit_from(v, f"{where}.visits[{k}]") for k, v in enumerate(data["visits"]))
            return cls(visits, _finite(data["return_time"]), agent)
        except (KeyError, TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{where}: expected visits (a list) and return_time (a number)") from None


class HasTours(Protocol):
    """Whatever has tours, a Solution above all."""

    @property
    def tours(self) -> tuple[Tour, ...]: ...


def _visit_from(data, where):
    try:
        x, y = data["position"]
        target = data["target"]
        if isinstance(target, bool) or not isinstance(target, int):
            raise ValueError
        return Visit(target, _finite(data["time"]), (_finite(x), _finite(y)))
    except (KeyError, TypeError, ValueError):
        raise InputError(f"{where}: expected target (a whole number), time and position [x, y]") from None


def _finite(value):
    if not is_number(value):
        raise ValueError
    return float(value)


def as_tours(tours: Iterable[Tour] | HasTours, name: str = "tours") -> tuple[Tour, ...]:
    """Return the tours of a Solution, or those in a sequence of Tour, as a tuple; InputError if it is neither."""
    given = getattr(tours, "tours", tours)
    if isinstance(given, (str, bytes, dict)) or not isinstance(given, Iterable):
        raise InputError(f"{name}: expected a Solution or a list of Tours, found {brief(tours)}")
    given = tuple(given)
    for k, tour in enumerate(given):
        if not isinstance(tour, Tour) or not isinstance(tour.visits, (tuple, list)) or not _real(tour.return_time):
            raise InputError(
                f"{name}[{k}]: expected a Tour, its visits a tuple and return_time in s, found {brief(tour)}"
            )
        if tour.agent is not None and (isinstance(tour.agent, bool) or not isinstance(tour.agent, Integral)):
            raise InputError(f"{name}[{k}].agent: expected a whole number or None, found {brief(tour.agent)}")
        for i, visit in enumerate(tour.visits):
            if not _is_visit(visit):
                expected = "a Visit, its target a whole number, time in s and position (x, y)"
                raise InputError(f"{name}[{k}].visits[{i}]: expected {expected}, found {brief(visit)}")
    return given


def _is_visit(visit):
    return (
        isinstance(visit, Visit)
        and isinstance(visit.target, Integral)
        and _real(visit.time)
        and isinstance(visit.position, (tuple, list, np.ndarray))
        and len(visit.position) == 2
        and all(map(_real, visit.position))
    )


def _real(value):
    """Whether it is a number at all; that it is finite and right is for `check` to find out."""
    return isinstance(value, Real) and not isinstance(value, bool)


def check(instance: Instance, tours: Iterable[Tour] | HasTours, tolerance: float = TOLERANCE) -> float:
    """Return the total length of the tours, or raise TourError with a line for every violation.

    tours: a Solution, or a sequence of Tour; InputError if it is neither, or the instance is none.

    Independent of every formulation and solver: each target exactly once, inside one of its windows, on its path;
    each tour from the depot of its agent's type, no hop faster than that type's max_speed, at the type's end by the
    horizon, with no more demand than its capacity; of no type more tours than agents. A tour without visits is an agent
    that stays at its depot.

    tolerance: by how much lengths may be off, as a part of the instance's size (the diagonal of depots, ends and
    paths), times as one of the horizon, demands as one of the capacity.

    >>> from mamttsp import Instance, Target, Tour, Visit, check
    >>> target = Target(times=[0, 10], points=[[3, 4], [3, 4]], windows=[[2, 8]])
    >>> instance = Instance([target], n_agents=1, depot=(0, 0), max_speed=4, horizon=10)
    >>> check(instance, [Tour((Visit(0, 2.5, (3.0, 4.0)),), return_time=4.0)])
    10.0
    >>> check(instance, [Tour((Visit(0, 1.0, (3.0, 4.0)),), return_time=4.0)])
    Traceback (most recent call last):
        ...
    mamttsp.tours.TourError: tour 0, target 0: visited at 1, outside its windows [[2.0, 8.0]]
    tour 0, to target 0: 5 units in 1 s, faster than max_speed 4
    """
    of_type("instance", instance, Instance)
    tours, slack = as_tours(tours), positive("tolerance", tolerance) * instance.horizon
    faults = _count_faults(instance, tours)
    total = 0.0
    for k, tour in enumerate(tours):
        for visit in tour.visits:
            faults += _visit_faults(instance, k, visit, tolerance)
        if (entry := _type_of(instance, tour)) is None:
            continue
        length, hop_faults = _fly(instance, entry, k, tour, slack)
        total += length
        faults += hop_faults + _load_faults(instance, entry, k, tour, tolerance)
    if faults:
        raise TourError("\n".join(faults))
    return total


def agents_of(instance, tour):
    """Return the Agents, an entry of `instance.agents`, one of which flies the tour; InputError if it names none."""
    if (entry := _type_of(instance, tour)) is None:
        raise InputError(f"tours: agent {tour.agent} is not one of the {len(instance.agents)} types of agents, from 0")
    return entry


def _type_of(instance, tour):
    """Return the Agents entry of a tour, None if it names none."""
    if tour.agent is None:
        return instance.agents[0] if len(instance.agents) == 1 else None
    return instance.agents[tour.agent] if 0 <= tour.agent < len(instance.agents) else None


def _count_faults(instance, tours):
    faults = []
    for k, tour in enumerate(tours):
        if _type_of(instance, tour) is None:
            known = f"there are {len(instance.agents)} types, from 0"
            named = "its agent's type is not named" if tour.agent is None else f"agent {tour.agent} does not exist"
            faults.append(f"tour {k}: {named}; {known}")
    for number, entry in enumerate(instance.agents):
        flown = sum(tour.agent == number or (tour.agent is None and len(instance.agents) == 1) for tour in tours)
        if flown > entry.count:
            which = f" of type {number}" if len(instance.agents) > 1 else ""
            faults.append(f"{counted(flown, 'tour')} for {counted(entry.count, 'agent')}{which}")
    visited = [visit.target for tour in tours for visit in tour.visits]
    for u in range(instance.n_targets):
        if (times := visited.count(u)) != 1:
            faults.append(f"target {u} is visited {times} times, not once")
    return faults + [f"target {u} does not exist" for u in set(visited) - set(range(instance.n_targets))]


def _visit_faults(instance, k, visit, tolerance):
    if not 0 <= visit.target < instance.n_targets:
        return []
    target, slack = instance.targets[visit.target], tolerance * instance.horizon
    where = f"tour {k}, target {visit.target}"
    faults = []
    if not any(start - slack <= visit.time <= end + slack for start, end in target.windows):
        faults.append(f"{where}: visited at {visit.time:.9g}, outside its windows {target.windows.tolist()}")
    off = np.linalg.norm(target.position(visit.time) - visit.position)
    if not off <= tolerance * instance.size:
        faults.append(f"{where}: {off:.3g} units off its path at time {visit.time:.9g}")
    return faults


def _fly(instance, entry, k, tour, slack):
    """Return (length, faults) of tour k of an agent of the type `entry`; slack: s."""
    total, faults = 0.0, []
    for where, length, duration in _hops(entry, k, tour):
        total += length
        if not length <= entry.max_speed * (duration + slack):
            limit = f"max_speed {entry.max_speed:g}"
            faults.append(f"{where}: {length:.9g} units in {duration:.9g} s, faster than {limit}")
    if tour.return_time > instance.horizon + slack:
        faults.append(f"tour {k}: back at {tour.return_time:.9g}, after the horizon {instance.horizon:.9g}")
    return total, faults


def _hops(entry, k, tour):
    """Yield (where, length in units, duration in s) of each hop of tour k, the one home included."""
    position, time = entry.depot, 0.0
    home = entry.end if tour.visits else entry.depot
    name_of_home = "the depot" if entry.returns else "its end"
    ends = [(f"target {visit.target}", visit.position, visit.time) for visit in tour.visits]
    for name, there, then in [*ends, (name_of_home, home, tour.return_time)]:
        yield f"tour {k}, to {name}", float(np.linalg.norm(np.subtract(there, position))), then - time
        position, time = there, then


def _load_faults(instance, entry, k, tour, tolerance):
    known = [visit.target for visit in tour.visits if 0 <= visit.target < instance.n_targets]
    load = math.fsum(instance.targets[u].demand for u in known)
    if entry.capacity is None or load <= entry.capacity * (1 + tolerance):
        return []
    return [f"tour {k}: demands of {load:.9g} in all, above the capacity {entry.capacity:.9g}"]
