"""The models with cones of `pyomo.kernel`: what they consist of, and that they mean the same."""

import pyomo.environ as pyo
import pyomo.kernel as pmo
import pyscipopt
import pytest

from mamttsp import InputError, build_graph, generate
from mamttsp.backends.scip_models import ipopt_options
from mamttsp.formulations import build_formulation
from mamttsp.formulations.pyomo.kernel import to_kernel
from tests.oracle import optimum

CONVEX = ("baseline", "micp")


@pytest.fixture(scope="module")
def instance():
    return generate(3, 20, 2, seed=1)


@pytest.mark.parametrize("method", CONVEX)
def test_structure(instance, method):
    formulation = build_formulation(method, "pyomo", build_graph(instance), 2)
    formulation.add_subtour_cut([0, 1])
    model, block, sizes = formulation.model, to_kernel(formulation.model), formulation.statistics()
    rows = [row for family in model.component_objects(pyo.Constraint) for row in members(block, family)]
    assert sum(isinstance(row, pmo.conic.quadratic) for row in rows) == sizes.cones
    assert sum(isinstance(row, pmo.linear_constraint) for row in rows) == len(rows) - sizes.cones
    variables = [v for family in model.component_objects(pyo.Var) for v in members(block, family)]
    assert len(variables) == sizes.variables
    assert sum(v.is_binary() for v in variables) == sizes.binaries
    assert sum(v.is_integer() for v in variables) == sizes.binaries + sizes.integers
    edge = next(iter(model.norm))
    length = block.l_bar if method == "baseline" else block.l
    assert block.norm[edge].r is length[edge]
    assert all(x is block.l_xy[*edge, k] for k, x in enumerate(block.norm[edge].x))


def members(block, family):
    """Return what a block has under the name of a Pyomo family, as many entries as the family."""
    twin = getattr(block, family.local_name)
    twins = list(twin.values()) if family.is_indexed() else [twin]
    assert len(twins) == len(family)
    return twins


@pytest.mark.parametrize("method", CONVEX)
def test_optimum(instance, method, tmp_path):
    block = to_kernel(build_formulation(method, "pyomo", build_graph(instance), 2).model)
    block.write(str(tmp_path / "model.nl"))
    scip = pyscipopt.Model()
    scip.hideOutput()
    scip.readProblem(str(tmp_path / "model.nl"))
    with ipopt_options() as path:
        scip.setParam("nlpi/ipopt/optfile", str(path))
        scip.optimize()
    assert scip.getStatus() == "optimal"
    assert scip.getObjVal() == pytest.approx(optimum(instance), rel=1e-4)


def test_products_are_no_cones(instance):
    model = build_formulation("nonconvex", "pyomo", build_graph(instance), 1).model
    with pytest.raises(InputError, match="products of variables"):
        to_kernel(model)
