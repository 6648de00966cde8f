"""Our branch and bound for the MICP over conic relaxations (Clarabel): small, exact, with a proved bound at any stop.

Best bound first, with dives (`tree_search`). At a node the edges left and their times are propagated (`propagation`),
the relaxation is solved on them alone (`perspective`, `edge_entries`), violated subtour cuts are added (`separation`)
and what a tour demands of two edges in a row (`successions`), tours near its flow are tried (`rounding`, `best_found`),
the first ones along the edges that its duals favour (`beam`), and the node is split by whether one target follows
another (`branching`), where such splits have raised the bound most so far (`pseudo_costs`).
"""
