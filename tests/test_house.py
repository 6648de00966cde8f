"""Who may live where: imports run one way, each room knows those before it in its list; and a name has one home."""

import ast
from collections import Counter
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[1] / "mamttsp"
#: by folder of the package: its modules and folders in order
ORDER = {
    "": """validation schemas compiled motion random_order jsonfile paths agents instance graph tours conic_solver
        silent_highs timing infeasibility generate library readers tracks solution_table solution flow
        options display versions figures look
        formulations branch_and_bound backends exact warm_up relaxation cut_loop plain_model start solve
        experiments study arguments __main__""",
    "experiments": "campaigns summaries claims sheets build_tables build_figures verification",
    "formulations": "equations statistics conic_form pyomo cvxpy formulation residuals points",
}
#: the same thing said with either modeler
TWINS = {"baseline", "fleet", "micp", "nonconvex", "standard_form"}


def imported(path):
    """Return what a module of the package imports from the package, each as a tuple of names."""
    home, found = ("mamttsp", *path.relative_to(PACKAGE).parts[:-1]), []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found += [tuple(alias.name.split(".")) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = home[: len(home) + 1 - node.level] if node.level else ()
            module = tuple(node.module.split(".")) if node.module else ()
            found += [(*base, *module, alias.name) for alias in node.names]
    return [name[1:] for name in found if name[0] == "mamttsp"]


@pytest.mark.parametrize("folder, order", ORDER.items())
def test_imports_run_one_way(folder, order):
    rank = {room: k for k, room in enumerate(order.split())}
    inside = Path(folder).parts
    paths = [path for path in (PACKAGE / folder).rglob("*.py") if path != PACKAGE / folder / "__init__.py"]
    rooms = {path: path.relative_to(PACKAGE / folder).with_suffix("").parts[0] for path in paths}
    assert set(rooms.values()) == set(rank)  # who adds a room says where it stands
    known = [(path, name) for path in paths for name in imported(path) if name[: len(inside)] == inside]
    assert known
    assert not [
        f"{path.relative_to(PACKAGE)} knows {'.'.join(name)}"
        for path, name in known
        if rank[name[len(inside)]] > rank[rooms[path]]
    ]


def test_the_modelers_do_not_know_each_other():
    for one, other in (("pyomo", "cvxpy"), ("cvxpy", "pyomo")):
        names = [name for path in (PACKAGE / "formulations" / one).glob("*.py") for name in imported(path)]
        assert names and not [name for name in names if name[:2] == ("formulations", other)]


def test_a_name_has_one_home():
    paths = [path for path in PACKAGE.rglob("*.py") if path.stem != "__init__"]
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in paths]
    classes = Counter(node.name for tree in trees for node in tree.body if isinstance(node, ast.ClassDef))
    files = Counter(path.stem for path in paths)
    assert {name for name, count in files.items() if count > 1} == TWINS
    assert max(classes.values()) == 1, classes.most_common(3)
