from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.matches import StraightPool, even_points, even_spot, straight_pool_odds
from tiers import examples


@pytest.mark.slow
@settings(max_examples=examples(25))
@given(
    st.integers(1, 30),
    st.fractions(Fraction(1, 2), Fraction(14, 15), max_denominator=15),
    st.fractions(Fraction(1, 2), Fraction(14, 15), max_denominator=15),
    st.sampled_from((1, 2)),
)
def test_no_other_handicap_is_nearer_to_even(points, p1, p2, first):
    most = 60
    even = even_points(points, p1, p2, first=first, most=most)
    wins = [
        straight_pool_odds(StraightPool(points, n, p1, p2, first=first)).p_win_1
        for n in range(1, most + 1)
    ]
    assert all(less <= more * (1 + 1e-12) for less, more in pairwise(wins))
    gaps = [abs(win - 0.5) for win in wins]
    assert gaps[even.points_2 - 1] == min(gaps)
    assert even.p_win_1 == wins[even.points_2 - 1]


def test_equal_players_spot_little_for_the_first_inning():
    even = even_points(100, 0.9, 0.9)
    assert 90 < even.points_2 < 100
    assert even.p_win_1 == pytest.approx(0.5, abs=0.01)


@pytest.mark.slow
def test_points_that_take_too_long_are_not_asked_for():
    # 4096 points of a player who runs 1/3 would take more innings than are counted with.
    even = even_points(2000, 0.2, 0.25)
    assert even.points_2 == pytest.approx(2000 * 4 / 3, rel=0.01)
    assert even_points(1, 0.9, 0.01).points_2 == 1


def test_a_player_who_never_wins_gets_the_smallest_spot():
    even = even_points(5, 0, 0.5)
    assert (even.points_2, even.p_win_1) == (1, 0)
    assert even_points(5, 0.5, 0).points_2 == 1


@pytest.mark.parametrize(
    ("points", "p1", "p2", "even"),
    [(100, 0.9, 0.85, True), (150, 0.96, 0.95, True), (1, 0.9, 0.8, False), (5, 0, 0.5, False)],
)
def test_whether_any_number_of_points_makes_it_even(points, p1, p2, even):
    found = even_points(points, p1, p2)
    assert found.is_even is even
    every = [
        straight_pool_odds(StraightPool(points, n, p1, p2)).p_win_1 for n in range(1, 2 * points)
    ]
    assert any(0.4 <= win <= 0.6 for win in every) is even


@pytest.mark.parametrize("first", [1, 2])
def test_the_spot_goes_to_the_weaker_player_and_the_stronger_keeps_their_points(first):
    match = StraightPool(100, 80, 0.85, 0.9, first=first)
    spot = even_spot(match)
    assert spot.weaker == 1
    given_it = StraightPool(spot.points, 80, 0.85, 0.9, first=first)
    assert straight_pool_odds(given_it).p_win_1 == pytest.approx(spot.p_win_1)
    swapped = even_spot(StraightPool(80, 100, 0.9, 0.85, first=3 - first))
    assert (swapped.weaker, swapped.points) == (2, spot.points)
    assert swapped.p_win_1 == pytest.approx(1 - spot.p_win_1)


def test_safety_play_makes_a_player_weaker():
    # 0.5 * 0.9 / 0.1 balls an inning against 0.8 / 0.2
    assert even_spot(StraightPool(50, 50, 0.9, 0.8)).weaker == 2
    assert even_spot(StraightPool(50, 50, 0.9, 0.9, safety_1=0.5)).weaker == 1
    assert even_spot(StraightPool(50, 50, 1.0, 0.9)).weaker == 2


def test_where_no_spot_makes_it_even_there_is_none():
    assert even_spot(StraightPool(100, 100, 0.0, 0.8)) == (1, None, None)


def test_a_limit_must_be_a_number_of_points():
    with pytest.raises(InputError, match="most is 0"):
        even_points(5, 0.5, 0.5, most=0)
