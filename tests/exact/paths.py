"""The paths of the search, each forced by constants."""

import numpy as np

#: no enumeration fits, at whatever time
NONE_FITS = {"enumeration": 0.01, "enumeration_alone": 0.01, "least_extensions": 0}
#: {name: fields of `Parameters` that differ from the defaults}
FORCED = {
    "no enumeration fits at first": {**NONE_FITS, "piece": 9.0, "pieces_each": 4},
    "every enumeration is tried": {"narrower": 1.0, "piece": 9.0, "pieces_each": 4},
    "only parts of the gap are enumerated": {**NONE_FITS, "parts_work": 1e6, "piece": 9.0, "pieces_each": 2},
    "labels at one agent's present prices alone": {"prices": 0},
    "labels at whatever prices were tried": {"prices": 200, "apart": 0.0},
    "labels at prices drawn far and wide": {"prices": 20, "apart": np.inf, "drawn": 5.0},
    "tours on a coarse grid": {"grid": 2, "grid_slack": 0.0, "grid_charges": (10.0,)},
    "split as soon as shorter pieces were tried": {**NONE_FITS, "worthwhile": 2.0, "piece": 9.0, "pieces_each": 2},
    "split, without cuts": {**NONE_FITS, "worthwhile": 2.0, "violation": 10.0, "ng_size": 0},
    "ng-sets grow from nothing": {"ng_size": 0},
    "ng-sets grow by the shortest cycles": {
        "ng_size": 0,
        "longest_cycle": 2,
        **NONE_FITS,
        "piece": 9.0,
        "pieces_each": 4,
    },
    "two pieces for each target": {"piece": 9.0, "pieces_each": 2},
    "no set is settled": {"few_sets": 0},
    "no sequence is timed": {"few_sequences": 0},
    "prices move with all entries": {"few_entries": ()},
    "prices move with one entry of a piece": {"few_entries": (1,), "piece": 9.0, "pieces_each": 4},
    "arcs are dropped whenever they can be": {"dropped": 1.0, **NONE_FITS},
    "every gap is small": {"near": 1.0},
    "no gap is small": {"near": 0.0},
    "prices move along arcs to the nearest target": {"few_targets": 1},
    "one piece for each segment": {"first_pieces": 1, "crowded_pieces": 1},
    "one column an evaluation": {"columns": 1, "columns_each": 1},
    "two steps of column generation": {"most_steps": 2},
    "columns are forgotten": {"most_columns": 10},
    "a tiny box": {"box": 1e-4},
    "no annealing worth the name": {"annealing": 0.0, "annealing_step": 1, "timed": 0},
    "hardly a choice among known routes": {"choice_seconds": 0.0, "annealing": 0.0, "annealing_step": 1, "timed": 0},
    "any cut that is violated": {"violation": 1e-6, "cuts": 2, **NONE_FITS, "piece": 9.0, "pieces_each": 4},
    "a choice without cuts, from one column on": {"choice_columns": 1, "choice_few": 0},
    "pieces get much shorter": {"finer": 8.0, "finer_after_routes": 8.0, "piece": 9.0, "pieces_each": 2},
    "ng-sets are rolled back": {"most_entries": 12},
    "few pieces fit": {"most_pieces": 60, "piece": 9.0, "pieces_each": 3, **NONE_FITS},
}
#: paths on which nothing is timed to its end: where targets meet, there is a kink, and the gap closes to first order
#: only, if at all
UNSETTLED = ("no set is settled", "no sequence is timed")
#: paths on which labels are not enumerated, or late: the linear relaxation and shorter pieces close no other gap
UNENUMERATED = tuple(name for name, changed in FORCED.items() if changed.get("enumeration", 1.0) < 1.0)
#: paths on which evaluations are given up, and nothing is proved where even the smallest ng-sets take too many entries
GIVEN_UP = ("ng-sets are rolled back",)
