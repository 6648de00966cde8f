"""Functions compiled by numba, which keeps them in a folder, so that each is compiled once on a machine."""

from numba import njit

from .validation import InputError


def compiled(function):
    """Compile a function when it is first called; InputError if there is no folder to keep the outcome in."""
    try:
        return njit(cache=True)(function)
    except RuntimeError as error:  # numba finds neither the package's folder nor one of the user's to write to
        raise InputError(
            "NUMBA_CACHE_DIR: there is no folder to keep compiled code in; set this environment variable to one that "
            "can be written to"
        ) from error
