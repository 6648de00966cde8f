"""The paper's mixed-integer conic programs once more, in cvxpy: written from the paper alone, vectorised over edges."""

from .baseline import Baseline
from .micp import Micp
from .nonconvex import Nonconvex

__all__ = ["Baseline", "Micp", "Nonconvex"]
