"""What every distribution on 0, 1, 2, ... answers; ties are decided without rounding."""

from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.stats import CountLaw, exact
from rows import each_of


class Steps(CountLaw):
    """P(count <= n) = 1 - 1 / 2^(n + 1), with floats that are off by a last digit or so."""

    mean, sd, mode = 1.0, 2**0.5, 0

    def __init__(self, wrong: float = 0.0) -> None:
        self.wrong = wrong
        self.asked_exactly: list[int] = []

    def _probability(self, n: Any) -> Any:
        return 0.5 ** (n + 1.0)

    def _cumulative(self, n: Any) -> Any:
        below = 1 - 0.5 ** (np.maximum(n, 0) + 1.0)
        return np.where(n < 0, 0.0, below * (1 + self.wrong))

    def _at_least(self, n: Any) -> Any:
        return 0.5 ** np.maximum(n, 0.0) * (1 - self.wrong)

    def exact_cumulative(self, n: int) -> Fraction:
        self.asked_exactly.append(n)
        return 1 - Fraction(1, 2 ** (n + 1))


@each_of("wrong", [-1e-12, 0.0, 1e-12])
@each_of(
    "q, count",
    [
        (Fraction(1, 2), 0),
        (0.5, 0),
        (Fraction(1, 2) + Fraction(1, 10**15), 1),
        (Fraction(1, 2) - Fraction(1, 10**15), 0),
        (0.75, 1),
        (0.7500001, 2),
        (0, 0),
        (1 - 2**-10, 9),
        (1 - Fraction(1, 2**60), 59),
        (1 - Fraction(1, 2**60) + Fraction(1, 10**40), 60),
    ],
)
def test_a_quantile_at_a_tie_is_the_exact_one(q: Any, count: int, wrong: float) -> None:
    assert Steps(wrong).quantile(q) == count


def test_fractions_are_asked_only_near_a_tie() -> None:
    law = Steps()
    assert law.quantile(0.9) == 3
    assert law.asked_exactly == []
    assert law.median == 0
    assert set(law.asked_exactly) == {0}


def test_no_count_is_the_largest_here() -> None:
    assert Steps().most is None
    with pytest.raises(InputError, match="q must be below 1"):
        Steps().quantile(1)


@pytest.mark.parametrize("q", [-0.1, 1.5, float("nan"), "a", None])
def test_a_quantile_is_of_a_probability(q: Any) -> None:
    with pytest.raises(InputError, match=r"q must be a number from 0 to 1"):
        Steps().quantile(q)


def test_between_takes_in_both_ends() -> None:
    law = Steps()
    assert law.between(1, 2) == 0.25 + 0.125
    assert law.between(0, 0) == 0.5
    assert law.between(-5, 1) == 0.75
    assert law.between(3, 2) == 0.0
    assert isinstance(law.between(1, 2), float)
    assert law.between([0, 1, 60], [0, 0, 60]).tolist() == [0.5, 0.0, 0.5**61]


@pytest.mark.parametrize("end", ["1", 0.5, None, float("inf")])
def test_the_ends_of_a_span_are_whole_numbers(end: Any) -> None:
    with pytest.raises(InputError, match=r"^low must be whole"):
        Steps().between(end, 2)
    with pytest.raises(InputError, match=r"^high must be .*"):
        Steps().between(0, end)


def test_a_rare_span_keeps_its_digits() -> None:
    assert Steps().between(100, 101) == pytest.approx(0.75 * 2.0**-100, rel=1e-15)


# A float is the decimal that it prints as.


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
    with pytest.raises(InputError, match=r"(?s)^q must be .*"):
        exact(p, "q")


@pytest.mark.parametrize("p", [np.array([0.5]), np.array([0.5, 0.6])])
def test_an_array_is_no_probability(p: object) -> None:
    with pytest.raises(InputError, match="must be one number from 0 to 1"):
        exact(p)


def test_a_number_in_an_array_of_no_dimension_is_one() -> None:
    assert exact(np.array(0.52)) == Fraction(13, 25)
