"""The best that is known of each instance of the library: a table, a solution file for each line, and what improved.

Unlike best_known.csv of a campaign, which is what its rows say, this grows: a line changes only for the better, and
each change of a value is a line of changes.csv.
"""

import csv
import dataclasses
import math
from collections import Counter
from pathlib import Path

from ...library import load_for, short_name
from ...solution import FEASIBLE, OPTIMAL, UNKNOWN, Solution, relative_gap
from ...tours import TourError, check
from ...validation import InputError
from ..campaigns.rows import line_of, text_of, tours_of

TABLE, CHANGES, SOLUTIONS = "best_known.csv", "changes.csv", "best"
COLUMNS = ("name", "agents", "status", "objective", "bound", "gap_percent", "objective_by", "bound_by", "solution")
CHANGE_COLUMNS = ("name", "agents", "what", "before", "after", "by")
#: relative differences that count: an improvement, a bound above a length, a gap that is closed
_BETTER, _ABOVE, _CLOSED = 1e-7, 1e-4, 1e-4


@dataclasses.dataclass(frozen=True)
class Contribution:
    """What someone found of an instance of the library: tours, () for none, and a lower bound in units or None.

    agents: the number, which for types of agents is that of the instance; tours_by, bound_by: who.
    """

    name: str
    agents: int
    tours: tuple
    bound: float | None
    tours_by: str
    bound_by: str


def of_rows(best):
    """Yield what a campaign's best_known table, a DataFrame, says of the instances by the paper's recipe."""
    for _, line in best.iterrows():
        bound = None if math.isnan(line["bound"]) else float(line["bound"])
        name = short_name(None, line["n"], line["index"], line["total_window"])
        yield Contribution(
            name, int(line["agents"]), tours_of(line), bound, str(line["objective_by"]), str(line["bound_by"])
        )


def update(folder, found):
    """Take what is found into the table, the solution files and the changes in `folder`; return the table's path.

    Objectives are the checker's. TourError: tours that are no solution; InputError: a bound above the known length.
    """
    folder = Path(folder)
    lines = {(line["name"], int(line["agents"])): line for line in read_lines(folder / TABLE)}
    changes = read_lines(folder / CHANGES)
    (folder / SOLUTIONS).mkdir(exist_ok=True)
    for one in found:
        key = one.name, one.agents
        line = lines.get(key) or dict.fromkeys(COLUMNS, "") | {"name": one.name, "agents": one.agents}
        lines[key] = _improved(folder, line, one, changes)
    _write(folder / TABLE, COLUMNS, [lines[key] for key in sorted(lines)])
    _write(folder / CHANGES, CHANGE_COLUMNS, changes)
    return folder / TABLE


def line_faults(folder, line):
    """Return what is wrong with a line of the table, as texts: tours, length, bound, what follows of them, the file."""
    if None in line or None in line.values():  # as csv.DictReader says it
        return [f"expected {len(COLUMNS)} fields"]
    try:
        instance = load_for(line["name"], int(line["agents"]), folder)
        objective, bound, gap = (_number(line, name) for name in ("objective", "bound", "gap_percent"))
        if not line["solution"]:
            return ["claims a length and has no tours"] if objective else _stated_faults(line, None, bound, gap)
        stored = Solution.read(Path(folder) / line["solution"])
        length = check(instance, stored.tours)
    except (InputError, TourError, ValueError) as error:
        return str(error).splitlines()
    if objective is None or not abs(objective - length) <= 1e-9 * length:
        return [f"objective {line['objective'] or 'unknown'}, but the tours' length is {length:.9f}"]
    faults = _stated_faults(line, objective, bound, gap)
    if bound is not None and not bound <= length * (1 + _ABOVE):
        faults.append(f"bound {bound} is above the tours' length {length:.9f}")
    if stored != _solution(line["status"], objective, bound, stored.tours, line["objective_by"]):
        faults.append(f"{line['solution']} says another status, objective, bound or solver than the line")
    return faults


def table_faults(folder, lines):
    """Return what is wrong with the table besides its lines: one that is there twice, a file in no line."""
    times = Counter((line["name"], line["agents"]) for line in lines)
    faults = [f"{name}, {agents} agents: {count} lines" for (name, agents), count in times.items() if count > 1]
    named = {line["solution"] for line in lines}
    stored = sorted(path.relative_to(folder).as_posix() for path in (Path(folder) / SOLUTIONS).glob("*"))
    return faults + [f"{name}: in no line" for name in stored if name not in named]


def _stated_faults(line, objective, bound, gap):
    """Return what is wrong with the numbers that follow of the others, and with the name of the file."""
    faults, expected = [], relative_gap(objective, bound)
    if (gap is None) != (expected is None) or (gap is not None and not abs(gap - 100 * expected) <= 1e-9):
        stated = "unknown" if expected is None else 100 * expected
        faults.append(f"gap_percent {line['gap_percent'] or 'unknown'}, but of objective and bound it is {stated}")
    if line["status"] != (status := _status(objective, expected)):
        faults.append(f"status {line['status']}, but of objective and bound it is {status}")
    if line["solution"] not in ("", file := _file(line["name"], line["agents"])):
        faults.append(f"solution {line['solution']}, but the file's name is {file}")
    return faults


def _number(line, name):
    try:
        return float(line[name]) if line[name] else None
    except ValueError:
        raise InputError(f"{name}: expected a number or nothing, found {line[name]!r}") from None


def _file(name, agents):
    return f"{SOLUTIONS}/{name}-m{agents}.json"


def _status(objective, gap):
    return UNKNOWN if objective is None else OPTIMAL if gap is not None and gap <= _CLOSED else FEASIBLE


def _solution(status, objective, bound, tours, by):
    return Solution(status, objective, bound, 0.0, tours, "best known", by)


def _improved(folder, line, one, changes):
    """Return the line with what is better in `one`, its solution file written; note each value that changes."""
    new, tours = dict(line), None
    length, bound = (float(line[what]) if line[what] != "" else None for what in ("objective", "bound"))
    if one.tours:
        found = check(load_for(one.name, one.agents, folder), one.tours)
        if length is None or found < length * (1 - _BETTER):
            _note(changes, line, "objective", length, found, one.tours_by)
            new |= {"objective": found, "objective_by": one.tours_by}
            new["solution"] = _file(one.name, one.agents)
            length, tours = found, one.tours
    if one.bound is not None and (bound is None or one.bound > bound * (1 + _BETTER)):
        _note(changes, line, "bound", bound, one.bound, one.bound_by)
        new |= {"bound": one.bound, "bound_by": one.bound_by}
        bound = one.bound
    if None not in (length, bound) and bound > length * (1 + _ABOVE):
        who = f"{new['bound_by']} against {new['objective_by']}"
        raise InputError(f"{one.name}, {one.agents} agents: the bound {bound} is above the length {length} ({who})")
    gap = relative_gap(length, bound)
    new["gap_percent"] = "" if gap is None else 100 * gap
    new["status"] = _status(length, gap)
    if new != line and new["solution"]:
        tours = tours or Solution.read(folder / new["solution"]).tours
        _solution(new["status"], length, bound, tours, new["objective_by"]).write(folder / new["solution"])
    return new


def _note(changes, line, what, before, after, by):
    if before is not None:
        names = line["name"], line["agents"], what, before, after, by
        changes.append(dict(zip(CHANGE_COLUMNS, names)))


def read_lines(path):
    """Return the lines of a table as dicts of texts, none if there is no such file."""
    if not path.exists():
        return []
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def _write(path, columns, lines):
    texts = [list(columns), *([text_of(line[name]) for name in columns] for line in lines)]
    temporary = path.with_name(f"{path.name}.tmp")  # whoever is killed here leaves the old file
    temporary.write_bytes(b"".join(map(line_of, texts)))
    temporary.replace(path)
