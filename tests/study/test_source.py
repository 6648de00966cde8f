"""The code that is shown is the library's, for every family, and an unknown name is refused."""

import inspect

import pytest

from mamttsp import InputError
from mamttsp.formulations.equations import EQUATIONS
from mamttsp.formulations.pyomo import baseline, by_agent, micp, nonconvex
from mamttsp.study.source import source

MODULES = {"baseline": baseline, "nonconvex": nonconvex, "micp": micp}


@pytest.mark.parametrize("method", EQUATIONS)
def test_every_family_is_shown_with_its_equation_as_it_stands(method):
    library = inspect.getsource(MODULES[method]) + inspect.getsource(by_agent)
    for family, equation in EQUATIONS[method].items():
        shown = source(method, family).splitlines()
        assert shown[0].startswith("@m.Constraint(") and f'doc="({equation}) ' in shown[0]
        assert shown[1] == next(line.strip() for line in library.splitlines() if f"def {family}(" in line)
        assert any(line.lstrip().startswith("return ") for line in shown)
        assert all(f"    {line}\n" in library for line in shown)


def test_the_objective_and_several_families_at_once():
    shown = source("baseline", "length", "speed")
    assert shown.startswith('@m.Objective(doc="(1) ') and '\n\n@m.Constraint(E, V_agt, doc="(7) ' in shown


def test_a_family_of_the_formulation_itself_comes_before_the_shared_one():
    assert '"(5) ' in source("baseline", "flow_conservation")
    assert '"(22) ' in source("micp", "flow_conservation")


UNKNOWN = [("exact", "speed"), ("micp", "big_m"), ("micp", "depot_flow_out"), ("baseline", "nothing")]


@pytest.mark.parametrize("method, family", UNKNOWN)
def test_an_unknown_name_is_refused(method, family):
    with pytest.raises(InputError, match="expected"):
        source(method, family)
