"""A results file: several campaigns can share it, and a kill at any moment leaves its rows whole."""

import contextlib
import hashlib
import os
import threading

try:
    import fcntl
except ImportError:  # its locks are of Unix: campaigns run on Linux and macOS, all else everywhere
    fcntl = None

from ...validation import InputError
from .rows import COLUMNS, key_of, line_of, parse, text_of

#: claims are locks on single bytes from here on, far behind the rows
_CLAIMS = 2**40


class Results:
    """A results file open for appending; a context manager. Its locks go with the process, however it ends."""

    def __init__(self, path):
        if fcntl is None:
            raise InputError("campaign: campaigns run on Linux and macOS only, for the locks that their files need")
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
                self._write([text_of(row.get(name)) for name in COLUMNS])

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
        keys = {key_of(row) for row in parse(data, self.path)}
        whole = data.rfind(b"\n") + 1
        if whole < len(data):
            os.ftruncate(self._file, whole)
        return keys

    def _write(self, values):
        """Write a line whole or not at all."""
        before, line = self._size(), line_of(values)
        try:
            while line:
                line = line[os.write(self._file, line) :]
            os.fsync(self._file)
        except OSError as error:
            os.ftruncate(self._file, before)
            kept = "the rows written so far are whole, and the same command goes on from them"
            raise InputError(f"{self.path}: cannot be written: {error.strerror}; {kept}") from error
        except BaseException:  # Ctrl-C between two parts of a line
            os.ftruncate(self._file, before)
            raise
