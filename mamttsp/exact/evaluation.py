"""The Lagrangian bound: 'each target once' and the subset-row cuts go into the objective, at prices pi and sigma.

L = sum(pi) + sum(sigma) + (least total reduced cost of as many ng-routes as the fleet permits) is a lower bound on
every solution, whatever pi and whatever sigma <= 0. An Evaluation holds it with all that was found on the way.
"""

import dataclasses
import functools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from . import ngroutes
from .cuts import Cuts, times_paid
from .elimination import arcs_alive
from .fleet import Fleet
from .legs import least, share_before
from .pieces import Arcs, Pieces, all_arcs, finer, finer_arcs, make_pieces, select
from .sets import to_words


class Limits(NamedTuple):
    """Beyond these an evaluation raises `ngroutes.Unfinished`. most_entries: of the values to go from a piece; out():
    tells whether time is up."""

    most_entries: int = ngroutes.ALL_ENTRIES
    out: Callable = lambda: False


NO_LIMITS = Limits()


class Network(NamedTuple):
    """Pieces and the arcs between them that a better solution may use; starts, ends: (Q,) bool, pieces where its
    routes may begin and end; ahead, back: both directions of time, see `ngroutes`."""

    pieces: Pieces
    arcs: Arcs
    starts: np.ndarray
    ends: np.ndarray
    ahead: ngroutes.Side
    back: ngroutes.Side


def make_network(pieces, arcs, starts, ends):
    """Return the Network; what may not be a start or an end has no leg from or to the depot."""
    first, last = pieces.first.copy(), pieces.last.copy()
    first[~starts], last[~ends] = np.inf, np.inf
    pieces = pieces._replace(first=first, last=last)
    return Network(pieces, arcs, starts, ends, *ngroutes.sides(pieces, arcs))


def first_network(graph, cut, targets):
    """Return the Network of all arcs between the pieces of `cut`, see `pieces.even_cuts`."""
    pieces = make_pieces(graph, *cut, targets)
    every = np.ones(len(pieces.a), dtype=bool)
    return make_network(pieces, all_arcs(pieces), every, every)


def restricted(network, alive, starts, ends):
    """Return the Network with the arcs alive (A,) alone, and pieces that none of them touches left out."""
    arcs = select(network.arcs, alive)
    used = starts & ends
    used[arcs.tail] = used[arcs.head] = True
    place = np.cumsum(used) - 1
    start = np.r_[0, np.cumsum(np.diff(arcs.start)[used])]
    arcs = Arcs(start, place[arcs.tail].astype(np.int32), place[arcs.head].astype(np.int32), arcs.leg)
    return make_network(network.pieces.only(used), arcs, starts[used], ends[used])


def refined(network, graph, width, centre, targets):
    """Return the Network with every piece cut into parts of about `width` s, those of the visit times `centre` among
    them."""
    segment, a, b, origin = finer(network.pieces, width, centre)
    pieces = make_pieces(graph, segment, a, b, targets)
    return make_network(pieces, finer_arcs(pieces, origin, network.arcs), network.starts[origin], network.ends[origin])


@dataclasses.dataclass(frozen=True, eq=False)
class Evaluation:
    """L at prices pi (n,) and those of the cuts, over a network. lists: values to go; cost, entry: (Q,) see
    `ngroutes.cheapest_starts`; extensions: of entries, that it took; value: L, infinite if there is no ng-route at all;
    complete: False if not all ng-routes were looked at: value then is only at least L, and bound -infinity; limits:
    `eliminated` keeps to them as well."""

    network: Network
    pi: np.ndarray
    cuts: Cuts
    fleet: Fleet
    prices: ngroutes.Prices
    lists: ngroutes.Lists
    cost: np.ndarray
    entry: np.ndarray
    complete: bool
    extensions: int
    limits: Limits

    @property
    def pieces(self):
        return self.network.pieces

    @property
    def arcs(self):
        return self.network.arcs

    @functools.cached_property
    def cheapest(self):
        """(K,) the least reduced cost of an ng-route of each layer."""
        least = np.full(len(self.fleet.counts), np.inf)
        np.minimum.at(least, self.pieces.layer, self.cost)
        return least

    @property
    def constant(self):
        """What all prices are worth, where every target is served once."""
        return float(self.pi.sum() + self.cuts.sigma.sum())

    @functools.cached_property
    def value(self):
        return self.constant + self.fleet.total(self.cheapest)

    @property
    def bound(self):
        return self.value if self.complete else -np.inf

    def slack(self, limit):
        """Return (K,) the greatest reduced cost that a route of each layer may have in a solution of value at most
        `limit`."""
        return limit - self.constant - self.fleet.rest(self.cheapest)

    def columns(self, most, each, longest):
        """Return (routes, endless): up to `most` cheap ng-routes of pieces that visit different targets, no more than
        `each` of a layer with the same first one; endless: beginnings of such with `longest` or more visits."""
        routes, endless, seen = [], [], set()
        begun = np.zeros(self.pieces.demand.shape, dtype=int)
        pieces, ahead = self.pieces, self.network.ahead
        above = self.cost - np.minimum(self.cheapest, 0.0)[pieces.layer]  # agents of a layer cost their least
        for q in np.argsort(above, kind="stable"):
            first = pieces.layer[q], pieces.target[q]
            if not np.isfinite(self.cost[q]) or len(routes) >= most:
                break
            if begun[first] >= each:
                continue
            route = ngroutes.trace(ahead, self.prices, self.lists, q, self.entry[q], longest)
            key = first[0], *pieces.target[route]
            if key in seen:
                continue
            seen.add(key)
            begun[first] += 1
            if len(route) >= longest:
                endless.append(route)
                continue
            routes.append(route)
        return routes, endless

    def length(self, route):
        """Return the least length of a route of pieces that the values along it prove at these prices."""
        pieces, prices, q = self.pieces, self.prices, route[0]
        left, right = ngroutes.value_along(self.network.ahead, prices, route)
        share = share_before(pieces.ready[q], pieces.a[q], pieces.b[q] - pieces.a[q])
        value = least(pieces.first[q, 0] + left, pieces.first[q, 1] + right, share)
        paid = prices.sigma @ times_paid(pieces.target[route], prices.inside, prices.kept)
        return value + self.pi[pieces.target[route[1:]]].sum() + paid

    def eliminated(self, limit, tolerance):
        """Return the Network of what lies on a relaxed solution of value at most `limit`."""
        network, slack = self.network, self.slack(limit)
        back, _ = _values(network.back, self.prices, tolerance, None, self.limits)
        alive = arcs_alive(network.ahead, self.prices, self.lists, back, slack)
        back_cost, _ = ngroutes.cheapest_starts(network.back, self.prices, back)
        allowed = slack[self.pieces.layer]
        return restricted(
            network, alive, network.starts & (self.cost <= allowed), network.ends & (back_cost <= allowed)
        )


def evaluate(network, N, pi, cuts, fleet, tolerance, few_entries=None, limits=NO_LIMITS):
    """Return the Evaluation at multipliers pi; values that change by less than `tolerance` count as unchanged.

    N: (n, n) bool, the ng-sets; few_entries: that a piece may have, of which the Evaluation is not complete, None for
    all; Unfinished is raised beyond the limits.
    """
    prices = ngroutes.Prices(pi, to_words(N), *cuts.words)
    lists, extensions = _values(network.ahead, prices, tolerance, few_entries, limits)
    cost, entry = ngroutes.cheapest_starts(network.ahead, prices, lists)
    n = len(pi)
    return Evaluation(
        network, pi, cuts, fleet, prices, lists, cost - n * tolerance, entry, few_entries is None, extensions, limits
    )  # fmt: skip


def _values(side, prices, tolerance, few_entries, limits):
    few = ngroutes.ALL_ENTRIES if few_entries is None else few_entries
    return ngroutes.values_to_go(side, prices, tolerance, len(prices.pi), few, *limits)
