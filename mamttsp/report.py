"""A solution as a table to read."""

from .progress import number


def table(solution):
    """Return the solution's numbers and tours as lines of text."""
    gap = "-" if solution.gap is None else f"{100 * solution.gap:.4f} %"
    built = f" (after {solution.build_time:.2f} s to build the model)" if solution.modeler else ""
    rows = [
        ("status", solution.status),
        ("method", f"{solution.method}, {solution.modeler}" if solution.modeler else solution.method),
        ("solver", solution.solver),
        ("objective", number(solution.objective)),
        ("bound", number(solution.bound)),
        ("gap", gap),
        ("runtime", f"{solution.runtime:.2f} s{built}"),
        ("nodes", "-" if solution.nodes is None else str(solution.nodes)),
        ("subtour cuts", str(solution.subtour_cuts)),
    ]
    lines = [f"{name:<13} {value}" for name, value in rows]
    for k, tour in enumerate(solution.tours):
        visits = ", ".join(f"{visit.target} at {visit.time:.2f} s" for visit in tour.visits)
        lines.append(f"{f'tour {k}':<13} {visits}; back at {tour.return_time:.2f} s")
    return "\n".join(lines)
