"""How the labels of a layer are kept: parallel arrays, found again by their set of targets and last piece."""

from typing import NamedTuple

import numpy as np
from numba import njit


class Labels(NamedTuple):
    """The X labels of one layer (number of visits).

    visited: (X,) uint64 set of targets; piece: (X,) last piece; left, right: (X,) reduced cost at its ends; early: (X,)
    earliest time there in s; parent: (X,) label of the layer before, -1 for none; bound: (X,) least value of a
    completion, others' routes included, without the constant sum of pi.
    """

    visited: np.ndarray
    piece: np.ndarray
    left: np.ndarray
    right: np.ndarray
    early: np.ndarray
    parent: np.ndarray
    bound: np.ndarray


@njit(cache=True)
def empty(size):
    """Return room for Labels."""
    return Labels(
        np.empty(size, np.uint64), np.empty(size, np.int32), np.empty(size), np.empty(size), np.empty(size),
        np.empty(size, np.int32), np.empty(size),
    )  # fmt: skip


@njit(cache=True)
def grown(labels):
    """Return the Labels with room for as many again."""
    size = len(labels.left)
    more = empty(2 * size)
    more.visited[:size] = labels.visited
    more.piece[:size] = labels.piece
    more.left[:size] = labels.left
    more.right[:size] = labels.right
    more.early[:size] = labels.early
    more.parent[:size] = labels.parent
    more.bound[:size] = labels.bound
    return more


@njit(cache=True)
def select(labels, keep):
    """Return the labels with the given indices, in that order."""
    return Labels(
        labels.visited[keep], labels.piece[keep], labels.left[keep], labels.right[keep], labels.early[keep],
        labels.parent[keep], labels.bound[keep],
    )  # fmt: skip


@njit(cache=True)
def put(labels, x, visited, piece, left, right, early, parent, bound):
    """Write label x."""
    labels.visited[x] = visited
    labels.piece[x] = piece
    labels.left[x] = left
    labels.right[x] = right
    labels.early[x] = early
    labels.parent[x] = parent
    labels.bound[x] = bound


@njit(cache=True)
def slot_of(visited, piece, size):
    """Return where in a table of `size`, a power of 2, the labels of a set and piece are chained."""
    key = visited * np.uint64(0x9E3779B97F4A7C15) + np.uint64(piece) * np.uint64(0xC2B2AE3D27D4EB4F)
    return np.int64((key ^ (key >> np.uint64(29))) & np.uint64(size - 1))


@njit(cache=True)
def rehash(labels, count, size, following):
    """Return a table of `size` with the chains of the first `count` labels, linked by `following`."""
    head = np.full(size, -1, np.int32)
    for y in range(count):
        slot = slot_of(labels.visited[y], labels.piece[y], size)
        following[y] = head[slot]
        head[slot] = y
    return head
