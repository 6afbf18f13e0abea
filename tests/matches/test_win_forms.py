from fractions import Fraction

import pytest

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.games import Rack
from evenbreak.matches import match_format, win_probability
from evenbreak.matches.win_formula import degree_of, value_at, win_forms
from rows import each_of

TEXTS = [
    "1:1",
    "9:5",
    "1:7",
    "ahead 1:1",
    "ahead 5:3",
    "7:7 win by 2",
    "5:2 win by 3",
    "1:9 win by 5",
    "2:2 win by 4",
    "3:1 of 3:3",
    "3:1 of ahead 2:3",
    "ahead 2:1 of 3:2 win by 2",
    "2:2 of 2:1 of 1:2",
]


@each_of("text", TEXTS)
@each_of("p", [Fraction(1, 50), Fraction(1, 3), Fraction(1, 2), Fraction(7, 8)])
def test_forms_are_the_win_probability(text, p):
    played = match_format(text)
    one, two = win_forms(played)
    assert min(one + two) >= 0
    first, second = (value_at(f, p.numerator, p.denominator - p.numerator) for f in (one, two))
    exact = Fraction(first, first + second)
    match = played.match(Rack(float(p)))
    assert win_probability(match) == pytest.approx(float(exact), rel=1e-11, abs=0)
    # The other way: by the graph of the game.
    limit = stochastic_limit(chain_of(match))
    found = sum(limit[state] for state in limit if match.winner(state) == 1)
    assert found == pytest.approx(float(exact), rel=1e-9)


@each_of("text", TEXTS)
def test_degree_is_not_understated(text):
    played = match_format(text)
    one, two = win_forms(played)
    assert len(one) == len(two) <= degree_of(played) + 1


def test_sums_of_a_race_are_all_its_courses():
    one, two = win_forms(match_format("9:5"))
    assert sum(one) + sum(two) == 2**13
