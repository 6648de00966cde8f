"""The norm constraints (10), (15), (29), written once, in the quadratic form that solvers recognise as a cone."""


def cone(l_x, l_y, length):
    """Return ||(l_x, l_y)||^2 <= length^2; with length >= 0 this is a second-order cone."""
    return l_x**2 + l_y**2 <= length**2
