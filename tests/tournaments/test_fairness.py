"""How fair the races of a tournament are."""

from __future__ import annotations

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import chart
from evenbreak.tournaments import (
    Fairest,
    double_elimination,
    fairest_races,
    redraw_odds,
    single_elimination,
    title_odds,
    tournament_fairness,
)
from evenbreak.tournaments.odds.fairness import fairest_rounds, round_of
from tournaments.fields import by_fargo, by_seed

RATINGS = [660, 600, 560, 520, 480, 440, 400, 340]


def test_equals_need_no_handicap() -> None:
    found = tournament_fairness(double_elimination(8), [500] * 8, 7)
    assert found.spread == pytest.approx(0.0, abs=1e-12)
    assert found.upper_half == pytest.approx(0.5)


def test_a_chart_is_fairer_than_even_races() -> None:
    even = tournament_fairness(double_elimination(8), RATINGS, 7)
    hot = tournament_fairness(double_elimination(8), RATINGS, chart("fargo_r6_hot"))
    fair = tournament_fairness(double_elimination(8), RATINGS, Fairest(9))
    assert even.spread > hot.spread > fair.spread
    assert even.upper_half > hot.upper_half > 0.5
    assert even.edge.sum() == pytest.approx(0.0, abs=1e-12)


def test_games_of_the_whole_tournament() -> None:
    found = tournament_fairness(single_elimination(2), [500, 500], 2)
    assert found.games_mean == pytest.approx(2.5)
    single_games = tournament_fairness(double_elimination(8), RATINGS, 1).games_mean
    odds = title_odds(double_elimination(8), by_fargo(RATINGS))
    assert single_games == pytest.approx(odds.matches_mean)


def test_the_fairest_races_come_first() -> None:
    lengths = [Fairest(4), Fairest(6), Fairest(8)]
    found = fairest_races(double_elimination(8), RATINGS, lengths, [Fairest(3), Fairest(5)])
    assert len(found) == 6
    assert [one.spread for one in found] == sorted(one.spread for one in found)
    short = fairest_races(double_elimination(8), RATINGS, lengths, most_games=100)
    assert 0 < len(short) < 3
    assert all(one.games_mean <= 100 and one.races.race in lengths for one in short)
    with pytest.raises(InputError, match="combinations"):
        fairest_races(double_elimination(8), RATINGS, [])


def test_races_by_round_are_fairer_than_one_length() -> None:
    bracket = double_elimination(8)
    one_length = tournament_fairness(bracket, RATINGS, Fairest(7))
    begin = {round_of(match): 7 for match in bracket.matches}
    games = 0.95 * one_length.games_mean, 1.05 * one_length.games_mean
    asked = {"lengths": dict.fromkeys(begin, (5, 9)), "games_mean": games}
    best = fairest_rounds(bracket, RATINGS, begin, **asked)
    again = tournament_fairness(bracket, RATINGS, best.found.races)
    assert again.spread == pytest.approx(best.found.spread)
    assert best.found.spread < 0.5 * one_length.spread
    assert games[0] <= again.games_mean <= games[1]
    assert all(5 <= length <= 9 for length in best.games.values())
    assert fairest_rounds(bracket, RATINGS, begin, **asked, tries=1).games != begin
    with pytest.raises(InputError, match="final"):
        fairest_rounds(bracket, RATINGS, {("winners", 1): 7}, **asked)


def test_a_redraw_is_the_mean_of_all_placements() -> None:
    bracket, win = double_elimination(8, qualifiers=4), by_seed(8)
    odds = redraw_odds(bracket, win)
    drawn = [
        title_odds(
            double_elimination(
                8, qualifiers=4, placement="redraw", rng=np.random.default_rng(seed)
            ),
            win,
        ).title
        for seed in range(12)
    ]
    assert odds.samples == 0
    distinct = np.unique(np.round(drawn, 12), axis=0)
    assert len(distinct) == 2
    assert odds.title == pytest.approx(distinct.mean(axis=0))
    with pytest.raises(InputError, match="qualifiers"):
        redraw_odds(double_elimination(8), win)


def test_many_redraws_are_sampled() -> None:
    bracket, win = double_elimination(16, qualifiers=16), by_seed(16)
    odds = redraw_odds(bracket, win, samples=10)
    assert odds.samples == 10
    assert odds.error.max() > 0.0
    assert odds.p_place.sum(axis=1) == pytest.approx(np.ones(16))
