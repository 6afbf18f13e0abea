"""Answers in fractions, against the solver of the tests and facts from the literature."""

from fractions import Fraction
from math import comb

import networkx as nx
import numpy as np
import pytest

import oracle
from evenbreak.chains import absorption, chain_of, steps_to_absorption, stochastic_limit
from evenbreak.chains.exact import exact_rows
from evenbreak.errors import ChainError, InputError
from evenbreak.games import Ahead, OneBall, Race, Rack, winner_breaks
from evenbreak.matches import win_probability


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
    with pytest.raises(ChainError, match="start density"):
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
