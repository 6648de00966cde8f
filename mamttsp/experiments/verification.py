"""A folder of results put to the test: stored tours by the checker, and files by the sums in their manifests."""

import csv
import hashlib
import json
from pathlib import Path

from ..generate import paper_instance
from ..solution import FEASIBLE, OPTIMAL
from ..tours import check
from ..validation import InputError, counted
from .campaigns.rows import INSTANCE, tours_of
from .summaries.best_solutions import COLUMNS, TABLE, line_faults, table_faults

#: relative difference that counts as equal: of a length that the row and the checker say
_EQUAL = 1e-6
#: how far a bound may be above a length, relative to it: solvers' tolerances
_ABOVE = 1e-4
_MANIFEST = "manifest.json"


def verify(folder):
    """Yield (what, faults) for each file with tours and each manifest in the folder, and in folders within.

    what: the file, and how much of it was looked at, in a few words; faults: a list of lines, each with the file and
    the place in it. A file with tours is a CSV with the columns n, index, total_window, agents and tours; a manifest is
    `manifest.json`, whose "files" are an object of names, beside it or below, and their sha256 sums. Beside the
    manifest of a library of instances its best_known.csv is held against the tours' files. InputError: there
    is no such folder, or nothing in it to verify.
    """
    if not Path(folder).is_dir():
        raise InputError(f"{folder}: there is no such folder")
    tables = [path for path in sorted(Path(folder).rglob("*.csv")) if _has_tours(path)]
    manifests = sorted(Path(folder).rglob(_MANIFEST))
    libraries = [path for path in (manifest.parent / TABLE for manifest in manifests) if path.is_file()]
    if not tables and not manifests:
        raise InputError(f"{folder}: holds no table with tours and no {_MANIFEST}")
    for path in tables:
        yield _verify_table(path)
    for path in manifests:
        yield _verify_sums(path)
    for path in libraries:
        yield _verify_library(path)


def sha256(path):
    """Return the sha256 sum of a file, in hexadecimal digits."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def _has_tours(path):
    with path.open(newline="", encoding="utf-8", errors="replace") as file:
        return {*INSTANCE, "tours"} <= set(file.readline().rstrip("\r\n").split(","))


def _verify_table(path):
    _, rows, faults = _read(path)
    checked, instances = 0, {}
    for number, row in rows:
        try:
            found, looked_at = _row_faults(row, instances)
        except (ValueError, KeyError, TypeError) as error:  # an InputError or a TourError, or no number
            found, looked_at = str(error).splitlines(), True
        checked += looked_at
        faults += [f"{path}, line {number}: {fault}" for fault in found]
    return f"{path}: tours of {counted(checked, 'row')}", faults


def _read(path):
    """Return the header of a CSV file, its rows with their numbers, as far as it can be read, and faults in that."""
    rows = []
    with path.open(newline="", encoding="utf-8", errors="replace") as file:
        reader = csv.DictReader(file)
        try:
            rows.extend(enumerate(reader, start=2))
        except csv.Error as error:  # a quotation mark opens a field that is too long
            return reader.fieldnames, rows, [f"{path}, line {len(rows) + 2}: {error}"]
        return reader.fieldnames, rows, []


def _row_faults(row, instances):
    """Return (faults, whether the row has tours). instances: those made so far, by their fields in a row."""
    tours = tours_of(row)
    if not tours:
        claims = row.get("status") in (OPTIMAL, FEASIBLE) or row.get("objective")
        return (["claims a solution and has no tours"] if claims else []), False
    key = tuple(row[name] for name in INSTANCE)
    if key not in instances:
        n, index, total_window, agents = key
        instances[key] = paper_instance(int(n), int(index), float(total_window), int(agents))
    length, objective = check(instances[key], tours), float(row["objective"])
    faults = []
    if not abs(objective - length) <= _EQUAL * length:
        faults.append(f"objective {objective}, but the tours' length is {length:.9f}")
    if row.get("bound") and not float(row["bound"]) <= length * (1 + _ABOVE):
        faults.append(f"bound {row['bound']} is above the tours' length {length:.9f}")
    return faults, True


def _verify_library(path):
    header, lines, faults = _read(path)
    if tuple(header or ()) != COLUMNS:
        return f"{path}: tours of 0 lines", [f"{path}, line 1: expected the columns {', '.join(COLUMNS)}"]
    faults += [f"{path}, line {number}: {fault}" for number, line in lines for fault in line_faults(path.parent, line)]
    faults += [f"{path}: {fault}" for fault in table_faults(path.parent, [line for _, line in lines])]
    return f"{path}: tours of {counted(len(lines), 'line')}", faults


def _verify_sums(path):
    try:
        sums = json.loads(path.read_text(encoding="utf-8"))["files"]
        wanted = {name: str(sum_) for name, sum_ in sums.items()}
    except (ValueError, KeyError, TypeError, AttributeError):
        return f"{path}: 0 files", [f'{path}: expected an object with "files", names and their sha256 sums']
    faults = []
    for name, sum_ in wanted.items():
        file = path.parent / name
        if not file.is_file():
            faults.append(f"{path}: {name}: there is no such file")
        elif (found := sha256(file)) != sum_:
            faults.append(f"{path}: {name}: its sha256 sum is {found}, not {sum_}")
    return f"{path}: sums of {counted(len(wanted), 'file')}", faults
