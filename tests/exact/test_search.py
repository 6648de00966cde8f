"""When tours are looked for: at first, and anew whenever that is cheap beside the prices."""

import pytest

from mamttsp import build_graph, generate
from mamttsp.exact.fleet import Fleet
from mamttsp.exact.parameters import Parameters
from mamttsp.exact.ruin_and_recreate import Annealing
from mamttsp.exact.search import Search, luby
from mamttsp.options import Watch


def _search(n=8, window=40, **changed):
    graph, own = build_graph(generate(n, window, 2, seed=1)), Parameters(**changed)
    fleet = Fleet.of(graph)
    return Search(graph, fleet, 1e-4, Watch(60.0), own, Annealing(graph, range(n), fleet, own))


def test_starts_take_once_as_long_as_the_first_one_then_longer_and_longer():
    assert [luby(k) for k in range(1, 16)] == [1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8]


def test_tours_are_looked_for_anew_once_prices_have_taken_as_much_work():
    search = _search()
    search.search_tours()
    first = search.annealing.filled
    dear, cheap = (share * first / search.parameters.annealing_share for share in (1.99, 2.0))
    search.search_more_tours(dear)
    assert search.starts == 1 and search.annealing.filled == first > 0
    search.search_more_tours(cheap)
    assert search.starts == 2 and search.annealing.filled == pytest.approx(2 * first, rel=0.5)
    search.search_more_tours(cheap)
    assert search.starts == 2


@pytest.mark.parametrize("window, most", [(20, 50), (60, 150)])
def test_there_may_be_more_first_pieces_where_many_targets_are_open_at_once(window, most):
    """Of 12 targets 1.6 and 4.8 are open at once, and an ng-set holds four."""
    search = _search(n=12, window=window, ng_size=4, first_pieces=50, crowded_pieces=150)
    duration = (search.graph.t_hi - search.graph.t_lo)[search.graph.V_seg].sum()
    assert search.first_width() == pytest.approx(duration / most)


def test_each_start_is_from_nothing(monkeypatch):
    search, stops = _search(annealing=0.5), []
    run = search.annealing.run

    def watched(*arguments):
        stops.append(int(search.annealing.length.sum()))
        return run(*arguments)

    monkeypatch.setattr(search.annealing, "run", watched)
    for _ in range(3):
        search.search_tours()
    assert [k for k, served in enumerate(stops) if not served] == [0, 4, 8]
