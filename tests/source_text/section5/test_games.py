import math
import re
from fractions import Fraction

import pytest

from derived import derived
from evenbreak.source_text.section5 import games
from evenbreak.stats import GamesWon, InningsScore, RunLength
from rows import each_of


def test_the_orders_of_a_score_sum_to_its_chance():
    found = derived(games, "P5.4")
    orders = [chance for (quantity, _), chance in found.items() if quantity.startswith("order")]
    assert len(orders) == 4
    assert sum(orders) == Fraction(32, 81)


@pytest.mark.parametrize(("m", "n"), [(1, 1), (3, 2), (9, 5)])
def test_a_match_is_won_at_all_the_scores_at_which_it_can_be(m, n):
    p = Fraction(2, 3)
    chances = (math.comb(m - 1 + k, k) * p**m * (1 - p) ** k for k in range(n))
    assert games.match_probability(p, m, n) == sum(chances)


def test_spans_shrink_with_the_length_of_the_race():
    found = derived(games, "P5.7")
    name = "width of the span where the longer match is lost more seldom"
    widths = [width for (quantity, _), width in found.items() if quantity == name]
    assert len(widths) == 9
    assert widths == sorted(widths, reverse=True)
    assert widths[-1] > 0


def test_the_range_of_games_won_covers_what_it_should():
    found = derived(games, "P5.10")
    for coverage in (0.95, 0.5):
        inputs = f"N=120 p=.52 coverage={coverage}"
        exact = found["probability of the range, exact, the shortest", inputs]
        assert coverage <= exact < coverage + 0.1


LAWS = {
    "p": Fraction(7, 10),
    "q": Fraction(3, 10),
    "alpha": Fraction(4, 5),
    "N": 12,
    "m": 4,
    "n": 3,
}
RUN, SAFE, SCORE = RunLength(0.7), RunLength(0.7, 0.8), InningsScore(0.7, 4)
GAMES = GamesWon(12, 0.7)


@each_of(
    "problem, quantity, inputs, value",
    [
        ("P5.9", "mode", "", GAMES.mode),
        ("P5.9", "mean", "", GAMES.mean),
        ("P5.9", "standard deviation", "", GAMES.sd),
        ("P5.11", "P(run = n)", "", RUN.probability(3)),
        ("P5.11", "P(run >= n)", "", RUN.at_least(3)),
        ("P5.11", "mode", "", RUN.mode),
        ("P5.11", "mean", "", RUN.mean),
        ("P5.15", "P(run = 0)", "", SAFE.probability(0)),
        ("P5.15", "P(run = n)", "n > 0", SAFE.probability(3)),
        ("P5.15", "mean", "", SAFE.mean),
        ("P5.16", "P(score = n)", "m innings", SCORE.probability(3)),
        ("P5.16", "mean", "m innings", SCORE.mean),
        ("P5.16", "standard deviation", "m innings", SCORE.sd),
        ("P5.16", "mode", "m innings", SCORE.mode),
    ],
)
def test_formulas_are_those_of_the_library(problem, quantity, inputs, value):
    text = derived(games, problem)[f"formula: {quantity}", inputs]
    formula = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", text).replace("^", "**")
    functions = {"C": math.comb, "sqrt": math.sqrt, "ceiling": math.ceil}
    assert eval(formula, {**LAWS, **functions}) == pytest.approx(value, rel=1e-12)  # noqa: S307


def test_the_totals_of_two_dice_are_one_of_36():
    chances = derived(games, "P5.16")
    totals = {
        int(inputs.removeprefix("total=")): chance
        for (quantity, inputs), chance in chances.items()
        if quantity == "P(two dice total)"
    }
    assert totals == {total: Fraction(6 - abs(7 - total), 36) for total in range(2, 13)}


def test_a_wager_over_or_under_is_fair_at_the_median():
    found = derived(games, "P5.17")
    below = found["P(score <= the median)", "p=.96 innings=5"]
    assert 0.5 <= below < 0.51
    assert found["P(score <= the mean)", "p=.96 innings=5"] > below
