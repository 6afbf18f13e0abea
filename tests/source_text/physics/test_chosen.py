"""What is chosen is what the drawings of the text were drawn for, as far as they show it."""

import math
from itertools import pairwise

from evenbreak.physics import gearing_side, miscue_offset
from evenbreak.source_text.physics import section_3_plots, section_4_plots


def test_sidespins_are_even_steps_about_none():
    for sides in (section_3_plots.SIDES_AFTER_TIP, section_3_plots.SIDES_IN_ROLL):
        assert sides == tuple(-side for side in reversed(sides))
        assert len({b - a for a, b in pairwise(sides)}) == 1


def test_contours_double():
    assert all(2.0 * a == b for a, b in pairwise(section_4_plots.LEVELS))


def test_offsets_end_near_the_miscue_of_a_tip_of_friction_1():
    assert abs(section_3_plots.LARGEST_OFFSET - miscue_offset(1.0)) < 0.01


def test_the_inset_and_the_spins_hold_the_point_without_slip():
    step = gearing_side(section_4_plots.HALF_BALL)
    assert abs(step) + section_4_plots.INSET < section_4_plots.LARGEST_SPIN
    assert math.degrees(section_4_plots.HALF_BALL) - 30.0 < 1e-12
