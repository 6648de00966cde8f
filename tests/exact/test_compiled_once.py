"""Compiled code: one version of each function, or a first solve compiles in its middle what an earlier one did not."""

import importlib
import pkgutil

import mamttsp.exact
from mamttsp import paper_instance, solve


def _compiled():
    """Return {name: number of compiled versions} of the compiled functions of the exact solver."""
    names = [module.name for module in pkgutil.iter_modules(mamttsp.exact.__path__)]
    modules = [importlib.import_module(f"mamttsp.exact.{name}") for name in names]
    functions = {
        function for module in modules for function in vars(module).values() if hasattr(function, "signatures")
    }
    return {f"{function.__module__}.{function.__name__}": len(function.signatures) for function in functions}


def test_refined_rounds_and_several_agents_use_what_the_first_round_compiled():
    for setting in ((10, 18, 60, 1), (15, 1, 40, 2)):
        assert solve(paper_instance(*setting)).status == "optimal"
    versions = _compiled()
    assert versions["mamttsp.exact.relaxed.backward"] == 1
    assert max(versions.values()) == 1
