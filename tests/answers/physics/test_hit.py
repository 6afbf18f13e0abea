import math

import pytest

from evenbreak.answers.physics.hit import Hit, cut_words, friction_values, spin_words
from evenbreak.physics import SlipFriction, collide


def hit(cut, topspin=1.0, side=0.0):
    return Hit(cut, topspin, side, 4 / 72, "limited")


@pytest.mark.parametrize(
    ("cut", "side", "english"),
    [
        (30.0, 0.1, "inside"),
        (30.0, -0.1, "outside"),
        (-30.0, 0.1, "outside"),
        (-30.0, -0.1, "inside"),
        (0.0, 0.1, "right"),
        (0.0, -0.1, "left"),
        (30.0, 0.0, None),
    ],
)
def test_outside_english_is_on_the_side_away_from_the_cut(cut, side, english):
    assert hit(cut, side=side).english == english


def test_a_cut_to_the_left_is_the_mirror_image_of_one_to_the_right():
    left, right = hit(-20.0, 0.5, 0.3), hit(20.0, 0.5, -0.3)
    assert left.collide().throw == right.collide().throw
    assert left.collide().sideways == -right.collide().sideways
    assert (left.hand, left.toward, left.away) == (-1.0, "left", "right")
    assert (right.hand, right.toward, right.away) == (1.0, "right", "left")


def test_the_english_that_leaves_no_slip_is_exact():
    angle, _, side = hit(30.0, 0.0, -0.5).cut_and_spin
    assert side == -math.sin(angle)
    assert hit(30.0, 0.0, -0.5).collide().throw == 0.0


def test_it_is_the_hit_of_the_library():
    found, wanted = hit(25.0, 0.3, -0.2).collide(), collide(math.radians(25.0), 0.3, -0.2)
    assert (found.throw, found.departure) == (wanted.throw, wanted.departure)


def test_friction_is_taken_at_the_speed_of_the_hit():
    by_speed = hit(30.0, 0.0)._replace(mu=SlipFriction(), speed=2.0)
    assert by_speed.collide().mu == pytest.approx(SlipFriction().at(1.0))
    full = by_speed.collide(0.0)
    assert (full.cut, full.mu) == (0.0, SlipFriction().slow)
    assert friction_values(by_speed.mu, None, "limited")["mu"] is None
    assert friction_values(0.05, None, "limited")["mu"] == 0.05


def test_in_words():
    assert cut_words(-1.0).endswith("1 degree to the left")
    assert cut_words(2.0).endswith("2 degrees to the right")
    assert "outside (right)" in hit(-30.0, side=0.2).description
    assert hit(0.0, side=-0.2).description.endswith("left english, 0.22 tips")
    assert spin_words(0.25) == "topspin (0.25)"
