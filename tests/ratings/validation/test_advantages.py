"""Advantages of the first breaker and the breaker, in simulated seasons."""

import numpy as np
import pytest

from evenbreak.ratings import Results, walk_forward
from evenbreak.ratings.validation.advantages import (
    break_advantage,
    by_experience,
    first_breaks,
    first_column,
    known_breaks,
    side_advantage,
)
from simulated_levels import league


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


# Whether the first column means something, in simulated seasons.


def turned(season, swap):
    """Return a season with its players swapped in some rows."""
    a, b = (season.player_a, season.player_b), (season.score_a, season.score_b)
    return Results(
        season.players, np.where(swap, a[1], a[0]), np.where(swap, a[0], a[1]),
        np.where(swap, b[1], b[0]), np.where(swap, b[0], b[1]), date=season.date,
    )  # fmt: skip


def test_a_season_of_the_model_has_no_order(plain):
    found, side = first_column(plain), side_advantage(plain)
    assert side.low < 0.0 < side.high
    assert not found.winners_first
    assert not found.winners_first_on_some_dates
    assert (found.stronger_first, found.dates, found.dates_won) == (0, 30, 0)
    assert found.varies > 0.01


@pytest.mark.parametrize("half", [False, True], ids=["all dates", "half of the dates"])
def test_winners_listed_first_are_seen(play_season, half):
    season = play_season(np.random.default_rng(2), matches=400)
    day = (season.date - season.date[0]).astype(int)
    swap = (season.score_b > season.score_a) & ((day % 2 == 0) | (not half))
    found = first_column(walk_forward(turned(season, swap), prior_sd=0.5))
    assert found.winners_first is not half
    assert found.winners_first_on_some_dates
    assert found.dates_won == (5 if half else 10)
    if half:
        assert found.varies < 1e-3


def test_stronger_players_listed_first_are_seen(play_season):
    season = play_season(np.random.default_rng(2), matches=600)
    wins = np.bincount(season.player_a, season.score_a, 20) + np.bincount(
        season.player_b, season.score_b, 20
    )
    swap = wins[season.player_b] > wins[season.player_a]
    ranked = turned(season, swap)
    assert first_column(walk_forward(ranked, prior_sd=0.5)).stronger_first == 1


def test_the_advantage_of_the_first_column_is_found(play_season):
    forecasts = walk_forward(play_season(np.random.default_rng(7), side=0.3), prior_sd=0.5)
    found = side_advantage(forecasts)
    # The ratings absorb a little of it.
    assert 0.2 < found.value < 0.4
    assert found.low > 0.15


def test_two_dates_do_not_make_a_first_column_matter(play_season):
    """From two dates alone hardly any spread could be estimated."""
    off = 0
    for seed in range(40):
        rng = np.random.default_rng([11, seed])
        found = side_advantage(walk_forward(play_season(rng, matches=80), prior_sd=0.5))
        off += not found.low < 0.0 < found.high
    assert off <= 6  # 5% of 40 are 2


# Newcomers who are weaker than the prior expects, and newcomers who are not.


def newest(below, seed):
    rng = np.random.default_rng(seed)
    results, _, _ = league(rng, below=below, players=150, days=40, a_day=40)
    return by_experience(walk_forward(results, prior_sd=0.5))


def test_weak_newcomers_win_less_than_predicted():
    groups = newest(1.0, 1)
    assert groups[0].fewest == 0
    assert groups[0].most == 0
    assert groups[0].stronger.high < 0.0
    assert groups[0].seen < groups[0].predicted
    assert groups[-1].stronger.low < 0.0 < groups[-1].stronger.high


@pytest.mark.slow
def test_a_league_without_the_effect_shows_none():
    far = [group for seed in range(6) for group in newest(0.0, seed)]
    out = [one for one in far if not one.stronger.low <= 0.0 <= one.stronger.high]
    assert len(out) <= 0.15 * len(far) + 1


def test_groups_hold_all_matches_of_unequal_experience():
    results, _, _ = league(np.random.default_rng(3), days=40)
    walk = walk_forward(results)
    unequal = (walk.known_a != walk.known_b) & (walk.date_of > 0)
    groups = by_experience(walk)
    assert sum(group.matches for group in groups) >= unequal.sum() - 4 * 30
    assert all(0.5 < group.spread < 2.0 for group in groups)
    assert groups[0].games == pytest.approx(groups[0].matches * 9, rel=0.3)
