import math

import pytest

from evenbreak.source_text.physics.inputs import crossing, parse_inputs, slope


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("alpha=30deg", math.pi / 6),
        ("alpha=0.55", 0.55),
        ("Jz=-.2", -0.2),
        ("mu=4/72", 1 / 18),
        ("V_0=50in/s", 50 * 0.0254),
        ("D=36in", 36 * 0.0254),
        ("M=3oz", 3 * 0.028349523125),
        ("t=7.00s", 7.0),
    ],
)
def test_numbers_are_taken_in_si_units(text, value):
    [found] = parse_inputs(text).values()
    assert found == pytest.approx(value, rel=1e-15)


def test_words_are_kept_where_they_have_a_name():
    assert parse_inputs("nine-foot table class=very_slow") == {"class": "very slow"}
    assert parse_inputs("") == {}


def test_slope_of_a_function_with_a_known_one():
    assert slope(math.exp, 1.0) == pytest.approx(math.e, rel=1e-11)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_crossing_of_a_rising_and_a_falling_function(sign):
    assert crossing(lambda x: sign * (x**3 - 2.0), 1.0, 2.0) == pytest.approx(2 ** (1 / 3))
