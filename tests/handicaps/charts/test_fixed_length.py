from fractions import Fraction
from math import comb

import pytest

from evenbreak.errors import InputError
from evenbreak.handicaps.charts.design import fixed_length_chart
from evenbreak.ratings.scale import SCALES
from rows import each_of


def win(p, m, games):
    """P(player 1 wins m of so many games, as if all were played)."""
    return sum(comb(games, k) * p**k * (1 - p) ** (games - k) for k in range(m, games + 1))


@each_of("games", [1, 3, 9, 13])
@each_of("scale", SCALES)
def test_each_difference_has_the_most_even_race_of_the_length(games, scale):
    chart = fixed_length_chart(games, scale)
    assert chart.name == f"fixed_{games}"
    half = (games + 1) // 2
    for difference in range(0, 3 * round(SCALES[scale].points_per_doubling), 11):
        p = Fraction(SCALES[scale].win_probability(float(difference)))
        m, n = chart.race(difference)
        assert m + n - 1 == games
        off = abs(win(p, m, games) - Fraction(1, 2))
        best = min(abs(win(p, k, games) - Fraction(1, 2)) for k in range(half, games + 1))
        assert off <= best + Fraction(1, 10**12)


def test_the_chart_ends_where_the_weaker_needs_one_game():
    last = fixed_length_chart(5).rows[-1]
    assert (last.difference_to, last.stronger_needs, last.weaker_needs) == (None, 5, 1)


@pytest.mark.parametrize(
    ("games", "message"),
    [
        (8, "no even race"),
        (0, "games must"),
        (1001, "games must be a whole number from 1 to 999; you gave 1001"),
    ],
)
def test_a_length_without_an_even_race_is_refused(games, message):
    with pytest.raises(InputError, match=message):
        fixed_length_chart(games)
