"""A wrong type anywhere at the front is an InputError of one line that names what was given."""

import pytest

import mamttsp
from mamttsp import InputError, Instance, Solution, Target
from tests.examples import instance, still

GOOD = instance(still(10, 0))

WRONG = {
    "instance: expected Instance, found dict {}": lambda: mamttsp.solve({}),
    "instance: expected Instance, found str 'i.json'": lambda: mamttsp.check("i.json", []),
    "instance: expected Instance, found int 3": lambda: mamttsp.build_graph(3),
    "time_limit: expected a number above 0, found 'x'": lambda: mamttsp.solve(GOOD, time_limit="x"),
    "gap: expected a number of at least 0, found None": lambda: mamttsp.solve(GOOD, gap=None),
    "threads: expected a whole number of at least 1, found 1.5": lambda: mamttsp.solve(GOOD, threads=1.5),
    "progress: expected a function of a Progress, found 3": lambda: mamttsp.solve(GOOD, progress=3),
    "method: expected one of": lambda: mamttsp.solve(GOOD, method=["exact"]),
    "modeler: expected one of": lambda: mamttsp.solve(GOOD, method="micp", modeler={}),
    "solver: expected one of": lambda: mamttsp.solve(GOOD, method="micp", solver=[]),
    "tours: expected a Solution or a list of Tours, found 3": lambda: mamttsp.check(GOOD, 3),
    "start: expected a Solution or a list of Tours, found 3": lambda: mamttsp.solve(GOOD, start=3),
    "path: expected str or PathLike, found int 3": lambda: Instance.read(3),
    "path: expected str or PathLike, found NoneType None": lambda: Solution.read(None),
    "path: expected str or PathLike, found float 1.5": lambda: GOOD.write(1.5),
    "targets: expected a list of Targets, found 3": lambda: Instance(3, 1, (0, 0), 1, 1),
    "targets[0]: expected Target, found dict {}": lambda: Instance([{}], 1, (0, 0), 1, 1),
    "n_agents: expected a whole number of at least 1, found 'x'": lambda: GOOD.with_agents("x"),
    "points: expected": lambda: Target([0, 1], "somewhere", [(0, 1)]),
    "n_targets: expected a whole number of at least 1, found 'x'": lambda: mamttsp.generate("x", 20),
    "total_window: expected a finite number above 0, found None": lambda: mamttsp.generate(3, None),
    "ax: expected Axes, found int 3": lambda: mamttsp.figures.save(3, "plan.png"),
}


@pytest.mark.parametrize("message", WRONG)
def test_it_is_one_line(message):
    with pytest.raises(InputError) as caught:
        WRONG[message]()
    assert str(caught.value).startswith(message) and "\n" not in str(caught.value)


def test_a_value_of_many_lines_is_cut_short():
    long = "\n".join(["a line"] * 99)
    with pytest.raises(InputError) as caught:
        mamttsp.solve(GOOD, time_limit=[long])
    assert str(caught.value).endswith("...") and len(str(caught.value)) < 120
