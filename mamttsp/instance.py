"""Target and Instance: the data of an MA-MT-TSP (Section II), its validation and its JSON file."""

import dataclasses
import json
import math
import os
from pathlib import Path

import numpy as np

FORMAT = "mamttsp-instance"
VERSION = 1


class InputError(ValueError):
    """Bad input from a person: one line that names the field, what is wrong and what would be right."""


@dataclasses.dataclass(frozen=True, eq=False)
class Target:
    """A target on a piecewise-linear path.

    times: (K,) strictly increasing breakpoint times in s, K >= 2.
    points: (K, 2) positions at those times, in units.
    windows: (W, 2) pairs (start, end) in s, in order, not overlapping (they may touch), inside [times[0], times[-1]].
    """

    times: np.ndarray
    points: np.ndarray
    windows: np.ndarray

    def __post_init__(self):
        for name, shape in (("times", (-1,)), ("points", (-1, 2)), ("windows", (-1, 2))):
            object.__setattr__(self, name, _array(name, getattr(self, name), shape))
        _check_path(self.times, self.points)
        _check_windows(self.times, self.windows)

    def position(self, t):
        """Return the position (2,) at time t, or (len(t), 2) for an array of times."""
        return np.stack([np.interp(t, self.times, self.points[:, axis]) for axis in (0, 1)], axis=-1)

    @property
    def speeds(self):
        """The speed on each of the K - 1 pieces, in units/s."""
        return np.linalg.norm(np.diff(self.points, axis=0), axis=1) / np.diff(self.times)

    def to_dict(self):
        return {name: getattr(self, name).tolist() for name in ("times", "points", "windows")}


@dataclasses.dataclass(frozen=True, eq=False)
class Instance:
    """An MA-MT-TSP: targets, a fleet of `n_agents` equal agents at one depot, their speed, and the horizon T.

    targets: sequence of Target; depot: (2,) in units; max_speed: v_max in units/s; horizon: T in s.
    """

    targets: tuple
    n_agents: int
    depot: np.ndarray
    max_speed: float
    horizon: float

    def __post_init__(self):
        object.__setattr__(self, "targets", tuple(self.targets))
        object.__setattr__(self, "depot", _array("depot", self.depot, (2,)))
        for name in ("max_speed", "horizon"):
            object.__setattr__(self, name, _positive(name, getattr(self, name)))
        object.__setattr__(self, "n_agents", _count("n_agents", self.n_agents))
        _check_targets(self)

    @property
    def n_targets(self):
        return len(self.targets)

    @property
    def size(self):
        """R of the paper: the diagonal of the smallest upright rectangle that holds the depot and all paths."""
        points = np.vstack([self.depot[None]] + [target.points for target in self.targets])
        return float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))

    def with_agents(self, n_agents):
        """Return the same instance with another number of agents."""
        return dataclasses.replace(self, n_agents=n_agents)

    def to_dict(self):
        """Return the JSON object of the file format (times in s, lengths in units)."""
        return {
            "format": FORMAT,
            "version": VERSION,
            "depot": self.depot.tolist(),
            "max_speed": self.max_speed,
            "horizon": self.horizon,
            "n_agents": self.n_agents,
            "targets": [target.to_dict() for target in self.targets],
        }

    @classmethod
    def from_dict(cls, data):
        """Build an instance from the JSON object; InputError names the field that is wrong."""
        check_header(data, FORMAT, VERSION)
        require(data, "", "depot", "max_speed", "horizon", "n_agents", "targets")
        if not isinstance(data["targets"], list):
            raise InputError("targets: expected a list of targets")
        targets = [_target_from(entry, f"targets[{u}]") for u, entry in enumerate(data["targets"])]
        return cls(targets, data["n_agents"], data["depot"], data["max_speed"], data["horizon"])

    def write(self, path):
        """Write the instance as JSON."""
        write_json(self.to_dict(), path)

    @classmethod
    def read(cls, path):
        """Read an instance file; InputError starts with the file's name."""
        return read_json(path, cls.from_dict)

    def __eq__(self, other):
        return isinstance(other, Instance) and self.to_dict() == other.to_dict()

    def __hash__(self):
        return hash(json.dumps(self.to_dict(), sort_keys=True))


# --- JSON, shared with the solution file ---------------------------------------------------------------------------


def read_json(path, build):
    """Read the JSON file at `path` and return build(object); every InputError is prefixed with the path."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from error
    try:
        return build(json.loads(text, parse_constant=_no_constant))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}: not JSON: {error.msg} at line {error.lineno}, column {error.colno}") from error
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def write_json(data, path):
    """Write `data` as JSON to `path` through a temporary file, so that a failure leaves the old file as it was."""
    path = Path(path)
    temporary = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        temporary.write_text(json.dumps(data, allow_nan=False) + "\n", encoding="utf-8")
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise InputError(f"{path}: cannot be written: {error.strerror}") from error


def check_header(data, expected_format, expected_version):
    """Reject anything but an object of the expected format and version."""
    if not isinstance(data, dict):
        raise InputError(f'expected a JSON object with "format": "{expected_format}"')
    if data.get("format") != expected_format:
        raise InputError(f'format: expected "{expected_format}", found {json.dumps(data.get("format"))}')
    if data.get("version") != expected_version:
        raise InputError(f"version: expected {expected_version}, found {json.dumps(data.get('version'))}")


def require(data, where, *fields):
    """Reject an object that lacks a field."""
    for field in fields:
        if field not in data:
            raise InputError(f"{where}{field}: missing")


def _no_constant(name):
    raise InputError(f"{name} is not a number that JSON allows; every value must be finite")


def _target_from(entry, where):
    if not isinstance(entry, dict):
        raise InputError(f"{where}: expected an object with times, points and windows")
    require(entry, f"{where}.", "times", "points", "windows")
    try:
        return Target(entry["times"], entry["points"], entry["windows"])
    except InputError as error:
        raise InputError(f"{where}.{error}") from error


# --- Validation ----------------------------------------------------------------------------------------------------


def _array(name, value, shape):
    """Return `value` as a read-only float array of the shape (-1: any length), or raise InputError."""
    wanted = "x".join("K" if size < 0 else str(size) for size in shape)
    try:
        if any(isinstance(item, (str, bool)) for item in np.asarray(value, dtype=object).ravel()):
            raise ValueError
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"{name}: expected numbers in the shape {wanted}") from None
    if array.ndim != len(shape) or any(0 <= want != have for want, have in zip(shape, array.shape)):
        raise InputError(f"{name}: expected the shape {wanted}, found {'x'.join(map(str, array.shape)) or 'a number'}")
    if not np.isfinite(array).all():
        raise InputError(f"{name}: every value must be finite")
    array.flags.writeable = False
    return array


def _positive(name, value):
    if isinstance(value, bool) or not isinstance(value, (int, float, np.number)) or not math.isfinite(value) or value <= 0:
        raise InputError(f"{name}: expected a finite number above 0, found {value!r}")
    return float(value)


def _count(name, value):
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
        raise InputError(f"{name}: expected a whole number of at least 1, found {value!r}")
    return int(value)


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
            raise InputError(f"windows[{w}]: starts at {start:g} before the one before it ends at {windows[w - 1, 1]:g}")
        if start < times[0] or end > times[-1]:
            raise InputError(
                f"windows[{w}]: ({start:g}, {end:g}) is not covered by the path, known from {times[0]:g} to {times[-1]:g}"
            )


def _check_targets(instance):
    if not instance.targets:
        raise InputError("targets: expected at least one target")
    for u, target in enumerate(instance.targets):
        if not isinstance(target, Target):
            raise InputError(f"targets[{u}]: expected a Target, found {type(target).__name__}")
        if target.windows[0, 0] < 0 or target.windows[-1, 1] > instance.horizon:
            raise InputError(f"targets[{u}].windows: expected times from 0 to the horizon {instance.horizon:g}")
        if (fastest := target.speeds.max()) >= instance.max_speed:
            raise InputError(
                f"targets[{u}].points: speed {fastest:g} is not below max_speed {instance.max_speed:g}; agents must be faster"
            )
