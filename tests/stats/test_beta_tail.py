from fractions import Fraction
from math import comb

import numpy as np
import pytest

from evenbreak.stats.beta_tail import beta_tail

CASES = [(19, 28, 1e-16), (64, 100, 6.469511877280967e-06), (20, 28, 4.9e-16), (26, 28, 2e-12)]


@pytest.mark.parametrize(("successes", "tries", "p"), CASES)
def test_the_smallest_tails_keep_their_digits(successes: int, tries: int, p: float) -> None:
    x = Fraction(p)
    exact = sum(comb(tries, k) * x**k * (1 - x) ** (tries - k) for k in range(successes, tries + 1))
    found = beta_tail(successes, tries - successes + 1, p)
    assert found == pytest.approx(float(exact), rel=1e-12, abs=0)


def test_arrays_of_small_and_large_tails_broadcast() -> None:
    found = beta_tail([[19], [1]], 10, [0.0, 1e-16, 0.5, 1.0])
    assert found.shape == (2, 4)
    assert found[0].tolist() == [beta_tail(19, 10, p) for p in (0.0, 1e-16, 0.5, 1.0)]
    assert found[:, 0].tolist() == [0.0, 0.0]
    assert np.all(found[:, 3] == 1.0)
