"""Every constant of the exact solver, with its meaning and the measurement that it comes from."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Parameters:
    """Constants of the search."""

    #: targets that an ng-set holds at first
    ng_size: int = 8
    #: cycles of up to so many visits are forbidden at once when ng-sets grow
    longest_cycle: int = 5
    #: columns of an evaluation, and of them with the same first target
    columns: int = 30
    columns_each: int = 5
    #: half the width of the box around the best prices, as a share of their mean
    box: float = 0.3
    #: steps of column generation, and columns in the master, at most
    most_steps: int = 80
    most_columns: int = 3000
    #: and steps without a better bound
    idle_steps: int = 20
    #: column generation ends when the bound is within this share of the gap of the master's value
    converged: float = 0.05
    #: prices are moved with only so many entries of each of the first pieces, one after the other, and along arcs
    #: between a target and only so many others, those cheapest to fly to or from
    few_entries: tuple = (3, 8)
    few_targets: int = 40
    #: entries of a piece: before there are so many the ng-sets are rolled back
    most_entries: int = 1000
    #: arcs are dropped during column generation whenever the gap has shrunk to this share since the last time
    dropped: float = 0.8
    #: length of the first pieces, as a share of the time there is for each target, and pieces of one, at least
    piece: float = 0.35
    pieces_each: int = 8
    #: and of all together, at most; where more targets than an ng-set holds are open at once, in the mean, routes would
    #: go round and round between them if pieces were longer than legs
    first_pieces: int = 500
    crowded_pieces: int = 2000
    #: looks of ruin and recreate, for each target, of a start from nothing, or some times as many, and the share of the
    #: time left that one may take; iterations of a look, for each target, and at most: the tours of each look are
    #: timed, and all routes are chosen among
    annealing: float = 2.5
    annealing_most: float = 0.25
    annealing_step: int = 5
    annealing_longest: int = 100
    #: while the gap is wide, or an enumeration did not fit, so many rows of values on the time grid in all, for each
    #: extension of an entry that prices take: about a quarter of the time
    annealing_share: float = 0.03
    #: its time grid: points for each target; by how many steps a flight may come late on it, and what is charged for
    #: the distance that it is short by, in turn: where charges are low routes look shorter than they are, where they
    #: are high some look longer
    grid: int = 24
    grid_slack: float = 0.7
    grid_charges: tuple = (0.5, 0.0, 2.0, 8.0, 32.0)
    #: targets that a ruin takes out on average, and at most as a string from one route; how often it takes the targets
    #: closest to one instead, wherever they are; how often they come back in random order, not first the far ones or
    #: those of large demand, short, early or late windows; how often a place is overlooked on the way back
    removed: float = 10.0
    string: float = 30.0
    radial: float = 0.5
    shuffled: float = 0.5
    blink: float = 0.01
    #: heat of its annealing at first, as a share of the length; cost of a target left out, in sizes of the area
    heat: float = 0.02
    left_out: float = 4.0
    #: a gap below this share is small: no more tours are looked for, and sets are settled
    near: float = 0.01
    #: columns that are timed in a round, for each target
    timed: int = 5
    #: a choice among enumerated routes: columns that its linear program begins with, and takes in at once; subset-row
    #: cuts that are added at once, and at most; columns, at most, for cuts
    choice_columns: int = 1000
    choice_cuts: int = 30
    choice_most_cuts: int = 200
    choice_few: int = 200_000
    #: seconds for a choice among known routes; more where all choices have taken less than this share of the run
    choice_seconds: float = 0.5
    choice_share: float = 0.05
    #: label extensions of an enumeration, for each extension of an entry that prices have taken, with several agents
    #: and with one, for whom little else closes a gap; and how many it may make at least, which takes milliseconds
    enumeration: float = 0.3
    enumeration_alone: float = 4.5
    least_extensions: int = 10_000
    #: for one agent, the share of this work for an enumeration while prices still move with few entries
    early_work: float = 0.25
    #: labels, at most, with several agents and with one, for whom fewer links lead to each: then two arcs take the
    #: place of a label
    most_labels: int = 8_000_000
    most_labels_alone: int = 16_000_000
    #: for one agent, other multipliers at which a label must be possible to complete: those tried that are so far from
    #: each other, as a share of the present ones, the rest drawn around these, with that share for standard deviation;
    #: and the share of the work so far that they may take
    prices: int = 24
    prices_share: float = 1.0
    apart: float = 0.15
    drawn: float = 0.4
    #: where that does not fit, parts of the gap that are tried in turn, and the share of this work for each of them
    parts: tuple = (0.5, 0.25, 0.125)
    parts_work: float = 0.25
    #: an enumeration is tried again over the same pieces once the gap has shrunk to this share
    narrower: float = 0.8
    #: a means of raising the bound is used again if it closed this share of the gap
    worthwhile: float = 0.05
    #: a level of the master's columns this close to 0 or 1 is not worth a split, and a number of routes to a whole one
    whole: float = 0.01
    whole_routes: float = 0.1
    #: subset-row cuts added to the prices at once, and by how much they must be violated
    cuts: int = 15
    violation: float = 0.02
    #: sets of targets that are settled, and sequences of segments that are timed for one, by how much more each time
    few_sets: int = 500_000
    few_sequences: int = 1500
    more_sequences: float = 10.0
    #: by how much pieces get shorter, without and with all routes known
    finer: float = 2.0
    finer_after_routes: float = 3.0
    #: pieces of a network, at first: the number of arcs grows with the square; and arcs, which take 100 bytes each
    most_pieces: int = 4000
    most_arcs: int = 15_000_000
    #: arcs of a network that are made and evaluated per second, an underestimate, to stop in time
    arcs_rate: float = 2e5
    #: pieces of more than this share of the present length are hardly shorter
    hardly: float = 0.9
    #: least length of a piece, as a share of the horizon
    thinnest: float = 1e-8
