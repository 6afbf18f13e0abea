from fractions import Fraction

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps import team_handicap


def test_the_published_example():
    found = team_handicap(417, 447)
    assert round(found.scored_1, 3) == 24.042
    assert round(found.scored_2, 3) == 26.958
    assert found.scored_2 - found.scored_1 == pytest.approx(2.916, abs=0.001)
    assert (found.points, found.to_team) == (4, 1)
    assert round(found.given_away, 2) == 0.31


@pytest.mark.parametrize("off", [-0.01, 0.01])
def test_the_winners_average_is_determined_by_the_example(off):
    found = team_handicap(417, 447, points_won=13.19 + off, points_lost=3.81 - off)
    assert round(found.scored_2, 3) != 26.958 or round(found.scored_1, 3) != 24.042


def test_by_hand():
    found = team_handicap(
        500, 400, match_ups=5, games=1, points_won=10, points_lost=4, scale="fargo"
    )
    p = Fraction(2, 3)
    assert found.scored_1 == pytest.approx(float(5 * (10 * p + 4 * (1 - p))))
    assert found.scored_2 == pytest.approx(float(5 * (10 * (1 - p) + 4 * p)))
    assert (found.points, found.to_team) == (10, 2)
    assert found.given_away == pytest.approx(0.0)


def test_equal_teams_get_nothing():
    found = team_handicap(430, 430)
    assert (found.points, found.to_team, found.given_away) == (0, None, 0.0)


@pytest.mark.parametrize("apart", [1, 5, 10, 200, 1000])
def test_the_teams_may_change_places(apart):
    one, other = team_handicap(430, 430 + apart), team_handicap(430 + apart, 430)
    assert (one.scored_1, one.scored_2) == pytest.approx((other.scored_2, other.scored_1))
    assert one.points == other.points <= one.even_points + 1e-9


@pytest.mark.parametrize(
    "wrong",
    [{"games": 0}, {"match_ups": 1.5}, {"points_lost": 20}, {"points_won": -1}, {"scale": "x"}],
)
def test_what_cannot_be(wrong):
    with pytest.raises(InputError, match=next(iter(wrong))):
        team_handicap(417, 447, **wrong)
