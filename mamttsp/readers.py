"""Other people's instances: linear motions from JSON and TOML, vehicle routing with time windows from Solomon's text.

Nothing of theirs is in this package: give paths to files that you have.
"""

import tomllib
from pathlib import Path

import numpy as np

from .agents import Agents
from .instance import Instance, Target
from .jsonfile import read_json, require
from .validation import InputError, counted, file_path, whole


def read_linear_motions(targets: str | Path, agent: str | Path, n_agents: int = 1) -> Instance:
    """Return the Instance in a pair of files as the public repository MICP_for_MT-TSP has them.

    targets: path of a JSON object, for each target its name with px, py (units, at time 0), vx, vy (units/s) and the
    window tmin, tmax (s). agent: path of a TOML file with [depot] px, py and [param] T (s), vmax (units/s) and perhaps
    R (units), which becomes the baseline's big-M. n_agents: m, which the files do not say.

    A `radius` of a target is left out: there an agent that comes so near has met it, here it has to be at the target,
    so that optima here are longer. InputError: a file that cannot be read, a field that is missing or wrong.

    >>> import pathlib, tempfile
    >>> from mamttsp.readers import read_linear_motions
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     targets, agent = pathlib.Path(folder, "targets.json"), pathlib.Path(folder, "agent.toml")
    ...     _ = targets.write_text('{"a": {"px": 30, "py": 0, "vx": 0, "vy": 0.5, "tmin": 10, "tmax": 30}}')
    ...     _ = agent.write_text("depot = {px = 0, py = 0}\\nparam = {T = 100, vmax = 4}")
    ...     read_linear_motions(targets, agent).targets[0].position(20).tolist()
    [30.0, 10.0]
    """
    fleet = _read_toml(file_path("agent", agent))
    for section, *fields in (("depot", "px", "py"), ("param", "T", "vmax")):
        if not isinstance(fleet.get(section), dict):
            raise InputError(f"{agent}: {section}: expected a table with {', '.join(fields)}")
        _require(fleet[section], agent, f"{section}.", *fields)
    depot, param = fleet["depot"], fleet["param"]
    paths = read_json(file_path("targets", targets), _motions)
    named = {"n_agents": n_agents, "depot": (depot["px"], depot["py"]), "max_speed": param["vmax"]}
    try:
        p, v, windows = (list(column) for column in zip(*paths))
        return Instance.from_arrays(p, v, windows, param["T"], R=param.get("R"), **named)
    except InputError as error:
        raise InputError(f"{targets}, {agent}: {error}") from error


def read_solomon(path: str | Path, ignore_service: bool = False, n_agents: int | None = None) -> Instance:
    """Return the Instance in a text file as Solomon's of vehicle routing with time windows, by the package vrplib.

    The customers are targets that stay where they are, with one window each and their demands; vehicles are agents of
    speed 1, so that distances are times, with the file's capacity; T is when the depot closes. A travelling salesman
    with time windows is the file of one vehicle. n_agents: another number of vehicles.

    Compare lengths with care: published optima are of distances cut to one decimal, cut to whole numbers or in doubles,
    and often of the fewest vehicles first. Here distances are exact, and only the total length counts: a tour that
    keeps a window by a rounded distance may miss it here, and the other way round. Service takes no time here: with
    service times a file is refused, or with `ignore_service` read without them, which is another problem.
    InputError: a file that cannot be read, service times, or vrplib is not installed.

    >>> from mamttsp.readers import read_solomon
    >>> read_solomon("nowhere.txt")
    Traceback (most recent call last):
        ...
    mamttsp.validation.InputError: nowhere.txt: cannot be read: No such file or directory
    """
    data = _read_vrplib(path)
    if np.any(data["service_time"]) and not ignore_service:
        raise InputError(
            f"{path}: customers take time to serve, which targets do not; ignore_service=True leaves it out"
        )
    horizon = float(data["time_window"][0, 1])
    agents = whole("n_agents", int(data["vehicles"]) if n_agents is None else n_agents, 1)
    customers = zip(data["node_coord"][1:], data["time_window"][1:], data["demand"][1:])
    try:
        targets = [_parked(place, opens, closes, demand, horizon) for place, (opens, closes), demand in customers]
        fleet = Agents(agents, data["node_coord"][0], 1.0, capacity=int(data["capacity"]))
        return Instance(targets, agents=[fleet], horizon=horizon)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _parked(place, opens, closes, demand, horizon):
    """Return the target of a customer; a window that outlasts the horizon ends there."""
    return Target((0.0, horizon), (place, place), [(opens, min(float(closes), horizon))], int(demand))


def _motions(data):
    if not isinstance(data, dict) or not data:
        raise InputError("expected an object with a target's px, py, vx, vy, tmin, tmax under its name")
    found = []
    for name, entry in data.items():
        if not isinstance(entry, dict):
            raise InputError(f"{name}: expected an object with px, py, vx, vy, tmin, tmax")
        require(entry, f"{name}.", "px", "py", "vx", "vy", "tmin", "tmax")
        found.append(((entry["px"], entry["py"]), (entry["vx"], entry["vy"]), (entry["tmin"], entry["tmax"])))
    return found


def _read_toml(path):
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from error
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path}: not TOML: {error}") from error


def _require(data, path, where, *fields):
    try:
        require(data, where, *fields)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _read_vrplib(path):
    try:
        import vrplib  # here: only this reader needs it
    except ImportError as error:
        raise InputError("vrplib is not installed; pip install vrplib") from error
    try:
        data = vrplib.read_instance(file_path("path", path), instance_format="solomon", compute_edge_weights=False)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    except (ValueError, RuntimeError, IndexError, TypeError) as error:
        raise InputError(f"{path}: not in Solomon's format: {' '.join(str(error).split())}") from error
    if np.ndim(data["node_coord"]) != 2 or len(data["node_coord"]) < 2:
        raise InputError(
            f"{path}: expected a depot and at least one customer, found {counted(len(data['node_coord']), 'row')}"
        )
    return data
