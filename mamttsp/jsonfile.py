"""JSON files of a named format and version, read and written whole."""

import contextlib
import json
import os

from .validation import InputError, file_path


def read_json(path, build):
    """Read the JSON file at `path` and return build(object); every InputError is prefixed with the path."""
    file = file_path("path", path)
    try:
        text = file.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read: {getattr(error, 'strerror', None) or error}") from error
    try:
        data = json.loads(text, parse_constant=_no_constant)
    except json.JSONDecodeError as error:
        raise InputError(f"{path}: not JSON: {error.msg} at line {error.lineno}, column {error.colno}") from error
    except (RecursionError, ValueError) as error:  # nested too deep, NaN, or a number of thousands of digits
        raise InputError(f"{path}: {error}") from error
    try:
        return build(data)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def write_json(data, path):
    """Write `data` as JSON to `path` through a temporary file, so that a failure leaves the old file as it was."""
    path = file_path("path", path)
    temporary = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        temporary.write_text(json.dumps(data, allow_nan=False) + "\n", encoding="utf-8")
        temporary.replace(path)
    except OSError as error:
        with contextlib.suppress(OSError):
            temporary.unlink()
        raise InputError(f"{path}: cannot be written: {error.strerror}") from error


def check_header(data, expected_format, versions):
    """Reject anything but an object of the expected format in one of these versions."""
    if not isinstance(data, dict):
        raise InputError(f'expected a JSON object with "format": "{expected_format}"')
    if data.get("format") != expected_format:
        raise InputError(f'format: expected "{expected_format}", found {json.dumps(data.get("format"))}')
    if data.get("version") not in versions:
        known = " or ".join(map(str, versions))
        raise InputError(f"version: expected {known}, found {json.dumps(data.get('version'))}")


def require(data, where, *fields):
    """Reject an object that lacks a field."""
    for field in fields:
        if field not in data:
            raise InputError(f"{where}{field}: missing")


def _no_constant(name):
    raise InputError(f"{name} is not a number that JSON allows; every value must be finite")
