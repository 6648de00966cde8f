"""A solution as a table for people: the lines that are printed, and the same in a notebook.

Targets and tours have the numbers that they have in files and code, from 0.
"""

from html import escape


def table(solution):
    """Return a solution's numbers and tours as lines of text."""
    return "\n".join(f"{name:<13} {value}" for name, value in _rows(solution))


def html_table(solution):
    """Return the same as a table in HTML."""
    cells = (f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in _rows(solution))
    return f'<table style="text-align: left">{"".join(cells)}</table>'


def number(value):
    """Return a length as text, a dash where it is unknown."""
    return "-" if value is None else f"{value:.4f}"


def _rows(solution):
    """Return (name, value) of each line."""
    gap = "-" if solution.gap is None else f"{100 * solution.gap:.4f} %"
    built = f" (after {solution.build_time:.2f} s to build the model)" if solution.modeler else ""
    rows = [
        ("status", solution.status),
        *([("reason", solution.reason)] if solution.reason else []),
        ("method", f"{solution.method}, {solution.modeler}" if solution.modeler else solution.method),
        ("solver", solution.solver),
        ("objective", number(solution.objective)),
        ("bound", number(solution.bound)),
        ("gap", gap),
        ("runtime", f"{solution.runtime:.2f} s{built}"),
        ("nodes", "-" if solution.nodes is None else str(solution.nodes)),
        ("subtour cuts", str(solution.subtour_cuts)),
    ]
    rows += [(f"tour {k}", _tour(tour)) for k, tour in enumerate(solution.tours)]
    # Only the claim of a plain model has cycles, a PaperSolution.
    cycles = getattr(solution, "cycles", ())
    return rows + [("cycle", f"targets {', '.join(map(str, cycle))}, flown by nobody") for cycle in cycles]


def _tour(tour):
    if not tour.visits:
        return "stays at the depot"
    kind = "" if tour.agent is None else f"by an agent of type {tour.agent}: "
    visits = ", ".join(f"{visit.target} at {visit.time:.2f} s" for visit in tour.visits)
    return f"{kind}target{'s' * (len(tour.visits) > 1)} {visits}; back at {tour.return_time:.2f} s"
