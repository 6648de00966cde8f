"""Tours: visits in order, the best times for a given order (a small SOCP), and the independent checker."""

import dataclasses
import math

import clarabel
import numpy as np
from scipy import sparse

from .motion import earliest_meeting
from .validation import InputError, is_number

#: default tolerance of `check`, relative to the instance's size (lengths) and horizon (times)
TOLERANCE = 1e-6


class TourError(ValueError):
    """Tours that are not a solution; the message lists every violation, one a line."""


@dataclasses.dataclass(frozen=True)
class Visit:
    """A visit of `target` (from 0) at `time` in s, at `position` (x, y) in units."""

    target: int
    time: float
    position: tuple


@dataclasses.dataclass(frozen=True)
class Tour:
    """One agent's tour: it leaves the depot at time 0, makes its visits in order and is back at `return_time`."""

    visits: tuple
    return_time: float

    def to_dict(self):
        visits = [{"target": v.target, "time": v.time, "position": list(v.position)} for v in self.visits]
        return {"visits": visits, "return_time": self.return_time}

    @classmethod
    def from_dict(cls, data, where="tour"):
        """Build a tour from the JSON object of a solution file; InputError names the field that is wrong."""
        try:
            visits = tuple(_visit_from(v, f"{where}.visits[{k}]") for k, v in enumerate(data["visits"]))
            return cls(visits, _finite(data["return_time"]))
        except (KeyError, TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"{where}: expected visits (a list) and return_time (a number)") from None


def _visit_from(data, where):
    try:
        x, y = data["position"]
        target = data["target"]
        if isinstance(target, bool) or not isinstance(target, int):
            raise ValueError
        return Visit(target, _finite(data["time"]), (_finite(x), _finite(y)))
    except (KeyError, TypeError, ValueError):
        raise InputError(f"{where}: expected target (a whole number), time and position [x, y]") from None


def _finite(value):
    if not is_number(value):
        raise ValueError
    return float(value)


# --- The checker: reads the instance's own data, never a graph, a formulation or a solver -----------------------------


def check(instance, tours, tolerance=TOLERANCE):
    """Return the total length of the tours, or raise TourError with a line for every violation.

    Independent of every formulation and solver: each target exactly once, inside one of its windows, on its path;
    no hop faster than max_speed; back by the horizon; at most n_agents tours. Lengths may be off by
    `tolerance` x the instance's size (the diagonal R), times by `tolerance` x the horizon.
    """
    slack = tolerance * instance.horizon
    faults = _count_faults(instance, tours)
    total = 0.0
    for k, tour in enumerate(tours):
        position, time = instance.depot, 0.0
        for visit in tour.visits:
            faults += _visit_faults(instance, k, visit, tolerance)
            total += _hop(
                instance,
                f"tour {k}, to target {visit.target}",
                position,
                time,
                visit.position,
                visit.time,
                slack,
                faults,
            )
            position, time = np.asarray(visit.position), visit.time
        total += _hop(
            instance, f"tour {k}, to the depot", position, time, instance.depot, tour.return_time, slack, faults
        )
        if tour.return_time > instance.horizon + slack:
            faults.append(f"tour {k}: back at {tour.return_time:.9g}, after the horizon {instance.horizon:.9g}")
    if faults:
        raise TourError("\n".join(faults))
    return float(total)


def _count_faults(instance, tours):
    faults = []
    if len(tours) > instance.n_agents:
        faults.append(f"{len(tours)} tours for {instance.n_agents} agents")
    visited = [visit.target for tour in tours for visit in tour.visits]
    for u in range(instance.n_targets):
        if (times := visited.count(u)) != 1:
            faults.append(f"target {u} is visited {times} times, not once")
    return faults + [f"target {u} does not exist" for u in set(visited) - set(range(instance.n_targets))]


def _visit_faults(instance, k, visit, tolerance):
    if not 0 <= visit.target < instance.n_targets:
        return []
    target, slack = instance.targets[visit.target], tolerance * instance.horizon
    where = f"tour {k}, target {visit.target}"
    faults = []
    if not any(start - slack <= visit.time <= end + slack for start, end in target.windows):
        faults.append(f"{where}: visited at {visit.time:.9g}, outside its windows {target.windows.tolist()}")
    off = np.linalg.norm(target.position(visit.time) - visit.position)
    if not off <= tolerance * instance.size:
        faults.append(f"{where}: {off:.3g} units off its path at time {visit.time:.9g}")
    return faults


def _hop(instance, where, p, t, q, u, slack, faults):
    """Return the length of a hop, and note it in `faults` if it is faster than max_speed."""
    length = np.linalg.norm(np.subtract(q, p))
    if not length <= instance.max_speed * (u - t + slack):
        faults.append(f"{where}: {length:.9g} units in {u - t:.9g} s, faster than max_speed {instance.max_speed:g}")
    return length


# --- The best times for a given order --------------------------------------------------------------------------------


def earliest_times(graph, route):
    """Return the earliest visit times (len(route),) of the segments in order, or None if they cannot be flown in time.

    route: nodes of V_seg in the order of their visits. Flying at v_max is best for time: movers are slower than agents.
    """
    times = np.empty(len(route))
    t, p = 0.0, graph.p_lo[graph.s]
    for k, i in enumerate(route):
        times[k] = t = _meeting(graph, p, t, i)
        if math.isinf(t):
            return None
        p = graph.position(i, t)
    return None if math.isinf(_meeting(graph, p, t, graph.s_prime)) else times


def _meeting(graph, p, t, i):
    q, v = graph.p_lo[i], graph.v[i]
    return earliest_meeting(
        p[0], p[1], t, q[0], q[1], graph.t_lo[i], v[0], v[1], graph.t_lo[i], graph.t_hi[i], graph.max_speed
    )


def best_times(graph, route):
    """Return (length, times): the shortest tour through the segments of `route` in order, None if none is in time.

    times: (len(route),) visit times in s. The times come from an SOCP (Clarabel) and are then nudged forward onto
    times that can be flown exactly, so `length` is the length of a real tour, within about 1e-8 of the optimum.
    """
    found = bounded_times(graph, route)
    return None if found is None else found[:2]


def bounded_times(graph, route):
    """Return (length, times, bound): as `best_times`, with the SOCP's dual bound on every tour of this order.

    The bound holds whatever the accuracy of Clarabel's answer.
    """
    earliest = earliest_times(graph, route)
    if earliest is None:
        return None
    solved, bound = _solve_times(graph, route)
    candidates = [earliest] if solved is None else [earliest, _flyable_times(graph, route, solved)]
    length, times = min(((_length(graph, route, times), times) for times in candidates), key=lambda found: found[0])
    return length, times, min(bound, length)


def best_tours(graph, routes):
    """Return (length, tours) for a set of routes, each with its best times; None if one of them cannot be flown."""
    total, tours = 0.0, []
    for route in routes:
        found = best_times(graph, route)
        if found is None:
            return None
        total += found[0]
        tours.append(to_tour(graph, route, found[1]))
    return total, tours


def to_tour(graph, route, times):
    """Return the Tour through the segments of `route` at the given times, back at the depot as soon as can be."""
    visits = tuple(
        Visit(int(graph.tau[i]), float(t), tuple(map(float, graph.position(i, t)))) for i, t in zip(route, times)
    )
    home = _meeting(graph, visits[-1].position, visits[-1].time, graph.s_prime) if visits else 0.0
    return Tour(visits, float(min(home, graph.horizon)))


def _length(graph, route, times):
    stops = np.vstack([graph.p_lo[:1], *(graph.position(i, t)[None] for i, t in zip(route, times)), graph.p_lo[-1:]])
    return float(np.linalg.norm(np.diff(stops, axis=0), axis=1).sum())


def _flyable_times(graph, route, times):
    """Pull each time forward to where all later visits can still be made, push it to where the agent can be by then."""
    flown = np.empty(len(route))
    t, p = 0.0, graph.p_lo[graph.s]
    for k, (i, latest) in enumerate(zip(route, _latest_times(graph, route))):
        soonest = _meeting(graph, p, t, i)
        wish = min(max(times[k], graph.t_lo[i]), latest)
        flown[k] = t = graph.t_hi[i] if math.isinf(soonest) else max(wish, soonest)
        p = graph.position(i, t)
    return flown


def _latest_times(graph, route):
    """Return (len(route),) the latest times of the visits that leave time for all later ones, home by the horizon.

    Seen backwards in time these are earliest meetings, with motions reversed.
    """
    latest = np.empty(len(route))
    t, p = graph.horizon, graph.p_lo[graph.s_prime]
    for k, i in reversed(list(enumerate(route))):
        q, v, start, end = graph.p_hi[i], -graph.v[i], -graph.t_hi[i], -graph.t_lo[i]
        back = earliest_meeting(p[0], p[1], -t, q[0], q[1], start, v[0], v[1], start, end, graph.max_speed)
        latest[k] = t = max(-back, graph.t_lo[i])
        p = graph.position(i, t)
    return latest


def _solve_times(graph, route):
    """Return (times, bound): the optimal visit times of a fixed order, None if Clarabel does not answer, and the
    dual bound.

    Unknowns: times t_1..t_K and leg lengths l_0..l_K, in the units T and R of the instance so that the data are near
    one. Rows A x + s = b: windows; l_k <= v_max * (t_k+1 - t_k); ||p_k+1(t_k+1) - p_k(t_k)|| <= l_k as second-order
    cones.
    """
    K, R, T = len(route), graph.size or 1.0, graph.horizon
    nodes = [graph.s, *route, graph.s_prime]
    speed, v = graph.max_speed * T / R, graph.v[nodes] * T / R
    offset = np.diff(graph.p_lo[nodes] - graph.t_lo[nodes, None] * graph.v[nodes], axis=0) / R
    k, leg = np.arange(K), np.arange(K + 1)
    before, after = leg[1:], leg[:-1]  # the legs after which t_k comes as tail, and as head
    cone = 3 * K + 1 + 3 * leg
    ones = np.ones(K)
    entries = [
        (k, k, -ones),
        (K + k, k, ones),
        (2 * K + after, k, -speed * ones),
        (2 * K + before, k, speed * ones),
        (2 * K + leg, K + leg, np.ones(K + 1)),
        (cone, K + leg, -np.ones(K + 1)),
    ]
    for axis in (0, 1):
        entries += [(cone[after] + 1 + axis, k, -v[1:-1, axis]), (cone[before] + 1 + axis, k, v[1:-1, axis])]
    row, column, value = (np.concatenate(part) for part in zip(*entries))
    A = sparse.csc_matrix((value, (row, column)), shape=(6 * K + 4, 2 * K + 1))
    limit = np.r_[np.zeros(K), speed]  # t_0 = 0, and the last arrival may be as late as T
    b = np.r_[-graph.t_lo[route] / T, graph.t_hi[route] / T, limit, np.c_[np.zeros(K + 1), offset].ravel()]
    cones = [clarabel.NonnegativeConeT(3 * K + 1)] + [clarabel.SecondOrderConeT(3)] * (K + 1)
    settings = clarabel.DefaultSettings()
    settings.verbose, settings.max_threads = False, 1
    cost = np.r_[np.zeros(K), np.ones(K + 1)]
    P = sparse.csc_matrix((2 * K + 1, 2 * K + 1))
    answer = clarabel.DefaultSolver(P, cost, A, b, cones, settings).solve()
    bounds = np.c_[np.r_[graph.t_lo[route] / T, np.zeros(K + 1)], np.r_[graph.t_hi[route] / T, np.full(K + 1, speed)]]
    bound = _dual_bound(np.array(answer.z), 3 * K + 1, cost, A, b, bounds) * R
    solved = answer.status in (clarabel.SolverStatus.Solved, clarabel.SolverStatus.AlmostSolved)
    return np.array(answer.x[:K]) * T if solved else None, bound


def _dual_bound(z, split, cost, A, b, bounds):
    """Return a lower bound on cost @ x subject to A x + s = b, s in the cones, from any z: it is moved into the dual
    cones (nonnegative rows up to `split`, then cones of three),
    and what its residual could cost within the variables' bounds (K, 2) is taken off. -infinity if z is not finite.
    """
    if not np.isfinite(z).all():
        return -math.inf
    cones = z[split:].reshape(-1, 3)
    cones[:, 0] = np.maximum(cones[:, 0], np.hypot(cones[:, 1], cones[:, 2]))
    z[:split] = np.maximum(z[:split], 0.0)
    residual = cost + A.T @ z
    return float(-b @ z + np.minimum(residual * bounds[:, 0], residual * bounds[:, 1]).sum())
