from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.checks import complement

DECIMALS = st.integers(0, 10**15).map(lambda n: n / 10**15)


@given(p=DECIMALS)
def test_of_a_decimal_it_is_the_nearest_float_to_1_minus_the_decimal(p: float) -> None:
    assert complement(p) == float(1 - Fraction(repr(p)))


@given(p=st.floats(0.0, 1.0))
def test_it_is_within_a_rounding_of_1_minus_p(p: float) -> None:
    assert abs(Fraction(complement(p)) + Fraction(p) - 1) <= Fraction(1, 2**53)
    assert 0.0 <= complement(p) <= 1.0


@given(p=st.lists(st.one_of(DECIMALS, st.floats(0.0, 1.0)), min_size=1))
def test_arrays_equal_numbers(p: list[float]) -> None:
    assert complement(np.array(p)).tolist() == [complement(x) for x in p]


@pytest.mark.parametrize("p", [0.0, 1.0, 1e-300, 0.5])
def test_what_floats_can_say_stays(p: float) -> None:
    assert complement(p) == 1.0 - p
