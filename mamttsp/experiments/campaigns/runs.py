"""What a campaign runs: one of our instances by one method within one limit; and the profiles, named lists of runs."""

import dataclasses
from typing import ClassVar

from ...backends import choose
from ...generate import PAPER_INDICES, PAPER_SIZES, paper_instance
from ...library import load_for
from ...validation import InputError, positive

#: the settings of the paper's Figures 2 and 3: (total window in s, agents)
SETTINGS = ((20, 1), (40, 1), (60, 1), (40, 2), (40, 3), (40, 4), (40, 5))
PROFILES = ("smoke", "reduced", "claims", "full", "exact")


@dataclasses.dataclass(frozen=True)
class Run:
    """One solve of `paper_instance(n, index, total_window, agents)`; its fields are the key of its row.

    method, modeler, solver: as given to `solve`, modeler and solver None for "exact"; time_limit: s.
    """

    n: int
    index: int
    total_window: float
    agents: int
    method: str
    modeler: str | None
    solver: str | None
    time_limit: float

    def __post_init__(self):
        positive("time_limit", self.time_limit)

    def instance(self):
        """Return what is solved."""
        return paper_instance(self.n, self.index, self.total_window, self.agents)


@dataclasses.dataclass(frozen=True)
class LibraryRun:
    """One solve of an instance of the library for so many agents, by our exact method; time_limit: s."""

    name: str
    agents: int
    time_limit: float
    method: ClassVar = "exact"
    modeler: ClassVar = None
    solver: ClassVar = None

    def __post_init__(self):
        positive("time_limit", self.time_limit)

    def instance(self):
        """Return what is solved."""
        return load_for(self.name, self.agents)


def run_of(fields):
    """Return the Run or the LibraryRun that has these fields."""
    return (LibraryRun if "name" in fields else Run)(**fields)


def profile(name, solver=None):
    """Return the list of runs of a profile, small instances first.

    "smoke": every method on n = 5 within 5 s, under two minutes in all. "reduced": MICP and baseline on SCIP, and
    the MICP on our branch and bound over Clarabel, instances 0 to 4 of each n within 60 s. "claims": the baseline on
    SCIP, the MICP on our branch and bound, and on SCIP for instance 0, within 600 s; n = 15, instances 0 to 4, and
    n = 20, instances 0 to 2. "full": 1120 runs as in the paper, MICP and baseline within 1800 s on `solver` (default:
    scip). "exact": our own solver on all 560 problems within 300 s.

    >>> from mamttsp.experiments import profile
    >>> len(profile("exact")), profile("exact")[0].method
    (560, 'exact')
    """
    if name not in PROFILES:
        raise InputError(f"profile: expected one of {', '.join(PROFILES)}, found {name!r}")
    if solver is not None and name != "full":
        raise InputError(f'solver: only the profile "full" takes one, found {solver!r} for "{name}"')
    if name == "smoke":
        return _runs((5,), range(1), ((20, 1), (20, 2)), _SMOKE, 5)
    if name == "reduced":
        return _runs(PAPER_SIZES, range(5), SETTINGS, _REDUCED, 60)
    if name == "claims":
        return [run for n, indices in _CLAIMS for index in indices for run in _of_claims(n, index)]
    if name == "full":
        both = [(method, solver or "scip") for method in ("micp", "baseline")]
        return _runs(PAPER_SIZES, PAPER_INDICES, SETTINGS, both, 1800)
    return _runs(PAPER_SIZES, PAPER_INDICES, SETTINGS, (("exact", None),), 300)


_REDUCED = (("micp", "scip"), ("baseline", "scip"), ("micp", "clarabel"))
#: of the profile "claims": sizes, and the instances of each
_CLAIMS = ((15, range(5)), (20, range(3)))
_SMOKE = (("exact", None), *_REDUCED, ("nonconvex", "scip"))


def _runs(sizes, indices, settings, methods, time_limit):
    routes = [(method, *_route(method, solver)) for method, solver in methods]
    return [
        Run(n, index, window, agents, *route, time_limit)
        for n in sizes
        for index in indices
        for window, agents in settings
        for route in routes
    ]


def _of_claims(n, index):
    """Return the runs of one instance; the MICP on SCIP, slower than our branch and bound, is looked at once a size."""
    methods = _REDUCED if index == 0 else [route for route in _REDUCED if route != ("micp", "scip")]
    return _runs((n,), (index,), SETTINGS, methods, 600)


def _route(method, solver):
    return (None, None) if method == "exact" else choose(method, None, solver)
