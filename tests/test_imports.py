"""What is slow to import is imported where it is used: each case in a process of its own."""

import json
import subprocess
import sys

import pytest

import mamttsp

MODELERS = {"pyomo", "cvxpy"}
DRAWING = {"matplotlib", "pandas", "scipy.stats"}
#: in a process of its own: what a statement leaves in sys.modules
LEFT = "import sys; before = set(sys.modules); {}; import json; print(json.dumps(sorted(set(sys.modules) - before)))"


def imported(statement):
    """Return the modules that a statement imports."""
    done = subprocess.run([sys.executable, "-c", LEFT.format(statement)], capture_output=True, text=True, check=True)
    return set(json.loads(done.stdout))


def test_the_package_itself_needs_none_of_the_slow_ones():
    modules = imported("import mamttsp")
    assert "mamttsp.solve" in modules and "numpy" in modules
    assert not modules & (MODELERS | DRAWING | {"numba", "scipy.sparse", "networkx", "clarabel", "tqdm"})


def test_the_command_line_needs_none_of_them_to_say_what_is_wrong():
    modules = imported("from mamttsp.__main__ import main; assert main(['solve', 'nowhere.json']) == 2")
    assert not modules & (MODELERS | DRAWING | {"numba", "scipy.sparse", "networkx", "clarabel"})


def test_the_exact_method_needs_no_modeler_and_nothing_that_draws():
    modules = imported("import mamttsp; assert mamttsp.solve(mamttsp.generate(3, 20, seed=0)).status == 'optimal'")
    assert {"mamttsp.exact", "numba"} <= modules
    assert not modules & (MODELERS | DRAWING | {"networkx"})


@pytest.mark.parametrize("modeler, other", [("pyomo", "cvxpy"), ("cvxpy", "pyomo")])
def test_a_modeler_does_without_the_other(modeler, other):
    modules = imported(
        "import mamttsp; from mamttsp.formulations import build_formulation; from mamttsp.backends import Options;"
        f"from mamttsp.backends.scip import solve; graph = mamttsp.build_graph(mamttsp.generate(2, 20, seed=0));"
        f"assert solve(build_formulation('micp', '{modeler}', graph, 1), Options()).status == 'optimal'"
    )
    assert modeler in modules and not modules & ({other, "matplotlib", "pandas"})


@pytest.mark.parametrize("name", mamttsp.__all__)
def test_every_public_name_is_there_and_listed(name):
    assert getattr(mamttsp, name).__name__.rpartition(".")[2] == name
    assert name in dir(mamttsp)


def test_other_names_are_not():
    with pytest.raises(AttributeError, match="^module 'mamttsp' has no attribute 'nowhere'$"):
        mamttsp.nowhere
