"""The MICP's conic program sorted by edges: which rows are whose, positions and displacements put in for their names."""

import dataclasses

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

_POSITIONS = ("z_p", "z_p_prime", "l_xy")
_OWN = ("y", "l", "z_t", "z_t_prime")


def without_positions(program):
    """Return the program without z_p, z'_p and l_xy: rows (25), (26) and (28), which define them, are solved for them."""
    gone = np.concatenate([program.columns[name].ravel() for name in _POSITIONS])
    kept = np.setdiff1d(np.arange(len(program.c)), gone)
    A = program.A.tocsc()
    defining = np.unique(A[:, gone][: program.n_zero].indices)
    solver = splu(sparse.csc_matrix(A[defining][:, gone]))
    inverse = sparse.csc_array(solver.solve(np.eye(len(gone)))) 
    raise NotImplementedError
