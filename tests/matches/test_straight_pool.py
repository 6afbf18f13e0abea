from fractions import Fraction
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.matches import (
    StraightPool,
    StraightPoolOdds,
    even_points,
    even_spot,
    straight_pool_odds,
)
from evenbreak.stats import RunLength
from tiers import examples

chances = st.fractions(0, 1, max_denominator=12)
few = st.integers(1, 6)
matches = st.builds(
    StraightPool,
    few,
    few,
    chances,
    chances,
    safety_1=chances,
    safety_2=chances,
    first=st.sampled_from((1, 2)),
)


class ShotByShot:
    """The match as a game: what both still need, who shoots, whether it is his first shot."""

    def __init__(self, match):
        self.match = match
        self.start = (match.points_1, match.points_2, match.first, True)

    def moves(self, state):
        needs_1, needs_2, shooter, fresh = state
        if 0 in (needs_1, needs_2):
            return {}
        match = self.match
        p, safety = (match.p1, match.safety_1) if shooter == 1 else (match.p2, match.safety_2)
        made = float(p * safety if fresh else p)
        left = (needs_1 - 1, needs_2) if shooter == 1 else (needs_1, needs_2 - 1)
        return {(*left, shooter, False): made, (needs_1, needs_2, 3 - shooter, True): 1.0 - made}

    def winner(self, state):
        return 1 if state[0] == 0 else 2 if state[1] == 0 else None


def endings_by_inning(match, innings):
    """Return {(winner, inning): chance} up to an inning, and what is left, played shot by shot."""
    first = (match.points_1, match.points_2, match.first, True)
    now, endings = {first: Fraction(1)}, {}
    for inning in range(1, innings + 1):
        for shooter in (match.first, 3 - match.first):
            p, safety = (match.p1, match.safety_1) if shooter == 1 else (match.p2, match.safety_2)
            later = {}
            while now:
                (a, b, _, fresh), chance = now.popitem()
                made = p * safety if fresh else p
                x, y = (a - 1, b) if shooter == 1 else (a, b - 1)
                if 0 in (x, y):
                    key = (shooter, inning)
                    endings[key] = endings.get(key, 0) + chance * made
                else:
                    key = (x, y, shooter, False)
                    now[key] = now.get(key, 0) + chance * made
                key = (a, b, 3 - shooter, True)
                later[key] = later.get(key, 0) + chance * (1 - made)
            now = later
    return endings, sum(now.values())


@given(matches)
def test_the_graph_of_shots_is_the_witness(match):
    game = ShotByShot(match)
    limit = stochastic_limit(chain_of(game))
    odds = straight_pool_odds(match)
    won = {1: 0.0, 2: 0.0, None: 0.0}
    for state, chance in zip(limit.states, limit.probability, strict=True):
        won[game.winner(state)] += chance
    assert odds.p_win_1 == pytest.approx(won[1], rel=1e-11)
    assert odds.p_win_2 == pytest.approx(won[2], rel=1e-11)
    assert odds.p_never_ends == pytest.approx(won[None], abs=1e-12)


@given(matches, st.integers(1, 8))
def test_matches_played_out_in_fractions(match, innings):
    endings, left = endings_by_inning(match, innings)
    odds = straight_pool_odds(match)
    for player, chance in ((1, odds.p_win_1), (2, odds.p_win_2)):
        seen = float(sum(p for (winner, _), p in endings.items() if winner == player))
        assert seen <= chance * (1 + 1e-12)
        assert chance <= seen + float(left) + 1e-12
    for quantile, level in (
        (odds.innings_p50, Fraction(1, 2)),
        (odds.innings_p90, Fraction(9, 10)),
    ):
        within = [sum(p for (_, i), p in endings.items() if i <= k) for k in range(innings + 1)]
        if within[-1] >= level:
            assert within[quantile] >= level > within[quantile - 1]
        else:
            assert quantile is None or quantile > innings


def test_length_is_that_of_matches_played_out():
    match = StraightPool(6, 4, Fraction(3, 4), Fraction(2, 3), safety_2=Fraction(1, 2), first=2)
    endings, left = endings_by_inning(match, 60)
    assert left < 1e-12
    mean = float(sum(i * p for (_, i), p in endings.items()))
    square = float(sum(i * i * p for (_, i), p in endings.items()))
    odds = straight_pool_odds(match)
    assert odds.mean_innings == pytest.approx(mean, rel=1e-10)
    assert odds.sd_innings == pytest.approx((square - mean**2) ** 0.5, rel=1e-9)


@given(matches)
def test_players_may_change_places(match):
    odds = straight_pool_odds(match)
    swapped = straight_pool_odds(
        StraightPool(
            match.points_2,
            match.points_1,
            match.p2,
            match.p1,
            safety_1=match.safety_2,
            safety_2=match.safety_1,
            first=3 - match.first,
        )
    )
    assert (odds.p_win_1, odds.p_win_2) == (swapped.p_win_2, swapped.p_win_1)
    assert odds.mean_innings == swapped.mean_innings
    assert odds.p_win_1 + odds.p_win_2 + odds.p_never_ends == pytest.approx(1.0, rel=1e-12)


def test_one_point_is_the_one_ball_game():
    p1, p2 = 0.4, 0.8
    odds = straight_pool_odds(StraightPool(1, 1, p1, p2))
    assert odds.p_win_1 == pytest.approx(p1 / (p1 + p2 - p1 * p2), rel=1e-14)


def test_long_matches_and_safety_play():
    plain = straight_pool_odds(StraightPool(1000, 1000, 0.96, 0.95))
    # 1000 points of 24 an inning, the last inning not finished: 1000 / 24 + 1 innings at the most
    assert 30 < plain.innings_p50 <= plain.mean_innings + 1 < 43.7
    assert 0.8 < plain.p_win_1 < 0.95
    # Safety play at the same averages makes the runs more uneven, and so the match less certain.
    p1, p2 = (RunLength.of_mean(mean, 0.6).p for mean in (24, 19))
    safe = straight_pool_odds(StraightPool(1000, 1000, p1, p2, safety_1=0.6, safety_2=0.6))
    assert 0.5 < safe.p_win_1 < plain.p_win_1


def test_a_win_that_is_next_to_impossible_keeps_its_digits():
    # Player 1 never misses a second shot, but seldom makes a first.
    rare = straight_pool_odds(StraightPool(300, 1, Fraction(1, 10), 1))
    assert rare.p_win_1 == pytest.approx(1e-300, rel=1e-11)
    sure = StraightPool(50, 50, 1, 1, safety_1=Fraction(1, 3), safety_2=Fraction(1, 3))
    assert straight_pool_odds(sure).p_win_1 == pytest.approx(3 / 5, rel=1e-14)


def test_who_never_makes_a_ball():
    assert straight_pool_odds(StraightPool(5, 5, 0, 0)) == StraightPoolOdds(
        0.0, 0.0, 1.0, None, None, None, None
    )
    alone = straight_pool_odds(StraightPool(2, 5, 0.5, 0.9, safety_2=0))
    assert (alone.p_win_1, alone.p_win_2) == (pytest.approx(1.0), 0.0)
    # Two balls, each missed with 1/2: 1 inning for the first chance and 2 misses on average
    assert alone.mean_innings == pytest.approx(3.0, rel=1e-12)


def test_arguments_may_be_averages():
    match = StraightPool(100, 100, RunLength.of_mean(9).p, RunLength.of_mean(4).p)
    assert straight_pool_odds(match) == straight_pool_odds(StraightPool(100, 100, 0.9, 0.8))


@pytest.mark.parametrize(
    ("make", "remedy"),
    [
        (
            lambda: StraightPool(0, 5, 0.5, 0.5),
            "points_1 must be a whole number, 1 or more; you gave 0",
        ),
        (
            lambda: StraightPool(5, 2.5, 0.5, 0.5),
            r"points_2 must be a whole number, 1 or more; you gave 2\.5",
        ),
        (lambda: StraightPool(5, 5, 1.5, 0.5), r"p1 must be a number from 0 to 1; you gave 1\.5"),
        (
            lambda: StraightPool(5, 5, 0.5, 0.5, safety_2=-1),
            "safety_2 must be a number from 0 to 1; you gave -1",
        ),
        (lambda: StraightPool(5, 5, 0.5, 0.5, first=3), "first must be 1 or 2; you gave 3"),
        (lambda: straight_pool_odds(StraightPool(500, 5, 1e-6, 0.5)), "Give a larger chance"),
    ],
)
def test_wrong_values_say_how_to_mend_them(make, remedy):
    with pytest.raises(InputError, match=remedy):
        make()


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
    with pytest.raises(InputError, match="most must"):
        even_points(5, 0.5, 0.5, most=0)
