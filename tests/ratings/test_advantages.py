"""Advantages of the first breaker and the breaker, in simulated seasons."""

import numpy as np
import pytest

from evenbreak.ratings import Results, walk_forward
from evenbreak.ratings.validation.advantages import break_advantage, first_breaks, known_breaks


def test_a_season_of_the_model_shows_no_advantage(plain):
    breaker = break_advantage(plain)
    assert first_breaks(plain).p_value > 0.01
    assert breaker.low < 0.0 < breaker.high
    assert known_breaks(plain) == plain.games.sum()


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("breaks", [3, 1], ids=["alternate", "winner"])
def test_the_advantage_of_the_breaker_is_found(play_season, breaks):
    forecasts = walk_forward(
        play_season(np.random.default_rng(6), advantage=0.3, breaks=breaks), prior_sd=0.5
    )
    found = break_advantage(forecasts)
    assert found.low < 0.3 < found.high
    assert found.low > 0.15


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("form", [0.0, 0.6])
def test_a_stronger_player_who_breaks_more_often_is_not_taken_for_an_advantage(play_season, form):
    """Winner breaks give the break to the player who is stronger on the day."""
    season = play_season(np.random.default_rng(10), form=form, breaks=1)
    found = break_advantage(walk_forward(season, prior_sd=0.5))
    assert found.low < 0.0 < found.high
    assert found.high - found.low < 0.25


def test_who_breaks_first_wins_more_when_the_break_is_worth_much(play_season):
    season = play_season(np.random.default_rng(8), advantage=0.8)
    found = first_breaks(walk_forward(season, prior_sd=0.5))
    assert found.won > found.expected
    assert found.p_value < 0.01


def test_what_the_file_does_not_say_is_not_answered():
    results = Results.from_names(
        ["Ann", "Ann"], ["Bo", "Bo"], [4, 3], [4, 3], date=["2024-09-03", "2024-09-04"]
    )
    forecasts = walk_forward(results)
    assert first_breaks(forecasts) is None
    assert break_advantage(forecasts) is None
