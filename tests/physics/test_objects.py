"""Ball, cloth, table and cue refuse what cannot be."""

import dataclasses
import itertools
import math
from typing import Any

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.physics import (
    BALL_SETS,
    LIQUIDS,
    Ball,
    Cloth,
    Cue,
    PoolTable,
    density_range,
    floats_in,
    volume_range,
)
from rows import each_of

FIELDS = [
    (Ball, "mass"),
    (Ball, "radius"),
    (Cloth, "mu_slide"),
    (Cloth, "mu_roll"),
    (Cloth, "gravity"),
    (PoolTable, "length"),
    (PoolTable, "width"),
    (Cue, "mass"),
    (Cue, "tip_friction"),
]


@each_of("kind, field", FIELDS)
@each_of("value", [0.0, -1.0, math.nan, math.inf, "1", None, [1.0, 2.0], 10**400])
def test_no_field_is_anything_but_a_number_above_0(kind: Any, field: str, value: object) -> None:
    with pytest.raises(InputError) as refused:
        kind(**{field: value})
    assert str(refused.value).startswith(f"{field} must be ")
    assert "must be a number from 1e-50" in str(refused.value)


@pytest.mark.parametrize(("kind", "field"), FIELDS)
def test_no_field_is_too_large_or_too_small_to_calculate_with(kind: Any, field: str) -> None:
    for value in (1e-60, 1e60):
        with pytest.raises(InputError, match="from 1e-50 to 1e"):
            kind(**{field: value})


@pytest.mark.parametrize(("kind", "field"), FIELDS)
def test_fields_are_frozen_floats(kind: Any, field: str) -> None:
    thing = kind(**{field: np.float32(1.0)})
    assert type(getattr(thing, field)) is float
    with pytest.raises(dataclasses.FrozenInstanceError):
        setattr(thing, field, 2.0)
    assert thing == kind(**{field: 1})


def test_the_inertia_of_a_ball_by_its_points() -> None:
    rng = np.random.default_rng(7)
    points = rng.uniform(-1.0, 1.0, size=(400_000, 3))
    inside = (points**2).sum(axis=1) <= 1.0
    square = (points[inside, :2] ** 2).sum(axis=1)
    bound = 5.0 * float(square.std()) / math.sqrt(square.size)
    ball = Ball(mass=1.0, radius=1.0)
    assert ball.inertia == pytest.approx(float(square.mean()), abs=bound)
    share = float(inside.mean())
    error = 8.0 * 5.0 * math.sqrt(share * (1.0 - share) / inside.size)
    assert ball.volume == pytest.approx(8.0 * share, abs=error)
    assert ball.density == pytest.approx(1.0 / ball.volume)


# What the rules allow: the ranges hold what they should.


@pytest.mark.parametrize("name", sorted(BALL_SETS))
def test_every_ball_that_the_rules_allow_is_in_the_ranges(name: str) -> None:
    balls = BALL_SETS[name]
    volumes, densities = volume_range(balls), density_range(balls)
    found = [
        Ball(mass=mass, radius=(diameter + off * balls.tolerance) / 2.0)
        for diameter, off, mass in itertools.product(balls.diameters, (-1, 0, 1), balls.masses)
    ]
    assert min(ball.volume for ball in found) == pytest.approx(volumes[0])
    assert max(ball.volume for ball in found) == pytest.approx(volumes[1])
    assert all(densities[0] <= ball.density * (1 + 1e-12) for ball in found)
    assert all(ball.density <= densities[1] * (1 + 1e-12) for ball in found)


def test_what_floats_is_lighter_than_the_liquid() -> None:
    for balls in BALL_SETS.values():
        for liquid, density in LIQUIDS.items():
            assert floats_in(balls, liquid) == (density_range(balls)[1] < density)
    assert floats_in(BALL_SETS["pool"], "mercury")
    assert not floats_in(BALL_SETS["pool"], "water")


def test_only_liquids_that_are_listed() -> None:
    with pytest.raises(
        InputError,
        match=(
            "liquid must be 'water', 'sugar solution', 'caesium chloride solution' or "
            "'mercury'; you gave 'milk'"
        ),
    ):
        floats_in(BALL_SETS["pool"], "milk")
