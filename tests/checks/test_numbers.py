"""Single values that pass the checks, as what they pass, and values that do not."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from evenbreak.checks import (
    number,
    number_probabilities,
    number_probability,
    one_of,
    positive,
    seed_of,
    whole,
)
from evenbreak.errors import InputError


@pytest.mark.parametrize("value", [2, 2.0, Fraction(2), np.float32(2), np.array(2), True + True])
def test_a_number_comes_back_as_a_float(value: object) -> None:
    assert type(number(value, "drift")) is float
    assert number(value, "drift") == 2.0


@pytest.mark.parametrize(
    "value", ["2", b"2", None, 2j, [2], np.array([2]), float("nan"), float("-inf"), 10**400]
)
def test_what_is_not_one_finite_number_is_refused(value: object) -> None:
    with pytest.raises(InputError, match=r"(?s)^drift must be a finite number"):
        number(value, "drift")


@pytest.mark.parametrize(
    ("value", "limits"),
    [(-0.1, {"low": 0}), (1.5, {"low": 0, "high": 1}), (0, {"above": 0}), (1, {"below": 1})],
)
def test_a_number_outside_the_limits_is_refused(value: float, limits: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=r"^drift must be a .*number"):
        number(value, "drift", **limits)


def test_the_limits_themselves_pass_where_they_are_included() -> None:
    assert number(0, "x", low=0, high=1) == 0.0
    assert number(1, "x", low=0, high=1) == 1.0


def test_the_caller_may_say_what_is_wanted() -> None:
    with pytest.raises(InputError, match=r"^half_life must be days above 0; you gave 0$"):
        positive(0, "half_life", wanted="days above 0")
    with pytest.raises(InputError, match=r"^gap must be whole points; you gave 2.5$"):
        whole(2.5, "gap", at_least=None, wanted="whole points")


def test_positive_numbers() -> None:
    assert positive(5e-324, "mass") > 0.0
    for value in (0, -1, float("inf"), "1"):
        with pytest.raises(InputError, match=r"mass must be a finite number above 0"):
            positive(value, "mass")


def test_probabilities_one_by_one() -> None:
    assert number_probability(1, "p") == 1.0
    assert number_probabilities((0, Fraction(1, 2)), "levels", "level") == (0.0, 0.5)
    with pytest.raises(InputError, match=r"p must be one number from 0 to 1; you gave \[0\.5\]"):
        number_probability([0.5], "p")
    with pytest.raises(InputError, match=r"level 2 must be a number from 0 to 1; you gave 1\.5"):
        number_probabilities((0.5, 1.5), "levels", "level")
    for none in ((), 0.5, None):
        with pytest.raises(InputError, match="levels must be a list"):
            number_probabilities(none, "levels", "level")


@pytest.mark.parametrize("value", [3, 3.0, np.int8(3), np.float64(3), Fraction(3)])
def test_whole_numbers_come_back_as_ints(value: object) -> None:
    assert type(whole(value, "m")) is int
    assert whole(value, "m") == 3


def test_whole_numbers_without_a_limit() -> None:
    assert whole(-7.0, "gap", at_least=None) == -7


@pytest.mark.parametrize(
    "value", [2.5, -1, "3", None, float("nan"), float("inf"), np.array([3, 4]), [3], 3 + 0j]
)
def test_what_is_not_whole_is_refused(value: object) -> None:
    with pytest.raises(InputError, match=r"m must be a whole number, 0 or more"):
        whole(value, "m")


@pytest.mark.parametrize("value", [1, 1.0, True, np.int64(1)])
def test_a_choice_comes_back_as_it_was_listed(value: object) -> None:
    assert type(one_of(value, "player", (1, 2))) is int


@pytest.mark.parametrize("value", [0, "1", None, 1.5, np.array([1, 2])])
def test_other_choices_are_refused(value: object) -> None:
    with pytest.raises(InputError, match=r"player must be 1 or 2"):
        one_of(value, "player", (1, 2))


@pytest.mark.parametrize("wrong", ["x", 1.5, -1, None])
def test_a_seed_is_a_whole_number_or_a_generator(wrong):
    with pytest.raises(InputError, match="seed"):
        seed_of(wrong)
