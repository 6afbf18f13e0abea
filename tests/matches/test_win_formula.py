"""Formulas against the kernels at fractions, and against those of the source text."""

from fractions import Fraction

import pytest

from evenbreak.chains import chain_of, stochastic_limit
from evenbreak.errors import InputError
from evenbreak.games import (
    Ahead,
    OneBall,
    Race,
    Rack,
    alternate_breaks,
    loser_breaks,
    winner_breaks,
)
from evenbreak.matches import match_format, win_formula, win_probability
from evenbreak.matches.win_formula import degree_of, value_at, win_forms
from rows import each_of

sympy = pytest.importorskip("sympy", reason="the extra 'symbolic' is not installed")
p, q, p1, p2 = sympy.symbols("p q p1 p2")


def value(formula, chances):
    """Return the value of a formula, exactly."""
    fractions = {name: sympy.Rational(x.numerator, x.denominator) for name, x in chances.items()}
    return float(formula.subs(fractions))


@each_of(
    "match",
    [
        Race(3, 2, Rack(2 / 3)),
        Race(9, 5, Rack(2 / 3)),
        Ahead(5, 3, Rack(2 / 3)),
        Race(3, 3, Rack(2 / 3), win_by=2),
        Race(3, 1, Race(3, 3, Rack(2 / 3))),
        Race(5, 4, Rack(2 / 3), score=(2, 1)),
        Race(2, 2, Race(2, 2, Rack(2 / 3), score=(1, 0))),
    ],
)
@each_of("player", [1, 2])
def test_a_formula_has_the_value_of_the_kernel(match, player):
    found = value(win_formula(match, player=player), {p: Fraction(2, 3), q: Fraction(1, 3)})
    assert found == pytest.approx(win_probability(match, player=player), rel=1e-13)


@pytest.mark.slow
@pytest.mark.parametrize("breaks", [winner_breaks, alternate_breaks])
@pytest.mark.parametrize("player", [1, 2])
def test_a_formula_may_depend_on_the_break(breaks, player):
    chances = {p1: Fraction(3, 5), p2: Fraction(11, 20)}
    for match in (
        Race(3, 2, Rack(0.6, 0.55), breaks=breaks, first_breaker=2),
        Ahead(2, 2, Rack(0.6, 0.55), breaks=breaks),
    ):
        found = value(win_formula(match, player=player), chances)
        assert found == pytest.approx(win_probability(match, player=player), rel=1e-13)


@pytest.mark.parametrize("breaks", [winner_breaks, alternate_breaks, loser_breaks])
@pytest.mark.parametrize("chances", [("3/5", "11/20"), ("1/1000000007", "999999/1000000")])
def test_a_race_to_11_in_two_symbols_has_the_value_of_the_fractions(breaks, chances):
    own, other = map(Fraction, chances)
    race = Race(11, 11, Rack(own, other), breaks=breaks)
    for player in (1, 2):
        formula = sympy.Poly(win_formula(race, player=player), p1, p2)
        found = formula.eval({p1: sympy.Rational(own), p2: sympy.Rational(other)})
        assert Fraction(int(found.p), int(found.q)) == win_probability(
            race, player=player, exact=True
        )


def test_a_race_of_sets_with_breaks_has_the_value_of_the_fractions():
    own, other = Fraction(3, 5), Fraction(1, 7)
    match = Race(3, 2, Race(3, 3, Rack(own, other), breaks=winner_breaks), breaks=alternate_breaks)
    found = win_formula(match).subs({p1: sympy.Rational(own), p2: sympy.Rational(other)})
    assert Fraction(int(found.p), int(found.q)) == win_probability(match, exact=True)


def test_the_texts_formulas():
    """P5.5, P5.20 and P5.27."""
    race = sum(sympy.binomial(3 + b - 1, b) * p**3 * q**b for b in range(2))
    assert sympy.simplify((win_formula("3:2") - race).subs(q, 1 - p)) == 0
    assert sympy.simplify(win_formula(OneBall(0, 1)) - p1 / (1 - (1 - p1) * (1 - p2))) == 0
    ruin = p**5 * (p**3 - q**3) / (p**8 - q**8)
    assert sympy.simplify((win_formula("ahead 5:3") - ruin).subs(q, 1 - p)) == 0


def test_the_chances_of_both_players_add_up_to_1():
    for played in ("4:3", "ahead 3:2", "3:3 win by 2", "2:1 of 2:2"):
        both = win_formula(played) + win_formula(played, player=2)
        assert sympy.simplify(both.subs(q, 1 - p)) == 1
    both = win_formula(OneBall(0, 1)) + win_formula(OneBall(0, 1), player=2)
    assert sympy.simplify(both) == 1


def test_a_match_that_is_over_is_won():
    assert win_formula(Race(2, 2, Rack(0.5), score=(2, 0))) == 1
    assert win_formula(Race(2, 2, Rack(0.5), score=(2, 0)), player=2) == 0


@pytest.mark.parametrize("wrong", [5, "nine games", Rack(0.5)])
def test_other_things_have_no_formula(wrong):
    with pytest.raises(InputError):
        win_formula(wrong)
    with pytest.raises(InputError, match="player"):
        win_formula("3:2", player=3)


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
