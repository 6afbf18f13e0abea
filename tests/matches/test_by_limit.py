"""Who wins, by the limit of a game's graph: small cases by hand, and what is refused."""

import pytest

from evenbreak.errors import InputError
from evenbreak.games import Ahead, OneBall, Race, Rack, alternate_breaks, winner_breaks
from evenbreak.matches.by_limit import match_odds_by_limit, odds_by_limit

ROADS = ("elimination", "eigen")


@pytest.mark.parametrize("via", ROADS)
def test_a_race_by_hand(via) -> None:
    found = match_odds_by_limit(Race(2, 2, Rack(0.75), score=(1, 0)), via)
    assert found["p_win_1"] == pytest.approx(15 / 16, rel=1e-15)
    assert found["p_shutout_1"] == pytest.approx(3 / 4, rel=1e-15)
    assert found["p_shutout_2"] == pytest.approx(1 / 16, rel=1e-15)
    assert found["p_hill_hill"] == pytest.approx(1 / 4, rel=1e-15)
    if via == "elimination":
        assert found["mean_games"] == pytest.approx(1.25, rel=1e-15)
        assert found["sd_games"] == pytest.approx(3**0.5 / 4, rel=1e-15)


@pytest.mark.parametrize("via", ROADS)
def test_play_that_never_ends(via) -> None:
    """Each player wins their own break, and they break in turn: nobody ever leads by two."""
    found = match_odds_by_limit(Ahead(2, 2, Rack(1.0, 1.0), breaks=alternate_breaks), via)
    assert found["p_never_ends"] == pytest.approx(1.0, rel=1e-15)
    assert (found["p_win_1"], found["p_win_2"]) == (0.0, 0.0)
    if via == "elimination":
        assert found["mean_games"] is None


@pytest.mark.parametrize("via", ROADS)
def test_a_match_that_is_over(via) -> None:
    odds = odds_by_limit(Race(2, 1, Rack(0.5), score=(0, 1)), via)
    assert odds.by_winner == {2: 1.0}
    assert (odds.p_win(1), odds.p_win(2)) == (0.0, 1.0)


@pytest.mark.parametrize("via", ROADS)
def test_a_race_of_games_goes_shot_by_shot(via) -> None:
    odds = odds_by_limit(Race(1, 1, OneBall(0.5, 0.25)), via)
    assert odds.p_win(1) == pytest.approx(0.8, rel=1e-15)
    assert len(odds.limit) == 4


def test_arrays_of_chances_are_refused() -> None:
    with pytest.raises(InputError, match=r"p1 must be one number\. For an array"):
        odds_by_limit(Race(2, 2, Rack([0.5, 0.6], 0.5), breaks=winner_breaks), "eigen")
