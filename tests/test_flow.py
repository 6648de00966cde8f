"""Reading routes and cycles out of a flow."""

import numpy as np
import pytest

from mamttsp import FlowError, build_graph
from mamttsp.flow import read_flow, shortest_unflyable, targets_of
from tests.examples import instance, still


def _graph(n=4, n_windows=1):
    windows = [(20.0 * k, 20.0 * k + 10.0) for k in range(n_windows)]
    return build_graph(instance(*(still(10 * (u + 1), 0, windows) for u in range(n))))


def _flow(graph, *routes):
    edges = graph.edges.tolist()
    flow = np.zeros(len(edges))
    for route in routes:
        for edge in zip(route[:-1], route[1:]):
            flow[edges.index(list(edge))] += 1.0
    return flow


def test_paths_are_read_in_order():
    graph = _graph()
    routes = read_flow(graph, _flow(graph, (0, 3, 1, 5), (0, 2, 4, 5)))
    assert sorted(routes.paths) == [(2, 4), (3, 1)] and routes.cycles == ()


def test_cycles_that_miss_the_depot_are_told_apart():
    graph = _graph(6)
    routes = read_flow(graph, _flow(graph, (0, 2, 7), (1, 4, 1), (3, 6, 5, 3)))
    assert routes.paths == ((2,),)
    assert sorted(routes.cycles) == [(1, 4), (3, 6, 5)]
    assert sorted(targets_of(graph, routes.cycles)) == [(0, 3), (2, 5, 4)]


def test_targets_of_segments():
    graph = _graph(2, n_windows=2)
    routes = read_flow(graph, _flow(graph, (0, 4, 1, 5)))
    assert targets_of(graph, routes.paths) == ((1, 0),)


def test_a_flow_within_tolerance_of_whole_numbers_is_read_as_whole():
    graph = _graph(2)
    flow = np.abs(_flow(graph, (0, 2, 1, 3)) - 1e-6)
    assert read_flow(graph, flow).paths == ((2, 1),)


@pytest.mark.parametrize(
    "routes",
    [
        [(0, 1, 5)],  # targets 1, 2, 3 are not visited
        [(0, 1, 2, 3, 4, 5), (0, 2, 5)],  # target 1 twice
        [(0, 1, 2, 3, 4)],  # never returns
    ],
)
def test_a_flow_that_is_no_flow_is_an_error(routes):
    graph = _graph()
    with pytest.raises(FlowError, match="once through every target"):
        read_flow(graph, _flow(graph, *routes))


def test_a_path_that_cannot_be_flown_is_cut_to_its_shortest_such_start():
    graph = build_graph(instance(still(40, 0, [(10, 12)]), still(-40, 0, [(13, 15)]), still(0, 10)))
    assert shortest_unflyable(graph, (3, 1, 2)) == (3, 1)
    assert shortest_unflyable(graph, (1, 2, 3)) == (1, 2)
    assert shortest_unflyable(graph, (1, 3)) is None


def test_all_agents_may_stay_at_home_while_cycles_take_all_targets():
    """(2) and (3) allow it, so the baseline and the nonconvex program do where all targets meet."""
    graph = _graph(3)
    assert read_flow(graph, _flow(graph, (1, 3, 2, 1))) == ((), ((1, 3, 2),))
