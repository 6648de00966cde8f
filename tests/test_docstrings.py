"""The examples in docstrings say what happens; each stands alone, as a reader would copy it."""

import doctest
import importlib
import inspect
import pkgutil
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

import mamttsp
from tests.test_public_names import documented

#: not made by users, or (exceptions) shown where they are raised; a film is shown where it is saved
WITHOUT = {"Film", "FlowError", "InputError", "SolverUnavailable", "TourError"}


def modules_with_examples():
    """The names of the modules whose files hold an example."""
    found = pkgutil.walk_packages(mamttsp.__path__, "mamttsp.", onerror=lambda name: None)
    paths = {module.name: Path(module.module_finder.path, *module.name.split(".")[-1:]) for module in found}
    files = {name: path / "__init__.py" if path.is_dir() else path.with_suffix(".py") for name, path in paths.items()}
    return [name for name, file in files.items() if ">>> " in file.read_text(encoding="utf-8")]


@pytest.mark.parametrize("name", modules_with_examples())
def test_examples_say_what_happens(name):
    if name.endswith("campaigns.campaign"):
        pytest.importorskip("fcntl", reason="campaigns need the locks of Unix")
    module, runner = importlib.import_module(name), doctest.DocTestRunner()
    tests = doctest.DocTestFinder().find(module, module.__name__, globs={})
    with plt.rc_context({"backend": "agg"}):
        assert sum(runner.run(test).attempted for test in tests) > 0
    plt.close("all")
    assert runner.summarize().failed == 0


PUBLIC = {name: getattr(mamttsp, name) for name in mamttsp.__all__} | documented()


@pytest.mark.parametrize("name", sorted(set(PUBLIC) - WITHOUT))
def test_every_public_name_has_an_example(name):
    assert ">>> " in inspect.getdoc(PUBLIC[name])
