"""The rows of a campaign: one CSV file that several campaigns can share, and that a kill at any moment leaves whole."""

import contextlib
import csv
import dataclasses
import fcntl  # locks of Unix: campaigns run on Linux and macOS
import hashlib
import io
import json
import os
import threading
from collections import Counter

from ..tours import Tour
from ..validation import InputError
from .runs import Run

KEY = tuple(field.name for field in dataclasses.fields(Run))
ANSWER = ("status", "message", "objective", "bound", "gap", "gap_percent", "runtime_s", "build_time_s", "solve_time_s")
ANSWER += ("nodes", "subtour_cuts", "memory_mb")
SIZES = ("V", "E", "variables", "binaries", "integers", "linear_rows", "cones", "bilinear_rows")
PROVENANCE = ("version", "commit", "solver_version", "modeler_version", "gap_limit", "threads", "seed", "memory_limit_mb")
PROVENANCE += ("jobs", "cpu", "cores", "machine_memory_gb", "os", "python", "date")
COLUMNS = (*KEY, *ANSWER, *SIZES, "tours", *PROVENANCE)

#: claims are locks on single bytes from here on, far behind the rows
_CLAIMS = 2**40


def key_of(row):
    """Return the key of a row, or of a run's fields, as a tuple of texts."""
    return tuple(_text(row[name]) for name in KEY)


def read_rows(path):
    """Return the rows of a results file as dicts of texts; a last line that was cut off is no row.

    InputError: no such file, or not the columns of this version.
    """
    try:
        with open(path, "rb") as file:
            return _parse(file.read(), path)
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error


def tours_of(row):
    """Return the Tours of a row, to be checked against its instance; none if the run found none."""
    return tuple(Tour.from_dict(tour) for tour in json.loads(row["tours"] or "[]"))


def summary(runs, path):
    """Return how many of the runs have a row, and how many of those end in each status, as one line."""
    wanted = {key_of(dataclasses.asdict(run)) for run in runs}
    statuses = Counter(row["status"] for row in read_rows(path) if key_of(row) in wanted)
    parts = [f"{count} {status}" for status, count in statuses.most_common()]
    return f"{statuses.total()} of {len(runs)} runs: {', '.join(parts)}"


class Results:
    """A results file open for appending; a context manager. Its locks go with the process, however it ends."""

    def __init__(self, path):
        self.path = path
        self._mutex = threading.RLock()  # the file's lock excludes other processes, not this one's threads
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        except OSError as error:
            raise InputError(f"{path}: cannot be written: {error.strerror}") from error
        try:
            with self._locked():
                self._keys()
                if not self._size():
                    self._write(COLUMNS)
        except BaseException:
            self.__exit__()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        os.close(self._file)

    def keys(self):
        """Return the keys of the rows, as they are now."""
        with self._locked():
            return self._keys()

    def claim(self, key):
        """Tell whether the run is ours to do: no other campaign has it in flight, and it has no row yet."""
        byte = _CLAIMS + int.from_bytes(hashlib.sha256(repr(key).encode()).digest()[:5], "big")
        try:
            fcntl.lockf(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB, 1, byte)
        except (BlockingIOError, PermissionError):
            return False
        return key not in self.keys()

    def append(self, row):
        """Append a row unless its run has one; InputError if there is no room, with the file as it was."""
        with self._locked():
            if key_of(row) not in self._keys():
                self._write([_text(row.get(name)) for name in COLUMNS])

    @contextlib.contextmanager
    def _locked(self):
        with self._mutex:
            fcntl.flock(self._file, fcntl.LOCK_EX)
            try:
                yield
            finally:
                fcntl.flock(self._file, fcntl.LOCK_UN)

    def _size(self):
        return os.fstat(self._file).st_size

    def _keys(self):
        """Return the keys of the rows; a line that another campaign was killed in is cut off first."""
        data = os.pread(self._file, self._size(), 0)
        keys = {key_of(row) for row in _parse(data, self.path)}
        whole = data.rfind(b"\n") + 1
        if whole < len(data):
            os.ftruncate(self._file, whole)
        return keys

    def _write(self, values):
        """Write a line whole or not at all."""
        before, line = self._size(), _line(values)
        try:
            while line:
                line = line[os.write(self._file, line) :]
            os.fsync(self._file)
        except OSError as error:
            os.ftruncate(self._file, before)
            reason = f"{self.path}: cannot be written: {error.strerror}"
            raise InputError(f"{reason}; the rows written so far are whole, and the same command goes on from them") from error
        except BaseException:  # Ctrl-C between two parts of a line
            os.ftruncate(self._file, before)
            raise


def _parse(data, path):
    whole = data[: data.rfind(b"\n") + 1]
    if not whole:
        if _line(COLUMNS).startswith(data):
            return []
        raise InputError(f"{path}: not a campaign's results: the first line is not that of its columns")
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


def _line(values):
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerow(values)
    return text.getvalue().encode()


def _text(value):
    """Return a value as it stands in the file: always one line, nothing for None, 60 for 60.0."""
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return "" if value is None else " ".join(str(value).split())
