"""What a person may give: InputError, and the checks of numbers and arrays that every room shares."""

import math
from numbers import Real

import numpy as np


class InputError(ValueError):
    """Bad input from a person: one line that names the field, what is wrong and what would be right."""


def array(name, value, shape):
    """Return `value` as a read-only float array of the shape (-1: any length), or raise InputError."""
    wanted = "x".join("K" if size < 0 else str(size) for size in shape)
    try:
        if any(isinstance(item, (str, bool)) for item in np.asarray(value, dtype=object).ravel()):
            raise ValueError
        numbers = np.array(value, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name}: expected numbers in the shape {wanted}") from None
    if numbers.ndim != len(shape) or any(0 <= want != have for want, have in zip(shape, numbers.shape)):
        found = "x".join(map(str, numbers.shape)) or "a number"
        raise InputError(f"{name}: expected the shape {wanted}, found {found}")
    if not np.isfinite(numbers).all():
        raise InputError(f"{name}: every value must be finite")
    numbers.flags.writeable = False
    return numbers


def is_number(value):
    """Tell whether `value` is a finite real number; booleans are none."""
    try:
        return isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value)
    except OverflowError:  # a whole number beyond every float
        return False


def positive(name, value):
    """Return `value` as a float above 0, or raise InputError."""
    if not is_number(value) or value <= 0:
        raise InputError(f"{name}: expected a finite number above 0, found {value!r}")
    return float(value)


def whole(name, value, least):
    """Return `value` as an int of at least `least`, or raise InputError."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < least:
        raise InputError(f"{name}: expected a whole number of at least {least}, found {value!r}")
    return int(value)
