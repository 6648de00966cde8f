"""Every public name says which types it takes and gives; `make lint` checks that they are true."""

import inspect
from pathlib import Path

import pytest

import mamttsp

FOLDER = Path(mamttsp.__file__).parent


def functions():
    """Yield (name, function) of every public function, and of every public method and property of a public class."""
    for name in mamttsp.__all__:
        item = getattr(mamttsp, name)
        if inspect.isfunction(item):
            yield name, item
        elif inspect.isclass(item):
            for attribute, value in vars(item).items():
                value = getattr(value, "fget", None) or getattr(value, "__func__", value)
                if inspect.isfunction(value) and not attribute.startswith("_"):
                    yield f"{name}.{attribute}", value


@pytest.mark.parametrize("name, function", list(functions()))
def test_all_types_are_said(name, function):
    signature = inspect.signature(function)
    silent = [
        p.name for p in signature.parameters.values() if p.annotation is p.empty and p.name not in ("self", "cls")
    ]
    assert not silent and signature.return_annotation is not signature.empty


def test_type_checkers_are_told_so():
    assert (FOLDER / "py.typed").exists()
