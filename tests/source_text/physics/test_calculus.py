import math

import pytest

from evenbreak.source_text.physics.calculus import crossing, slope


def test_slope_of_a_function_with_a_known_one():
    assert slope(math.exp, 1.0) == pytest.approx(math.e, rel=1e-11)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_crossing_of_a_rising_and_a_falling_function(sign):
    assert crossing(lambda x: sign * (x**3 - 2.0), 1.0, 2.0) == pytest.approx(2 ** (1 / 3))
