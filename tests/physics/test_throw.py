"""Throw: the law of the text, its limit, its signs, and aim."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from evenbreak.errors import InputError
from evenbreak.physics import (
    BALL_FRICTION,
    FRICTION_LAWS,
    aim,
    full_throw_cut,
    gearing_side,
    throw_angle,
    throw_factor,
    throw_sensitivity,
)

cuts = st.floats(0.0, math.pi / 2.0)
spins = st.floats(-3.0, 3.0)
frictions = st.floats(0.0, 1.0)
laws = st.sampled_from(FRICTION_LAWS)
any_spin = st.floats(-1e50, 1e50)
any_friction = st.floats(0.0, 1e50)


@given(cuts, any_spin, any_spin, any_friction, laws)
def test_throw_is_a_number_whatever_the_shot(
    cut: float, topspin: float, side: float, mu: float, law: str
) -> None:
    factor = throw_factor(cut, topspin, side)
    angle = throw_angle(cut, topspin, side, mu=mu, friction=law)
    assert -1.0 <= factor <= 1.0
    assert abs(angle) <= math.atan(mu * abs(factor)) * (1.0 + 1e-12)
    assert throw_sensitivity(cut, topspin, side) >= 0.0


@pytest.mark.parametrize("law", FRICTION_LAWS)
def test_no_slip_no_throw(law: str) -> None:
    for cut in (0.0, 0.3, math.pi / 6.0, math.pi / 2.0):
        assert throw_angle(cut, 0.0, gearing_side(cut), friction=law) == 0.0
    assert throw_factor(0.0, 0.0, 0.0) == 0.0
    assert throw_sensitivity(0.0, 0.0, 0.0) == math.inf


@pytest.mark.parametrize("tiny", [1e-140, 1e-200, 5e-324])
def test_the_least_slip_has_a_direction(tiny: float) -> None:
    assert throw_factor(0.0, 0.0, tiny) == 1.0
    assert throw_factor(0.0, tiny, -tiny) == pytest.approx(-1.0, abs=0.3)
    assert throw_angle(0.0, 0.0, -tiny, friction="shepard") == -math.atan(BALL_FRICTION)
    assert throw_angle(0.0, 0.0, tiny) == pytest.approx(tiny / 7.0, rel=1e-9, abs=5e-324)
    assert throw_sensitivity(0.0, 0.0, tiny) == 0.0


def test_a_right_angle_is_the_limit_of_thin_cuts() -> None:
    for law in FRICTION_LAWS:
        thin = throw_angle(math.pi / 2.0 - 1e-9, 1.0, friction=law)
        assert throw_angle(math.pi / 2.0, 1.0, friction=law) == pytest.approx(thin, abs=1e-9)


@given(cuts, spins, spins, frictions)
def test_friction_stops_with_the_slip(cut: float, topspin: float, side: float, mu: float) -> None:
    ahead = math.cos(cut)
    sideways = math.tan(throw_angle(cut, topspin, side, mu=mu)) * ahead
    assert abs(sideways) <= abs(math.sin(cut) + side) / 7.0 + 1e-15


@given(cuts, frictions)
def test_a_stun_shot_has_its_full_throw_from_a_cut_on(cut: float, mu: float) -> None:
    limited = throw_angle(cut, 0.0, mu=mu)
    if math.tan(cut) >= 7.0 * mu * (1.0 + 1e-12):
        assert limited == pytest.approx(throw_angle(cut, 0.0, mu=mu, friction="shepard"))
    else:
        assert math.tan(limited) == pytest.approx(math.tan(cut) / 7.0, abs=1e-15)


def test_where_the_full_throw_begins() -> None:
    assert math.degrees(full_throw_cut(4.0 / 72.0)) == pytest.approx(21.25, abs=0.005)


@given(cuts, spins, spins)
def test_topspin_throws_as_draw_does(cut: float, topspin: float, side: float) -> None:
    for law in FRICTION_LAWS:
        one, two = (throw_angle(cut, spin, side, friction=law) for spin in (topspin, -topspin))
        assert one == two


@given(spins, spins)
def test_english_on_a_full_hit_throws_to_either_side(topspin: float, side: float) -> None:
    assert throw_angle(0.0, topspin, side) == -throw_angle(0.0, topspin, -side)


@given(cuts.filter(bool), spins, spins, laws)
def test_a_cut_to_the_left_is_the_mirror_image(
    cut: float, topspin: float, side: float, law: str
) -> None:
    for ask in (throw_factor, throw_sensitivity, partial(throw_angle, friction=law)):
        assert ask(-cut, topspin, -side) == ask(cut, topspin, side)
    assert gearing_side(-cut) == -gearing_side(cut)


@given(st.floats(1e-6, 1.4), st.floats(-1.5, 1.5), st.floats(-1.0, 1.0))
def test_aiming_to_the_left_is_the_mirror_image(cut: float, topspin: float, side: float) -> None:
    right, left = aim(cut, 1.0, topspin, side), aim(-cut, 1.0, topspin, -side)
    assert left.cut == pytest.approx(-right.cut, abs=1e-9)
    assert left[1:] == pytest.approx(right[1:], abs=1e-9)


def test_outside_english_is_negative_and_takes_throw_away() -> None:
    cut = math.radians(30.0)
    without, outside, inside = (throw_angle(cut, 1.0, side) for side in (0.0, -0.3, 0.3))
    assert outside < without < inside
    assert gearing_side(cut) == pytest.approx(-0.5)
    assert throw_angle(cut, 1.0, -0.9) < 0.0


@given(st.floats(0.05, 1.5), st.floats(0.05, 2.0), spins)
def test_sensitivity_is_the_gradient(cut: float, topspin: float, side: float) -> None:
    step = 1e-6
    by_topspin, by_side = (
        (
            throw_factor(cut, topspin + up, side + left)
            - throw_factor(cut, topspin - up, side - left)
        )
        / (2.0 * step)
        for up, left in ((step, 0.0), (0.0, step))
    )
    found = throw_sensitivity(cut, topspin, side)
    assert found == pytest.approx(math.hypot(by_topspin, by_side), rel=1e-3, abs=1e-6)


@given(st.floats(0.0, 1.4), st.floats(-1.5, 1.5), st.floats(-1.0, 1.0), laws)
def test_a_shot_aimed_so_is_thrown_to_its_target(
    cut: float, topspin: float, side: float, law: str
) -> None:
    found = aim(cut, 1.0, topspin, side, friction=law)
    assert found.cut - found.throw == pytest.approx(cut, abs=1e-9)
    there = throw_angle(found.cut, topspin, side, friction=law)
    if abs(throw_factor(found.cut, topspin, side)) < 1.0:  # else it may leap just here
        assert abs(found.throw) == pytest.approx(abs(there), abs=1e-9)
    assert found.offset == pytest.approx(math.tan(found.cut - cut), abs=1e-9)


def test_a_full_hit_without_english_is_aimed_straight() -> None:
    for law in FRICTION_LAWS:
        found = aim(0.0, 36.0, [1.0, 0.0], friction=law)
        assert found.cut.tolist() == [0.0, 0.0]
        assert found.offset.tolist() == [0.0, 0.0]


def test_no_cut_is_thinner_than_a_right_angle() -> None:
    with pytest.raises(InputError, match="cut is too thin"):
        aim(math.pi / 2.0, 1.0, 0.0)


def test_scalars_and_arrays() -> None:
    cut = np.linspace(0.0, 1.5, 4)[:, None]
    side = np.linspace(-1.0, 1.0, 3)
    for law in FRICTION_LAWS:
        table = throw_angle(cut, 1.0, side, friction=law)
        one = throw_angle(float(cut[2, 0]), 1.0, float(side[1]), friction=law)
        assert table.shape == (4, 3)
        assert type(one) is float
        assert table[2, 1] == one
    assert throw_sensitivity(cut, 1.0, side).shape == throw_factor(cut, 1.0, side).shape == (4, 3)


@pytest.mark.parametrize(
    ("shot", "options", "said"),
    [
        ((-1.6,), {}, "cut must be a number from -1.5708 to 1.5708; it is -1.6"),
        ((2.0,), {}, "it is 2.0"),
        ((0.1, math.nan), {}, "topspin must be a number from -1e+50 to 1e+50; it is nan"),
        ((0.1, 1.0, math.inf), {}, "side must be a number from -1e+50 to 1e+50; it is inf"),
        ((0.1,), {"mu": -0.1}, "is -0.1"),
        ((0.1,), {"friction": "none"}, "friction must be 'limited' or 'shepard'; you gave 'none'"),
    ],
)
def test_refusals(shot: tuple[float, ...], options: dict[str, object], said: str) -> None:
    with pytest.raises(InputError) as refused:
        throw_angle(*shot, **options)  # type: ignore[arg-type]
    assert said in str(refused.value)


@pytest.mark.parametrize("degrees", [10.0, 30.0, 45.0, 60.0])
def test_english_that_is_the_sine_but_for_rounding_leaves_no_slip(degrees):
    cut = math.radians(degrees)
    for turn in (-math.inf, math.inf):
        side = float(np.nextafter(gearing_side(cut), turn))
        assert throw_factor(cut, 0.0, side) == 0.0
        assert throw_angle(cut, 0.0, side, friction="shepard") == 0.0
    assert throw_factor(cut, 0.0, gearing_side(cut) + 1e-12) == 1.0
