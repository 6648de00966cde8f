"""The rows of a campaign: their columns, how they stand in a CSV file, and how they are read back."""

import csv
import dataclasses
import io
import json
from collections import Counter

from ...tours import Tour
from ...validation import InputError, brief, file_path, listed
from .runs import Run

KEY = tuple(field.name for field in dataclasses.fields(Run))
#: the part of the key that says what is solved
INSTANCE = ["n", "index", "total_window", "agents"]
ANSWER = ("status", "message", "objective", "bound", "gap", "gap_percent", "runtime_s", "build_time_s", "solve_time_s")
ANSWER += ("nodes", "subtour_cuts", "memory_mb")
SIZES = ("V", "E", "variables", "binaries", "integers", "linear_rows", "cones", "bilinear_rows")
PROVENANCE = ("version", "commit", "solver_version", "modeler_version", "gap_limit", "threads", "seed")
PROVENANCE += ("memory_limit_mb", "jobs", "cpu", "cores", "machine_memory_gb", "os", "python", "date")
COLUMNS = (*KEY, *ANSWER, *SIZES, "tours", *PROVENANCE)


def key_of(row):
    """Return the key of a row, or of a run's fields, as a tuple of texts."""
    return tuple(text_of(row[name]) for name in KEY)


def read_rows(path):
    """Return the rows of a results file as dicts of texts; a last line that was cut off is no row.

    InputError: no such file, or not the columns of this version.

    >>> from mamttsp.experiments import read_rows
    >>> read_rows("nowhere.csv")
    Traceback (most recent call last):
        ...
    mamttsp.validation.InputError: nowhere.csv: cannot be read: No such file or directory
    """
    file_path("path", path)
    try:
        with open(path, "rb") as file:
            return parse(file.read(), path)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error


def tours_of(row):
    """Return the Tours of a row, to be checked against its instance; none if the run found none.

    InputError: not a row, or tours in it that are none.

    >>> from mamttsp.experiments import tours_of
    >>> (tour,) = tours_of({"tours": '[{"visits": [], "return_time": 0.0}]'})
    >>> tour.return_time
    0.0
    """
    try:
        text = row["tours"] or "[]"
    except (IndexError, KeyError, TypeError):
        raise InputError(f"row: expected a row of a results file, found {brief(row)}") from None
    try:
        tours = json.loads(text)
    except (TypeError, ValueError) as error:
        raise InputError(f"row.tours: not JSON: {error}") from None
    if not isinstance(tours, list):
        raise InputError(f"row.tours: expected a list of tours, found {brief(tours)}")
    return tuple(Tour.from_dict(tour, f"row.tours[{k}]") for k, tour in enumerate(tours))


def summary(runs, path):
    """Return how many of the runs have a row, and how many of those end in each status, as one line.

    runs: a list of Run; path: of the results file. InputError: no such runs, no such file.

    >>> import pathlib, tempfile
    >>> from mamttsp.experiments import profile, summary
    >>> from mamttsp.experiments.campaigns.rows import COLUMNS, line_of
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "rows.csv")
    ...     _ = path.write_bytes(line_of(COLUMNS))
    ...     summary(profile("smoke"), path)
    '0 of 10 runs: '
    """
    runs = listed("runs", runs, Run)
    wanted = {key_of(dataclasses.asdict(run)) for run in runs}
    statuses = Counter(row["status"] for row in read_rows(path) if key_of(row) in wanted)
    parts = [f"{count} {status}" for status, count in statuses.most_common()]
    return f"{statuses.total()} of {len(runs)} runs: {', '.join(parts)}"


def parse(data, path):
    """Return the rows in the bytes of a results file; InputError, with its path, if they are not one."""
    whole = data[: data.rfind(b"\n") + 1]
    if not whole:
        if line_of(COLUMNS).startswith(data):
            return []
        raise InputError(f"{path}: not a campaign's results: its first line is cut off, or it is no such file")
    try:
        header, *lines = csv.reader(io.StringIO(whole.decode()))
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{path}: not a campaign's results: {error}") from error
    _check_header(header, path)
    for number, line in enumerate(lines, start=2):
        if len(line) != len(COLUMNS):
            raise InputError(f"{path}: line {number}: expected {len(COLUMNS)} fields, found {len(line)}")
    return [dict(zip(COLUMNS, line)) for line in lines]


def _check_header(header, path):
    if tuple(header) == COLUMNS:
        return
    missing, unknown = [c for c in COLUMNS if c not in header], [c for c in header if c not in COLUMNS]
    parts = [f"{word} {', '.join(names[:5])}" for word, names in (("missing", missing), ("unknown", unknown)) if names]
    found = "; ".join(parts) or "in another order"
    raise InputError(f"{path}: columns of another version ({found}); keep this file and name a new one")


def line_of(values):
    """Return a line of the file as bytes."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(values)
    return text.getvalue().encode()


def text_of(value):
    """Return a value as it stands in the file: always one line, nothing for None, 60 for 60.0."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return "" if value is None else " ".join(str(value).split())
