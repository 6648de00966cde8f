"""Two claims of the paper that no plot shows, tested against certified optima."""

from ..campaigns.rows import INSTANCE
from ..summaries.row_statistics import true_gaps
from .verdicts import DIFFERS, HOLDS, OPEN

#: % of the optimum within which lengths count as equal: twice the solvers' gap limit, since both have one
_EQUAL = 0.02
#: settings with one agent: 80 instances, three windows
_ALONE = 240


def certified(reduced, exact):
    """Yield the lines of the claim table for the theorem, and for instances that one agent can serve."""
    yield _theorem(reduced, exact)
    yield _one_agent(exact)


def _theorem(reduced, exact):
    solved = true_gaps(reduced[(reduced.method == "micp") & reduced.solved], exact)
    equal = int((solved.incumbent_percent.abs() <= _EQUAL).sum())
    ours = f"{equal} of {len(solved)} MICP optima equal the certified optimum"
    whole = solved[solved.solver == "scip"]  # solves the program as it stands, and again with cuts if it has to
    cycles = f"in {(whole.subtour_cuts > 0).sum()} of them the plain program had an optimum with a cycle nobody flies"
    reason = f"{len(solved)} MICP runs proved an optimum that is certified, {len(whole)} on SCIP; {cycles}"
    return _line("IV-C", "an optimum of the MICP is an optimum of the problem", ours, equal, len(solved), reason)


def _one_agent(exact):
    alone = exact[exact.agents == 1].groupby(INSTANCE).objective.min()
    served = int(alone.notna().sum())
    ours = f"tours found for {served} of {len(alone)}"
    reason = f"{len(alone)} of {_ALONE} settings have a row"
    return _line("V-A", "one agent can serve every instance", ours, served, len(alone), reason)


def _line(section, claim, ours, good, tested, reason):
    verdict = OPEN if not tested else HOLDS if good == tested else DIFFERS
    return section, claim, "", "not in a plot", ours, verdict, reason
