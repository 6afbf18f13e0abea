import math

import numpy as np
import pytest

from evenbreak.chains import chain_of, long_run_reward
from evenbreak.errors import InputError
from evenbreak.games import BREAK_FORMATS, Rack, Series, loser_breaks, winner_breaks
from evenbreak.practice.breaks import Breakers
from rows import each_of


@each_of("breaks", BREAK_FORMATS.values())
@each_of("first", [1, 2])
def test_the_fraction_won_is_the_long_run_reward_of_the_series(breaks, first):
    rack = Rack(0.7, 0.6)
    series = Series(rack, breaks=breaks, first_breaker=first)
    breakers = Breakers.of(0.7, 0.6, breaks)
    chain = chain_of(series)
    per_state = {state: rack.chance(1, state) for state in chain.states}
    reward = long_run_reward(chain, per_state=per_state)
    assert breakers.won(first) == pytest.approx(reward)
    assert breakers.won(first) + breakers.lost(first) == pytest.approx(1.0)
    assert sum(breakers.broken(first)) == pytest.approx(1.0)


def test_a_break_that_never_passes_on_stays_with_the_first_breaker():
    breakers = Breakers.of(1.0, 1.0, winner_breaks)
    assert [float(part) for part in breakers.broken(2)] == [0.0, 1.0]
    assert breakers.first_break == math.inf
    assert Breakers.of(0.0, 0.0, loser_breaks).first_break == -math.inf


def test_arrays_are_many_pairs_of_players():
    breakers = Breakers.of([0.5, 0.75], 0.75, winner_breaks)
    assert breakers.won(1).shape == (2,)
    assert np.allclose(breakers.first_break, [1 / 3, 1.0])


def test_pulls_are_the_next_breaks_after_a_win_less_those_after_a_loss():
    assert Breakers.of(0.5, 0.5, winner_breaks).pulls == (1, 1)
    assert Breakers.of(0.5, 0.5, loser_breaks).pulls == (-1, -1)


def test_both_chances_are_needed():
    with pytest.raises(InputError, match="p2 is missing"):
        Breakers.of(0.5, None, winner_breaks)
