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
        "node_time": 6,
        "speed": 7,
        "hop": 8,
        "big_M": 9,
        "norm": 10,
    },
    "nonconvex": {
        "depot_flow_out": 2,
        "depot_flow_in": 3,
        "target_flow_in": 4,
        "flow_conservation": 5,
        "node_time": 6,
        "node_position": 12,
        "speed": 13,
        "hop": 14,
        "norm": 15,
        "product_z_p": 16,
        "product_z_t": 16,
        "product_z_p_prime": 16,
        "product_z_t_prime": 16,
    },
    "micp": {
        "depot_flow_out": 18,
        "depot_flow_in": 19,
        "number_of_agents": 20,
        "target_flow_in": 21,
        "flow_conservation": 22,
        "time_conservation": 22,
        "time_i": 23,
        "time_j": 24,
        "position_i": 25,
        "position_j": 26,
        "speed": 27,
        "hop": 28,
        "norm": 29,
    },
}
