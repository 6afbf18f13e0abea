import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.games import Rack, winner_breaks
from evenbreak.matches import crossings, even_probability, match_format, win_probability
from evenbreak.matches.crossings import form_roots, sign_at
from evenbreak.matches.win_formula import product
from rows import each_of
from tiers import examples

BREAK_TEXTS = ["winner", "loser", "alternate", "player 1", "player 2"]
SMALL = st.tuples(st.integers(1, 6), st.integers(1, 6)).map(lambda mn: f"{mn[0]}:{mn[1]}")
FORMATS = SMALL | SMALL.map("ahead {}".format) | SMALL.map("{} win by 2".format)
FORMATS |= st.tuples(SMALL, SMALL).map(" of ".join)


def test_curves_of_p5_7_cross():
    (point,) = crossings("2:1", "4:2").points
    assert point.p1 == (1 + math.sqrt(17)) / 8  # 4p^2 - p - 1 = 0
    assert point.p1 == pytest.approx(0.640388, abs=5e-7)  # .641 is printed: an erratum
    assert point.p_win_1 == pytest.approx(0.410097, abs=5e-7)
    assert crossings("2:1", "4:2").better == (1, 2)


def test_4_2_of_p5_7_is_even():
    (point,) = even_probability("4:2")
    assert point.p1 == pytest.approx(0.6861898, abs=5e-8)
    assert point.p_win_1 == pytest.approx(0.5, abs=1e-14)


def test_choice_of_p5_8_turns_where_the_player_is_weak():
    found = crossings("9:5", "3:1 of 3:3")
    assert found.better == (2, 1)  # at p = 2/3 the long match is better for player 1
    assert found.points[0].p1 < 2 / 3


@settings(max_examples=examples(40))
@given(FORMATS)
def test_where_the_break_does_not_matter_one_chance_is_even(text):
    (point,) = even_probability(text)
    assert point.p_win_1 == pytest.approx(0.5, abs=1e-9)


@settings(max_examples=examples(60))
@given(FORMATS, FORMATS)
def test_the_better_one_is_better(text_1, text_2):
    found = crossings(text_1, text_2)
    assert found.exact
    ends = [0.0, *(point.p1 for point in found.points), 1.0]
    for better, low, high in zip(found.better, ends[:-1], ends[1:], strict=True):
        rack = Rack(0.5 * (low + high))
        one, two = (win_probability(match_format(text).match(rack)) for text in (text_1, text_2))
        assert one - two == pytest.approx(0, abs=1e-12) or better == (1 if one > two else 2)
    for point in found.points:
        other = win_probability(match_format(text_2).match(Rack(point.p1)))
        assert other == pytest.approx(point.p_win_1, abs=1e-12)


@settings(max_examples=examples(25))
@given(FORMATS, FORMATS)
def test_the_grid_finds_what_the_polynomials_find(text_1, text_2):
    exact = crossings(text_1, text_2)
    # With odds of the break 1 the break does not matter, but the grid is what looks.
    found = crossings(text_1, text_2, break_odds=1.0, breaks="alternate")
    assert not found.exact
    seen = [point.p1 for point in exact.points if 1e-4 < point.p1 < 1 - 1e-4]
    also = [point.p1 for point in found.points if 1e-4 < point.p1 < 1 - 1e-4]
    assert also == pytest.approx(seen, abs=1e-6)


def test_what_is_better_is_told_where_chances_underflow():
    """Below 1/2 the race is better; the chance of the lead underflows long before."""
    found = crossings("1000:1000", "ahead 1000:1000")
    assert [round(point.p1, 9) for point in found.points] == [0.5]
    assert found.better == (1, 2)
    assert crossings("ahead 1000:1000", "1000:1000").better == (2, 1)


def test_grid_and_polynomials_agree_on_long_matches():
    exact, grid = crossings("100:60", "90:54"), crossings("300:180", "270:162")
    assert (exact.exact, grid.exact) == (True, False)
    for found in (exact, grid):
        (point,) = found.points
        assert point.p1 == pytest.approx(0.625, abs=0.01)


@each_of("p2", [0.3, 0.55, 0.8])
@each_of("breaks", BREAK_TEXTS)
def test_along_p1_at_fixed_p2(p2, breaks):
    for point in even_probability("7:5", p2=p2, breaks=breaks):
        assert point.p2 == p2
        assert point.p_win_1 == pytest.approx(0.5, abs=1e-9)
    dense = np.linspace(0.001, 0.999, 999)
    wins = win_probability(match_format(f"7:5, {_short(breaks)} breaks").match(Rack(dense, p2)))
    changes = np.count_nonzero((wins[1:] > 0.5) != (wins[:-1] > 0.5))
    assert len(even_probability("7:5", p2=p2, breaks=breaks)) == changes


def _short(breaks):
    return {"player 1": "a", "player 2": "b"}.get(breaks, breaks)


def test_there_may_be_no_even_chance_at_a_fixed_p2():
    # B breaks every second rack and wins nine of ten of those, and needs one.
    assert even_probability("5:1", p2=0.9, breaks="alternate") == ()


def test_there_may_be_several_crossings():
    found = crossings("ahead 6:6", "3:4 of 3:3")
    assert found.better == (1, 2, 1, 2)
    assert [round(point.p1, 6) for point in found.points] == [0.042967, 0.589155, 0.757584]


@pytest.mark.parametrize("breaks", BREAK_TEXTS)
def test_along_skill_at_a_fixed_advantage_of_the_break(breaks):
    (point,) = even_probability("6:4", break_odds=2.25, breaks=breaks)
    odds = point.p1 / (1 - point.p1) * point.p2 / (1 - point.p2)
    assert odds == pytest.approx(2.25)
    assert point.p_win_1 == pytest.approx(0.5, abs=1e-9)


def test_even_races_are_worth_the_same_in_three_break_formats():
    for breaks in ("loser", "alternate"):
        found = crossings("7:7, winner breaks", f"7:7, {breaks} breaks", p2=0.8)
        assert (found.points, found.better) == ((), (0,))
    assert crossings("5:3", "5:3").better == (0,)
    assert crossings("1:1", "ahead 1:1").better == (0,)


def test_break_formats_may_be_functions():
    by_name = even_probability("5:4", p2=0.6, breaks="winner")
    assert even_probability("5:4", p2=0.6, breaks=winner_breaks) == by_name


@pytest.mark.parametrize(
    ("options", "remedy"),
    [
        ({"p2": 0.5, "break_odds": 2}, "Leave one out"),
        ({"p2": 0.5}, "breaks is missing"),
        ({"p2": 1.5, "breaks": "winner"}, r"p2 must be a number from 0 to 1; you gave 1\.5"),
        ({"break_odds": 0, "breaks": "winner"}, "above 0"),
        ({"break_odds": math.inf, "breaks": "winner"}, "above 0"),
        ({"break_odds": math.nan, "breaks": "winner"}, "above 0"),
        (
            {"p2": 0.5, "breaks": "mine"},
            (
                "breaks must be 'winner', 'loser', 'alternate', 'player 1' or 'player 2'; "
                "you gave 'mine'"
            ),
        ),
        (
            {"p2": 0.5, "breaks": "winner", "first_breaker": 3},
            "first_breaker must be 1 or 2; you gave 3",
        ),
    ],
)
def test_wrong_parameters_say_how_to_mend_them(options, remedy):
    with pytest.raises(InputError, match=remedy):
        even_probability("5:3", **options)
    with pytest.raises(InputError, match=remedy):
        crossings("5:3", "4:2", **options)


PLACES = st.lists(st.integers(1, 1023), max_size=7, unique=True)


def with_zeros(places, other=(1,)):
    form = list(other)
    for place in places:  # p = place / 1024: (1024 - place) p - place q
        form = product(form, [-place, 1024 - place])
    return form


@given(PLACES, st.lists(st.integers(1, 50), min_size=1, max_size=6))
def test_every_zero_is_found_and_no_other(places, other):
    assert form_roots(with_zeros(places, other)) == sorted(place / 1024 for place in places)


@given(st.integers(1, 1023), st.integers(2, 4))
def test_a_zero_of_any_order_is_told_once(place, order):
    (found,) = form_roots(with_zeros([place] * order))
    assert found == pytest.approx(place / 1024, abs=1e-13)


def test_a_touch_that_no_float_holds_is_found():
    third = product([-1, 2], [-1, 2])  # (2p - q)^2 is zero at p = 1/3 and negative nowhere
    assert form_roots(third) == [pytest.approx(1 / 3, abs=1e-13)]
    assert (
        form_roots([x + y for x, y in zip([10**6 * c for c in third], [1, 0, 0], strict=True)])
        == []
    )


def test_zeros_that_grids_miss():
    near = [500_000_000, 500_000_001]
    form = [1]
    for place in near:
        form = product(form, [-place, 10**9 - place])
    assert form_roots(form) == [place / 10**9 for place in near]


def test_none_and_everywhere():
    assert form_roots([3, 1, 2]) == []
    assert form_roots([0, 0, 0]) is None
    assert form_roots([0, -2, 1, 0]) == [2 / 3]


@given(PLACES, st.floats(0.01, 0.99))
def test_signs(places, p):
    exact = 1
    for place in places:
        exact *= (p > place / 1024) - (p < place / 1024)
    assert sign_at(with_zeros(places), p) == exact
