import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.games import Race, Rack, alternate_breaks, winner_breaks
from evenbreak.handicaps import MatchRules
from evenbreak.matches import match_length, race_odds, win_probability

POINTS = np.array([-40, 0, 7, 100])
M, N = [5, 1, 4, 6], [3, 1, 4, 1]


@pytest.mark.parametrize("place", range(4))
def test_plain_races_are_those_of_the_rack_by_rack_law(place):
    rules = MatchRules("npl")
    for column, points in enumerate(POINTS):
        law = race_odds(M[place], N[place], 1 / (1 + 2 ** (-points / 30)))
        assert rules.win(M, N, POINTS)[place, column] == pytest.approx(law.p_win_1, rel=1e-12)
        assert rules.mean_games(M, N, POINTS)[place, column] == pytest.approx(law.mean, rel=1e-12)
        assert rules.games_quantile(M[place], N[place], POINTS, 0.9)[column] == law.quantile(0.9)
        for games in range(8):
            ended = sum(p for k, p in zip(law.games, law.probability, strict=True) if k <= games)
            within = rules.ends_within(M, N, POINTS, games)[place, column]
            assert within == pytest.approx(ended, abs=1e-13)


@pytest.mark.parametrize("breaks", [winner_breaks, alternate_breaks])
def test_with_a_break_that_counts_either_breaks_first_with_an_even_chance(breaks):
    rules = MatchRules("fargo", breaks=breaks, break_points=30)
    p1, p2 = (1 / (1 + 2 ** (-(d + 30) / 100)) for d in (50, -50))
    laws = [race_odds(5, 4, Rack(p1, p2), breaks, first) for first in (1, 2)]
    assert rules.win([5], [4], [50])[0, 0] == pytest.approx(np.mean([law.p_win_1 for law in laws]))
    assert rules.mean_games([5], [4], [50])[0, 0] == pytest.approx(
        np.mean([law.mean for law in laws])
    )
    ended = np.cumsum(np.mean([law.probability for law in laws], axis=0))
    assert rules.ends_within([5], [4], [50], 7)[0, 0] == pytest.approx(ended[7 - 4])
    assert rules.games_quantile(5, 4, [50], 0.9)[0] == laws[0].games[(ended >= 0.9).argmax()]


def test_a_break_worth_nothing_changes_nothing():
    plain, slow = MatchRules("npl"), MatchRules("npl", breaks=winner_breaks, break_points=1e-9)
    assert not slow.is_plain
    np.testing.assert_allclose(slow.win(M, N, POINTS), plain.win(M, N, POINTS), atol=1e-9)
    np.testing.assert_allclose(
        slow.mean_games(M, N, POINTS), plain.mean_games(M, N, POINTS), atol=1e-9
    )
    np.testing.assert_allclose(slow.even_differences(M, N), plain.even_differences(M, N), atol=1e-4)


def test_races_won_by_two_are_those_of_the_match():
    rules = MatchRules("npl", win_by=2)
    match = Race(5, 3, Rack(1 / (1 + 2 ** (-20 / 30))), win_by=2)
    length = match_length(match)
    assert rules.win([5], [3], [20])[0, 0] == pytest.approx(win_probability(match))
    assert rules.mean_games([5], [3], [20])[0, 0] == pytest.approx(length.mean)
    assert rules.games_quantile(5, 3, [20], 0.9)[0] == length.quantile(0.9)
    even = rules.even_differences([5], [3])[0]
    assert rules.win([5], [3], [even])[0, 0] == pytest.approx(0.5, abs=1e-6)


@settings(max_examples=25, deadline=None)
@given(st.integers(1, 30), st.integers(1, 30), st.floats(1, 500))
def test_a_race_is_even_where_it_is_said_to_be(m, n, points):
    rules = MatchRules(points)
    even = rules.even_differences([m], [n])
    assert rules.win([m], [n], even)[0, 0] == pytest.approx(0.5, abs=1e-9)
    assert even[0] == pytest.approx(-rules.even_differences([n], [m])[0], abs=1e-9 * points)


@pytest.mark.parametrize(
    ("wrong", "remedy"),
    [
        ({"scale": "nlp"}, "give npl, fargo, elo"),
        ({"win_by": 0}, "win_by is 0"),
        ({"break_points": 5}, "breaks is missing"),
        ({"break_points": float("nan")}, "give a finite number"),
        ({"break_points": "5"}, "give a finite number"),
    ],
)
def test_wrong_parameters_are_refused(wrong, remedy):
    with pytest.raises(InputError, match=remedy):
        MatchRules(**{"scale": "npl", **wrong})
