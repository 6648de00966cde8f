"""The norm constraints (10), (15), (29), written once, in the quadratic form that solvers recognise as a cone."""

import math

import pyomo.environ as pyo


def cone(l_x, l_y, length):
    """Return ||(l_x, l_y)||^2 <= length^2; with length >= 0 this is a second-order cone."""
    return l_x**2 + l_y**2 <= length**2


def cone_violation(row):
    """Return by how many units the displacement exceeds the length, in a row made by `cone`; NaN without values."""
    squares = [pyo.value(side, exception=False) for side in row.expr.args]
    return math.nan if None in squares else math.sqrt(squares[0]) - math.sqrt(squares[1])
