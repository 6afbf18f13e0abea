"""Exact chances of winning, against the chain of all scores and against floats."""

from fractions import Fraction
from math import comb

import pytest

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.games import (
    Ahead,
    OneBall,
    Race,
    Rack,
    alternate_breaks,
    loser_breaks,
    winner_breaks,
)
from evenbreak.matches import win_probability
from rows import each_of

BY_BREAK = Rack(0.6, 0.45)
MATCHES = [
    Race(7, 5, Rack(0.6)),
    Race(7, 5, Rack(0.6), score=(2, 3)),
    Race(4, 4, Rack(0.3), win_by=2),
    Race(5, 6, BY_BREAK, breaks=winner_breaks, first_breaker=2),
    Ahead(4, 3, BY_BREAK, breaks=alternate_breaks),
    Race(3, 2, Race(3, 3, BY_BREAK, breaks=loser_breaks)),
    Race(2, 2, Race(2, 2, BY_BREAK, breaks=winner_breaks), breaks=alternate_breaks),
    Race(3, 2, Ahead(2, 2, BY_BREAK, breaks=winner_breaks), breaks=loser_breaks, score=(1, 1)),
]


@each_of("match", MATCHES)
@each_of("player", [1, 2])
def test_it_is_the_limit_of_the_chain_of_scores(match, player):
    limit = stochastic_limit(chain_of(match), exact=True)
    won = sum(p for state, p in limit.items() if match.winner(state) == player)
    found = win_probability(match, player=player, exact=True)
    assert found == won
    assert win_probability(match, player=player) == pytest.approx(float(found), rel=1e-14)


def test_fractions_are_kept():
    third = Fraction(1, 3)
    found = win_probability(Race(9, 5, Rack(1 - third)), exact=True)
    assert found == sum(comb(13, k) * (1 - third) ** k * third ** (13 - k) for k in range(9, 14))


def test_play_that_never_ends_is_neither_players():
    each_wins_own_break = Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks)
    assert win_probability(each_wins_own_break, exact=True) == 0
    set_ = Ahead(2, 2, Rack(1.0, 0.5), breaks=alternate_breaks, first_breaker=1)
    race = Race(2, 2, set_)
    total = sum(win_probability(race, player=k, exact=True) for k in (1, 2))
    assert total == 1


def test_a_decided_match_and_a_chance_near_1():
    assert win_probability(Race(2, 2, Rack(0.5), score=(2, 1)), exact=True) == 1
    nearly = Rack(1.0, q1=1e-20)
    assert win_probability(Race(1, 1, nearly), player=2, exact=True) == Fraction(1, 10**20)


def test_arrays_are_refused():
    with pytest.raises(InputError, match="array"):
        win_probability(Race(2, 2, Rack([0.5, 0.6])), exact=True)


def test_games_of_your_own():
    alone = win_probability(OneBall(0.5, 0.25), exact=True)
    assert alone == Fraction(4, 5)
    race = win_probability(Race(2, 2, OneBall(0.5, 0.25)), player=2, exact=True)
    assert race == win_probability(Race(2, 2, Rack(0.8)), player=2, exact=True)
