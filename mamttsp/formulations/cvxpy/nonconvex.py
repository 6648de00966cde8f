"""Why the nonconvex program of Section IV-A has no cvxpy form."""

from ...validation import InputError


class Nonconvex:
    """Raises InputError: cvxpy states only convex programs, and equations (16) are not convex."""

    def __init__(self, graph, n_agents):
        raise InputError(
            "modeler: cvxpy cannot state the nonconvex program: its bilinear products y p and y t, equations (16), "
            'break the rules of disciplined convex programming (DCP); use "pyomo"'
        )
