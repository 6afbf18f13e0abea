"""What passes the checks, as what it passes, and what does not."""

from fractions import Fraction

import numpy as np
import pytest

from evenbreak.checks import number_probabilities, one_of, probability, whole
from evenbreak.errors import InputError


@pytest.mark.parametrize("value", [0, 1, 0.25, Fraction(1, 3), np.float32(0.5), np.array(0.5)])
def test_a_number_comes_back_as_a_float(value: object) -> None:
    checked = probability(value, "p")
    assert type(checked) is float
    assert checked == value or value == Fraction(1, 3)


def test_a_list_comes_back_as_an_array() -> None:
    assert probability([0, Fraction(1, 2), 1], "p").tolist() == [0.0, 0.5, 1.0]
    assert probability(np.empty((0, 3)), "p").shape == (0, 3)


@pytest.mark.parametrize("value", ["0.5", b"1", ["0.5"], [0.5, "a"], 0.5j, [0.5j], None, [None]])
def test_what_is_no_number_is_no_probability(value: object) -> None:
    with pytest.raises(InputError, match=r"^p .*numbers? from 0 to 1$"):
        probability(value, "p")


def test_the_wrong_one_of_many_is_told() -> None:
    with pytest.raises(InputError, match="p holds nan, not a probability"):
        probability([0.5, float("nan")], "p")
    with pytest.raises(InputError, match=r"level 2 is 1\.5, not a probability"):
        number_probabilities((0.5, 1.5), "levels", "level")


@pytest.mark.parametrize("value", [3, 3.0, np.int8(3), np.float64(3), Fraction(3)])
def test_whole_numbers_come_back_as_ints(value: object) -> None:
    assert type(whole(value, "m")) is int
    assert whole(value, "m") == 3


@pytest.mark.parametrize(
    "value", [2.5, -1, "3", None, float("nan"), float("inf"), np.array([3, 4]), [3], 3 + 0j]
)
def test_what_is_not_whole_is_refused(value: object) -> None:
    with pytest.raises(InputError, match=r"m is .*; give a whole number, 0 or more"):
        whole(value, "m")


@pytest.mark.parametrize("value", [1, 1.0, True, np.int64(1)])
def test_a_choice_comes_back_as_it_was_listed(value: object) -> None:
    assert type(one_of(value, "player", (1, 2))) is int


@pytest.mark.parametrize("value", [0, "1", None, 1.5, np.array([1, 2])])
def test_other_choices_are_refused(value: object) -> None:
    with pytest.raises(InputError, match=r"player is .*; give 1 or 2"):
        one_of(value, "player", (1, 2))
