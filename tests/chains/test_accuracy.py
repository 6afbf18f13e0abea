"""Every entry of every limit right to 1e-12, against exact arithmetic, however stiff the chain.

Entries below the smallest normal float are exempt: a float cannot hold twelve digits there.
"""

import random
from collections.abc import Iterator
from decimal import Decimal, localcontext
from fractions import Fraction
from itertools import accumulate, pairwise
from math import comb
from operator import mul

import numpy as np
import pytest

import oracle
from evenbreak.chains import (
    Chain,
    absorption,
    chain_from_arrays,
    chain_of,
    expected_visits,
    stochastic_limit,
)
from evenbreak.games import Race, Rack, alternate_breaks, loser_breaks, winner_breaks
from rows import each_of

TOLERANCE = 1e-12
ONE = Fraction(1)

Triples = list[tuple[int, int, float]]


def shared_out(draw: random.Random, targets: list[int], stiffness: float) -> dict[int, float]:
    """Return float probabilities over the targets that spread over `stiffness` decades."""
    weights = [10.0 ** -draw.uniform(0.0, stiffness) for _ in targets]
    total = sum(weights)
    return {target: weight / total for target, weight in zip(targets, weights, strict=True)}


def random_triples(draw: random.Random) -> tuple[Triples, int]:
    """Return a chain of 2 to 40 states with up to four closed classes, and a start.

    All states are reached from the start; the states come in any order.
    """
    n = draw.randint(2, 40)
    labels = draw.sample(range(n), n)
    count = draw.randint(1, min(4, n - 1))
    cuts = sorted(draw.sample(range(1, max(count + 1, n // 2)), count))
    closed = [labels[a:b] for a, b in zip([0, *cuts], cuts, strict=False)]
    transient = labels[cuts[-1] :]
    stiffness = draw.choice([0.5, 3.0, 12.0])
    targets = {state: set(draw.sample(labels, min(n, draw.randint(1, 3)))) for state in transient}
    for here, after in pairwise(transient):
        targets[here].add(after)
    for states in closed:
        targets[draw.choice(transient)].add(states[0])
        for here, after in zip(states, states[1:] + states[:1], strict=True):
            targets[here] = {after, *draw.sample(states, min(len(states), draw.randint(0, 3)))}
    return [
        (state, target, chance)
        for state in draw.sample(range(n), n)
        for target, chance in shared_out(draw, sorted(targets[state]), stiffness).items()
    ], transient[0]


def exact(chain: Chain, start: int) -> list[Fraction]:
    return oracle.limit(oracle.columns_of(chain), {chain.index(start): ONE})


@pytest.mark.slow
@pytest.mark.parametrize("block", range(6))
def test_random_chains(block: int) -> None:
    worst = 0.0
    for seed in range(50 * block, 50 * block + 50):
        triples, start = random_triples(random.Random(seed))
        chain = chain_of(triples, start=start)
        found = stochastic_limit(chain)
        assert (found.bound or 0.0) < 5e-15
        worst = max(worst, oracle.worst_relative_error(found.probability, exact(chain, start)))
    assert worst <= TOLERANCE


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("block", range(3))
def test_absorption_and_visits_of_random_chains(block: int) -> None:
    worst = 0.0
    for seed in range(1000 + 20 * block, 1020 + 20 * block):
        triples, start = random_triples(random.Random(seed))
        chain = chain_of(triples, start=start)
        columns, density = oracle.columns_of(chain), {chain.index(start): ONE}
        ends = absorption(chain)
        for states, mass in oracle.absorption(columns, density).items():
            names = tuple(chain.states[i] for i in sorted(states))
            found = [float(ends[names if len(names) > 1 else names[0]])]
            worst = max(worst, oracle.worst_relative_error(found, [mass]))
        transient = oracle.visits(columns, density)
        found = expected_visits(chain).iloc[list(transient)].tolist()
        worst = max(worst, oracle.worst_relative_error(found, list(transient.values())))
    assert worst <= TOLERANCE


# Birth and death -----------------------------------------------------------------------

EXTREMES = [1e-12, 1e-9, 1e-3, 0.3, 0.5, 0.75, 1 - 1e-3, 1 - 1e-9, 1 - 1e-12]


def steps_up_and_down(draw: random.Random, n: int) -> tuple[list[float], list[float]]:
    """Return P(up) and P(down) from each of n states: mostly a walk, sometimes one that waits."""
    up, down = [], []
    for _ in range(n):
        p = draw.choice(EXTREMES)
        lazy = draw.random() < 0.3
        up.append(p)
        down.append(min(draw.choice(EXTREMES), 1.0 - p) if lazy else 1.0 - p)
    return up, down


def ladder(up: list[float], down: list[float]) -> Chain:
    """Return the walk on 0 ... n-1: from i up with up[i], down with down[i], else it stays."""
    n = len(up)
    triples: Triples = []
    for i, (u, d) in enumerate(zip(up, down, strict=True)):
        u, d = (0.0 if i == n - 1 else u), (0.0 if i == 0 else d)
        triples += [(i, i + 1, u)] * (u > 0) + [(i, i - 1, d)] * (d > 0)
        if 1.0 - (u + d) > 1e-15 or u + d == 0.0:
            triples.append((i, i, 1.0 - (u + d)))
    return chain_of(triples)


def law_of_ladder(up: list[float], down: list[float]) -> list[Fraction]:
    """Return its stationary law: what goes up between two neighbors comes down."""
    ratios = [Fraction(up[i - 1]) / Fraction(down[i]) for i in range(1, len(up))]
    # Integers only, and no division: numerators before a state, denominators after it.
    before = accumulate((x.numerator for x in ratios), mul, initial=1)
    after = [*accumulate((x.denominator for x in reversed(ratios)), mul, initial=1)]
    weights = [a * b for a, b in zip(before, reversed(after), strict=True)]
    total = sum(weights)
    return [Fraction(w, total) for w in weights]


def in_order(chain: Chain, law: list[Fraction]) -> list[Fraction]:
    return [law[state] for state in chain.states]


@pytest.mark.parametrize("seed", range(4))
def test_birth_and_death_law(seed: int) -> None:
    up, down = steps_up_and_down(random.Random(seed), 30 + 40 * seed)
    chain = ladder(up, down)
    found = stochastic_limit(chain, 0)
    law = in_order(chain, law_of_ladder(up, down))
    assert (found.bound or 0.0) < 5e-15
    assert oracle.worst_relative_error(found.probability, law) <= TOLERANCE


def ruin(up: list[float], down: list[float], start: int) -> tuple[Chain, list[Fraction]]:
    """Return the walk that ends at 0 and at n, and the exact chances of both ends.

    From k the top comes first with probability (r_0 + ... + r_(k-1)) / (r_0 + ... + r_(n-1)), where
    r_i is the product of down[j] / up[j] over j = 1 ... i.
    """
    n = len(up)
    inner = range(1, n)
    sources = np.repeat(inner, 3)
    targets = np.array([t for i in inner for t in (i - 1, i, i + 1)])
    stays = 1.0 - (np.array(up) + np.array(down))[1:]
    chances = np.stack([down[1:], stays, up[1:]], axis=1).ravel()
    listed = (sources != targets) | (chances > 1e-15)
    chain = chain_from_arrays(
        range(n + 1), sources[listed], targets[listed], chances[listed], start=start
    )
    ratios = [Fraction(down[i]) / Fraction(up[i]) for i in inner]
    bottom, total = (sum_of_products(column) for column in (ratios[: start - 1], ratios))
    win = bottom / total
    return chain, [1 - win, win]


def sum_of_products(ratios: list[Fraction]) -> Fraction:
    """Return 1 + x_1 + x_1 x_2 + ... by Horner's scheme, in integers until the end."""
    num, den = 1, 1
    for x in reversed(ratios):
        num, den = x.denominator * den + x.numerator * num, x.denominator * den
    return Fraction(num, den)


@pytest.mark.parametrize("seed", range(4))
def test_birth_and_death_with_two_ends(seed: int) -> None:
    draw = random.Random(100 + seed)
    n = 30 + 40 * seed
    up, down = steps_up_and_down(draw, n)
    chain, ends = ruin(up, down, draw.randrange(1, n))
    found = stochastic_limit(chain)
    assert (found.bound or 0.0) < 5e-15
    assert oracle.worst_relative_error([found[0], found[n]], ends) <= TOLERANCE
    assert np.count_nonzero(found.probability) <= 2


@pytest.mark.parametrize(
    ("p", "n", "start"),
    [
        (0.5, 100, 37),
        (0.1, 211, 1),  # W = 1e-201
        (0.9, 211, 210),
        (0.3, 500, 3),
        (0.4, 1000, 20),
        (0.01, 100, 1),
        (1e-12, 20, 3),  # W = 1e-204
        (0.25, 1000, 500),
    ],
)
def test_gamblers_ruin(p: float, n: int, start: int) -> None:
    chain, ends = ruin([p] * n, [1.0 - p] * n, start)
    found = stochastic_limit(chain)
    assert oracle.worst_relative_error([found[0], found[n]], ends) <= TOLERANCE


def test_gamblers_ruin_of_many_states() -> None:
    p, n, start = 0.49, 10_000, 1
    found = stochastic_limit(ruin_chain(p, n, start))
    with localcontext(prec=60):
        ratio = Decimal(1.0 - p) / Decimal(p)
        win = Fraction((ratio - 1) / (ratio**n - 1))
    assert float(win) < 1e-170
    assert oracle.worst_relative_error([found[0], found[n]], [1 - win, win]) <= TOLERANCE


def ruin_chain(p: float, n: int, start: int) -> Chain:
    inner = np.arange(1, n)
    return chain_from_arrays(
        range(n + 1),
        np.repeat(inner, 2),
        np.stack([inner - 1, inner + 1], axis=1).ravel(),
        np.tile([1.0 - p, p], n - 1),
        start=start,
    )


# Blocks that hardly know each other ----------------------------------------------------


def coupled_blocks(draw: random.Random, size: int, coupling: float, *, ends: bool) -> Triples:
    """Return two random blocks joined by arcs of about `coupling`, with or without an exit each."""
    triples: Triples = []
    for block in (0, 1):
        states = range(block * size, (block + 1) * size)
        for state in states:
            targets = set(draw.sample(states, 3)) | {states[(state + 1) % size]}
            chances = shared_out(draw, sorted(targets), 1.0)
            if state == states[0]:
                out = coupling * draw.uniform(0.3, 3.0)
                exits = {(1 - block) * size: out} | ({2 * size + block: out / 7} if ends else {})
                left = 1.0 - sum(exits.values())
                chances = {t: c * left for t, c in chances.items()} | exits
            triples += [(state, target, chance) for target, chance in chances.items()]
    return triples


@each_of("ends", [False, True])
@each_of("coupling", [1e-6, 1e-10, 1e-15])
@each_of("size", [4, 12])
def test_coupled_blocks(size: int, coupling: float, ends: bool) -> None:
    draw = random.Random(size)
    chain = chain_of(coupled_blocks(draw, size, coupling, ends=ends), start=1)
    found = stochastic_limit(chain)
    assert oracle.worst_relative_error(found.probability, exact(chain, 1)) <= TOLERANCE


# Races ---------------------------------------------------------------------------------


def race_by_integers(race: Race) -> dict[tuple[int, ...], Fraction]:
    """Return the exact chance of each final state, all paths added in whole numbers.

    The chances of a rack are the floats p and 1 - p; a chain that is left with p or q is
    left for the first with p / (p + q), which matters where 1 - p was rounded.
    """
    pairs = {}
    for breaker in (1, 2):
        win, lose = (int(Fraction(race.rack.chance(w, breaker)) * 2**1074) for w in (1, 2))
        shared = Fraction(win, win + lose)
        pairs[breaker] = (shared.numerator, shared.denominator)
    scale = pairs[1][1] * pairs[2][1]
    chances = {
        breaker: {1: num * (scale // den), 2: (den - num) * (scale // den)}
        for breaker, (num, den) in pairs.items()
    }
    level = {race.start: 1}
    racks = 0
    final: dict[tuple[int, ...], Fraction] = {}
    while level:
        deeper: dict[tuple[int, ...], int] = {}
        for state, weight in level.items():
            if race.winner(state):
                final[state] = Fraction(weight, scale**racks)
                continue
            a, b, *last = state
            breaker = last[0] if last else 1
            for winner, after in ((1, (a + 1, b)), (2, (a, b + 1))):
                nxt = (*after, race.breaks(breaker, winner)) if last else after
                more = weight * chances[breaker][winner]
                if more:
                    deeper[nxt] = deeper.get(nxt, 0) + more
        level = deeper
        racks += 1
    return final


RACES = [
    Race(60, 60, Rack(0.5)),
    Race(60, 60, Rack(0.1)),
    Race(60, 60, Rack(0.999)),
    Race(60, 60, Rack(1e-12)),
    Race(60, 7, Rack(2 / 3)),
    Race(1, 60, Rack(0.3)),
    Race(13, 9, Rack(0.55), score=(3, 5)),
    Race(60, 60, Rack(0.6, 0.55), breaks=winner_breaks),
    Race(60, 45, Rack(0.9, 1e-3), breaks=loser_breaks, first_breaker=2),
    Race(30, 60, Rack(1 - 1e-9, 0.3), breaks=alternate_breaks),
]


@each_of("race", RACES)
def test_races(race: Race) -> None:
    final = race_by_integers(race)
    found = stochastic_limit(chain_of(race))
    given = [found[state] for state in final]
    assert oracle.worst_relative_error(given, list(final.values())) <= TOLERANCE
    for player in (1, 2):
        wins = sum(found[state] for state in final if race.winner(state) == player)
        exact_wins = sum((x for s, x in final.items() if race.winner(s) == player), Fraction(0))
        assert oracle.worst_relative_error([wins], [exact_wins]) <= TOLERANCE


def test_the_witness_of_races_counts_paths() -> None:
    final = race_by_integers(Race(3, 2, Rack(0.25)))
    assert final[3, 1] == comb(3, 1) * Fraction(1, 64) * Fraction(3, 4)
    assert sum(final.values()) == 1


# More decades than a float has ---------------------------------------------------------


def error_against(law: list[Fraction], chain: Chain, start: object) -> float:
    found = stochastic_limit(chain, start).probability
    return oracle.worst_relative_error(found, law)


@pytest.mark.parametrize("n", [60, 150, 300])
def test_one_peak_over_many_decades(n: int) -> None:
    up, down = [1e-9] * n, [1 - 1e-9] * n
    assert error_against(law_of_ladder(up, down), ladder(up, down), n - 1) <= TOLERANCE


@pytest.mark.parametrize("n", [60, 150, 300])
def test_two_peaks_with_a_deep_valley(n: int) -> None:
    low, high = [1e-9] * (n // 2), [0.25] * (n // 2)
    up, down = low + high, high + low
    chain = ladder(up, down)
    law = law_of_ladder(up, down)
    assert min(float(law[0]), float(law[-1])) > 0.1
    assert float(law[n // 2]) < 1e-200
    assert error_against(in_order(chain, law), chain, n // 2) <= TOLERANCE


def metropolis(heights: np.ndarray, neighbors: Iterator[tuple[int, int]]) -> Chain:
    """Return a chain whose law is 2^-height: all its arcs are exact powers of two."""
    triples = []
    left = np.ones(len(heights))
    for i, j in neighbors:
        for a, b in ((i, j), (j, i)):
            chance = 0.125 * 2.0 ** min(0, int(heights[a] - heights[b]))
            triples.append((a, b, chance))
            left[a] -= chance
    return chain_of([*triples, *((k, k, float(x)) for k, x in enumerate(left))])


@pytest.mark.parametrize(
    ("side", "span"),
    [(5, 40), (5, 1000), (5, 4000), (9, 40), (9, 1000), (13, 40), (13, 1000), (20, 1000)],
)
def test_hilly_grid(side: int, span: int) -> None:
    """Hills and valleys on a grid: no order of the states is downhill all the way."""
    x, y = np.meshgrid(np.arange(side), np.arange(side), indexing="ij")
    height = (np.sin(1.3 * x) * np.cos(1.7 * y) + 1.0) / 2.0
    heights = np.round(height.ravel() / height.max() * min(span, 900 * side)).astype(int)
    number = np.arange(side * side).reshape(side, side)
    pairs = [*zip(number[1:].flat, number[:-1].flat, strict=True)]
    pairs += zip(number[:, 1:].flat, number[:, :-1].flat, strict=True)
    chain = metropolis(heights, ((int(i), int(j)) for i, j in pairs))
    weights = [1 << int(heights.max() - h) for h in heights]
    law = in_order(chain, [Fraction(w, sum(weights)) for w in weights])
    if chain.matrix.nnz < len(heights) + 2 * len(pairs):  # some arcs are smaller than any float
        law = exact(chain, 0)
    assert error_against(law, chain, 0) <= TOLERANCE


def random_tree(
    draw: random.Random, n: int, decades: float, reach: int
) -> tuple[Chain, list[Fraction]]:
    """Return a walk on a tree with arcs of any size, and its law: what goes up comes down.

    With a reach of 1 the tree is a line; the states come in any order.
    """
    parent = {k: draw.randrange(max(0, k - reach), k) for k in range(1, n)}
    weights: list[dict[int, float]] = [{} for _ in range(n)]
    for k, above in parent.items():
        weights[k][above] = 10.0 ** -draw.uniform(0.0, decades)
        weights[above][k] = 10.0 ** -draw.uniform(0.0, decades)
    columns = [
        {target: weight / sum(row.values()) for target, weight in row.items()} for row in weights
    ]
    law = [ONE]
    for k, above in parent.items():
        law.append(law[above] * Fraction(columns[above][k]) / Fraction(columns[k][above]))
    total = sum(law)
    chain = chain_of((j, i, columns[j][i]) for j in draw.sample(range(n), n) for i in columns[j])
    return chain, in_order(chain, [x / total for x in law])


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("decades", [10, 60, 300])
@pytest.mark.parametrize("reach", [1, 4], ids=["line", "tree"])
@pytest.mark.parametrize("n", [40, 150])
def test_arcs_of_any_size(n: int, reach: int, decades: float) -> None:
    for seed in range(6):
        chain, law = random_tree(random.Random(seed), n, decades, reach)
        assert error_against(law, chain, chain.states[seed]) <= TOLERANCE
