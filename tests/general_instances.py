"""Random instances beyond the paper: one to three types of agents with depots, ends, speeds and capacities, demands."""

import numpy as np

from mamttsp import Agents, generate

#: (targets, types, seed): twenty instances; at some the types matter, at some capacities bind, some have no solution
FAST = [
    (2, 1, 3), (2, 1, 11), (2, 2, 0), (2, 2, 1), (2, 2, 2), (2, 2, 3), (2, 2, 4), (2, 2, 7), (3, 1, 5), (3, 1, 7),
    (3, 1, 10), (3, 2, 0), (3, 2, 1), (3, 2, 3), (3, 2, 5), (3, 2, 10), (3, 3, 1), (3, 3, 3), (3, 3, 5), (3, 3, 8),
]  # fmt: skip
#: sixty more, as large as the slowest routes still prove within minutes
SLOW = [(3, K, seed) for K in (1, 2, 3) for seed in range(20, 30)]
SLOW += [(4, K, seed) for K in (1, 2) for seed in range(20, 30)] + [(5, 1, seed) for seed in range(20, 30)]


def random_general(n_targets, n_types, seed, total_window=20):
    """Return an instance with one agent of each type, or two of one; depots may coincide, capacities need not bind."""
    rng = np.random.default_rng([n_targets, n_types, seed])
    depots = rng.integers(-30, 31, (max(1, rng.integers(1, n_types + 1)), 2)).tolist()
    types = []
    for _ in range(n_types):
        end = rng.integers(-30, 31, 2).tolist() if rng.random() < 0.4 else None
        capacity = float(rng.integers(2, 6)) if rng.random() < 0.7 else None
        depot = depots[rng.integers(len(depots))]
        types.append(
            Agents(int(rng.integers(1, 3 if n_types == 1 else 2)), depot, float(rng.integers(3, 7)), end, capacity)
        )
    demands = rng.integers(0, 5, n_targets).tolist()
    return generate(n_targets, total_window, seed=seed, agents=types, demands=demands)
