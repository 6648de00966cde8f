"""Two claims of the paper that no plot shows, tested against certified optima."""

from ..campaigns.rows import INSTANCE
from ..summaries.row_statistics import true_gaps
from . import quotations as said
from .verdicts import DIFFERS, HOLDS, OPEN

#: the verdict on a theorem of which rows can show no more, and which has a counterexample
ON_ROWS = "holds on these rows; false in general, see notebook 06"
#: % of the optimum within which lengths count as equal: twice the solvers' gap limit, since both have one
_EQUAL = 0.02
#: settings with one agent: 80 instances, three windows
_ALONE = 240


def certified(rows, exact):
    """Yield the lines of the claim table for the theorem, and for instances that one agent can serve."""
    yield _theorem(rows, exact)
    yield _one_agent(exact)


def _theorem(rows, exact):
    solved = true_gaps(rows[(rows.method == "micp") & rows.solved], exact)
    equal = int((solved.incumbent_percent.abs() <= _EQUAL).sum())
    ours = f"{equal} of {len(solved)} MICP optima equal the certified optimum"
    whole = solved[solved.solver == "scip"]  # solves the program as it stands, and again with cuts if it has to
    cycles = f"in {(whole.subtour_cuts > 0).sum()} of them the plain program had an optimum with a cycle nobody flies"
    reason = f"{len(solved)} MICP runs proved an optimum that is certified, {len(whole)} on SCIP; {cycles}"
    rule = "every optimum that a run of the MICP proved is as long as the certified optimum, to 0.02 %"
    verdicts = [_verdict(part.incumbent_percent.abs() <= _EQUAL, ON_ROWS) for part in (solved, whole)]
    claim = "an optimum of the MICP is an optimum of the problem"
    return "I, IV-C", claim, said.PROVED, rule, "", "not in a plot", ours, verdicts[0], reason, verdicts[1]


def _one_agent(exact):
    found = exact[exact.agents == 1].groupby(INSTANCE).objective.min().notna()
    ours, reason = f"tours found for {found.sum()} of {len(found)}", f"{len(found)} of {_ALONE} settings have a row"
    rule = "the exact method found tours of one agent for every instance and window; the instances are ours"
    claim, verdict = "one agent can serve every instance", _verdict(found, HOLDS)
    return "V-A", claim, said.FEASIBLE_ALONE, rule, "", "not in a plot", ours, verdict, reason, "not on SCIP"


def _verdict(good, if_all):
    return OPEN if not len(good) else if_all if good.all() else DIFFERS
