"""Where agents start and end: a marker for each place, with the types of agents in the legend where they differ."""

from .style import DEPOT

_END = DEPOT | {"marker": "X", "markersize": 11}


def depots(instance):
    """Yield (place, style, label) for each place at which agents start, then for the others at which they end."""
    starts = _by_place((entry.depot, k) for k, entry in enumerate(instance.agents))
    ends = _by_place((entry.end, k) for k, entry in enumerate(instance.agents) if not entry.returns)
    several = len(instance.agents) > 1
    for what, places, style in (("depot", starts, DEPOT), ("end", ends, _END)):
        for place, types in places.items():
            numbers = ", ".join(map(str, types))
            yield place, style, f"{what} of type {numbers}" if several else what


def _by_place(pairs):
    """Return {place: the types there}."""
    found = {}
    for place, k in pairs:
        found.setdefault(tuple(place.tolist()), []).append(k)
    return found
