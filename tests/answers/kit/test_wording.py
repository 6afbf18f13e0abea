import pytest

from evenbreak.answers.kit import wording
from evenbreak.words import listed
from rows import each_of


@each_of(
    "p, text",
    [
        (0.0, "0%"),
        (1e-12, "less than 0.1%"),
        (0.001, "0.1%"),
        (0.0994, "9.9%"),
        (0.0996, "10%"),
        (0.5, "50%"),
        (0.994, "99%"),
        (0.996, "99.6%"),
        (0.9995, "more than 99.9%"),
        (1.0, "100%"),
    ],
)
def test_per_cent_never_says_sure_of_what_is_not(p, text):
    assert wording.percent(p) == text


@pytest.mark.parametrize(
    ("p", "text"), [(0.0, "0.0000"), (4.9e-5, "4.9e-05"), (5.1e-5, "0.0001"), (1.0, "1.0000")]
)
def test_small_chances_keep_two_digits(p, text):
    assert wording.chance(p) == text


@pytest.mark.parametrize(
    ("places", "value", "text"),
    [(1, -0.04, "0.0"), (1, -0.06, "-0.1"), (0, -1234.6, "-1,235"), (2, -1e-9, "0.00")],
)
def test_no_number_is_minus_zero(places, value, text):
    assert wording.decimals(places)(value) == text


@pytest.mark.parametrize(
    ("value", "text"), [(1234, "1,234"), (1234.5, "1234.50"), (1e9, "1e+09"), (0.0, "0.00")]
)
def test_games(value, text):
    assert wording.games(value) == text


@pytest.mark.parametrize(
    ("minutes", "text"),
    [(0.2, "0 min"), (59.4, "59 min"), (59.6, "1 h 00"), (61.0, "1 h 01"), (1445.0, "24 h 05")],
)
def test_an_hour_has_sixty_minutes(minutes, text):
    assert wording.clock(minutes) == text


def test_long_lists_are_cut_short():
    assert listed(["Ann", 2, "Cy"]) == "Ann, 2 and Cy"
    assert wording.some_of(["Ann", "Bo"], most=2) == "Ann, Bo"
    assert wording.some_of([str(k) for k in range(2000)], most=1) == "0 and 1,999 more"
    assert wording.some_of([]) == ""


@pytest.mark.parametrize(
    ("number", "text"), [(0, "0 matches"), (1, "1 match"), (1001, "1,001 matches")]
)
def test_only_one_is_singular(number, text):
    assert wording.count_of(number, "match", "matches") == text


@pytest.mark.parametrize(
    ("p", "text"),
    [
        (0.0009, "less than 1 time in 1000"),
        (0.001, "about 1 time in 1000"),
        (0.099, "about 1 time in 10"),
        (0.1, "about 10 times in 100"),
        (0.99, "about 99 times in 100"),
        (0.991, "nearly always"),
    ],
)
def test_how_often(p, text):
    assert wording.how_often(p) == text


def test_the_smaller_the_chance_the_less_it_is_luck():
    said = [wording.luck_words(p) for p in (0.1, 0.05, 0.01, 0.0099)]
    assert len(set(said)) == 4
    assert ["not luck" in words for words in said] == [False, False, True, True]


def test_ranges_and_signs():
    assert wording.range_words(3, 3) == "3"
    assert wording.signed(2)(-0.006) == "-0.01"
    assert wording.signed(1)(0.0) == "+0.0"
