"""From tours to a value for every variable of a formulation, and back: the maps behind the paper's proof of validity.

The way back is the procedure of Section IV-B, by graph search, together with the cycles that it would miss.
"""

import dataclasses
import itertools
from typing import NamedTuple

import numpy as np

from ..flow import read_flow
from ..timing import best_tours, to_tour
from ..tours import Visit
from ..validation import InputError, counted


def assign(formulation, tours, cycles=()):
    """Give every variable of the formulation its value for these tours; at most m of them, each target once.

    `tours`: a list of Tour. A visit goes to the segment of its target whose time interval holds the visit time.
    `cycles`: sequences of Visit that start and end nowhere, as in the hole of the paper's proof; agent 1 gets them.
    InputError: more tours than agents (of one type), or a hop that is not an edge of the graph.
    """
    flown = _fly(formulation.graph, formulation.counts, [tour for tour in tours if tour.visits], cycles)
    values = _VALUES[formulation.method](formulation.graph, flown)
    for name, value in values.items():
        if hasattr(formulation.model, name):  # q, only where capacities bind
            _set(getattr(formulation.model, name), np.asarray(value, dtype=float))


def begin_from(formulation, tours):
    """Give every variable its value for the tours' orders of segments, flown at their best times.

    The times of the tours as given may hold only within the checker's tolerance, which is wider than a solver's. Where
    their orders cannot be flown to the last digit they are taken as they are, for the solver to judge.
    """
    graph = formulation.graph
    best = best_tours(graph, [list(route) for route in routes_of(graph, formulation.counts, tours)])
    assign(formulation, tours if best is None else best[1])


def routes_of(graph, counts, tours):
    """Return the route (tuple of segments) of each tour that makes a visit; counts: (K,) agents of each layer.

    InputError: more tours of a type than agents.
    """
    flown = [tour for tour in tours if tour.visits]
    return [_route(graph, tour, layer) for tour, (layer, _) in zip(flown, _agents_of(graph, counts, flown))]


def _route(graph, tour, layer):
    return tuple(segment_of(graph, visit.target, visit.time, layer) for visit in tour.visits)


def _set(variable, value):
    """Set a Pyomo variable, a cvxpy variable, or a list of two, one for each coordinate (the last axis of `value`)."""
    if isinstance(variable, list):
        for axis, part in enumerate(variable):
            part.value = value[..., axis]
    elif _is_pyomos(variable):
        for component, number in zip(variable.values(), value.flat, strict=True):
            component.set_value(float(number))
    else:
        variable.value = value


def _is_pyomos(variable):
    """Told apart so, because cvxpy's formulations do without Pyomo."""
    return hasattr(variable, "values")


@dataclasses.dataclass(frozen=True)
class _Flown:
    """What the agents do: y (|E|, m) flow; q (|E|, m) load on the edges flown; t (|V|, m), p (|V|, m, 2) times and
    positions, also of nodes not visited. m: the agents of a layer, or of the largest one."""

    y: np.ndarray
    q: np.ndarray
    t: np.ndarray
    p: np.ndarray


def _fly(graph, counts, tours, cycles):
    edge_number = {tuple(edge): e for e, edge in enumerate(graph.edges.tolist())}
    y = np.zeros((len(graph.edges), max(counts)))
    q = np.zeros_like(y)
    # A node that the agent does not visit takes the start of its interval: inside (6), and big-M frees all the rest.
    t = np.tile(graph.t_lo[:, None], max(counts))
    for k, nodes, times in _walks(graph, counts, tours, cycles):
        load = 0.0
        for hop in itertools.pairwise(nodes):
            if hop not in edge_number:
                raise InputError(f"tours: no edge from node {hop[0]} to node {hop[1]} in the graph")
            load += graph.demands[graph.tau[hop[0]]] if graph.tau[hop[0]] >= 0 else 0.0
            y[edge_number[hop], k], q[edge_number[hop], k] = 1.0, load
        t[nodes[1:], k] = times
    t = np.clip(t, graph.t_lo[:, None], graph.t_hi[:, None])
    p = graph.p_lo[:, None] + (t - graph.t_lo[:, None])[..., None] * graph.v[:, None]
    return _Flown(y, q, t, p)


def _walks(graph, counts, tours, cycles):
    """Yield (agent of its layer, nodes in order, times of all nodes but the first) of each tour and each cycle."""
    for tour, (layer, k) in zip(tours, _agents_of(graph, counts, tours)):
        nodes = [int(graph.starts[layer]), *_route(graph, tour, layer), int(graph.ends[layer])]
        yield k, nodes, [*(visit.time for visit in tour.visits), tour.return_time]
    for cycle in cycles:
        route = [segment_of(graph, visit.target, visit.time) for visit in cycle]
        yield 0, [route[-1], *route], [visit.time for visit in cycle]


def _agents_of(graph, counts, tours):
    """Return (layer, number in it) of an agent for each tour: of each type the next one that has none yet."""
    types = [tour.agent or 0 for tour in tours]
    of_type = {
        a: [(layer, k) for layer in np.flatnonzero(graph.types == a).tolist() for k in range(counts[layer])]
        for a in set(types)
    }
    for a, agents in of_type.items():
        if types.count(a) > len(agents):
            which = f" of type {a}" if len(set(graph.types.tolist())) > 1 else ""
            flown = counted(types.count(a), "tour")
            raise InputError(f"tours: {flown} for {counted(len(agents), 'agent')}{which}")
    return [of_type[a][types[:k].count(a)] for k, a in enumerate(types)]


def segment_of(graph, u, t, layer=0):
    """Return the node of C_u in a layer whose time interval holds t, or the one nearest in time."""
    nodes = graph.C(u)
    nodes = nodes[graph.layer[nodes] == layer]
    away = np.maximum(graph.t_lo[nodes] - t, t - graph.t_hi[nodes])
    return int(nodes[np.argmin(np.maximum(away, 0.0))])


def _baseline(graph, flown):
    i, j = graph.edges.T
    l_xy = flown.p[j] - flown.p[i]
    l = flown.y * np.linalg.norm(l_xy, axis=-1)
    return {"y": flown.y, "t": flown.t, "l": l, "l_xy": l_xy, "l_bar": l + graph.R * (1.0 - flown.y)}


def _nonconvex(graph, flown):
    return {"t": flown.t, "p": flown.p} | _edge_values(graph, flown)


def _micp(graph, flown):
    """The theorem's correspondence: at most one agent flies an edge, so the sum over agents is that agent's value."""
    values = {name: value.sum(axis=1) for name, value in _edge_values(graph, flown).items()}
    alpha = [values["y"][graph.out_of(s)].sum() for s in graph.starts]
    return {"alpha": alpha if graph.n_layers > 1 else alpha[0], "q": flown.q.sum(axis=1)} | values


def _edge_values(graph, flown):
    """Return y, l, l_xy and the products (16) of each edge and agent."""
    i, j = graph.edges.T
    y, on = flown.y, flown.y[..., None]
    z_p, z_p_prime = on * flown.p[i], on * flown.p[j]
    l_xy = z_p_prime - z_p
    return {
        "y": y,
        "l": np.linalg.norm(l_xy, axis=-1),
        "l_xy": l_xy,
        "z_p": z_p,
        "z_t": y * flown.t[i],
        "z_p_prime": z_p_prime,
        "z_t_prime": y * flown.t[j],
    }


_VALUES = {"baseline": _baseline, "nonconvex": _nonconvex, "micp": _micp}


class Recovered(NamedTuple):
    """What the values of a model say: tours from the depot, and cycles (tuples of Visits) that miss it."""

    tours: tuple
    cycles: tuple


def recover(formulation):
    """Return the Recovered tours and cycles of a formulation whose variables have values; the inverse of `assign`.

    Visit times are the model's own, t_{i,k} or z'_{e,t}, so they are as accurate as its solver; a tour is back at the
    depot as soon as it can be. FlowError: y is no flow through every target.
    """
    graph = formulation.graph
    y = _values(formulation.model.y, len(graph.edges))
    paths, cycles = read_flow(graph, y.sum(axis=1))
    times = _visit_times(formulation, y)
    tours = tuple(to_tour(graph, path, times[list(path)]) for path in paths)
    return Recovered(tours, tuple(_visits(graph, cycle, times) for cycle in cycles))


def _visits(graph, nodes, times):
    return tuple(
        Visit(int(graph.tau[i]), float(times[i]), tuple(map(float, graph.position(i, times[i])))) for i in nodes
    )


def _visit_times(formulation, y):
    """Return (|V|,) the time of each node that is visited, within its interval; nothing of use at other nodes."""
    graph, model = formulation.graph, formulation.model
    heads, flown = graph.edges[:, 1], y > 0.5
    times = np.zeros(len(graph.tau))
    if formulation.method == "micp":
        used = flown[:, 0]
        times[heads[used]] = _values(model.z_t_prime, len(heads))[used, 0]
    else:
        edge, agent = np.nonzero(flown)
        times[heads[edge]] = _values(model.t, len(times))[heads[edge], agent]
    return np.clip(times, graph.t_lo, graph.t_hi)


def _values(variable, rows):
    """Return the values of a Pyomo or cvxpy variable as an array with this many rows."""
    if _is_pyomos(variable):
        values = [component.value for component in variable.values()]
    else:
        values = variable.value
    return np.array(values, dtype=float).reshape(rows, -1)
