"""Sets of targets as bits of W words of 64: as many targets as there are."""

import numpy as np

from ..compiled import compiled, inlined


def to_words(marks):
    """Return (X, W) uint64, sets of targets as bits; marks: (X, n) bool."""
    count, n = marks.shape
    whole = np.zeros((count, 64 * max(1, -(-n // 64))), bool)
    whole[:, :n] = marks
    return np.packbits(whole, axis=1, bitorder="little").view(np.uint64)


def to_marks(bits, n_targets):
    """Return (X, n) uint8, 1 for the targets in each set; bits: (X, W or more), contiguous."""
    return np.unpackbits(bits.view(np.uint8), axis=1, bitorder="little", count=n_targets)


@inlined
def has(sets, x, u):
    """Tell whether target u is in set x of (X, W). All of these take whole arrays and rows: views cost time."""
    return (sets[x, u >> 6] >> np.uint64(u & 63)) & np.uint64(1) != np.uint64(0)


@inlined
def add(sets, x, u):
    """Put target u into set x."""
    sets[x, u >> 6] |= np.uint64(1) << np.uint64(u & 63)


@inlined
def same(sets, x, others, y):
    """Tell whether set x of `sets` is set y of `others`."""
    equal = True
    for w in range(sets.shape[1]):
        equal = equal and sets[x, w] == others[y, w]
    return equal


@inlined
def subset(sets, x, others, y):
    """Tell whether set x of `sets` is part of set y of `others`."""
    inside = True
    for w in range(sets.shape[1]):
        inside = inside and (sets[x, w] & ~others[y, w]) == np.uint64(0)
    return inside


@inlined
def disjoint(sets, x, others, y):
    """Tell whether set x of `sets` and set y of `others` have no target in common."""
    apart = True
    for w in range(sets.shape[1]):
        apart = apart and (sets[x, w] & others[y, w]) == np.uint64(0)
    return apart


@compiled
def grown(memory, parity, load, left, right, used, more):
    """Return the arrays of entries with room for at least `more` behind the first `used`."""
    size = 2 * (used + more)
    new_memory, new_parity = np.empty((size, memory.shape[1]), np.uint64), np.empty(size, np.uint64)
    new_load, new_left, new_right = np.empty(size), np.empty(size), np.empty(size)
    for x in range(used):
        for z in range(memory.shape[1]):
            new_memory[x, z] = memory[x, z]
        new_parity[x], new_load[x], new_left[x], new_right[x] = parity[x], load[x], left[x], right[x]
    return new_memory, new_parity, new_load, new_left, new_right
