"""Tables of what the code says of itself, as Markdown: solvers, equations, variables."""

import re
from functools import cache

import pyomo.environ as pyo

from mamttsp import Instance, Target, build_graph
from mamttsp.backends import SOLVERS, STARTS
from mamttsp.formulations import build_formulation
from mamttsp.formulations.equations import BEYOND, EQUATIONS
from mamttsp.study.source import source

TITLES = {"baseline": "The baseline, Section III", "nonconvex": "The nonconvex program, Section IV-A"}
TITLES |= {"micp": "The new MICP, Section IV-B"}
OPEN_SOLVERS = ("scip", "clarabel", "highs")


def solvers():
    """A table: which solver takes which formulation stated in which modeler, and whether it begins from known tours."""
    lines = ["| solver | licence | Pyomo | cvxpy | start |", "|---|---|---|---|---|"]
    for solver, routes in SOLVERS.items():
        licence = "open" if solver in OPEN_SOLVERS else "commercial"
        cells = (
            ", ".join(f"`{method}`" for method in routes.get(modeler, ())) or "–" for modeler in ("pyomo", "cvxpy")
        )
        lines.append(f"| `{solver}` | {licence} | {' | '.join(cells)} | {'yes' if solver in STARTS else '–'} |")
    return "\n".join(lines)


@cache
def models():
    """The three formulations in Pyomo, of a small instance."""
    here, there = ([0, 10], [[1, 0], [2, 0]], [[2, 8]]), ([0, 10], [[0, 3], [0, 2]], [[2, 8]])
    instance = Instance([Target(*here), Target(*there)], 1, (0, 0), 4, 20)
    graph = build_graph(instance)
    return {method: build_formulation(method, "pyomo", graph, 1).model for method in EQUATIONS}


def equations():
    """For each formulation a table of equations, names in the code and what they say, and the code, folded."""
    parts = []
    for method, families in EQUATIONS.items():
        model = models()[method]
        parts += [f"### {TITLES[method]}", "", "| equation | name in the code | what it says |", "|---|---|---|"]
        for family in ("length", *families):
            number, _, says = model.component(family).doc.partition(" ")
            parts.append(f"| {number} | `{family}` | {_with_symbols(says)} |")
        code = source(method, "length", *families)
        parts += ["", f":::{{dropdown}} The code of these rows: `{method}`", "```python", code, "```", ":::", ""]
    return "\n".join(parts)


def beyond():
    """A table of the families that unlike agents and capacities add or state anew."""
    lines = ["| formulation | name in the code | generalises |", "|---|---|---|"]
    for method, families in BEYOND.items():
        for family, number in families.items():
            lines.append(f"| {method} | `{family}` | {f'({number})' if number else '–'} |")
    return "\n".join(lines)


def variables():
    """A table of the formulations' variables: symbol, name in the code, what it is, and where."""
    found = {}
    for method, model in models().items():
        for variable in model.component_objects(pyo.Var):
            if variable.doc:
                symbol, _, says = variable.doc.partition(": ")
                found.setdefault((symbol, variable.name, says), []).append(method)
    lines = ["| paper | name in the code | what it is | in |", "|---|---|---|---|"]
    for (symbol, name, says), where in found.items():
        lines.append(f"| {_with_symbols(symbol)} | `{name}` | {_with_symbols(says)} | {', '.join(where)} |")
    return "\n".join(lines)


def _with_symbols(text):
    """Set the symbols in a sentence of a model, such as z'_{e,p}, v_max and alpha, as formulas."""
    return re.sub(r"(?<!\w)(?:alpha|[a-z]'?(?:_bar|_xy)?_(?:\{[^}]*\}|\w+))", lambda found: f"${_tex(found[0])}$", text)


def _tex(symbol):
    for plain, tex in (("l_xy", "l^{xy}"), ("l_bar", r"\bar l"), ("v_max", "v_{max}"), ("alpha", r"\alpha")):
        symbol = symbol.replace(plain, tex)
    return symbol
