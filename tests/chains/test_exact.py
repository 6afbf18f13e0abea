"""Answers in fractions, against the solver of the tests and facts from the literature."""

from fractions import Fraction
from math import comb

import networkx as nx
import numpy as np
import pytest

import oracle
from evenbreak.chains import absorption, chain_of, exact, steps_to_absorption, stochastic_limit
from evenbreak.chains.elimination import Elimination
from evenbreak.chains.exact import Lifting, exact_rows
from evenbreak.errors import AccuracyError, ChainError, InputError
from evenbreak.games import Ahead, OneBall, Race, Rack, winner_breaks
from evenbreak.matches import win_probability
from tries import tries


def test_a_race_is_a_sum_of_binomials():
    m, n, p = 50, 50, Fraction(3, 5)
    limit = stochastic_limit(chain_of(Race(m, n, Rack(0.6))), exact=True)
    won = sum(x for (a, _), x in limit.items() if a == m)
    assert won == sum(p**m * (1 - p) ** k * comb(m - 1 + k, k) for k in range(n))
    assert sum(limit.values()) == 1


def test_a_random_chain_agrees_with_the_solver_of_the_tests():
    draw = np.random.default_rng(3)
    arcs = []
    for j in range(12):
        targets = draw.choice(12, 4, replace=False)
        weights = draw.integers(1, 9, 4).tolist()
        arcs += [
            (j, int(i), Fraction(w, sum(weights))) for i, w in zip(targets, weights, strict=True)
        ]
    chain = chain_of(arcs, start=0)
    expected = oracle.limit(exact_rows(chain), {0: Fraction(1)})
    assert list(stochastic_limit(chain, exact=True).values()) == expected
    assert stochastic_limit(chain).probability == pytest.approx([float(x) for x in expected])


def test_transient_states_lead_to_classes_of_several_states():
    arcs = {"s": {"s": "1/7", "a": "2/7", "c": "4/7"}, "a": {"b": 1}, "b": {"a": "0.5", "b": "0.5"}}
    chain = chain_of(arcs, start="s")
    limit = stochastic_limit(chain, exact=True)
    assert limit == {"s": 0, "a": Fraction(1, 9), "b": Fraction(2, 9), "c": Fraction(2, 3)}
    classes = absorption(chain, exact=True)
    assert classes.to_dict() == {("a", "b"): Fraction(1, 3), "c": Fraction(2, 3)}
    begun = {"a": Fraction(1, 3), "c": Fraction(2, 3)}
    assert stochastic_limit(chain, begun, exact=True) == limit


def test_the_steps_of_a_gamblers_ruin():
    p, q = Fraction(3, 5), Fraction(2, 5)
    odds = (q / p) ** 3
    time = steps_to_absorption(chain_of(Ahead(3, 3, Rack(0.6))), exact=True)
    ahead = 1 / (1 + odds)
    assert time.p_reached == 1
    assert time.mean_if_reached == 3 * (2 * ahead - 1) / (p - q)
    near = steps_to_absorption(chain_of(Ahead(3, 3, Rack(0.6))))
    assert float(time.variance_if_reached) == pytest.approx(near.variance_if_reached, rel=1e-14)


def test_a_target_that_may_be_missed():
    chain = chain_of({"s": {"end": "1/4", "a": "3/4"}, "a": {"b": 1}, "b": {"a": 1}}, start="s")
    assert steps_to_absorption(chain, exact=True) == (Fraction(1, 4), Fraction(3, 4), 1, 0)
    never = steps_to_absorption(chain, "a", exact=True)
    assert never == (0, 1, None, None)


def test_graphs_keep_fractions_too():
    graph = nx.DiGraph()
    graph.add_edge("s", "won", probability=Fraction(1, 3))
    graph.add_edge("s", "lost", probability="2/3")
    assert stochastic_limit(chain_of(graph), "s", exact=True)["won"] == Fraction(1, 3)


def test_arcs_that_miss_1_are_refused_by_name():
    with pytest.raises(ChainError, match="'rack'"):
        stochastic_limit(chain_of({"rack": {"won": 1 / 3, "lost": 2 / 3}}), "rack", exact=True)


def test_a_start_that_misses_1_is_refused():
    chain = chain_of({"a": {"b": 1}, "b": {"a": 1}})
    with pytest.raises(ChainError, match="start vector"):
        stochastic_limit(chain, {"a": 1 / 3, "b": 2 / 3}, exact=True)


def test_chances_that_are_no_fractions_are_refused():
    with pytest.raises(ChainError, match="arc 1"):
        chain_of([("a", "b", "often")])
    with pytest.raises(ChainError, match="arc 1"):
        chain_of([("a", "b", "1/0")])
    with pytest.raises(ChainError, match="float"):
        chain_of([("a", "b", Fraction(1, 10**400)), ("a", "a", 1)])


def test_there_is_one_way_to_an_exact_answer():
    with pytest.raises(InputError, match="eigen"):
        stochastic_limit(chain_of({"a": {"b": 1}}), "a", via="eigen", exact=True)


THIRD, SEVENTH = Fraction(1, 3), Fraction(1, 7)
IN_FRACTIONS = [
    OneBall(THIRD, Fraction(4, 5)),
    Race(3, 2, Rack(THIRD, SEVENTH), breaks=winner_breaks),
    Ahead(2, 2, Rack(THIRD)),
    Race(2, 1, Race(2, 2, Rack(THIRD))),
    Race(2, 1, OneBall(THIRD, SEVENTH)),
]


@pytest.mark.parametrize(
    "game", IN_FRACTIONS, ids=["one-ball", "race", "ahead", "sets", "race of one-ball"]
)
def test_a_game_keeps_the_fractions_that_it_is_given(game):
    limit = stochastic_limit(chain_of(game), exact=True)
    wins = sum(p for state, p in limit.items() if game.winner(state) == 1)
    assert wins == win_probability(game, exact=True)
    assert float(wins) == pytest.approx(win_probability(game), rel=1e-14)


def test_one_ball_of_a_third_is_five_thirteenths():
    limit = stochastic_limit(chain_of(OneBall(THIRD, Fraction(4, 5))), exact=True)
    assert limit["W"] == Fraction(5, 13)


# Exact solutions modulo powers of a prime, against elimination in fractions.


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
    monkeypatch.setattr("evenbreak.chains.exact._BITS", 5)
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
    monkeypatch.setattr("evenbreak.chains.exact._MOST_STATES", 30)
    weights = np.random.default_rng(3).integers(1, 10, (40, 40)).tolist()
    rows = [[Fraction(w, sum(row)) for w in row] for row in weights]
    chain = chain_of([(j, i, p) for j, row in enumerate(rows) for i, p in enumerate(row)], start=0)
    with pytest.raises(
        AccuracyError, match=r"39 states for an answer in fractions\. Leave out exact"
    ):
        stochastic_limit(chain, exact=True)
