"""Friction between balls that falls with the speed of the slip."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.physics import (
    BALL_FRICTION,
    Cloth,
    SlipFriction,
    aim,
    aimed_shot,
    collide,
    pocketed_shot,
    pockets,
    shot,
    strike_for_speed,
    throw_angle,
)
from evenbreak.physics.objects import PoolTable

FIT = SlipFriction()
HALF_BALL = math.radians(30.0)


def test_the_fit_is_the_published_one() -> None:
    assert (FIT.fast, FIT.more, FIT.decay) == (9.951e-3, 0.108, 1.088)
    assert FIT.at(0.0) == FIT.slow == 0.117951
    assert FIT.at([0.5, 2.0]) == pytest.approx(
        [0.009951 + 0.108 * math.exp(-0.544), 0.009951 + 0.108 * math.exp(-2.176)]
    )
    assert FIT.at(1e50) == FIT.fast


@pytest.mark.parametrize(("speed", "degrees"), [(0.5, 4.7), (2.0, 2.7), (4.0, 1.3)])
def test_a_half_ball_stun_shot_by_hand(speed: float, degrees: float) -> None:
    slip = 0.5 * speed
    mu = 0.009951 + 0.108 * math.exp(-1.088 * slip)
    # Slip takes friction along only up to a seventh of itself.
    sideways = min(mu * math.cos(HALF_BALL), 0.5 / 7.0)
    thrown = throw_angle(HALF_BALL, 0.0, mu=FIT, speed=speed)
    assert thrown == pytest.approx(math.atan2(sideways, math.cos(HALF_BALL)))
    assert math.degrees(thrown) == pytest.approx(degrees, abs=0.05)


@given(st.floats(-1.57, 1.57), st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.floats(0.0, 20.0))
def test_it_is_the_constant_friction_of_that_slip(
    cut: float, topspin: float, side: float, speed: float
) -> None:
    by_slip = collide(cut, topspin, side, speed=speed, mu=FIT)
    assert by_slip.mu == pytest.approx(FIT.at(math.hypot(*by_slip.slip)))
    constant = collide(cut, topspin, side, speed=speed, mu=by_slip.mu)
    assert by_slip.object_velocity.tolist() == constant.object_velocity.tolist()
    # A ball that does not move has no direction; `throw_angle` is the limit of slow shots.
    if speed > 1e-6:
        angle = throw_angle(cut, topspin, side, mu=FIT, speed=speed)
        assert by_slip.throw == pytest.approx(angle, abs=1e-12)


def test_a_curve_that_is_flat_is_a_constant() -> None:
    flat = SlipFriction(BALL_FRICTION, 0.0, 1.0)
    cuts = np.linspace(-1.5, 1.5, 7)
    assert throw_angle(cuts, mu=flat, speed=3.0).tolist() == throw_angle(cuts).tolist()
    assert aim(0.3, 1.0, mu=flat, speed=3.0) == aim(0.3, 1.0)


@given(st.floats(-1.4, 1.4), st.floats(-1.5, 1.5), st.floats(-1.0, 1.0), st.floats(0.01, 10.0))
def test_a_shot_aimed_so_goes_to_its_target(
    cut: float, topspin: float, side: float, speed: float
) -> None:
    found = aim(cut, 1.0, topspin, side, mu=FIT, speed=speed)
    hit = collide(found.cut, topspin, side, mu=FIT, speed=speed)
    x, y, _ = hit.object_velocity
    assert -math.atan2(y, x) == pytest.approx(cut, abs=1e-8)


def test_arrays_of_speeds() -> None:
    speeds = np.array([0.5, 2.0, 4.0])
    many = throw_angle([[0.2], [0.5]], 0.0, mu=FIT, speed=speeds)
    assert many.shape == (2, 3)
    assert many[1, 2] == throw_angle(0.5, 0.0, mu=FIT, speed=4.0)
    assert (np.diff(many[1]) < 0.0).all()


def test_a_traced_shot_takes_the_friction_of_its_hit() -> None:
    slow, fast = (
        shot(strike_for_speed(speed, -0.2), 0.5, 0.3, mu=FIT).collision for speed in (0.6, 4.0)
    )
    assert slow is not None
    assert fast is not None
    assert fast.mu < slow.mu == FIT.at(math.hypot(*slow.slip))
    fixed = shot(strike_for_speed(4.0, -0.2), 0.5, 0.3, mu=fast.mu)
    assert fixed.throw == fast.throw


def test_a_pot_allows_for_it() -> None:
    pocket = pockets(PoolTable())[3]
    balls = (0.7, 0.4), (1.2, 0.4)
    for speed in (3.0, 5.0):
        found = pocketed_shot(strike_for_speed(speed, -0.2), *balls, pocket, mu=FIT)
        assert found.shot.object_leg is not None
        assert found.shot.object_leg.pocket == pocket.name
    one = aimed_shot(strike_for_speed(5.0, -0.2), *balls, (pocket.x, pocket.y), mu=FIT)
    assert one.turn == pytest.approx(found.turn)
    other = aimed_shot(strike_for_speed(5.0, -0.2), *balls, (pocket.x, pocket.y), cloth=Cloth())
    assert one.turn < other.turn  # so fast, the balls have less friction than 4/72


def test_refusals() -> None:
    with pytest.raises(InputError, match="speed of the slip; give the speed"):
        throw_angle(0.3, mu=FIT)
    with pytest.raises(InputError, match="speed of the slip; give the speed"):
        aim(0.3, 1.0, mu=FIT)
    with pytest.raises(InputError, match="speed is -1"):
        throw_angle(0.3, mu=FIT, speed=-1.0)
    with pytest.raises(InputError, match=r"decay is -0\.1"):
        SlipFriction(decay=-0.1)
    with pytest.raises(InputError, match="slip is -1"):
        FIT.at(-1.0)
    with pytest.raises(InputError, match="mu is 'low'"):
        throw_angle(0.3, mu="low")
