"""Where the cue ball goes: the formulas against the hit and the slide that they come from."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

from evenbreak.errors import InputError
from evenbreak.physics import (
    Ball,
    Cloth,
    Slide,
    collide,
    deflection,
    deflection_slope,
    energy_after_hit,
    energy_in_roll,
    largest_deflection_cut,
    right_angle_cut,
    split_cut,
    split_roll_cut,
    unit_slope_cut,
)

cuts = st.floats(0.0, math.pi / 2.0)
inner_cuts = st.floats(0.01, 1.56)
spins = st.floats(-2.4, 3.0)


@given(inner_cuts, st.floats(-3.0, 3.0), st.floats(-1.0, 1.0))
def test_it_is_the_roll_after_a_hit_without_friction(cut: float, spin: float, side: float) -> None:
    hit = collide(cut, spin, side, speed=2.0, mu=0.0)
    level = hit.cue_velocity[:2]
    after = Slide(Ball(), Cloth(), [0.0, 0.0], level, hit.cue_spin).roll_velocity
    if np.hypot(*after) > 1e-3:
        found = math.atan2(after[1], after[0])
        assert deflection(cut, spin) == pytest.approx(found, abs=1e-9)


@given(cuts, st.floats(-1e50, 1e50))
def test_it_lies_between_0_and_pi(cut: float, spin: float) -> None:
    assert 0.0 <= deflection(cut, spin) <= math.pi
    assert math.isfinite(deflection_slope(cut, spin))


@given(inner_cuts, spins)
def test_the_tangents_of_p4_21(cut: float, spin: float) -> None:
    k = 0.4 * spin
    turned = cut + deflection(cut, spin)
    # tan(cut + theta) = (1 + k)/k tan(cut), without the poles.
    residual = k * math.cos(cut) * math.sin(turned) - (1 + k) * math.sin(cut) * math.cos(turned)
    assert residual == pytest.approx(0.0, abs=1e-12)


@given(cuts)
def test_stun_leaves_at_a_right_angle_to_the_object_ball(cut: float) -> None:
    assert deflection(cut, 0.0) == pytest.approx(math.pi / 2.0 - cut, abs=1e-12)


@pytest.mark.parametrize(
    ("cut", "spin", "theta"),
    [
        (0.0, 0.0, math.pi / 2.0),
        (0.0, -0.0, math.pi / 2.0),
        (0.0, 1.0, 0.0),
        (0.0, -1.0, math.pi),
        (math.pi / 2.0, 1.0, 0.0),
        (math.pi / 2.0, -1.0, 0.0),
        (math.pi / 2.0, -3.0, math.pi),
    ],
)
def test_the_ends(cut: float, spin: float, theta: float) -> None:
    assert deflection(cut, spin) == pytest.approx(theta, abs=1e-15)


@given(st.floats(0.01, 1.5), spins)
def test_the_slope_is_the_derivative(cut: float, spin: float) -> None:
    step = 1e-6
    if math.sin(cut) ** 2 + abs(0.4 * spin) > 0.01:
        rise = deflection(cut + step, spin) - deflection(cut - step, spin)
        found = deflection_slope(cut, spin)
        assert rise / (2.0 * step) == pytest.approx(found, rel=1e-5, abs=1e-6)


@given(st.floats(0.05, 3.0))
def test_the_largest_deflection_by_search(spin: float) -> None:
    found = minimize_scalar(
        lambda cut: -deflection(cut, spin), bounds=(0.0, 1.57), method="bounded"
    )
    cut = largest_deflection_cut(spin)
    assert cut == pytest.approx(found.x, abs=1e-4)
    assert deflection(cut, spin) == pytest.approx(-found.fun, abs=1e-9)
    assert deflection(cut, spin) == pytest.approx(math.pi / 2.0 - 2.0 * cut, abs=1e-9)
    assert deflection_slope(cut, spin) == pytest.approx(0.0, abs=1e-9)


@given(st.floats(0.01, 2.5))
def test_where_the_slope_is_one(spin: float) -> None:
    assert deflection_slope(unit_slope_cut(spin), spin) == pytest.approx(1.0, abs=1e-9)


@given(st.floats(-2.4, -0.01))
def test_where_draw_makes_a_right_angle(spin: float) -> None:
    assert deflection(right_angle_cut(spin), spin) == pytest.approx(math.pi / 2.0, abs=1e-9)


@given(st.floats(-2.5, 2.5))
def test_the_deflection_is_the_cut_where_the_energies_of_roll_split(spin: float) -> None:
    cut = split_roll_cut(spin)
    shares = energy_in_roll(cut, spin)
    assert shares.object_ball == pytest.approx(shares.cue_ball, abs=1e-12)
    if 1e-6 < cut < 1.57:
        assert deflection(cut, spin) == pytest.approx(cut, abs=1e-7)
    assert cut + split_roll_cut(-spin) == pytest.approx(math.pi / 2.0, abs=1e-7)


@given(st.floats(-1.58, 1.58))
def test_where_all_energy_splits_just_after_the_hit(spin: float) -> None:
    shares = energy_after_hit(split_cut(spin), spin)
    assert shares.object_ball == pytest.approx(shares.cue_ball, abs=1e-12)


@given(cuts, st.floats(-3.0, 3.0))
def test_energies_are_those_of_the_balls(cut: float, spin: float) -> None:
    ball = Ball()
    hit = collide(cut, spin, mu=0.0, ball=ball)
    after = energy_after_hit(cut, spin)
    turning = 0.4 * ball.radius**2 * float(hit.cue_spin @ hit.cue_spin)
    assert after.object_ball == pytest.approx(float(hit.object_velocity @ hit.object_velocity))
    assert after.cue_ball == pytest.approx(float(hit.cue_velocity @ hit.cue_velocity) + turning)
    assert after.object_ball + after.cue_ball == pytest.approx(1.0 + 0.4 * spin**2)
    rolls = [
        Slide(ball, Cloth(), [0.0, 0.0], velocity[:2], turn).roll_velocity
        for velocity, turn in (
            (hit.object_velocity, hit.object_spin),
            (hit.cue_velocity, hit.cue_spin),
        )
    ]
    expected = [float(roll @ roll) for roll in rolls]
    assert list(energy_in_roll(cut, spin)) == pytest.approx(expected, abs=1e-12)


def test_arrays_broadcast_and_scalars_stay_scalars() -> None:
    cut, spin = np.linspace(0.0, 1.5, 4)[:, None], np.linspace(-1.0, 1.0, 3)
    for law in (deflection, deflection_slope):
        assert law(cut, spin).shape == (4, 3)
        assert type(law(0.5)) is float
    assert energy_in_roll(cut, spin).cue_ball.shape == (4, 3)
    for where in (largest_deflection_cut, unit_slope_cut, split_cut, split_roll_cut):
        assert where(np.array([0.5, 1.0])).shape == (2,)
        assert type(where(1.0)) is float


def test_a_cut_to_the_left_is_the_mirror_image() -> None:
    cut, spin = np.linspace(0.01, 1.5, 4)[:, None], np.linspace(-1.0, 1.0, 3)
    for law in (deflection, deflection_slope):
        assert law(-cut, spin).tolist() == law(cut, spin).tolist()
    for shares in (energy_after_hit, energy_in_roll):
        assert shares(-cut, spin).cue_ball.tolist() == shares(cut, spin).cue_ball.tolist()


def test_refusals() -> None:
    with pytest.raises(InputError, match=r"it is -1\.6"):
        deflection(-1.6)
    with pytest.raises(
        InputError, match=r"topspin must be a number from 1e-50 to 1e\+50; it is 0\.0"
    ):
        largest_deflection_cut(0.0)
    with pytest.raises(InputError, match=r"topspin must be .* to 2\.5; it is 2\.6"):
        unit_slope_cut(2.6)
    with pytest.raises(InputError, match=r"topspin must be a number from -2\.5 to 0; it is 1\.0"):
        right_angle_cut(1.0)
    with pytest.raises(InputError, match=r"topspin must be .* to 1\.58114; it is 1\.6"):
        split_cut(1.6)
