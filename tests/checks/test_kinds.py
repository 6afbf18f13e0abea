import pytest

from evenbreak.checks import kind_of, kind_or_usual
from evenbreak.errors import InputError
from evenbreak.physics import Ball


def test_a_thing_of_the_kind_is_returned():
    ball = Ball(mass=0.2)
    assert kind_of(ball, "ball", Ball) is kind_or_usual(ball, "ball", Ball) is ball
    assert kind_or_usual(None, "ball", Ball) == Ball()


@pytest.mark.parametrize("wrong", [0, 0.2, "", [], Ball])
def test_others_are_refused_even_if_they_count_as_false(wrong):
    for check in (kind_of, kind_or_usual):
        with pytest.raises(InputError, match=r"^ball must be a Ball"):
            check(wrong, "ball", Ball)
    with pytest.raises(InputError, match="ball must be a Ball; you gave None"):
        kind_of(None, "ball", Ball)
