"""The paper's three formulations in Pyomo, one module each: `build(graph, n_agents)` returns a ConcreteModel."""
