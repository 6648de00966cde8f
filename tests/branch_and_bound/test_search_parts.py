"""The parts of the branch and bound, each against a definition that can be checked by enumeration."""

import itertools

import numpy as np
import pytest

from mamttsp import build_graph, generate
from mamttsp.branch_and_bound.beam import beam_routes
from mamttsp.branch_and_bound.branching import branch
from mamttsp.branch_and_bound.loads import enough_agents, fits
from mamttsp.branch_and_bound.perspective import Perspective
from mamttsp.branch_and_bound.propagation import propagate
from mamttsp.branch_and_bound.pseudo_costs import FLOWN, NOT_FLOWN, PseudoCosts
from mamttsp.branch_and_bound.rounding import round_flow
from mamttsp.branch_and_bound.separation import depot_cuts, violated_sets
from mamttsp.branch_and_bound.successions import AFTER, BEFORE, neighbours
from mamttsp.flow import read_flow
from mamttsp.formulations import build_formulation
from mamttsp.timing import best_times, best_tours, earliest_times
from tests.examples import agents, general, instance, still
from tests.oracle import optimum

INSTANCES = [generate(3, 60, 2, seed=3), generate(4, 40, 1, seed=2), generate(4, 20, 2, seed=5)]


def _routes(graph):
    """Return every route through all targets, as tuples of segments, that one agent can fly."""
    clusters = [graph.C(u).tolist() for u in range(graph.n_targets)]
    orders = (route for order in itertools.permutations(clusters) for route in itertools.product(*order))
    return [route for route in orders if earliest_times(graph, route) is not None]


def _edges_of(graph, route):
    stops = [graph.s, *route, graph.s_prime]
    number = {tuple(edge): e for e, edge in enumerate(graph.edges.tolist())}
    return np.array([number[edge] for edge in zip(stops[:-1], stops[1:])])


def _relaxation(problem):
    graph = build_graph(problem)
    program = build_formulation("micp", "cvxpy", graph, problem.n_agents).conic_program().relaxed()
    return graph, Perspective(program, graph, graph.counts)


def _only(graph, edges):
    alive = np.zeros(len(graph.edges), dtype=bool)
    alive[edges] = True
    return alive


@pytest.mark.parametrize("problem", INSTANCES)
def test_propagation_keeps_every_route_and_its_times(problem):
    graph = build_graph(problem)
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    assert not alive.all()
    for route in _routes(graph):
        edges = _edges_of(graph, route)
        assert alive[edges].all()
        for visits in (earliest_times(graph, route), best_times(graph, list(route))[1]):
            leave, arrive = np.array([0.0, *visits]), np.array([*visits, graph.horizon])
            assert (times[edges, 0] <= leave + 1e-6).all() and (leave <= times[edges, 1] + 1e-6).all()
            assert (times[edges, 2] <= arrive + 1e-6).all() and (arrive <= times[edges, 3] + 1e-6).all()


@pytest.mark.parametrize("problem", INSTANCES)
def test_an_only_agent_keeps_its_routes(problem):
    graph = build_graph(problem)
    several, _ = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    alive, _ = propagate(graph, np.ones(len(graph.edges), dtype=bool), alone=True)
    assert (alive <= several).all() and alive.sum() < several.sum()
    assert all(alive[_edges_of(graph, route)].all() for route in _routes(graph))


def test_an_only_agent_misses_no_target():
    """Two parked targets, of which the first closes before the second opens."""
    graph = build_graph(instance(still(5, 0, ((2.0, 4.0),)), still(0, 5, ((20.0, 30.0),))))
    everything = np.ones(len(graph.edges), dtype=bool)
    s, s_prime = graph.s, graph.s_prime
    assert {(s, 2), (1, s_prime)} <= set(map(tuple, graph.edges[propagate(graph, everything)[0]].tolist()))
    assert graph.edges[propagate(graph, everything, alone=True)[0]].tolist() == [[s, 1], [1, 2], [2, s_prime]]


def test_propagation_along_one_route_starts_at_its_earliest_times():
    graph = build_graph(INSTANCES[1])
    route = _routes(graph)[0]
    edges = _edges_of(graph, route)
    _, times = propagate(graph, _only(graph, edges))
    assert times[edges[:-1], 2] == pytest.approx(earliest_times(graph, route), abs=1e-6)


def test_propagation_sees_that_a_target_cannot_be_reached():
    graph = build_graph(INSTANCES[0])
    assert propagate(graph, graph.tau[graph.edges[:, 1]] != 1) is None


@pytest.mark.parametrize("problem", INSTANCES)
def test_on_one_route_the_relaxation_is_its_length(problem):
    graph, relaxation = _relaxation(problem)
    for route in _routes(graph)[:10]:
        alive, times = propagate(graph, _only(graph, _edges_of(graph, route)))
        length = best_times(graph, list(route))[0]
        assert length * (1 - 1e-6) <= relaxation.relax(alive, times).bound <= length * (1 + 1e-8)


@pytest.mark.parametrize("problem", INSTANCES)
def test_the_matrix_of_a_relaxation_is_the_programs_with_its_variables_put_in(problem):
    graph, relaxation = _relaxation(problem)
    alive, times = propagate(graph, np.arange(len(graph.edges)) % 3 > 0)
    e, rows, program = np.flatnonzero(alive), relaxation.rows, relaxation.program
    lo, width = relaxation._intervals(e, times[e])
    cones = (rows.cone[e][:, None] + np.arange(3)).ravel()
    entries, core = relaxation.entries.on(alive), np.concatenate([rows.zero, rows.joint, rows.speed[e]])
    A, n_signs = entries.matrix(core, cones, relaxation.K, relaxation.R, lo, width)
    alpha, y, l, u = np.split(np.random.default_rng(0).random(A.shape[1]), np.cumsum([relaxation.K, len(e), len(e)]))
    x, share = np.zeros(len(program.c)), np.zeros(width.shape)
    share[width > 0] = u
    x[np.atleast_1d(program.columns["alpha"])] = alpha
    x[program.columns["y"][e]], x[program.columns["l"][e]] = y, relaxation.R * l
    for name, least, wide, part in zip(relaxation.names, lo, width, share):
        x[program.columns[name][e]] = least * y + wide * part
    found = A @ np.concatenate([alpha, y, l, u])
    assert np.delete(found, np.s_[len(core) : len(core) + n_signs]) == pytest.approx(
        (program.A @ x)[np.concatenate([core, cones])], abs=1e-9
    )
    signs = found[len(core) : len(core) + n_signs]
    assert signs[: len(u)] == pytest.approx(-u) and signs[len(u) : 2 * len(u)] == pytest.approx((share - y)[width > 0])


@pytest.mark.parametrize("problem", INSTANCES)
def test_no_route_is_shorter_than_the_bound_with_what_its_edges_add(problem):
    graph, relaxation = _relaxation(problem)
    relaxed = relaxation.relax(*propagate(graph, np.ones(len(graph.edges), dtype=bool)))
    assert relaxed.extra.max() > 0.1 * relaxed.bound
    for route in _routes(graph):
        length = best_times(graph, list(route))[0]
        assert relaxed.bound + relaxed.extra[_edges_of(graph, route)].max() <= length * (1 + 1e-8)


@pytest.mark.parametrize("problem", INSTANCES)
def test_what_follows_an_edge_is_what_routes_fly(problem):
    graph = build_graph(problem)
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    tail, head = graph.edges.T
    edges = np.arange(len(alive))
    after, before = (neighbours(graph, edges, side, alive, times) for side in (AFTER, BEFORE))
    joined = (head[:, None] == tail) & alive
    assert (after <= joined).all() and 0 < after[alive].sum() < joined[alive].sum()
    assert (after[np.ix_(alive, alive)] == before[np.ix_(alive, alive)].T).all()
    for route in _routes(graph):
        own = _edges_of(graph, route)
        assert after[own[:-1], own[1:]].all()


@pytest.mark.parametrize("problem", [generate(4, 60, 2, 1), generate(3, 60, 2, 3), generate(4, 40, 1, 5)])
def test_demands_on_two_edges_in_a_row_raise_the_bound_and_cut_off_no_route(problem):
    graph, relaxation = _relaxation(problem)
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    relaxed = relaxation.relax(alive, times)
    assert relaxation.successions.demand(relaxed.y, alive, times)
    number, row, edge, value = relaxation.successions.rows(alive, times)
    assert np.bincount(row, value * relaxed.y[edge], minlength=number).min() > 0.02 - 1e-9
    for route in _routes(graph):
        y = _only(graph, _edges_of(graph, route)).astype(float)
        assert not relaxation.successions.demand(y, alive, times)
        assert np.bincount(row, value * y[edge], minlength=number).max() <= 0.0
    again = relaxation.relax(alive, times).bound
    assert relaxed.bound < again <= min(best_times(graph, list(route))[0] for route in _routes(graph)) * (1 + 1e-8)


@pytest.mark.parametrize("problem", INSTANCES)
def test_branching_loses_no_route_and_shares_none(problem):
    graph, relaxation = _relaxation(problem)
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    children = branch(graph, relaxation.relax(alive, times).y, alive, PseudoCosts(graph))[:2]
    assert all((child <= alive).all() and child.sum() < alive.sum() for child in children)
    for route in _routes(graph):
        assert sum(child[_edges_of(graph, route)].all() for child in children) == 1


def test_nothing_is_left_to_branch_on_in_one_route():
    graph = build_graph(INSTANCES[1])
    alive = _only(graph, _edges_of(graph, _routes(graph)[0]))
    assert branch(graph, alive.astype(float), alive, PseudoCosts(graph)) is None


def test_branching_goes_where_it_raised_the_bound():
    graph, relaxation = _relaxation(INSTANCES[0])
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    y, costs = relaxation.relax(alive, times).y, PseudoCosts(graph)
    flow = costs.flow(y, alive)
    fractional = np.flatnonzero((flow > 1e-3) & (flow < 1 - 1e-3))
    assert len(fractional) > 1
    for pair in fractional:
        costs = PseudoCosts(graph)
        for side in (FLOWN, NOT_FLOWN):
            costs.learn(side, pair, flow[pair], 1e3)
            costs.learn(side, 0, 0.5, 0.0)
        chosen = branch(graph, y, alive, costs)
        assert (chosen.pair, chosen.flow) == (pair, flow[pair])
        assert (costs.pair[chosen.flown & ~chosen.other] == pair).all()
        assert (costs.pair[chosen.other] != pair).all()


def _flow(graph, *paths):
    """Return (|E|,) the sum of flows (share, nodes), each along its nodes."""
    number = {edge: e for e, edge in enumerate(map(tuple, graph.edges.tolist()))}
    y = np.zeros(len(number))
    for share, nodes in paths:
        np.add.at(y, [number[edge] for edge in itertools.pairwise(nodes)], share)
    return y


def _shares(graph, *paths):
    return [share for share, _ in depot_cuts(graph, _flow(graph, *paths))]


def test_what_reaches_a_target_from_the_depot():
    graph = build_graph(instance(still(5, 0), still(0, 5), still(5, 5), still(9, 9)))
    s, s_prime = graph.s, graph.s_prime
    assert _shares(graph, (1, [s, 1, 2, 3, 4, s_prime])) == [1, 1, 1, 1]
    # A tour of all four, half flown, and a cycle of 2 and 3, half flown, which nothing but the tour enters.
    half = (0.5, [s, 1, 2, 3, 4, s_prime]), (0.5, [s, 1, 4, s_prime]), (0.5, [2, 3, 2])
    assert _shares(graph, *half) == [1, 0.5, 0.5, 1]
    assert violated_sets(graph, _flow(graph, *half)) == [(1, 2)]


@pytest.mark.parametrize("seed", range(6))
def test_a_violated_set_is_found_where_there_is_one(seed):
    """Half of a tour and half of another flow of paths and cycles, against all sets of targets."""
    graph = build_graph(generate(5, 10, 1, seed=seed))
    rng = np.random.default_rng(seed)
    y = (_random_flow(graph, rng) + _random_flow(graph, rng)) / 2
    tail, head = graph.tau[graph.edges.T]
    short = set()
    for size in range(2, 6):
        for S in itertools.combinations(range(5), size):
            if y[~np.isin(tail, S) & np.isin(head, S)].sum() < 0.98:
                short.add(S)
    found = violated_sets(graph, y)
    assert bool(found) == bool(short) and set(found) <= short


def _random_flow(graph, rng):
    """Return a flow that enters and leaves the first segment of each target once, in paths and cycles."""
    nodes = [graph.C(u)[0] for u in range(graph.n_targets)]
    after = dict(zip(nodes, rng.permutation(nodes)))
    hops = {(i, j) for i, j in after.items() if i != j}
    flow = hops.union(*({(graph.s, i), (i, graph.s_prime)} for i, j in after.items() if i == j))
    return np.array([float(tuple(edge) in flow) for edge in graph.edges.tolist()])


@pytest.mark.parametrize("problem", INSTANCES)
def test_rounding_finds_the_tours_of_a_whole_flow(problem):
    graph = build_graph(problem)
    everything = np.ones(len(graph.edges), dtype=bool)
    for route in _routes(graph)[:10]:
        y = _only(graph, _edges_of(graph, route)).astype(float)
        assert round_flow(graph, y, everything, graph.counts) == [route] == list(read_flow(graph, y).paths)


def test_rounding_makes_no_more_routes_than_agents():
    problem = generate(6, 40, 1, seed=1)
    graph, relaxation = _relaxation(problem)
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    y = relaxation.relax(alive, times).y
    for m in (1, 2, 6):
        routes = round_flow(graph, y, alive, np.array([m]))
        assert routes is None or len(routes) <= m
        assert routes is None or sorted(graph.tau[list(itertools.chain(*routes))]) == list(range(6))
    assert routes is not None and all(earliest_times(graph, route) is not None for route in routes)


@pytest.mark.parametrize("n, window, m, seed", [(4, 20, 1, 3), (4, 60, 2, 1), (6, 40, 1, 1), (6, 40, 3, 1)])
def test_first_tours_are_near_the_optimum(n, window, m, seed):
    problem = generate(n, window, m, seed)
    graph, relaxation = _relaxation(problem)
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    found = beam_routes(graph, relaxation.relax(alive, times).extra, alive, times, graph.counts)
    for routes in found:
        assert routes == sorted(routes) and len(routes) <= m
        assert sorted(graph.tau[list(itertools.chain(*routes))]) == list(range(n))
        assert all(alive[_edges_of(graph, route)].all() for route in routes)
    lengths = [best_tours(graph, list(map(list, routes)))[0] for routes in found]
    assert optimum(problem) * (1 - 1e-9) <= min(lengths) <= optimum(problem) * 1.1


def test_first_tours_of_unlike_agents_with_loads():
    types = [agents(capacity=2.0), agents(depot=(20.0, 0.0), max_speed=6.0, capacity=3.0)]
    where = [(5, 0), (10, 5), (20, 5), (15, -5)]
    graph = build_graph(general(*(still(x, y, demand=1.0) for x, y in where), types=types))
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    found = beam_routes(graph, np.zeros(len(alive)), alive, times, graph.counts)
    assert found
    for routes in found:
        assert sorted(graph.tau[list(itertools.chain(*routes))]) == [0, 1, 2, 3]
        assert enough_agents(graph, graph.counts, routes) and all(fits(graph, route) for route in routes)
        assert {len(route) for route in routes} <= {1, 2, 3}


def test_no_first_tours_where_there_are_none():
    """Two targets in opposite directions at the same time, and one agent."""
    graph = build_graph(instance(*(still(x, 0, ((10.0, 12.0),)) for x in (30, -30))))
    alive, times = propagate(graph, np.ones(len(graph.edges), dtype=bool))
    assert beam_routes(graph, np.zeros(len(alive)), alive, times, np.array([1])) == []
    found = beam_routes(graph, np.zeros(len(alive)), alive, times, np.array([2]))
    assert found and all(routes == [(1,), (2,)] for routes in found)
