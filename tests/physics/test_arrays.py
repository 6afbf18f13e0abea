"""Numbers in, numbers out, and what is refused."""

import math
from functools import partial

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.physics import (
    Ball,
    Cloth,
    ContactPoint,
    Slide,
    aim,
    ball_speed_ratio,
    break_energy_share,
    collide,
    contact_for_later,
    deflection,
    drag_distance,
    effective_contact,
    friction_of_stop,
    friction_of_throw,
    gearing_tip,
    kinetic_energy,
    lag_speed,
    parabola,
    roll_side,
    roll_speed,
    roll_speed_ratio,
    roll_velocity,
    rolling_time,
    sliding_ball_speed,
    sliding_distance,
    sliding_power,
    sliding_speed,
    strike,
    stroke_energy,
    stroke_speed,
    stun_distance,
    stun_offset,
    table_speed,
    throw_angle,
)
from evenbreak.physics.units import LARGEST, LEAST, numbers, positive
from rows import each_of


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (math.nan, "it is nan"),
        (-math.inf, "it is -inf"),
        ("1.0", "it is '1.0'"),
        (1j, "it is 1j"),
        (10**400, "it is 1000"),
        (1e51, "it is 1e+51"),
        ([0.0, math.nan], "it holds nan"),
        ([3.0, -1e60], "it holds -1e+60"),
    ],
)
def test_what_is_no_number_is_refused_by_name(value: object, said: str) -> None:
    with pytest.raises(InputError) as refused:
        numbers(value, "cut")
    assert said in str(refused.value)


def test_the_ends_of_a_range() -> None:
    assert numbers([0.0, 1.0], "x", low=0.0, high=1.0).tolist() == [0.0, 1.0]
    for wrong in (0.0, -1.0):
        with pytest.raises(InputError, match="1e-50"):
            positive(wrong, "x")
    with pytest.raises(InputError, match="is 5e-324"):
        positive(5e-324, "x")
    assert positive(LEAST, "x") == LEAST
    with pytest.raises(InputError, match="from 0 to 1"):
        numbers(np.nextafter(1.0, 2.0), "x", low=0.0, high=1.0)
    assert numbers(-LARGEST, "x") == -LARGEST


def test_no_numbers_are_numbers() -> None:
    assert numbers([], "x", low=0.0).shape == (0,)
    assert collide([], 1.0).object_velocity.shape == (0, 3)


@pytest.mark.parametrize("gravity", [0.0, -1.0, math.nan])
def test_gravity_pulls_down(gravity: float) -> None:
    for answer in (
        collide(0.1, -1.0).jump,
        partial(friction_of_stop, 1.0, 1.0),
        partial(sliding_speed, 1.0, 0.2, 1.0),
        partial(sliding_distance, 1.0, 0.2, 1.0),
        partial(sliding_power, 1.0, 0.2, 1.0),
        partial(rolling_time, 1.0, 0.01),
        partial(table_speed, 7.0),
    ):
        with pytest.raises(InputError, match=r"gravity must be a number from 1e-50"):
            answer(gravity=gravity)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: collide([0.1, 0.2], [0, 1, 2]), r"cut has shape \(2,\), topspin has shape \(3,\)"),
        (lambda: collide([0.1, 0.2], speed=[1, 2, 3]), r"cut has shape .2,., speed has shape .3,."),
        (lambda: throw_angle(0.1, [0, 1], mu=[0.1, 0.2, 0.3]), "topspin has shape .*, mu has"),
        (lambda: aim([0.1, 0.2], [1, 2, 3]), "distance has shape"),
        (lambda: deflection([0.1, 0.2], [1, 2, 3]), "shapes must broadcast"),
        (lambda: strike([1, 2], [0.1, 0.2, 0.3]), "stick_speed has shape"),
        (
            lambda: collide(0.5, None),
            r"topspin must be a number from -1e\+50 to 1e\+50; it is None",
        ),
    ],
)
def test_shapes_that_do_not_fit_are_refused_by_name(ask, message):
    with pytest.raises(InputError, match=message):
        ask()


TWO, THREE, CLOTH = [0.1, 0.2], [0.1, 0.2, 0.3], Cloth()


@each_of(
    "ask, names",
    [
        (lambda: friction_of_throw(TWO, THREE), "sideways, ahead"),
        (lambda: friction_of_stop(TWO, THREE), "distance, time"),
        (lambda: sliding_speed(TWO, THREE, 1.0), "speed, friction"),
        (lambda: sliding_distance(TWO, 0.2, THREE), "speed, time"),
        (lambda: sliding_power(TWO, 0.2, THREE), "speed, mass"),
        (lambda: roll_side(TWO, THREE), "y, z"),
        (lambda: effective_contact(ContactPoint(0.1, TWO), 1.0, THREE, CLOTH), "z, time"),
        (lambda: contact_for_later(ContactPoint(TWO, 1.0), THREE), "later.y, z"),
        (lambda: gearing_tip(TWO, THREE), "cut, z"),
        (lambda: stun_offset(TWO, THREE, CLOTH), "speed, distance"),
        (lambda: ball_speed_ratio(TWO, THREE), "offset, ball_ratio"),
        (lambda: roll_speed_ratio(TWO, THREE), "offset, ball_ratio"),
        (lambda: kinetic_energy(Ball(), TWO, THREE), "speed, rim_speed"),
        (lambda: rolling_time(TWO, THREE), "distance, friction"),
        (lambda: sliding_ball_speed(TWO, THREE, 1.0), "speed, rim_speed"),
        (lambda: roll_speed(TWO, THREE), "speed, rim_speed"),
        (lambda: roll_velocity(np.ones((2, 2)), np.ones((3, 3))), "velocity, rim_velocity"),
        (lambda: parabola(THREE, np.ones((2, 2)), CLOTH), "ahead, velocity"),
        (lambda: stun_distance(TWO, [-0.1, -0.2, -0.3], CLOTH), "speed, spin"),
        (lambda: drag_distance(TWO, THREE, CLOTH), "speed, spin"),
        (
            lambda: Slide(Ball(), CLOTH, [0, 0], np.ones((2, 2)), np.ones((3, 3))),
            "velocity, spin",
        ),
        (lambda: table_speed(TWO, distance=THREE), "lag_time, distance"),
        (lambda: lag_speed(TWO, distance=THREE), "lag_time, distance"),
        (lambda: stroke_speed(TWO, THREE, 1.0), "force, length"),
        (lambda: stroke_energy(1.0, TWO, THREE), "stick_ratio, forearm_ratio"),
        (lambda: break_energy_share(TWO, THREE), "stick_ratio, forearm_ratio"),
    ],
)
def test_every_formula_says_whose_shapes_do_not_fit(ask, names):
    first, second = names.split(", ")
    vectors = r"(\[\.\.\., 0\])?"
    said = rf"{first}{vectors} has shape \(2,\), (.*, )?{second}{vectors} has shape \(3,\)"
    turned = rf"{first}{vectors} has shape \(3,\), {second}{vectors} has shape \(2,\)"
    with pytest.raises(InputError, match=f"shapes must broadcast; .*({said}|{turned})"):
        ask()


@pytest.mark.parametrize("ask", ["at", "velocity_at", "spin_at"])
def test_times_that_do_not_fit_the_balls_are_refused(ask):
    balls = Slide(Ball(), CLOTH, [0, 0], np.ones((2, 2)), [0, 0, 0])
    with pytest.raises(InputError, match=r"time has shape \(3,\), slip.* has shape \(2,\)"):
        getattr(balls, ask)(THREE)


def test_a_slide_cannot_be_changed():
    slide = Slide(Ball(), CLOTH, [0, 0], [1, 0], [0, 0, 0])
    with pytest.raises(ValueError, match="read-only"):
        slide.velocity[0] = 2.0
