"""A float is the decimal that it prints as."""

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.stats import exact
from rows import each_of


@pytest.mark.parametrize(
    ("p", "meant"),
    [
        (0.9, Fraction(9, 10)),
        (1e-9, Fraction(1, 10**9)),
        (np.float64(0.96), Fraction(24, 25)),
        (Decimal("0.52"), Fraction(13, 25)),
        (Fraction(2, 3), Fraction(2, 3)),
        (1, Fraction(1)),
        (0, Fraction(0)),
    ],
)
def test_a_probability_is_the_fraction_that_was_meant(p: object, meant: Fraction) -> None:
    assert exact(p) == meant


@given(st.integers(0, 10**6))
def test_every_decimal_of_six_places_is_read_as_written(millionths: int) -> None:
    assert exact(float(f"{millionths / 10**6:.6f}")) == Fraction(millionths, 10**6)


@each_of(
    "p",
    [-0.1, 1.1, Fraction(4, 3), float("nan"), float("inf"), ".5", b"1", None, 1j, [0.5]],
)
def test_anything_else_is_refused_by_name(p: object) -> None:
    with pytest.raises(InputError, match=r"(?s)^q is .*"):
        exact(p, "q")


@pytest.mark.parametrize("p", [np.array([0.5]), np.array([0.5, 0.6])])
def test_an_array_is_no_probability(p: object) -> None:
    with pytest.raises(InputError, match="give one number from 0 to 1"):
        exact(p)


def test_a_number_in_an_array_of_no_dimension_is_one() -> None:
    assert exact(np.array(0.52)) == Fraction(13, 25)
