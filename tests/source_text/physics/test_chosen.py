"""What is chosen is what the drawings of the text were drawn for, as far as they show it."""

import math
from itertools import pairwise

from evenbreak.physics import gearing_side, miscue_offset
from evenbreak.source_text.physics import tip_figures as chosen


def test_sidespins_are_even_steps_about_none():
    for sides in (chosen.SIDES_AFTER_TIP, chosen.SIDES_IN_ROLL):
        assert sides == tuple(-side for side in reversed(sides))
        assert len({b - a for a, b in pairwise(sides)}) == 1


def test_contours_double():
    assert all(2.0 * a == b for a, b in pairwise(chosen.LEVELS))


def test_offsets_end_near_the_miscue_of_a_tip_of_friction_1():
    assert abs(chosen.LARGEST_OFFSET - miscue_offset(1.0)) < 0.01


def test_the_inset_and_the_spins_hold_the_point_without_slip():
    step = gearing_side(chosen.HALF_BALL)
    assert abs(step) + chosen.INSET < chosen.LARGEST_SPIN
    assert math.degrees(chosen.HALF_BALL) - 30.0 < 1e-12
