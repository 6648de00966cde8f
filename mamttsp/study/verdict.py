"""What a check says of an answer to an exercise: right, not answered yet, or wrong. It never stops a sheet."""

import reprlib
import textwrap

_MOST = 240  # characters of a verdict: one line on a screen, two on paper


def judge(label, check, *answers):
    """Print whether the answers are right, with the case that shows it where they are not.

    label: what is judged, such as "Task 02.1". check: takes the answers, asserts what must hold of them, each assertion
    with a message, and returns the lines to print if all holds, or None. answers: functions. NotImplementedError from
    one of them means that it is not written yet; any other error in one of them, or a value that the check cannot work
    with, makes it wrong. An assertion without a message is a fault of the check and is raised.
    """
    last = []
    try:
        lines = check(*(_watched(answer, last) for answer in answers))
    except NotImplementedError:
        print(f"{label}: not answered yet")
    except AssertionError as error:
        if not error.args:
            raise
        print(_one_line(f"{label}: wrong: {error}"))
    except Exception as error:
        print(_one_line(f"{label}: wrong: {' '.join(last)}, and the check cannot use it: {_named(error)}"))
    else:
        print(*(lines or ()), f"{label}: right", sep="\n")


def _watched(answer, last):
    """The answer as a function that keeps in `last` what it was asked and what it gave, and names a call that stops."""

    def call(*args):
        said = f"{getattr(answer, '__name__', 'the answer')}({', '.join(map(reprlib.repr, args))})"
        try:
            value = answer(*args)
        except NotImplementedError:
            raise
        except Exception as error:
            raise AssertionError(f"{said} stops with {_named(error)}") from error
        last[:] = [said, "gives", reprlib.repr(value)]
        return value

    return call


def _named(error):
    return f"{type(error).__name__}: {error}"


def _one_line(text):
    return textwrap.shorten(text, _MOST, placeholder=" …")
