import math

import pytest

from evenbreak.answers.league.sheet import how_sure, three_pairs
from evenbreak.matches.win import race_win_probability
from evenbreak.ratings.results import Results
from leagues import sheet_of, two_groups

SEASON = Results.from_names(["Ann", "Bo", "Ann"], ["Bo", "Cy", "Cy"], [70, 70, 7], [50, 40, 2])


def test_a_pair_is_nearly_as_sure_as_its_difference_with_the_covariance():
    sheet = sheet_of(SEASON)
    ratings = sheet.ratings
    assert [pair.error for pair in sheet.sure] == sorted(pair.error for pair in sheet.sure)
    error = dict(zip(ratings.players, ratings.standard_error, strict=True))
    for pair in sheet.sure:
        wanted = ratings.difference_error(pair.player_a, pair.player_b)
        assert pair.error == pytest.approx(wanted, rel=0.15)
        assert pair.error < math.hypot(error[pair.player_a], error[pair.player_b])
        assert pair.low < pair.p_win < pair.high
        m, n = map(int, pair.race.split(":"))
        p = ratings.scale.win_probability(pair.difference - 2 * pair.error)
        assert pair.low == race_win_probability(p, m, n)


def test_pairs_without_a_race_are_not_among_them():
    assert len(sheet_of(two_groups()).sure) == 2


def test_one_pair_is_no_half_of_the_pairs():
    sheet = sheet_of(Results.from_names(["Ann"], ["Bo"], [7], [5]))
    _, sentence = how_sure(sheet.ratings.scale, sheet.sure)
    assert "half" not in sentence
    assert f" {2 * sheet.sure[0].error:.1f} points" in sentence
    assert len(list(how_sure(sheet.ratings.scale, []))) == 1


def test_three_pairs_are_the_best_known_a_typical_and_the_least_known():
    pairs = sheet_of(SEASON).sure
    assert [pair for _, pair in three_pairs(pairs)] == pairs
    assert [name for name, _ in three_pairs(pairs[:2])] == ["best known", "least known"]
    assert three_pairs(pairs[:1]) == [("", pairs[0])]
    assert three_pairs([]) == []
