"""What a person may give: InputError, and the checks of numbers and arrays that every room shares."""

import math
import os
from collections.abc import Iterable
from numbers import Real
from pathlib import Path

import numpy as np


class InputError(ValueError):
    """Bad input from a person: one line that names the field, what is wrong and what would be right."""


def of_type(name, value, kind):
    """Return `value` if it is of the type `kind`, or of one of several, or raise InputError."""
    if not isinstance(value, kind):
        kinds = kind if isinstance(kind, tuple) else (kind,)
        expected = " or ".join(one.__name__ for one in kinds)
        raise InputError(f"{name}: expected {expected}, found {type(value).__name__} {brief(value)}")
    return value


def file_path(name, value):
    """Return `value`, a text or a path, as a Path, or raise InputError."""
    return Path(of_type(name, value, (str, os.PathLike)))


def listed(name, values, kind):
    """Return `values`, a list or another sequence of things of the type `kind`, as a tuple, or raise InputError."""
    if isinstance(values, (str, bytes, dict)) or not isinstance(values, Iterable):
        several = kind.__name__.removesuffix("s") + "s"
        raise InputError(f"{name}: expected a list of {several}, found {brief(values)}")
    return tuple(of_type(f"{name}[{k}]", value, kind) for k, value in enumerate(values))


def brief(value):
    """Return a value as it is written in code, on one line and not too long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def counted(count, noun):
    """Return a number with its noun: "1 agent", "2 agents"."""
    return f"{count} {noun}" + "s" * (count != 1)


def array(name, value, shape):
    """Return `value` as a read-only float array of the shape (-1: any length), or raise InputError."""
    wanted = "x".join("K" if size < 0 else str(size) for size in shape)
    numbers = floats(name, value, f"numbers in the shape {wanted}")
    if numbers.ndim != len(shape) or any(0 <= want != have for want, have in zip(shape, numbers.shape)):
        found = "x".join(map(str, numbers.shape)) or "a number"
        raise InputError(f"{name}: expected the shape {wanted}, found {found}")
    if not np.isfinite(numbers).all():
        raise InputError(f"{name}: every value must be finite")
    numbers.flags.writeable = False
    return numbers


def floats(name, value, expected):
    """Return `value` as a float array of its own shape, or raise InputError; `expected` says of what."""
    try:
        if any(isinstance(item, (str, bool, type(None))) for item in np.asarray(value, dtype=object).ravel()):
            raise ValueError
        return np.array(value, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name}: expected {expected}") from None


def is_number(value):
    """Tell whether `value` is a finite real number; booleans are none."""
    try:
        return isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:  # a whole number beyond every float
        return False


def positive(name, value):
    """Return `value` as a float above 0, or raise InputError."""
    if not is_number(value) or value <= 0:
        raise InputError(f"{name}: expected a finite number above 0, found {brief(value)}")
    return float(value)


def number(name, value):
    """Return `value` as a finite float, or raise InputError."""
    if not is_number(value):
        raise InputError(f"{name}: expected a finite number, found {brief(value)}")
    return float(value)


def at_least_0(name, value):
    """Return `value` as a finite float of at least 0, or raise InputError."""
    if not is_number(value) or value < 0:
        raise InputError(f"{name}: expected a finite number of at least 0, found {value!r}")
    return float(value)


def whole(name, value, least):
    """Return `value` as an int of at least `least`, or raise InputError."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise InputError(f"{name}: expected a whole number of at least {least}, found {brief(value)}")
    return int(value)
