"""Targets as people have them, in arrays, in data frames or parked, said as the file format says them.

Each function returns dicts with times, points and windows, which `Target` checks; what it could not say better itself
is checked here.
"""

from numbers import Real

import numpy as np

from .validation import InputError, array, brief, positive


def linear_paths(p, v, windows, horizon):
    """Return (name, dict) of targets that move straight from time 0 to the horizon; see `Instance.from_arrays`."""
    p, horizon = array("p", p, (-1, 2)), positive("horizon", horizon)
    v = array("v", v, (-1, 2))
    for name, value in (("v", v), ("windows", windows)):
        if not hasattr(value, "__len__") or len(value) != len(p):
            found = len(value) if hasattr(value, "__len__") else brief(value)
            raise InputError(f"{name}: expected one for each of the {len(p)} rows of p, found {found}")
    return [
        (
            f"targets[{u}]",
            {"times": [0.0, horizon], "points": [start, start + horizon * velocity], "windows": pairs(own)},
        )
        for u, (start, velocity, own) in enumerate(zip(p, v, windows))
    ]


def frame_paths(breakpoints, windows):
    """Return (name, dict) of the targets in two data frames; see `Instance.from_frames`."""
    paths = _groups("breakpoints", breakpoints, ("time", "x", "y"))
    opened = _groups("windows", windows, ("start", "end"))
    for name in opened:
        if name not in paths:
            raise InputError(f"windows: target {brief(name)} has no breakpoints")
    found = []
    for name, rows in paths.items():
        if name not in opened:
            raise InputError(f"windows: target {brief(name)} has none")
        times, *xy = zip(*rows)
        path = {"times": times, "points": list(zip(*xy)), "windows": opened[name]}
        found.append(
            (f"target {brief(name)}", path if len(times) > 1 else parked_path(path["points"][0], opened[name]))
        )
    return found


def parked_path(point, windows):
    """Return the dict of a target that stays at a point (2,), from time 0 until its last window closes."""
    point, windows = array("point", point, (2,)), array("windows", pairs(windows), (-1, 2))
    last = max(windows.max(initial=0.0), 0.0) or 1.0  # a path takes time, even where its window does not
    return {"times": [0.0, last], "points": [point, point], "windows": windows}


def pairs(windows):
    """Return windows as a list of pairs: a single (start, end) is one."""
    filled = isinstance(windows, (tuple, list, np.ndarray)) and len(windows) > 0
    return [windows] if filled and isinstance(windows[0], Real) else windows


def _groups(what, frame, columns):
    """Return {target: its rows, in order of the first column}, targets in the order of their first rows."""
    missing = [name for name in ("target", *columns) if name not in getattr(frame, "columns", ())]
    if missing:
        raise InputError(
            f"{what}: expected a DataFrame with the columns target, {', '.join(columns)}; missing: {', '.join(missing)}"
        )
    groups = {}
    for name, *row in zip(*(frame[column].tolist() for column in ("target", *columns))):
        groups.setdefault(name, []).append(tuple(row))
    try:
        return {name: sorted(rows) for name, rows in groups.items()}
    except TypeError:
        raise InputError(f"{what}: expected numbers in the columns {', '.join(columns)}") from None
