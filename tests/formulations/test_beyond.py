"""Several types of agents and capacities in the formulations: the same models where nothing is new, documented families
where something is, sizes that grow with types, points and residuals, and the cycles that nobody flies."""

import itertools

import numpy as np
import pyomo.environ as pyo
import pytest

from mamttsp import InputError, Instance, build_graph, check, generate, solve
from mamttsp.flow import read_flow
from mamttsp.formulations import METHODS, build_formulation, graph_for
from mamttsp.formulations.equations import BEYOND, EQUATIONS
from mamttsp.formulations.points import assign, recover
from mamttsp.formulations.residuals import objective, residuals
from mamttsp.formulations.statistics import closed_form
from mamttsp.study.meetings import passing
from tests.examples import agents, general, moving, still
from tests.general_instances import random_general
from tests.models import MODELS
from tests.oracle import optimum

TOLERANCE = 1e-6
UNLIKE = random_general(3, 2, 5)  # capacities bind, ends differ from depots


def built(method, modeler, instance, prune=False):
    return build_formulation(method, modeler, graph_for(method, instance, prune))


def families_of(formulation):
    """Return the names of the families of constraints that have rows, cuts aside."""
    if formulation.modeler == "cvxpy":
        return set(formulation.model.constraints)
    rows = formulation.model.component_objects(pyo.Constraint)
    return {family.local_name for family in rows if len(family)}


# --- Where nothing is new --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method, modeler", MODELS)
def test_version_2_that_says_nothing_new_gives_the_same_model(method, modeler):
    plain = generate(3, 20, 2, seed=1)
    entry = {"count": 2, "depot": [0.0, 0.0], "max_speed": 4.0, "end": [0.0, 0.0]}
    data = {name: value for name, value in plain.to_dict().items() if name not in ("n_agents", "depot", "max_speed")}
    same = Instance.from_dict(data | {"version": 2, "agents": [entry]})
    roomy = Instance.from_dict(data | {"version": 2, "agents": [entry | {"capacity": 3.0}]})  # nothing to carry
    reference = built(method, modeler, plain)
    for instance in (same, roomy):
        found = built(method, modeler, instance)
        assert found.statistics() == reference.statistics()
        assert families_of(found) == families_of(reference) == set(EQUATIONS[method])
        if method != "nonconvex":
            ours, theirs = (formulation.conic_program() for formulation in (found, reference))
            assert (ours.A != theirs.A).nnz == 0 and (ours.b == theirs.b).all() and (ours.c == theirs.c).all()


def test_version_2_that_says_nothing_new_has_the_same_answer():
    plain = generate(4, 20, 2, seed=2)
    demands = [{**target.to_dict(), "demand": 1.0} for target in plain.targets]
    entry = {"count": 2, "depot": [0.0, 0.0], "max_speed": 4.0, "capacity": 4.0}
    full = Instance.from_dict(
        {"format": "mamttsp-instance", "version": 2, "horizon": 150.0, "agents": [entry], "targets": demands}
    )
    expected, found = (solve(instance, method="micp") for instance in (plain, full))
    assert found.objective == expected.objective and found.nodes == expected.nodes
    assert [tour.visits for tour in found.tours] == [tour.visits for tour in expected.tours]


# --- What is new -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method, modeler", MODELS)
def test_the_families_are_those_of_the_paper_and_those_beyond(method, modeler):
    assert families_of(built(method, modeler, UNLIKE)) == {*EQUATIONS[method], *BEYOND[method]}


@pytest.mark.parametrize("method", METHODS)
def test_each_family_beyond_says_which_equation_it_generalises(method):
    model = built(method, "pyomo", UNLIKE).model
    for name, equation in BEYOND[method].items():
        said = "(new) " if equation is None else f"({equation}) for "
        assert model.component(name).doc.startswith(said)


def test_loads_by_hand():
    """On the way from i to j the load has the demand of i and room for that of j; out of the depot there is none."""
    heavy = [still(10, 0, demand=2.0), still(0, 10, demand=1.5), still(9, 9)]
    model = built("micp", "pyomo", general(*heavy, types=[agents(2, capacity=2.5)])).model
    for y, q in zip(model.y.values(), model.q.values()):
        y.set_value(1)
        q.set_value(0.0)
    least = {e: pyo.value(model.load_at_least[e].body) for e in model.E}  # least * y - q <= 0
    most = {e: -pyo.value(model.load_at_most[e].body) for e in model.E}  # q - most * y <= 0
    assert [least[0, 1], least[1, 2], least[2, 1], least[3, 4]] == pytest.approx([0.0, 2.0, 1.5, 0.0])
    assert [most[0, 1], most[1, 2], most[2, 3], most[1, 4]] == pytest.approx([0.0, 1.0, 2.5, 2.5])
    for y in model.y.values():
        y.set_value(0)
    model.y[0, 1].set_value(1)
    model.q[1, 2].set_value(2.0)  # as much as the visit of target 0, of demand 2, adds
    assert pyo.value(model.load_conservation[1].body) == pytest.approx(pyo.value(model.load_conservation[1].upper))
    model.q[1, 2].set_value(1.9)
    assert pyo.value(model.load_conservation[1].body) != pytest.approx(pyo.value(model.load_conservation[1].upper))


@pytest.mark.parametrize("modeler", ("pyomo", "cvxpy"))
def test_the_micp_grows_with_types_and_the_other_models_with_agents(modeler):
    def sizes(method, *counts):
        types = [agents(count, depot=(10.0 * k, 0.0)) for k, count in enumerate(counts)]
        return built(
            method, modeler, general(still(1, 1), moving((20, 0), (0, 0.5)), still(3, 9), types=types)
        ).statistics()

    assert sizes("micp", 1, 1) == sizes("micp", 2, 5)
    assert sizes("micp", 1, 1, 1).cones == 3 * sizes("micp", 7).cones
    assert sizes("baseline", 2, 2) == sizes("baseline", 1, 3)
    assert sizes("baseline", 2, 2).cones == 2 * sizes("baseline", 1, 1).cones == sizes("baseline", 4).cones


@pytest.mark.parametrize("modeler", ("pyomo", "cvxpy"))
def test_the_size_of_the_general_micp_in_closed_form(modeler):
    """K layers of |V| nodes and |E| edges are as one of K |V| and K |E|, but for the depots; loads add a variable an
    edge, a row a segment and two rows an edge."""
    K, one = len(UNLIKE.agents), build_graph(Instance(UNLIKE.targets, agents=UNLIKE.agents[:1], horizon=UNLIKE.horizon))
    V_seg, E, n = K * (len(one.tau) - 2), K * len(one.edges), UNLIKE.n_targets
    plain = closed_form("micp", n, 1, V_seg + 2, E)
    found = built("micp", modeler, UNLIKE).statistics()
    assert found == plain._replace(
        variables=plain.variables + (K - 1) + E,
        integers=K,
        linear_rows=plain.linear_rows + 4 * (K - 1) + 1 + V_seg + 2 * E,
    )


# --- Points ----------------------------------------------------------------------------------------------------------

CARRIED = [(3, 1, 7), (3, 2, 5), (3, 2, 10), (3, 3, 3), (3, 3, 8)]


@pytest.mark.parametrize("which", CARRIED)
@pytest.mark.parametrize("method, modeler", MODELS)
def test_tours_are_carried_into_each_formulation_and_back(method, modeler, which):
    instance = random_general(*which)
    solution = solve(instance, method="micp")
    formulation = built(method, modeler, instance, prune=True)
    assign(formulation, solution.tours)
    found = residuals(formulation.model)
    assert max(found.values()) < TOLERANCE, found
    assert objective(formulation.model) == pytest.approx(solution.objective, rel=TOLERANCE)
    back, cycles = recover(formulation)
    assert cycles == () and check(instance, back) == pytest.approx(solution.objective, rel=TOLERANCE)
    assert sorted(tour.agent for tour in back) == sorted(tour.agent for tour in solution.tours)


@pytest.mark.parametrize("method, modeler", MODELS)
def test_too_much_load_breaks_the_capacity_rows_and_nothing_else(method, modeler):
    instance = random_general(3, 2, 5)
    free = Instance([_weighing(target, 0.0) for target in instance.targets], agents=instance.agents, horizon=150.0)
    solution = solve(free, method="micp")
    assert optimum(free) < optimum(instance) * 0.999
    formulation = built(method, modeler, instance)
    assign(formulation, solution.tours)
    broken = {family for family, worst in residuals(formulation.model).items() if worst > TOLERANCE}
    assert broken and broken <= ({"load_at_most"} if method == "micp" else {"capacity"})


def _weighing(target, demand):
    return type(target)(target.times, target.points, target.windows, demand)


@pytest.mark.parametrize("method", METHODS)
def test_more_tours_of_a_type_than_agents_are_refused(method):
    instance = random_general(3, 2, 10)
    tour = next(tour for tour in solve(instance, method="micp").tours if tour.agent == 0)
    with pytest.raises(InputError, match="^tours: 3 tours for 1 agent of type 0$"):
        assign(built(method, "pyomo", instance), [tour] * 3)


# --- Cycles that nobody flies ----------------------------------------------------------------------------------------


def _meeting(types, demand=0.0):
    """Two targets that meet far from the depot, and a third that stays near it."""
    targets = [_weighing(target, demand) for target in passing().targets]
    return general(*targets, types=types)


CYCLE_ROUTES = [("micp", "cvxpy", "scip"), ("micp", "pyomo", "clarabel"), ("baseline", "cvxpy", "scip")]
FLEETS = {
    "a type that needs no flight": [agents(), agents(1, depot=(0.0, -5.0))],
    "an end that the targets pass": [agents(1, end=(60.0, 0.0)), agents()],
    "a depot where they meet": [agents(), agents(1, depot=(60.0, 0.0), end=(0.0, 0.0))],
    "an end on a target's path all the time": [agents(1, end=(10.0, 0.0))],
}


@pytest.mark.parametrize("fleet", FLEETS)
@pytest.mark.parametrize("route", CYCLE_ROUTES, ids="-".join)
def test_zero_length_cycles_are_cut_for_every_type(fleet, route):
    instance = _meeting(FLEETS[fleet])
    solution = solve(instance, *route)
    assert solution.status == "optimal" and solution.objective == pytest.approx(optimum(instance), rel=1e-4)


@pytest.mark.parametrize("fleet", ["a type that needs no flight", "an end on a target's path all the time"])
def test_without_cuts_the_hole_is_there_for_types_too(fleet):
    plain = solve(_meeting(FLEETS[fleet]), method="micp", solver="scip", subtour_cuts=False)
    assert plain.cycles and plain.objective < optimum(_meeting(FLEETS[fleet])) * 0.5


def test_the_hole_is_in_each_layer_and_one_cut_closes_all():
    instance = _meeting([agents(), agents(1, depot=(0.0, -5.0)), agents(1, max_speed=6.0)])
    formulation = built("micp", "pyomo", instance)
    graph = formulation.graph
    formulation.add_subtour_cut([1, 2])
    (cut,) = formulation.model.subtour_cuts.values()
    for layer in range(3):
        a, b = (int(graph.C(u)[graph.layer[graph.C(u)] == layer][0]) for u in (1, 2))
        for e, y in formulation.model.y.items():
            y.set_value(e in {(a, b), (b, a)})
        assert cut.slack() == -1


def test_loads_leave_no_cycle_through_a_demand():
    """The load grows along an edge by the demand of its tail, so a cycle with a demand cannot close."""
    light, bound = ([agents(1, capacity=c), agents(1, depot=(0.0, -5.0), capacity=c)] for c in (9.0, 2.0))
    open_hole = solve(_meeting(light, demand=1.0), method="micp", solver="scip", subtour_cuts=False)
    closed = solve(_meeting(bound, demand=1.0), method="micp", solver="scip", subtour_cuts=False)
    assert open_hole.cycles and not closed.cycles
    assert closed.objective == pytest.approx(optimum(_meeting(bound, demand=1.0)), rel=1e-4)


def test_flow_is_read_layer_by_layer():
    graph = build_graph(general(still(1, 0), still(2, 0), still(3, 0), types=[agents(), agents(end=(9.0, 0.0))]))
    flow = np.zeros(len(graph.edges))
    for route in ((0, 1, 4), (5, 8, 7, 9)):
        for edge in itertools.pairwise(route):
            flow[graph.edges.tolist().index(list(edge))] = 1.0
    assert read_flow(graph, flow) == (((1,), (8, 7)), ())
