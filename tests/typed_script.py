"""What a user may write, for the type checker: every public name with its types."""

from pathlib import Path
from typing import assert_type

import mamttsp


def use(path: Path) -> float:
    target = mamttsp.Target(times=[0, 80, 150], points=[(1, 2), (30, 9), (5, 44)], windows=[(10.0, 30.0)], demand=2)
    agents = [mamttsp.Agents(count=2, depot=(0, 0), max_speed=4.0, capacity=5)]
    instances = [
        mamttsp.Instance([target], n_agents=3, depot=(0, 0), max_speed=4, horizon=150, R=100),
        mamttsp.Instance([mamttsp.Target.parked((3, 4), windows=(2, 8))], agents=agents, horizon=150.0),
        mamttsp.generate(n_targets=5, total_window=40, seed=7),
        mamttsp.paper_instance(5, 0).with_agents(2),
        mamttsp.Instance.read(path),
    ]
    assert_type(instances, list[mamttsp.Instance])
    length = 0.0
    for instance in instances:
        instance.write(str(path))
        found = mamttsp.solve(instance, method="micp", time_limit=5, progress=report)
        assert_type(found, mamttsp.Solution)
        again = mamttsp.solve(instance, start=found)
        length += mamttsp.check(instance, again) + mamttsp.check(instance, list(again.tours))
        if again.gap is not None and again.objective is not None:
            length += again.gap * again.objective
        first = again.tours[0].visits[0]
        length += first.time + first.position[0] + mamttsp.build_graph(instance).horizon
        print(mamttsp.visits(instance, again).describe(), mamttsp.plot(instance, again).get_title())
    return length


def report(step: mamttsp.Progress) -> None:
    print(step.time, step.phase)
