import math
from fractions import Fraction

import pytest

from derived import derived
from evenbreak.source_text.section5 import games_won


def test_the_orders_of_a_score_sum_to_its_chance():
    found = derived(games_won, "P5.4")
    orders = [chance for (quantity, _), chance in found.items() if quantity.startswith("order")]
    assert len(orders) == 4
    assert sum(orders) == Fraction(32, 81)


@pytest.mark.parametrize(("m", "n"), [(1, 1), (3, 2), (9, 5)])
def test_a_match_is_won_at_all_the_scores_at_which_it_can_be(m, n):
    p = Fraction(2, 3)
    chances = (math.comb(m - 1 + k, k) * p**m * (1 - p) ** k for k in range(n))
    assert games_won.match_probability(p, m, n) == sum(chances)


def test_spans_shrink_with_the_length_of_the_race():
    found = derived(games_won, "P5.7")
    name = "width of the span where the longer match is lost more seldom"
    widths = [width for (quantity, _), width in found.items() if quantity == name]
    assert len(widths) == 9
    assert widths == sorted(widths, reverse=True)
    assert widths[-1] > 0


def test_the_range_of_games_won_covers_what_it_should():
    found = derived(games_won, "P5.10")
    for coverage in (0.95, 0.5):
        inputs = f"N=120 p=.52 coverage={coverage}"
        exact = found["probability of the range, exact, the shortest", inputs]
        assert coverage <= exact < coverage + 0.1
