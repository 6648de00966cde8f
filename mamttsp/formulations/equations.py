"""The constraint families of each formulation and the paper's equation that each one is.

The names are those of the Pyomo components and of the keys of a cvxpy formulation's `constraints`. A family that says
the same in two formulations has the same name in both.
"""

EQUATIONS = {
    "baseline": {
        "depot_flow_out": 2,
        "depot_flow_in": 3,
        "target_flow_in": 4,
        "flow_conservation": 5,
        "node_time_window": 6,
        "speed": 7,
        "displacement": 8,
        "big_m": 9,
        "norm": 10,
    },
    "nonconvex": {
        "depot_flow_out": 2,
        "depot_flow_in": 3,
        "target_flow_in": 4,
        "flow_conservation": 5,
        "node_time_window": 6,
        "node_position": 12,
        "speed": 13,
        "displacement": 14,
        "norm": 15,
        "product_z_p": 16,
        "product_z_t": 16,
        "product_z_p_prime": 16,
        "product_z_t_prime": 16,
    },
    "micp": {
        "flow_from_depot": 18,
        "flow_to_depot": 19,
        "number_of_agents": 20,
        "one_segment_per_cluster": 21,
        "flow_conservation": 22,
        "time_conservation": 22,
        "time_at_tail": 23,
        "time_at_head": 24,
        "position_at_tail": 25,
        "position_at_head": 26,
        "speed": 27,
        "displacement": 28,
        "norm": 29,
    },
}
METHODS = tuple(EQUATIONS)
#: families that several types of agents, and capacities, add or state anew; the equation that each one generalises,
#: None where the paper has nothing like it. (23) is the model for the load of an edge: y_e times an interval.
_BY_AGENT = {"depot_flow_out": 2, "depot_flow_in": 3, "capacity": None}
BEYOND = {
    "baseline": _BY_AGENT,
    "nonconvex": _BY_AGENT,
    "micp": {
        "flow_from_depot": 18,
        "flow_to_depot": 19,
        "number_of_agents": 20,
        "some_agent_flies": 20,
        "load_conservation": 22,
        "load_at_least": 23,
        "load_at_most": 23,
    },
}
