"""ng-memories (Baldacci, Mingozzi, Roberti 2011): which visits a relaxed route remembers, and so may not repeat.

Each target u has a neighbourhood N_u of close targets. A relaxed route that ends (going backward: starts) at u
remembers only visits to u itself and to members of N_u. A memory is a bit mask over the members of N_u; u itself is
implied.
"""

import numpy as np
from numba import njit


def neighbourhoods(pieces, n_targets, size):
    """Return N (n, size): for each target the `size` others that are cheapest to fly to or from, -1 where there are
    fewer."""
    size = min(size, n_targets - 1)
    present, starts = np.unique(pieces.target, return_index=True)  # pieces are ordered by target
    least = np.minimum.reduceat(np.minimum.reduceat(pieces.legs[:, :, 0], starts, axis=0), starts, axis=1)
    nearest = np.full((n_targets, n_targets), np.inf)
    nearest[np.ix_(present, present)] = least
    nearest = np.minimum(nearest, nearest.T)
    N = np.argsort(nearest, axis=1, kind="stable")[:, :size]
    N[~np.isfinite(np.take_along_axis(nearest, N, axis=1))] = -1
    return N.astype(np.int64).reshape(n_targets, size)


@njit(cache=True)
def transitions(N):
    """Return move (n, n, 2^g): the memory at w of a route that remembers `mask` at u and is extended to w, -1 if it
    remembers w already."""
    n, g = N.shape
    move = np.full((n, n, 1 << g), -1, np.int32)
    for u in range(n):
        for w in range(n):
            if u != w:
                for mask in range(1 << g):
                    move[u, w, mask] = _transition(N, u, w, mask)
    return move


@njit(cache=True)
def _transition(N, u, w, mask):
    kept = 0
    for bit in range(N.shape[1]):
        member = N[w, bit]
        if member == u:
            kept |= 1 << bit
    for position in range(N.shape[1]):
        if mask >> position & 1:
            member = N[u, position]
            if member == w or member < 0:
                return -1
            for bit in range(N.shape[1]):
                if N[w, bit] == member:
                    kept |= 1 << bit
    return kept


@njit(cache=True)
def local_memory(visited, N, u):
    """Return the mask over N_u of the members that are in the set `visited` (bits of targets)."""
    mask = 0
    for bit in range(N.shape[1]):
        if N[u, bit] >= 0 and (visited >> np.uint64(N[u, bit])) & np.uint64(1):
            mask |= 1 << bit
    return mask
