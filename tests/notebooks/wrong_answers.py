"""For each task of the exercises a wrong answer that students give, and what must be said of it."""

WRONG = {
    "02.1": (
        """
def meeting_time(q, w, v_max, start, end):
    t = max(abs(q) / (v_max - w), start)
    return t if t <= end else math.inf
""",
        r"q = -.*: you say inf s, but the agent can come",
    ),
    "02.2": (
        """
def graph_size(clusters):
    n_seg = sum(clusters)
    return n_seg + 2, 2 * n_seg + n_seg * (n_seg - 1)
""",
        r"but the graph has",
    ),
    "02.3": ("escape = lambda: ((1.0, 0.0), (1.5, 0.0), 10.0, 20.0)", r"too far away to be met"),
    "03.1": (
        """
def half_tours(graph, times):
    route = [graph.s, *(graph.C(u)[0] for u in range(4)), graph.s_prime]
    used = set(itertools.pairwise(route))
    return np.array([0.5 if tuple(edge) in used else 0.0 for edge in graph.edges.tolist()])
""",
        r"target_flow_in by 0\.5",
    ),
    "03.2": ("longest = lambda graph, i, j: np.linalg.norm(graph.p_lo[j] - graph.p_lo[i])", r"two points .* apart"),
    "04.1": (
        "widest = lambda y, t_lo, t_hi: y * (1 - y) * (t_hi - t_lo)",
        r"y = 0\.05, t from 40 to 60 s: you say 0\.95, it is 1\.00",
    ),
    "04.2": (
        """
def trap():
    return mamttsp.Target([0, 20, 60, 100], [[20, 0], [20, 0], [5, 0], [5, 0]], [(10, 20), (60, 100)]), [1]
""",
        r"the method stops at 10\.00, the optimum is 10\.00",
    ),
    "05.1": (
        """
def in_perspective(graph, i, y, z_p, z_t):
    in_time = y * graph.t_lo[i] - 1e-9 <= z_t <= y * graph.t_hi[i] + 1e-9
    return in_time and np.allclose(z_p, graph.v[i] * z_t + graph.p_lo[i] - graph.t_lo[i] * graph.v[i])
""",
        r"you say False, but y times a point of X_i is in y X_i",
    ),
    "05.2": (
        """
def without_play(instance, solution):
    moment = {visit.target: visit.time for tour in solution.tours for visit in tour.visits}
    windows = [[(moment[u] - 3, moment[u] + 3)] for u in range(4)]
    targets = [dataclasses.replace(target, windows=w) for target, w in zip(instance.targets, windows)]
    return dataclasses.replace(instance, targets=targets)
""",
        r"units without the row",
    ),
    "06.1": (
        """
def split(edges, s, s_prime):
    after, paths = dict(edges), []
    for first in [j for i, j in edges if i == s]:
        paths.append([first])
        while after[paths[-1][-1]] != s_prime:
            paths[-1].append(after[paths[-1][-1]])
    return paths, []
""",
        r"are not the cycles",
    ),
    "06.2": (
        """
def three_meet():
    still = [mamttsp.Target([0, 100], [[x, 0], [x, 0]], [(0, 100)]) for x in (10, 40)]
    return still + [mamttsp.Target([0, 100], [[60, y], [60, -y]], [(45, 55)]) for y in (20, -20)]
""",
        r"has the cycles",
    ),
    "06.3": (
        """
def oracle(instance):
    graph = mamttsp.build_graph(instance)
    routes = [list(route) for order in itertools.permutations(range(instance.n_targets))
              for route in itertools.product(*(graph.C(u).tolist() for u in order))]
    flyable = [route for route in routes if earliest_times(graph, route) is not None]
    return min((best_times(graph, route)[0] for route in flyable), default=math.inf)
""",
        r"agents: the oracle says",
    ),
    "07.1": ("rising_seed = lambda: 0", r"the ratio is"),
    "07.2": (
        """
def weak():
    window = [(0, 100)], [(45, 46)], [(45, 46)]
    return [mamttsp.Target([0, 100], [p, p], w) for p, w in zip([(1, 0), (60, 0), (60, 1)], window)]
""",
        r"the relaxed bound is \d\d % of the optimum",
    ),
    "08.1": (
        """
def run_time(row):
    value, error = float(row["runtime_s"].strip("<~")), 0.3 if row["figure"] == "2a" else 4.0
    return (0.0 if "<" in row["runtime_s"] else value - error), value + error * ("<" not in row["runtime_s"])
speed_up = lambda micp, baseline: (baseline[0] / micp[1], math.inf)
""",
        r"panel 3b, 10 targets, baseline",
    ),
    "08.2": (
        """
def audit(row):
    instance = mamttsp.paper_instance(row["n"], row["index"], row["total_window"], row["agents"])
    try:
        length = mamttsp.check(instance, [mamttsp.Tour.from_dict(tour) for tour in json.loads(row["tours"])])
    except mamttsp.TourError:
        return {"tours"}
    return set() if abs(length - row["objective"]) < 1e-6 * length else {"objective"}
""",
        r"a row with a wrong gap passes",
    ),
    "09.1": (
        """
def nearest_in_time(graph):
    return [int(min(graph.C(u), key=lambda i: graph.t_lo[i])) for u in range(5)]
def two_lengths(instance, graph, route):
    return best_times(graph, route)[0], best_times(graph, route)[0]
""",
        r"is reached first",
    ),
    "09.2": (
        """
def prices(graph, route):
    return best_times(graph, route)[0], np.zeros(len(route))
""",
        r"at your prices the legs come to",
    ),
    "09.3": ("is_ng_route = lambda walk, N: len(set(walk)) == len(walk)", r"the solver says True"),
    "09.4": ("dominates = lambda A, B, a, b: all(x <= y for x, y in zip(A, B))", r"on the grid it is True"),
    "11.1": (
        """
def fewest(demands, capacity):
    return math.ceil(sum(demands) / capacity)
""",
        r"demands \[3, 3, 3\], capacity 5: you say 2, it is 3",
    ),
    "11.2": (
        """
def share_out(shortest, counts, n_targets):
    everything = frozenset(range(n_targets))
    return min(tours.get(everything, math.inf) for tours in shortest)
""",
        r"seed 2, .*: you say \d+\.\d\d, the best of all ways is",
    ),
    "11.3": (
        """
def misleading():
    targets = [Target([0, 100], [(x, 0), (x, 0)], [(0, 100)]) for x in (-25, 25)]
    return targets, [Agents(1, (-30, 0), 4), Agents(1, (30, 0), 4)]
""",
        r"the rule makes 20\.00 units, the optimum is 20\.00: not enough",
    ),
}
