"""Targets from tracks: timed positions, as ships and planes report them, made straight pieces with windows.

A track is thinned to few pieces that are nowhere farther from it than a tolerance, at the same time; its windows are
when it is inside an area.
"""

import numpy as np

from .instance import Target
from .validation import InputError, array, brief, floats, positive

#: km, mean radius of the earth
_EARTH = 6371.0088


def tracks_to_targets(frame, area, tolerance):
    """Return {track: Target} of the tracks that are inside an area for a while, in the order in which they first come.

    frame: a pandas DataFrame, a row for each position in any order, with the columns track, time and either x, y
    (units) or lon, lat (degrees). time is in s, or in date and time: then s since the first one. area: (K, 2), the
    corners of a polygon in x, y or in lon, lat. tolerance: units, or km: how far a thinned track may be from the
    positions reported, at the same time; between two reports a track is taken to be straight.

    Lon and lat become x to the east and y to the north of the area's middle, in km, by a projection that is true to
    1 part in 1000 within about 300 km; keep away from the poles and the antimeridian. InputError: columns that are
    missing, a track with fewer than two positions or two at a time, no track inside the area.

    >>> import pandas
    >>> from mamttsp.tracks import tracks_to_targets
    >>> frame = pandas.DataFrame({"track": "tug", "time": [0, 50, 100], "x": [0, 5, 10], "y": 0.0})
    >>> targets = tracks_to_targets(frame, area=[(2, -1), (6, -1), (6, 1), (2, 1)], tolerance=0.1)
    >>> targets["tug"].times.tolist(), targets["tug"].windows.tolist()
    ([0.0, 100.0], [[20.0, 60.0]])
    """
    tolerance, area = positive("tolerance", tolerance), array("area", area, (-1, 2))
    if len(area) < 3:
        raise InputError(f"area: expected at least 3 corners, found {len(area)}")
    columns = getattr(frame, "columns", ())
    pair = next((pair for pair in (("x", "y"), ("lon", "lat")) if set(pair) <= set(columns)), None)
    if pair is None or not {"track", "time"} <= set(columns):
        raise InputError("frame: expected a DataFrame with the columns track, time and x, y or lon, lat")
    places = floats(f"frame: {', '.join(pair)}", frame[list(pair)].to_numpy(), "numbers")
    if pair == ("lon", "lat"):
        middle = (area.min(axis=0) + area.max(axis=0)) / 2
        places, area = project(places, middle), project(area, middle)
    targets = {}
    for name, rows in frame.reset_index(drop=True).groupby("track", sort=False):
        times, points = _track(name, _seconds(frame)[rows.index], places[rows.index])
        kept = thin(times, points, tolerance)
        if windows := windows_inside(times[kept], points[kept], area):
            targets[name] = Target(times[kept], points[kept], windows)
    if not targets:
        raise InputError("area: no track is ever inside it")
    return targets


def project(places, middle):
    """Return (K, 2) x and y in km of lon and lat (K, 2) in degrees, east and north of the middle (lon, lat)."""
    offset = np.radians(np.asarray(places, dtype=float) - middle)
    return _EARTH * offset * (np.cos(np.radians(middle[1])), 1.0)


def thin(times, points, tolerance):
    """Return the indices of the few positions such that straight motion between them, in time, passes each of the
    others within the tolerance; times: (K,), points: (K, 2). The first and the last one are kept."""
    kept, todo = {0, len(times) - 1}, [(0, len(times) - 1)]
    while todo:
        first, last = todo.pop()
        share = (times[first + 1 : last] - times[first]) / (times[last] - times[first])
        straight = points[first] + share[:, None] * (points[last] - points[first])
        off = np.hypot(*(points[first + 1 : last] - straight).T)
        if off.max(initial=0.0) > tolerance:
            worst = first + 1 + int(off.argmax())
            kept.add(worst)
            todo += [(first, worst), (worst, last)]
    return sorted(kept)


def windows_inside(times, points, area):
    """Return the windows [(start, end), ...] in which straight motion through the points is inside the polygon."""
    found = []
    for t, dt, p, d in zip(times[:-1], np.diff(times), points[:-1], np.diff(points, axis=0)):
        cuts = np.unique(np.r_[0.0, _crossings(p, d, area), 1.0])
        for a, b in zip(cuts[:-1], cuts[1:]):
            if not _inside(p + (a + b) / 2 * d, area):
                continue
            start, end = float(t + a * dt), float(t + b * dt) if b < 1.0 else float(t + dt)
            if found and start - found[-1][1] <= 1e-9 * (1.0 + abs(start)):
                start = found.pop()[0]
            found.append((start, end))
    return [(start, end) for start, end in found if end > start]


def _crossings(p, d, area):
    """Return the shares in [0, 1] of the way p to p + d at which it meets an edge of the polygon."""
    corner, edge = area, np.roll(area, -1, axis=0) - area
    across = d[0] * edge[:, 1] - d[1] * edge[:, 0]
    to = corner - p
    with np.errstate(divide="ignore", invalid="ignore"):
        on_way = (to[:, 0] * edge[:, 1] - to[:, 1] * edge[:, 0]) / across
        on_edge = (to[:, 0] * d[1] - to[:, 1] * d[0]) / across
    return on_way[(across != 0) & (on_way >= 0) & (on_way <= 1) & (on_edge >= 0) & (on_edge <= 1)]


def _inside(point, area):
    """Tell whether a point is inside the polygon: a ray to the right meets its edges an odd number of times."""
    (x, y), following = point, np.roll(area, -1, axis=0)
    between = (area[:, 1] > y) != (following[:, 1] > y)
    rise = np.where(between, following[:, 1] - area[:, 1], 1.0)
    at = area[:, 0] + (y - area[:, 1]) / rise * (following[:, 0] - area[:, 0])
    return bool(np.count_nonzero(between & (at > x)) % 2)


def _seconds(frame):
    """Return (rows,) times in s, since the first one where they are dates."""
    times = frame["time"]
    if times.dtype.kind == "M" or str(times.dtype).startswith("datetime64"):
        return (times - times.min()).dt.total_seconds().to_numpy()
    return array("time", times.to_numpy(), (-1,))


def _track(name, times, points):
    """Return a track in order of time, or say in a line what is wrong with it."""
    order = np.argsort(times, kind="stable")
    times, points = times[order], points[order]
    if len(times) < 2:
        raise InputError(f"track {brief(name)}: expected at least 2 positions, found {len(times)}")
    if not np.isfinite(points).all():
        raise InputError(f"track {brief(name)}: every position must be finite")
    if (np.diff(times) <= 0).any():
        twice = times[1:][np.diff(times) <= 0][0]
        raise InputError(f"track {brief(name)}: two positions at the time {twice:g}")
    return times, points
