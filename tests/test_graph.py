"""The graph of Section III: segments, clusters, edges and their pruning."""

import itertools

import numpy as np
import pytest

from mamttsp import InputError, Target, build_graph, generate
from mamttsp.graph import segments
from mamttsp.timing import earliest_times
from tests.examples import HORIZON, agents, general, instance, moving, still

BENT = Target([0.0, 40.0, 60.0, 100.0], [[0, 0], [40, 0], [40, 10], [0, 10]], [(30, 70), (80, 90)])


def test_segments_are_cut_at_bends_and_window_ends():
    spans = [(t_lo, t_hi) for t_lo, t_hi, *_ in segments(BENT)]
    assert spans == [(30, 40), (40, 60), (60, 70), (80, 90)]


def test_a_segment_runs_from_end_to_end_at_its_velocity():
    graph = build_graph(instance(BENT))
    for i in graph.V_seg:
        assert graph.position(i, graph.t_hi[i]) == pytest.approx(graph.p_hi[i])
        assert BENT.position(graph.t_lo[i]) == pytest.approx(graph.p_lo[i])
    assert graph.v[1:-1] == pytest.approx(np.array([[1, 0], [0, 0.5], [-1, 0], [-1, 0]]))


def test_a_window_of_one_moment_is_one_segment():
    graph = build_graph(instance(moving((0, 0), (1, 2), [(10, 10)])))
    assert list(graph.V_seg) == [1]
    assert graph.p_lo[1] == pytest.approx([10, 20]) and graph.v[1] == pytest.approx([1, 2])


def test_depot_nodes():
    graph = build_graph(instance(still(1, 1), still(2, 2)))
    assert (graph.s, graph.s_prime) == (0, 3)
    assert (graph.t_lo[[0, 3]] == 0).all() and graph.t_hi[0] == 0 and graph.t_hi[3] == HORIZON
    assert not graph.v[[0, 3]].any() and (graph.tau[[0, 3]] == -1).all()


def test_the_edges_are_those_of_the_paper():
    graph = build_graph(generate(4, 40, seed=1))
    V_seg, s, s_prime = graph.V_seg, graph.s, graph.s_prime
    wanted = {(s, i) for i in V_seg} | {(i, s_prime) for i in V_seg}
    wanted |= {(i, j) for i, j in itertools.permutations(V_seg, 2) if graph.tau[i] != graph.tau[j]}
    assert set(map(tuple, graph.edges.tolist())) == wanted
    assert len(graph.edges) == len(wanted)


def test_clusters_share_out_the_segments():
    graph = build_graph(generate(4, 40, seed=1))
    assert sorted(i for u in range(graph.n_targets) for i in graph.C(u)) == list(graph.V_seg)


def test_edges_into_and_out_of_a_node():
    graph = build_graph(generate(3, 20, seed=1))
    for i in graph.V_seg:
        assert {j for _, j in graph.edges[graph.into(i)]} == {i} == {k for k, _ in graph.edges[graph.out_of(i)]}
    assert len(graph.into(graph.s)) == len(graph.out_of(graph.s_prime)) == 0


@pytest.mark.parametrize("seed", range(4))
def test_pruning_drops_exactly_the_edges_that_cannot_be_flown(seed):
    instance = generate(5, 40, seed=seed)
    graph, pruned = build_graph(instance), build_graph(instance, prune=True)
    kept = set(map(tuple, pruned.edges.tolist()))
    assert 0 < len(kept) < len(graph.edges)
    for i, j in graph.edges.tolist():
        assert ((i, j) in kept) == _can_be_flown(graph, i, j)


def _can_be_flown(graph, i, j):
    """Tell by sampling: leave i at some time and be at j at some later time."""
    leave, arrive = (np.linspace(graph.t_lo[k], graph.t_hi[k], 60) for k in (i, j))
    ways = np.linalg.norm(graph.position(j, arrive[:, None])[None] - graph.position(i, leave[:, None])[:, None], axis=2)
    return bool((ways <= graph.max_speed * (arrive[None] - leave[:, None]) + 1e-9).any())


def test_pruning_loses_no_flyable_route():
    instance = generate(4, 40, seed=3)
    graph, kept = build_graph(instance), set(map(tuple, build_graph(instance, prune=True).edges.tolist()))
    flyable = 0
    for i, j, k in itertools.permutations(graph.V_seg, 3):
        if len({*graph.tau[[i, j, k]]}) == 3 and earliest_times(graph, [i, j, k]) is not None:
            flyable += 1
            assert {(i, j), (j, k)} <= kept
    assert flyable


# --- Types of agents -------------------------------------------------------------------------------------------------


def _layered(prune=False):
    slow, fast = agents(2, max_speed=1.0), agents(1, (20.0, 0.0), 9.0, end=(0.0, 20.0), capacity=1.0)
    return build_graph(general(still(5, 0, [(6, 60)], 2.0), still(90, 0, [(10, 20)]), types=[slow, fast]), prune)


def test_each_type_has_a_layer_with_a_depot_and_an_end_of_its_own():
    graph = _layered()
    assert graph.layer.tolist() == [0] * 4 + [1] * 4 and graph.tau.tolist() == [-1, 0, 1, -1] * 2
    assert (graph.starts.tolist(), graph.ends.tolist(), graph.V_seg) == ([0, 4], [3, 7], [1, 2, 5, 6])
    assert graph.p_lo[graph.starts].tolist() == [[0, 0], [20, 0]] and graph.p_lo[graph.ends].tolist() == [
        [0, 0],
        [0, 20],
    ]
    assert (graph.t_hi[graph.starts] == 0).all() and (graph.t_hi[graph.ends] == HORIZON).all()
    assert graph.C(1).tolist() == [2, 6] and graph.n_targets == 2
    assert (
        graph.speeds.tolist() == [1.0, 9.0]
        and graph.capacities.tolist() == [np.inf, 1.0]
        and graph.demands.tolist() == [2, 0]
    )
    assert graph.loaded and graph.numbered and graph.counts.tolist() == [2, 1]


def test_a_layer_for_each_agent():
    graph = build_graph(general(still(5, 0), types=[agents(2), agents(1, (9.0, 0.0))]), by_agent=True)
    assert graph.layer.tolist() == [0, 0, 0, 1, 1, 1, 2, 2, 2] and graph.types.tolist() == [0, 0, 1]
    assert graph.counts.tolist() == [1, 1, 1] and graph.p_lo[graph.starts].tolist() == [[0, 0], [0, 0], [9, 0]]


def test_edges_stay_in_their_layer():
    graph = _layered()
    one = build_graph(instance(still(5, 0), still(90, 0)))
    assert graph.edges.tolist() == [*one.edges.tolist(), *(one.edges + 4).tolist()]


def test_edges_are_pruned_by_the_speed_of_their_type():
    """Only the fast type reaches the far target by 20, and it cannot carry the near one."""
    graph = _layered(prune=True)
    assert sorted(map(tuple, graph.edges[graph.layer[graph.edges[:, 0]] == 0].tolist())) == [(0, 1), (1, 3), (2, 3)]
    assert sorted(map(tuple, graph.edges[graph.layer[graph.edges[:, 0]] == 1].tolist())) == [(4, 6), (6, 7)]


def test_what_is_of_one_type_is_not_asked_of_several():
    for field in ("s", "s_prime", "max_speed"):
        with pytest.raises(InputError, match="^agents: expected one type here, found 2"):
            getattr(_layered(), field)
