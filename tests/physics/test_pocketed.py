import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak import InputError
from evenbreak.physics.aimed import pocketed_shot
from evenbreak.physics.leg import pockets
from evenbreak.physics.objects import Ball, PoolTable
from evenbreak.physics.strike import strike_for_speed
from evenbreak.physics.units import INCH
from tiers import examples

POCKETS = {pocket.name: pocket for pocket in pockets(PoolTable())}
FROZEN = Ball().radius / INCH


def at(start, standing, name, *, side=0.0, **how):
    """Shoot at a pocket; places in inches."""
    places = (np.array(place) * INCH for place in (start, standing))
    return pocketed_shot(strike_for_speed(1.5, 0.0, side), *places, POCKETS[name], **how)


def test_with_nothing_in_the_way_the_middle_of_the_mouth_is_played_at():
    found = at((25, 16), (50, 25), "foot-left")
    assert found.target == pytest.approx([POCKETS["foot-left"].x, POCKETS["foot-left"].y])
    assert found.shot.object_leg.pocket == "foot-left"


@pytest.mark.slow_after(1)
@pytest.mark.parametrize(
    ("start", "standing", "name"),
    [
        ((20, FROZEN), (50, FROZEN), "foot-right"),
        ((20, 50 - FROZEN), (50, 50 - FROZEN), "foot-left"),
        ((60, FROZEN), (30, FROZEN), "head-right"),
        ((100 - FROZEN, 10), (100 - FROZEN, 25), "foot-left"),
        ((50, 8), (70, 1.2), "foot-right"),
    ],
)
def test_a_ball_at_a_cushion_goes_along_it_into_the_corner(start, standing, name):
    found = at(start, standing, name)
    assert found.shot.object_leg.pocket == name
    pocket = POCKETS[name]
    beside = found.target - [pocket.x, pocket.y]
    assert 0.0 < float(np.linalg.norm(beside)) < 0.5 * pocket.mouth - Ball().radius
    assert beside @ [pocket.into_x, pocket.into_y] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.slow
def test_throw_into_the_cushion_needs_outside_english():
    blocked = at((20, 10), (50, FROZEN), "foot-right")
    assert (blocked.shot.reached, blocked.shot.approach.ending) == (False, "cushion")
    # Seen from the shot the ball is cut to the left, so right english is outside.
    helped = at((20, 10), (50, FROZEN), "foot-right", side=0.15)
    assert helped.shot.object_leg.pocket == "foot-right"
    assert helped.shot.throw < 0.0
    smooth = at((20, 10), (50, FROZEN), "foot-right", mu=0.0)
    assert smooth.shot.object_leg.pocket == "foot-right"


@pytest.mark.slow
def test_a_mouth_that_is_too_flat_is_played_at_in_its_middle():
    found = at((90, 40), (70, 44), "side-left")
    assert found.shot.object_leg.ending == "cushion"
    assert found.target[0] == POCKETS["side-left"].x
    assert (
        POCKETS["side-left"].width_from(*found.shot.object_leg.slide.velocity) < 2 * FROZEN * INCH
    )


@pytest.mark.slow
@settings(max_examples=examples(5))
@given(st.floats(20.0, 60.0), st.floats(0.0, 1.0), st.floats(2.0, 10.0))
def test_left_and_right_are_mirror_images(x, off, gap):
    right = at((x, FROZEN + gap), (x + 20.0, FROZEN + off), "foot-right")
    left = at((x, 50 - FROZEN - gap), (x + 20.0, 50 - FROZEN - off), "foot-left")
    assert right.shot.approach.ending == left.shot.approach.ending
    assert right.target[0] == pytest.approx(left.target[0], abs=1e-9)
    assert right.shot.cut == pytest.approx(-left.shot.cut, abs=1e-9)


def test_a_pocket_behind_the_cue_ball_is_refused():
    with pytest.raises(InputError, match="target cannot be reached"):
        at((25, 16), (50, 25), "head-right")
    assert math.isfinite(at((25, 16), (50, 25), "foot-right").turn)
