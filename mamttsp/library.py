"""The library of instances: short names, the files behind them, and how the generator makes each."""

import hashlib
import json
import os
import re
from pathlib import Path

import numpy as np

from .agents import Agents
from .generate import GENERATOR_VERSION, PAPER_INDICES, PAPER_SIZES, generate
from .instance import Instance
from .jsonfile import write_json
from .validation import InputError, brief, file_path, of_type

#: where the files are in the repository
FOLDER = Path(__file__).parents[1] / "paper_results" / "instances"
MANIFEST = "manifest.json"
_NAME = re.compile(r"(?:(crowded|loose|scale|types|loads)-)?n(\d+)-i(\d+)-w(\d+)(?:-m(\d+))?")
#: by number of targets, where 150 s are too short for one agent: horizon in s, and straight pieces of a path
_LONGER = {25: (200.0, 6), 30: (250.0, 7), 40: (400.0, 11), 50: (500.0, 14), 64: (640.0, 18), 100: (1000.0, 28)}
#: of the series "types": two depots, and an agent that is faster than the others
_TWO_TYPES = ((2, (-25.0, 0.0), 4.0), (1, (25.0, 0.0), 6.0))


def load(name: str, n_agents: int | None = None, folder: str | os.PathLike[str] = FOLDER) -> Instance:
    """Return the instance of the library with a short name, such as "n20-i03-w40".

    The name says the number of targets, the number of the instance and the total window in s, after the series if it is
    not the paper's: "crowded-", "loose-", "scale-", "types-" or "loads-". Files of one type of agents hold one agent.
    n_agents: for more, as is a name that ends in "-m3"; folder: of the files. InputError: no such
    name, or no file in the folder.

    >>> import mamttsp
    >>> mamttsp.load("n20-i03-w40", n_agents=3) == mamttsp.paper_instance(20, 3, 40, 3)
    True
    """
    found = _NAME.fullmatch(of_type("name", name, str))
    if found is None or (short := short_name(*found.groups()[:4])) not in parameters():
        raise InputError(
            f'name: {brief(name)} is not in the library; names are like "n20-i03-w40" or "loose-n10-i00-w75"'
        )
    if found[5] is not None and n_agents is not None:
        raise InputError(f"n_agents: {brief(name)} says it already")
    instance = Instance.read(file_path("folder", folder) / f"{short}.json")
    agents = n_agents if found[5] is None else int(found[5])
    return instance if agents is None else instance.with_agents(agents)


def load_for(name, agents, folder=FOLDER):
    """Return the instance of a short name without "-m3" for so many agents, as tables name it.

    InputError: see `load`; or the file has types of agents or capacities, and so a number of its own, which is another.
    """
    instance = load(name, folder=folder)
    if instance.plain:
        return instance.with_agents(agents)
    if agents != instance.n_agents:
        raise InputError(f"agents: {name} has {instance.n_agents}, found {agents}")
    return instance


def parameters():
    """Return {short name: arguments of `generate`} of all instances, as JSON has them."""
    made = {}

    def add(series, n, index, window, **others):
        made[short_name(series, n, index, window)] = {"n_targets": n, "total_window": window, "seed": index, **others}

    for n in PAPER_SIZES:
        for index in PAPER_INDICES:
            for window in (20, 40, 60):
                add(None, n, index, window)
    for index in range(10):
        for window in (40, 60):
            add("crowded", 20, index, window, nearest=3)
            add("crowded", 25, index, window, nearest=3, **_longer(25))
        for n in (10, 15, 20):
            for window in (37, 75):  # a quarter and a half of the horizon
                add("loose", n, index, window, widest_total_window=75)
        for n in (10, 15, 20):
            made[short_name("types", n, index, 40)] = beyond_the_paper("types", n, index)
        for n in (20, 25):
            made[short_name("loads", n, index, 40)] = beyond_the_paper("loads", n, index)
    for n in _LONGER:
        for index in range(2):
            add("scale", n, index, 40, **_longer(n))
    return made


def beyond_the_paper(series, n, seed):
    """Return the arguments of `generate` of an instance of the series "types" or "loads", as JSON has them."""
    two = {"agents": [Agents(*entry).to_dict() for entry in _TWO_TYPES]}
    own = two if series == "types" else _loads(n, seed)
    return {"n_targets": n, "total_window": 40, "seed": seed, **own, **_longer(n)}


def make(arguments):
    """Return the instance that the generator makes of arguments as `parameters` has them."""
    arguments = dict(arguments)
    if "agents" in arguments:
        arguments["agents"] = [Agents.from_dict(entry, f"agents[{k}]") for k, entry in enumerate(arguments["agents"])]
    return generate(**arguments)


def write_library(folder=FOLDER):
    """Write all instances and their manifest into a folder: sha256 sums, the generator's version and arguments."""
    folder, sums = Path(folder), {}
    for name, arguments in parameters().items():
        path = folder / f"{name}.json"
        make(arguments).write(path)
        sums[path.name] = hashlib.sha256(path.read_bytes()).hexdigest()
    arguments = {f"{name}.json": given for name, given in parameters().items()}
    write_json({"generator": GENERATOR_VERSION, "files": sums, "arguments": arguments}, folder / MANIFEST)


def read_manifest(folder=FOLDER):
    """Return the manifest of a folder of instances as a dict; InputError if it cannot be read."""
    try:
        return json.loads((Path(folder) / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{Path(folder) / MANIFEST}: cannot be read: {error}") from error


def short_name(series, n, index, window):
    """Return the name of an instance, but for its number of agents; series: None for those by the paper's recipe."""
    prefix = "" if series is None else f"{series}-"
    return f"{prefix}n{int(n):02}-i{int(index):02}-w{int(window)}"


def _longer(n):
    if n not in _LONGER:
        return {}
    horizon, pieces = _LONGER[n]
    return {"horizon": horizon, "n_pieces": pieces}


def _loads(n, index):
    """Return demands from 1 to 9, and four agents with the greatest capacity of which two are not enough."""
    demands = np.random.default_rng([n, index]).integers(1, 10, n).tolist()
    capacity = float((sum(demands) - 1) // 2)
    return {"agents": [Agents(4, (0.0, 0.0), 4.0, capacity=capacity).to_dict()], "demands": demands}
