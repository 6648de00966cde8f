"""Compiled code: one version of each function, or a first solve compiles in its middle what an earlier one did not."""

import subprocess
import sys

from mamttsp.warm_up import ensure_compiled

_SOLVE_AND_COUNT = """
import importlib, pkgutil
import mamttsp.exact
from mamttsp import paper_instance, solve

for setting in ((10, 18, 60, 1), (15, 1, 40, 2)):
    assert solve(paper_instance(*setting)).status == "optimal"
names = [module.name for module in pkgutil.iter_modules(mamttsp.exact.__path__)]
modules = [importlib.import_module(f"mamttsp.exact.{name}") for name in names]
for function in {f for module in modules for f in vars(module).values() if hasattr(f, "signatures")}:
    print(f"{function.__module__}.{function.__name__}", len(function.signatures))
"""


def _versions():
    """Return {function: how many versions of it a new process called or compiled} for some refined rounds with one
    agent, then with two."""
    done = subprocess.run([sys.executable, "-c", _SOLVE_AND_COUNT], capture_output=True, text=True, check=True)
    return {name: int(versions) for name, versions in (line.split() for line in done.stdout.splitlines())}


def test_refined_rounds_and_several_agents_use_what_the_first_round_compiled():
    ensure_compiled()  # what compiled functions call among themselves is counted only while it is compiled
    versions = _versions()
    assert versions["mamttsp.exact.ngroutes._continued"] == 1
    assert [name for name, n in versions.items() if n > 1] == []
