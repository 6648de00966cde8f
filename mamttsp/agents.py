"""Agents: one type of agents, all alike, as an entry of an instance."""

import dataclasses
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike

from .jsonfile import require
from .validation import InputError, array, at_least_0, positive, whole

_FIELDS = ("count", "depot", "max_speed", "end", "capacity")


@dataclasses.dataclass(frozen=True, eq=False)
class Agents:
    """`count` agents that are alike.

    Each starts at time 0 at `depot`, (2,) in units, flies at most at `max_speed` in units/s, ends at `end`, (2,) in
    units (None: the depot), by the horizon, and serves targets of at most `capacity` demand in all (None: of any
    demand). An agent that serves no target stays where it is and flies nothing.

    >>> from mamttsp import Agents, Instance, Target
    >>> drones = Agents(count=2, depot=(0, 0), max_speed=4)
    >>> van = Agents(count=1, depot=(40, 0), max_speed=6, end=(0, 0), capacity=5)
    >>> Instance([Target.parked((3, 4), (2, 8))], agents=[drones, van], horizon=20).counts
    (2, 1)
    """

    count: int
    depot: np.ndarray
    max_speed: float
    end: np.ndarray = None  # type: ignore[assignment]  # the depot
    capacity: float | None = None

    if TYPE_CHECKING:  # what may be given, beside what is kept

        def __init__(
            self,
            count: int,
            depot: ArrayLike,
            max_speed: float,
            end: ArrayLike | None = None,
            capacity: float | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        object.__setattr__(self, "count", whole("count", self.count, 1))
        object.__setattr__(self, "depot", array("depot", self.depot, (2,)))
        object.__setattr__(self, "max_speed", positive("max_speed", self.max_speed))
        object.__setattr__(self, "end", self.depot if self.end is None else array("end", self.end, (2,)))
        if self.capacity is not None:
            object.__setattr__(self, "capacity", at_least_0("capacity", self.capacity))

    @property
    def returns(self) -> bool:
        """Whether the end is the depot."""
        return bool((self.end == self.depot).all())

    def to_dict(self) -> dict[str, Any]:
        """Return the JSON object of an entry of `agents` in an instance file."""
        fields = {"count": self.count, "depot": self.depot.tolist(), "max_speed": self.max_speed}
        if not self.returns:
            fields["end"] = self.end.tolist()
        return fields if self.capacity is None else fields | {"capacity": self.capacity}

    @classmethod
    def from_dict(cls, data: Any, where: str) -> Self:
        """Build an entry from its JSON object; InputError names the field, below `where`, that is wrong."""
        if not isinstance(data, dict):
            raise InputError(f"{where}: expected an object with count, depot and max_speed")
        require(data, f"{where}.", *_FIELDS[:3])
        if unknown := sorted(set(data) - set(_FIELDS)):
            raise InputError(f"{where}.{unknown[0]}: unknown; an entry has {', '.join(_FIELDS)}")
        try:
            return cls(**data)
        except InputError as error:
            raise InputError(f"{where}.{error}") from error

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Agents) and self.to_dict() == other.to_dict()

    def __hash__(self) -> int:
        return hash((self.count, *self.depot, self.max_speed, *self.end, self.capacity))
