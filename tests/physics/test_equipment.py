"""What the rules allow: the ranges hold what they should."""

import itertools

import pytest

from evenbreak.errors import InputError
from evenbreak.physics import BALL_SETS, LIQUIDS, Ball, density_range, floats_in, volume_range


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
    with pytest.raises(InputError, match="liquid is 'milk'; give 'water', "):
        floats_in(BALL_SETS["pool"], "milk")
