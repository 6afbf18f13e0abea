"""Running products with the exponents apart, against exact arithmetic."""

from fractions import Fraction
from itertools import accumulate

import numpy as np
import pytest

from evenbreak.chains.scaled import prefix_products, shares


def exact_products(numerators, denominators):
    ratios = [Fraction(a) / Fraction(b) for a, b in zip(numerators, denominators, strict=True)]
    return list(accumulate([Fraction(1), *ratios], lambda x, y: x * y))


@pytest.mark.parametrize("n", [0, 1, 31, 32, 33, 200])
@pytest.mark.parametrize("decades", [0.5, 5, 300])
def test_products_are_right_to_the_number_of_factors(n, decades):
    rng = np.random.default_rng(n)
    up, down = 10.0 ** -rng.uniform(0, decades, n), 10.0 ** -rng.uniform(0, decades, n)
    value, exponent = prefix_products(up, down)
    exact = exact_products(up, down)
    top = max(exact)
    found = [Fraction(v) * Fraction(2) ** int(e) for v, e in zip(value, exponent, strict=True)]
    assert 0.5 <= max(found) < 1
    scale = found[exact.index(top)] / top
    for x, y, e in zip(found, exact, exponent, strict=True):
        if e > -5000:
            assert abs(x / (y * scale) - 1) < 1e-13


def test_equal_ratios_do_not_repeat_one_rounding_error():
    n, up, down = 40_000, 0.4999, 0.5001
    value, exponent = prefix_products(np.full(n, up), np.full(n, down))
    ratio = Fraction(up) / Fraction(down)
    first = Fraction(value[0]) * Fraction(2) ** int(exponent[0])
    for k in (1_000, 9_999, 40_000):
        found = Fraction(value[k]) * Fraction(2) ** int(exponent[k])
        # The thousandth power is exact and rounded once; its own powers add little to that.
        exact = float(ratio**1000) ** (k / 1000)
        assert float(found / first) == pytest.approx(exact, rel=1e-12)


def test_shares_far_apart_keep_their_digits():
    value = np.array([1.0, 0.5, 1.0])
    left, right = shares(value, np.array([0, 0, -900]), 2)
    assert left == 1.0
    assert right == pytest.approx(2.0**-900 / 1.5, rel=1e-15)
    left, right = shares(value, np.array([-3000, -3000, -3900]), 2)
    assert (left, right) == (1.0, pytest.approx(2.0**-900 / 1.5, rel=1e-15))
