"""Lumping: against all partitions of small chains, and against chains whose states were split."""

import random
from collections.abc import Iterator
from fractions import Fraction

import numpy as np
import pytest

from evenbreak.chains import (
    Chain,
    chain_from_arrays,
    chain_of,
    coarsest_lumping,
    first_passage,
    lumped,
    stochastic_limit,
)
from evenbreak.errors import ChainError
from evenbreak.games import Race, Rack
from tries import tries

TRIES = tries("lumped chains", 40)


def partitions(states: list[int]) -> Iterator[list[set[int]]]:
    """Yield all partitions of the states."""
    if not states:
        yield []
        return
    for rest in partitions(states[1:]):
        yield [{states[0]}, *rest]
        for k, block in enumerate(rest):
            yield [*rest[:k], block | {states[0]}, *rest[k + 1 :]]


def is_lumpable(M: np.ndarray, blocks: list[set[int]]) -> bool:
    """Whether all states of a block have the same chances into each block; in whole sixths."""
    into = np.array([M[sorted(block)].sum(axis=0) for block in blocks])
    return all((into[:, [j]] == into[:, sorted(block)]).all() for block in blocks for j in block)


def test_the_coarsest_of_all_partitions() -> None:
    lumps = 0
    for seed in range(TRIES):
        draw = np.random.default_rng(seed)
        n = int(draw.integers(1, 7))
        sixths = np.stack([draw.multinomial(6, np.full(n, 1 / n)) for _ in range(n)], axis=1)
        if draw.random() < 0.6:
            twins = draw.choice(n, 2)
            sixths[:, twins[0]] = sixths[:, twins[1]]
        kept = draw.integers(0, 2, n).tolist()
        chain = chain_of(
            [(j, i, Fraction(int(sixths[i, j]), 6)) for j in range(n) for i in range(n)],
        )
        finest = [
            blocks
            for blocks in partitions(list(range(n)))
            if all(len({kept[j] for j in block}) == 1 for block in blocks)
            and is_lumpable(sixths, blocks)
        ]
        best = min(finest, key=len)
        by = coarsest_lumping(chain, dict(enumerate(kept)))
        found = {frozenset(j for j in range(n) if by[j] == name) for name in by.values()}
        assert found == {frozenset(block) for block in best}, seed
        lumps += len(best) < n
        matrix = lumped(chain, by).to_frame()
        for block in best:
            for other in best:
                chance = sixths[sorted(block)][:, min(other)].sum() / 6
                assert matrix.loc[by[min(block)], by[min(other)]] == pytest.approx(chance)
    assert lumps > TRIES / 10


def split_up(draw: random.Random, decades: float) -> tuple[Chain, Chain]:
    """Return a chain and one of up to four copies of each state that share its arcs at random."""
    n = draw.randint(2, 8)
    copies = [[(j, k) for k in range(draw.randint(1, 4))] for j in range(n)]
    small, large = [], []
    for j in range(n):
        targets = draw.sample(range(n), draw.randint(1, min(3, n)))
        weights = [10.0 ** -draw.uniform(0, decades) for _ in targets]
        for i, weight in zip(targets, weights, strict=True):
            small.append((j, i, weight / sum(weights)))
            for copy in copies[j]:
                shares = [10.0 ** -draw.uniform(0, 3) for _ in copies[i]]
                large += [
                    (copy, to, small[-1][2] * (share / sum(shares)))
                    for to, share in zip(copies[i], shares, strict=True)
                ]
    draw.shuffle(large)
    return chain_of(small, start=0), chain_of(large, start=(0, 0))


def test_split_states_are_found_again() -> None:
    for seed in range(TRIES):
        draw = random.Random(seed)
        small, large = split_up(draw, draw.choice([1.0, 12.0, 100.0]))
        again = lumped(large, lambda copy: copy[0])
        order = [again.index(state) for state in small.states]
        M = again.matrix.toarray()[np.ix_(order, order)]
        assert pytest.approx(small.matrix.toarray(), rel=1e-12, abs=0.0) == M
        target = draw.choice(list(small.states))
        by = coarsest_lumping(large, lambda copy, target=target: copy[0] == target)
        coarse = lumped(large, by)
        assert len(coarse) <= len(small)
        label = by[target, 0]
        for chain, start, end in ((coarse, None, label), (again, None, target)):
            steps = first_passage(chain, start, end)
            expected = first_passage(small, 0, target)
            assert steps.p_reached == pytest.approx(expected.p_reached, rel=1e-11)
            if expected.p_reached:
                assert steps.mean_if_reached == pytest.approx(expected.mean_if_reached, rel=1e-11)


def test_a_race_has_the_same_winner() -> None:
    race = Race(5, 4, Rack(0.7))
    chain = chain_of(race)
    by = coarsest_lumping(chain, race.winner)
    limit = stochastic_limit(lumped(chain, by))
    won = sum(p for score, p in stochastic_limit(chain).items() if race.winner(score) == 1)
    first = next(score for score in chain.states if race.winner(score) == 1)
    assert limit[first] == pytest.approx(won, rel=1e-14)


def test_rounding_does_not_keep_states_apart_but_rare_arcs_do() -> None:
    arcs = [("s", "a", 0.5), ("s", "b", 0.5), ("a", "x", 0.1), ("a", "y", 0.2), ("b", "x", 0.3)]
    ends = {"x": "end", "y": "end"}
    rest = [("a", "s", 0.7), ("b", "s", 0.7)]
    chain = chain_of([*arcs, *rest])
    assert len(set(coarsest_lumping(chain, lambda k: ends.get(k, "")).values())) == 3
    rare = [("a", "s", 0.7), ("b", "s", 0.7), ("a", "z", 1e-200), ("b", "z", 2e-200)]
    chain = chain_of([*arcs, *rare])
    ends["z"] = "z"
    assert len(set(coarsest_lumping(chain, lambda k: ends.get(k, "")).values())) == 5


def test_two_states_are_named() -> None:
    chain = chain_of([("s", "won", 0.25), ("s", "t", 0.75), ("t", "won", 0.5), ("t", "s", 0.5)])
    with pytest.raises(ChainError, match=r"states 's' and 't' .* to 'won' .* 0\.25 and 0\.5\."):
        lumped(chain, {"s": "play", "t": "play", "won": "won"})
    with pytest.raises(ChainError, match=r"states '(s|won)' and '(s|won)' have the same label"):
        lumped(chain, lambda state: "t" if state == "t" else "other")
    with pytest.raises(ChainError, match="no label for state 'won'"):
        lumped(chain, {"s": "play", "t": "play"})
    with pytest.raises(ChainError, match="by must be a function"):
        lumped(chain, "play")
    with pytest.raises(ChainError, match="label of state 's' must be a name, a number or a tuple"):
        coarsest_lumping(chain, lambda state: ([state],))


def test_fractions_are_kept() -> None:
    thirds = {("s", "a"): "1/3", ("s", "b"): "1/3", ("s", "c"): "1/3"}
    chain = chain_of([(j, i, p) for (j, i), p in thirds.items()], start="s")
    two = lumped(chain, lambda state: "ab" if state in "ab" else state)
    assert stochastic_limit(two, exact=True) == {"s": 0, "ab": Fraction(2, 3), "c": Fraction(1, 3)}
    chain = chain_of([("s", "a", 0.1), ("s", "b", 0.2), ("s", "c", 0.7)], start="s")
    two = lumped(chain, lambda state: "ab" if state in "ab" else state)
    assert stochastic_limit(two, exact=True)["ab"] == Fraction(3, 10)


@pytest.mark.slow
def test_a_long_ring_of_twins() -> None:
    """Around 3,000 places in two lanes, with one end: the lanes are one, the places are not."""
    n = 3000
    j = np.arange(n - 1)
    sources = np.concatenate((j, j, j + n, j + n))
    targets = np.concatenate((j + 1, j + n + 1, j + 1, j + n + 1))
    chain = chain_from_arrays(range(2 * n), sources, targets, np.full(4 * (n - 1), 0.5))
    by = coarsest_lumping(chain, lambda state: state % n == n - 1)
    assert {state for state, first in by.items() if state == first} == set(range(n))
