"""The code of one family of equations, as it stands in the library: notebooks show it and never retype it."""

import ast
import importlib
import inspect
import textwrap

from ..formulations import pyomo
from ..formulations.equations import BEYOND, EQUATIONS
from ..formulations.pyomo import by_agent, fleet
from ..validation import InputError


def source(method, *families, beyond=False):
    """Return the Pyomo code that states these families of constraints of a formulation, or its objective "length".

    method and families: as in EQUATIONS. beyond: as several types of agents, and capacities, have it instead: families
    as in BEYOND. InputError: an unknown name.
    """
    if method not in EQUATIONS:
        raise InputError(f"method: expected one of {', '.join(EQUATIONS)} for a formulation, found {method!r}")
    own = importlib.import_module(f".{method}", pyomo.__name__)
    # Where a formulation does not state a family itself, it shares it with others (eqs (2)-(6)).
    stated = _components(fleet) if beyond else _components(by_agent) | _components(own)
    known = BEYOND[method] if beyond else ("length", *EQUATIONS[method])
    for family in families:
        if family not in known:
            raise InputError(f"families: expected one of {', '.join(known)} for {method}, found {family!r}")
    return "\n\n".join(stated[family] for family in families)


def _components(module):
    """Return {name: code} of the functions in a module that Pyomo's decorators turn into model components."""
    code = inspect.getsource(module)
    lines = code.splitlines()
    found = {}
    for node in ast.walk(ast.parse(code)):
        if isinstance(node, ast.FunctionDef) and node.decorator_list:
            first = node.decorator_list[0].lineno - 1
            found[node.name] = textwrap.dedent("\n".join(lines[first : node.end_lineno]))
    return found
