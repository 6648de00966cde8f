"""Functions compiled by numba, which keeps them in a folder, so that each is compiled once on a machine.

What only makes compiling longer is left out: a wrapper to call from C, and ZeroDivisionErrors: a quotient by zero is
infinite or nan, as in numpy. In the functions themselves, slices are copied in loops, for an assignment brings along
the text of its error; and a number such as 0 is `np.int64(0)` where it goes into a call, for as a literal it is a type
of its own, for which the callee is compiled again.
"""

from numba import njit

from .validation import InputError


def compiled(function):
    """Compile a function when it is first called; InputError if there is no folder to keep the outcome in."""
    return _compiled(function)


def inlined(function):
    """Like `compiled`, for small functions that are copied into each of their callers."""
    return _compiled(function, inline="always")


def _compiled(function, **options):
    try:
        return njit(cache=True, error_model="numpy", no_cfunc_wrapper=True, **options)(function)
    except RuntimeError as error:  # numba finds neither the package's folder nor one of the user's to write to
        raise InputError(
            "NUMBA_CACHE_DIR: there is no folder to keep compiled code in; set this environment variable to one that "
            "can be written to"
        ) from error
