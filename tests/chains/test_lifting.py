"""Exact solutions modulo powers of a prime, against elimination in fractions."""

from fractions import Fraction

import numpy as np
import pytest

from evenbreak.chains import chain_of, exact, steps_to_absorption, stochastic_limit
from evenbreak.chains import exact as lifting
from evenbreak.chains.elimination import Elimination
from evenbreak.chains.exact import Lifting
from evenbreak.errors import AccuracyError
from tries import tries

COMMON = [1, 97, 10**17, 2**1074]


def part(n, draw, common):
    """Return arcs and leaks of n states at random, over common denominators."""
    arcs, leaks = [], []
    for j in range(n):
        targets = [i for i in range(n) if i != j and draw.random() < 0.7]
        weights = [int(draw.integers(1, 100)) for _ in targets]
        below = sum(weights) + int(draw.integers(0, 3)) + common
        arcs.append({i: Fraction(w, below) for i, w in zip(targets, weights, strict=True)})
        leaks.append(Fraction(int(draw.integers(0, 2)), below))
    leaks[-1] += Fraction(1, common + 1)
    arcs[-2][n - 1] = Fraction(1, common + 7)  # the last state can be reached from all others
    for j in range(n - 2):
        arcs[j][j + 1] = Fraction(1, common + 9)
    return arcs, leaks


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("common", COMMON, ids=["1", "97", "decimals", "subnormal"])
def test_both_solves_agree_with_elimination(common):
    for seed in range(tries("exact systems", 3, parts=len(COMMON))):
        draw = np.random.default_rng([seed, common % 10**9])
        n = int(draw.integers(2, 9))
        arcs, leaks = part(n, draw, common)
        lifted = Lifting(arcs, leaks)
        plain = Elimination([row.copy() for row in arcs], leaks)
        b = [Fraction(int(x), 3 + k) for k, x in enumerate(draw.integers(0, 5, n))]
        assert lifted.visits(b) == plain.visits(b)
        assert lifted.values(b) == plain.values(b)


def test_a_prime_that_divides_a_pivot_is_passed_over(monkeypatch):
    """Modulo 31 the first pivot is 0, modulo 29 the second one."""
    monkeypatch.setattr(lifting, "_BITS", 5)
    arcs = [{1: Fraction(2, 31)}, {0: Fraction(1, 3)}]
    leaks = [Fraction(29, 31), Fraction(0)]
    lifted, plain = Lifting(arcs, leaks), Elimination([row.copy() for row in arcs], leaks)
    assert lifted.visits([Fraction(1), Fraction(1)]) == plain.visits([Fraction(1), Fraction(1)])
    assert lifted._prime == 23


def test_answers_do_not_depend_on_the_way(monkeypatch):
    draw = np.random.default_rng(8)
    arcs = [("start", k, Fraction(1, 12)) for k in range(12)]
    for j in range(12):
        weights = draw.integers(1, 9, 5).tolist()
        targets = [(j + step) % 12 for step in range(1, 6)]
        arcs += [
            (j, i, Fraction(w, sum(weights) + 1)) for i, w in zip(targets, weights, strict=True)
        ]
        arcs.append((j, "A" if j < 6 else "B", Fraction(1, sum(weights) + 1)))
    arcs += [("A", "A'", 1), ("A'", "A", Fraction(1, 2)), ("A'", "A'", Fraction(1, 2))]
    chain = chain_of(arcs, start="start")
    ways = []
    for fill in (0, 4, 1_000):
        monkeypatch.setattr(exact, "_FILL", fill)
        steps = steps_to_absorption(chain, exact=True)
        ways.append((stochastic_limit(chain, exact=True), steps))
    assert ways[0] == ways[1] == ways[2]
    assert float(steps.mean_if_reached) == pytest.approx(
        steps_to_absorption(chain).mean_if_reached, rel=1e-14
    )


def test_the_law_of_many_dense_states_balances():
    n = 90
    weights = np.random.default_rng(2).integers(1, 10, (n, n)).tolist()
    rows = [[Fraction(w, sum(row)) for w in row] for row in weights]
    chain = chain_of([(j, i, p) for j, row in enumerate(rows) for i, p in enumerate(row)], start=0)
    law = stochastic_limit(chain, exact=True)
    assert sum(law.values()) == 1
    for i in (0, n - 1):
        assert sum(law[j] * rows[j][i] for j in range(n)) == law[i]


def test_too_many_states_are_refused(monkeypatch):
    monkeypatch.setattr(lifting, "_MOST_STATES", 30)
    weights = np.random.default_rng(3).integers(1, 10, (40, 40)).tolist()
    rows = [[Fraction(w, sum(row)) for w in row] for row in weights]
    chain = chain_of([(j, i, p) for j, row in enumerate(rows) for i, p in enumerate(row)], start=0)
    with pytest.raises(AccuracyError, match=r"39 states have too many arcs .* leave exact out"):
        stochastic_limit(chain, exact=True)
