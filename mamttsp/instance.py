"""Target and Instance: the data of an MA-MT-TSP (Section II), agents of several types included, and its JSON file."""

import dataclasses
import json
import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike

from .agents import Agents
from .jsonfile import check_header, read_json, require, write_json
from .paths import frame_paths, linear_paths, parked_path
from .validation import InputError, array, at_least_0, floats, listed, positive, whole

if TYPE_CHECKING:
    import pandas

FORMAT = "mamttsp-instance"
#: 1 has the paper's problem; 2 has types of agents, and demands
VERSIONS = (1, 2)
_PAPERS_FIELDS = ("n_agents", "depot", "max_speed")


@dataclasses.dataclass(frozen=True, eq=False)
class Target:
    """A target on a piecewise-linear path.

    times: (K,) strictly increasing breakpoint times in s, K >= 2.
    points: (K, 2) positions at those times, in units.
    windows: (W, 2) pairs (start, end) in s, in order, not overlapping (they may touch), inside [times[0], times[-1]].
    demand: what serving it takes of an agent's capacity, in the unit of that.

    >>> from mamttsp import Target
    >>> target = Target(times=[0, 10, 20], points=[[0, 0], [20, 0], [20, 30]], windows=[[2, 8]])
    >>> target.position(5).tolist()
    [10.0, 0.0]
    >>> target.speeds.tolist()
    [2.0, 3.0]
    """

    times: np.ndarray
    points: np.ndarray
    windows: np.ndarray
    demand: float = 0.0

    if TYPE_CHECKING:  # what may be given, beside what is kept

        def __init__(self, times: ArrayLike, points: ArrayLike, windows: ArrayLike, demand: float = 0.0) -> None: ...

    def __post_init__(self) -> None:
        for name, shape in (("times", (-1,)), ("points", (-1, 2)), ("windows", (-1, 2))):
            object.__setattr__(self, name, array(name, getattr(self, name), shape))
        _check_path(self.times, self.points)
        _check_windows(self.times, self.windows)
        object.__setattr__(self, "demand", at_least_0("demand", self.demand))

    @classmethod
    def parked(cls, point: ArrayLike, windows: ArrayLike) -> Self:
        """Return a target that stays at `point`, (2,) in units. windows: (W, 2) in s, or a single (start, end).

        >>> from mamttsp import Target
        >>> target = Target.parked((3, 4), windows=(2, 8))
        >>> target.position(5).tolist(), target.windows.tolist()
        ([3.0, 4.0], [[2.0, 8.0]])
        """
        return cls(**parked_path(point, windows))

    def position(self, t: float | Sequence[float] | np.ndarray) -> np.ndarray:
        """Return the position (2,) at time t, or (len(t), 2) for an array of times; InputError: t is no such thing."""
        t = floats("t", t, "a time in s, or an array of times")
        return np.stack([np.interp(t, self.times, self.points[:, axis]) for axis in (0, 1)], axis=-1)

    @property
    def speeds(self) -> np.ndarray:
        """The speed on each of the K - 1 pieces, in units/s."""
        return np.linalg.norm(np.diff(self.points, axis=0), axis=1) / np.diff(self.times)

    def to_dict(self) -> dict[str, Any]:
        path = {name: getattr(self, name).tolist() for name in ("times", "points", "windows")}
        return path | {"demand": self.demand} if self.demand else path


@dataclasses.dataclass(frozen=True, eq=False, init=False)
class Instance:
    """An MA-MT-TSP: targets, agents, and the horizon T.

    targets: sequence of Target; agents: sequence of Agents, an entry for each type; horizon: T in s.
    Instance(targets, n_agents, depot, max_speed, horizon) is the paper's: `n_agents` equal agents at one `depot`, (2,)
    in units, with `max_speed` v_max in units/s. R: the big-M of the baseline in units, at least every distance that may
    be flown, such as the diagonal of the area in which the targets move; None takes `size`.

    >>> from mamttsp import Instance, Target
    >>> target = Target(times=[0, 10], points=[[3, 4], [3, 4]], windows=[[2, 8]])
    >>> instance = Instance([target], n_agents=1, depot=(0, 0), max_speed=4, horizon=10)
    >>> instance.n_targets, instance.size
    (1, 5.0)
    >>> Instance.from_dict(instance.to_dict()) == instance
    True
    """

    targets: tuple[Target, ...]
    agents: tuple[Agents, ...]
    horizon: float
    R: float | None = None

    def __init__(
        self,
        targets: Iterable[Target],
        n_agents: int | None = None,
        depot: ArrayLike | None = None,
        max_speed: float | None = None,
        horizon: float | None = None,
        R: float | None = None,
        *,
        agents: Iterable[Agents] | None = None,
    ) -> None:
        object.__setattr__(self, "targets", listed("targets", targets, Target))
        object.__setattr__(self, "agents", _agents(agents, n_agents, depot, max_speed))
        object.__setattr__(self, "horizon", positive("horizon", horizon))
        object.__setattr__(self, "R", None if R is None else positive("R", R))
        _check_targets(self)
        if self.R is not None:
            _check_big_m(self)

    @property
    def n_targets(self) -> int:
        return len(self.targets)

    @property
    def n_agents(self) -> int:
        """m: the number of agents, of all types."""
        return sum(self.counts)

    @property
    def counts(self) -> tuple[int, ...]:
        """The number of agents of each type, a tuple."""
        return tuple(entry.count for entry in self.agents)

    @property
    def depot(self) -> np.ndarray:
        """s: the depot (2,) at which all agents start; InputError if there are several."""
        return self._common("depot")

    @property
    def max_speed(self) -> float:
        """v_max of all agents in units/s; InputError if there are several."""
        return self._common("max_speed")

    def _common(self, field: str) -> Any:
        first, *others = (getattr(entry, field) for entry in self.agents)
        if any(np.any(other != first) for other in others):
            raise InputError(f"{field}: the types of agents differ in it; agents[k].{field} is that of type k")
        return first

    @property
    def plain(self) -> bool:
        """Whether this is the paper's problem: one type of agents, which return to their depot, and no demands."""
        (first, *others) = self.agents
        alike = not others and first.returns and first.capacity is None
        return alike and not any(target.demand for target in self.targets)

    @property
    def size(self) -> float:
        """The diagonal of the smallest upright rectangle that holds all depots, ends and paths, in units."""
        points = self._corners()
        return float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))

    def _corners(self) -> np.ndarray:
        """Return (K, 2) the points whose hull holds all depots, ends and paths."""
        return np.vstack([*((entry.depot, entry.end) for entry in self.agents), *(u.points for u in self.targets)])

    def with_agents(self, n_agents: int) -> Self:
        """Return the same instance with another number of agents; InputError if they are of several types."""
        if len(self.agents) > 1:
            raise InputError(f"n_agents: there are {len(self.agents)} types of agents, each with a count of its own")
        entry = dataclasses.replace(self.agents[0], count=whole("n_agents", n_agents, 1))
        return dataclasses.replace(self, agents=(entry,))

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON object of the file format (times in s, lengths in units), version 1 where that suffices."""
        common = {"horizon": self.horizon} if self.R is None else {"horizon": self.horizon, "R": self.R}
        targets = [target.to_dict() for target in self.targets]
        if not self.plain:
            entries = [entry.to_dict() for entry in self.agents]
            return {"format": FORMAT, "version": 2, **common, "agents": entries, "targets": targets}
        return {
            "format": FORMAT,
            "version": 1,
            "depot": self.depot.tolist(),
            "max_speed": self.max_speed,
            "horizon": self.horizon,
            "n_agents": self.n_agents,
            **({} if self.R is None else {"R": self.R}),
            "targets": targets,
        }

    @classmethod
    def from_arrays(cls, p: ArrayLike, v: ArrayLike, windows: Any, horizon: float, **fleet: Any) -> Self:
        """Build an instance of targets that move straight, at constant velocity, from arrays.

        p: (n, 2) positions at time 0 in units; v: (n, 2) velocities in units/s; windows: (n, 2) pairs (start, end) in
        s, or for several windows each (n, W, 2), or a list of such lists; horizon: T in s; fleet: the other arguments
        of Instance. InputError: arrays that do not fit together, or what Target and Instance refuse.

        >>> from mamttsp import Instance
        >>> p, v, windows = [[30, 0], [-20, 10]], [[0, 0.5], [0.2, 0]], [(10, 30), (40, 60)]
        >>> instance = Instance.from_arrays(p, v, windows, horizon=100, n_agents=1, depot=(0, 0), max_speed=4)
        >>> instance.targets[0].position(20).tolist()
        [30.0, 10.0]
        """
        targets = [_target_from(entry, name) for name, entry in linear_paths(p, v, windows, horizon)]
        return cls(targets, horizon=horizon, **fleet)

    @classmethod
    def from_frames(
        cls, breakpoints: "pandas.DataFrame", windows: "pandas.DataFrame", horizon: float, **fleet: Any
    ) -> Self:
        """Build an instance from two pandas DataFrames.

        breakpoints: columns target, time (s), x, y (units), a row for each bend of a path, its ends included; a target
        with one row is parked there. windows: columns target, start, end (s), a row each. Rows may be in any order.
        Targets may have any names; they are numbered from 0 in the order in which breakpoints first names them.
        horizon: T in s; fleet: the other arguments of Instance. InputError: a missing column, a target in one frame
        only, or what Target and Instance refuse.

        >>> import pandas
        >>> from mamttsp import Instance
        >>> bends = [["tanker", 0, 30, 0], ["tanker", 60, 30, 30], ["buoy", 0, -20, 10]]
        >>> breakpoints = pandas.DataFrame(bends, columns=["target", "time", "x", "y"])
        >>> windows = pandas.DataFrame([["tanker", 10, 30], ["buoy", 40, 60]], columns=["target", "start", "end"])
        >>> instance = Instance.from_frames(breakpoints, windows, horizon=100, n_agents=1, depot=(0, 0), max_speed=4)
        >>> instance.targets[0].position(20).tolist(), instance.targets[1].position(50).tolist()
        ([30.0, 10.0], [-20.0, 10.0])
        """
        targets = [_target_from(entry, name) for name, entry in frame_paths(breakpoints, windows)]
        return cls(targets, horizon=horizon, **fleet)

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Build an instance from the JSON object; InputError names the field that is wrong."""
        check_header(data, FORMAT, VERSIONS)
        own, foreign = (_PAPERS_FIELDS, ("agents",)) if data["version"] == 1 else (("agents",), _PAPERS_FIELDS)
        require(data, "", *own, "horizon", "targets")
        for field in foreign:
            if field in data:
                raise InputError(f"{field}: not a field of version {data['version']}, which has {', '.join(own)}")
        if not isinstance(data["targets"], list):
            raise InputError("targets: expected a list of targets")
        targets = [_target_from(entry, f"targets[{u}]", data["version"]) for u, entry in enumerate(data["targets"])]
        common = {"horizon": data["horizon"], "R": data.get("R")}
        if data["version"] == 1:
            return cls(targets, data["n_agents"], data["depot"], data["max_speed"], **common)
        if not isinstance(data["agents"], list):
            raise InputError("agents: expected a list of entries, one for each type of agents")
        agents = [Agents.from_dict(entry, f"agents[{k}]") for k, entry in enumerate(data["agents"])]
        return cls(targets, agents=agents, **common)

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the instance as JSON."""
        write_json(self.to_dict(), path)

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> Self:
        """Read an instance file; InputError starts with the file's name."""
        return read_json(path, cls.from_dict)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Instance) and self.to_dict() == other.to_dict()

    def __hash__(self) -> int:
        return hash(json.dumps(self.to_dict(), sort_keys=True))


def _agents(agents, n_agents, depot, max_speed):
    """Return the entries (a tuple), from a list of them or from the paper's three numbers."""
    papers = {"n_agents": n_agents, "depot": depot, "max_speed": max_speed}
    if agents is None:
        if missing := [name for name, value in papers.items() if value is None]:
            raise InputError(f"{missing[0]}: missing; give n_agents, depot and max_speed, or agents")
        return (Agents(whole("n_agents", n_agents, 1), depot, max_speed),)
    if given := [name for name, value in papers.items() if value is not None]:
        raise InputError(f"{given[0]}: given as well as agents, which say it all")
    agents = listed("agents", agents, Agents)
    if not agents:
        raise InputError("agents: expected at least one entry")
    return agents


def _target_from(entry, where, version=2):
    if not isinstance(entry, dict):
        raise InputError(f"{where}: expected an object with times, points and windows")
    require(entry, f"{where}.", "times", "points", "windows")
    if version == 1 and "demand" in entry:
        raise InputError(f"{where}.demand: not a field of version 1; version 2 has demands")
    try:
        return Target(entry["times"], entry["points"], entry["windows"], entry.get("demand", 0.0))
    except InputError as error:
        raise InputError(f"{where}.{error}") from error


def _check_path(times, points):
    if len(times) < 2:
        raise InputError(f"times: expected at least 2 breakpoints, found {len(times)}")
    if len(points) != len(times):
        raise InputError(f"points: expected one for each of the {len(times)} times, found {len(points)}")
    late = np.flatnonzero(np.diff(times) <= 0)
    if len(late):
        k = late[0]
        raise InputError(f"times[{k + 1}]: {times[k + 1]:g} does not come after {times[k]:g}; times must increase")


def _check_windows(times, windows):
    if not len(windows):
        raise InputError("windows: expected at least one (start, end) pair")
    for w, (start, end) in enumerate(windows):
        if end < start:
            raise InputError(f"windows[{w}]: ends at {end:g} before it starts at {start:g}; give (start, end)")
        if w and start < windows[w - 1, 1]:
            before = windows[w - 1, 1]
            raise InputError(f"windows[{w}]: starts at {start:g} before the one before it ends at {before:g}")
        if start < times[0] or end > times[-1]:
            raise InputError(
                f"windows[{w}]: ({start:g}, {end:g}) is not covered by the path, "
                f"known from {times[0]:g} to {times[-1]:g}"
            )


def _check_targets(instance):
    if not instance.targets:
        raise InputError("targets: expected at least one target")
    slowest = min(range(len(instance.agents)), key=lambda k: instance.agents[k].max_speed)
    max_speed = instance.agents[slowest].max_speed
    for u, target in enumerate(instance.targets):
        if target.windows[0, 0] < 0 or target.windows[-1, 1] > instance.horizon:
            raise InputError(f"targets[{u}].windows: expected times from 0 to the horizon {instance.horizon:g}")
        if (fastest := target.speeds.max()) >= max_speed:
            where = "max_speed" if len(instance.agents) == 1 else f"agents[{slowest}].max_speed"
            raise InputError(
                f"targets[{u}].points: speed {fastest:g} is not below {where} {max_speed:g}; agents must be faster"
            )


def _check_big_m(instance):
    """Reject a big-M that would forbid flights: it must be at least the distance between any two points."""
    corners = instance._corners()
    farthest = np.linalg.norm(corners[:, None] - corners, axis=-1).max()
    if farthest > instance.R:
        raise InputError(
            f"R: {instance.R:g} is less than {farthest:g}, the distance between two points of depot and paths; "
            "leave it out, or give the diagonal of the area"
        )
