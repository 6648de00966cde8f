"""What docstrings say of arguments in sentences is a list on a page."""

import importlib.util
import inspect
import re
from collections import Counter

import pytest

import mamttsp
from tests.docs.conftest import ROOT

_spec = importlib.util.spec_from_file_location("argument_lists", ROOT / "docs" / "argument_lists.py")
argument_lists = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(argument_lists)

DOCSTRING = """Return something.

It has a reason: this one. n: how many; each: of them, for
example (see n): all. Nothing else. first, last: the ends;
InputError: no such number.

More of it.

>>> n: 3
"""
LISTED = """Return something.

It has a reason: this one.

More of it.

:param n: how many.
:param each: of them, for example (see n): all. Nothing else.
:param first: the ends.
:param last: the ends.
:raises InputError: no such number.

>>> n: 3
"""


def test_sentences_become_a_list_before_the_example():
    names = ["n", "each", "first", "last", "InputError"]
    assert argument_lists.with_list(DOCSTRING.split("\n"), names) == LISTED.split("\n")


def test_what_says_nothing_of_arguments_stays_as_it_is():
    lines = ["Return the length: all of it.", "", "- a list", "- of two", ""]
    assert argument_lists.with_list(lines, ["n"]) == lines


@pytest.mark.parametrize(
    "call", [mamttsp.solve, mamttsp.generate, mamttsp.Target, mamttsp.Solution, mamttsp.Instance.from_arrays]
)
def test_no_word_is_lost_and_arguments_are_in_order(call):
    lines = inspect.getdoc(call).split("\n")
    listed = list(lines)
    argument_lists.add(None, "function", "name", call, None, listed)
    before, after = (Counter(re.findall(r"[^\s.,;:]+", " ".join(text))) for text in (lines, listed))
    assert not before - after and set(after) - set(before) <= {"param", "raises"}
    fields = [line.split()[1].removesuffix(":") for line in listed if line.startswith(":param ")]
    order = list(inspect.signature(call).parameters)
    assert len(fields) >= 4 and [name for name in fields if name not in order] == []
