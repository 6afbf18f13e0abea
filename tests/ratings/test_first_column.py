"""Whether the first column means something, in simulated seasons."""

import numpy as np
import pytest

from evenbreak.ratings import Results, walk_forward
from evenbreak.ratings.validation.advantages import first_column, side_advantage


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
