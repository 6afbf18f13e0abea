"""Ball, cloth, table and cue refuse what cannot be."""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest

from evenbreak.errors import InputError
from evenbreak.physics import Ball, Cloth, Cue, PoolTable
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
    assert str(refused.value).startswith(f"{field} is ")
    assert "give a number from 1e-50" in str(refused.value)


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
