"""A hit taken in small steps of its impulse, friction against the slip of each moment.

This is Coulomb's law as a differential equation: it knows of no limit by the slip and of no
direction that stays. It vouches for `collide(friction="limited")`, and says how far off that
is where topspin or draw turns the slip during the hit.
"""

from typing import Any

import numpy as np
import pytest

from evenbreak.physics import BALL_FRICTION, collide

X = np.array([1.0, 0.0, 0.0])
MOST = np.array([0.0, 1.0 / 7.0, 1.0 / 6.0])


def in_steps(cut: Any, topspin: Any, side: Any, mu: float, steps: int = 300) -> tuple[Any, Any]:
    """Return the object ball's velocity to the left and up, over V_0; M and R are 1."""
    cut, topspin, side = np.broadcast_arrays(*map(np.atleast_1d, (cut, topspin, side)))
    sin, cos = np.sin(cut), np.cos(cut)
    cue = np.stack([cos, sin, 0.0 * cos], axis=-1)
    spin = np.stack([-topspin * sin, topspin * cos, side], axis=-1)
    thing, its_spin = np.zeros_like(cue), np.zeros_like(cue)
    pushed = np.zeros_like(cut)
    for _ in range(steps):
        push = cos / steps
        slip = (cue + np.cross(spin, X)) - (thing + np.cross(its_spin, -X))
        slip[..., 0] = 0.0
        length = np.linalg.norm(slip, axis=-1)
        pull = mu * push / np.where(length > 0.0, length, 1.0)
        # A step takes at most what is left of the slip, by either direction of it.
        force = slip * np.minimum(pull[..., None], MOST)
        pushed += force[..., 2]
        thing = thing + push[..., None] * X + force
        cue = cue - push[..., None] * X - force
        turn = np.cross(X, force) / 0.4  # the same for both balls
        spin, its_spin = spin - turn, its_spin - turn
        thing[..., 2], cue[..., 2] = np.maximum(thing[..., 2], 0.0), np.maximum(cue[..., 2], 0.0)
    return thing[..., 1], pushed


@pytest.mark.parametrize("mu", [0.02, BALL_FRICTION, 0.3])
def test_level_friction_is_exact(mu: float) -> None:
    cut, side = np.linspace(0.0, 1.55, 63)[:, None], np.linspace(-1.25, 1.25, 11)
    left, up = in_steps(cut, 0.0, side, mu)
    hit = collide(cut, 0.0, side, mu=mu)
    assert hit.sideways == pytest.approx(left, abs=1e-12)
    assert np.abs(up).max() == 0.0 == np.abs(hit.upward).max()
    # The grid holds both kinds of shots.
    stops = np.abs(np.sin(cut) + side) < 7.0 * mu * np.cos(cut)
    assert stops.any()
    assert not stops.all()


@pytest.mark.parametrize("mu", [0.02, BALL_FRICTION, 0.3])
def test_full_hits_without_english_are_exact(mu: float) -> None:
    topspin = np.linspace(-2.5, 2.5, 101)
    left, up = in_steps(0.0, topspin, 0.0, mu)
    hit = collide(0.0, topspin, 0.0, mu=mu)
    assert hit.upward == pytest.approx(up, abs=1e-12)
    assert np.abs(left).max() == 0.0 == np.abs(hit.sideways).max()


def test_how_far_off_the_direction_that_stays_is() -> None:
    cut = np.radians(np.arange(0.0, 90.0, 6.0))[:, None, None]
    # Draw throws as topspin does, and lifts as much.
    topspin, side = np.linspace(0.0, 1.0, 11)[:, None], np.linspace(-1.0, 1.0, 41)
    left, up = in_steps(cut, topspin, side, BALL_FRICTION)
    hit = collide(cut, topspin, side)
    off = np.degrees(np.abs(hit.throw - np.arctan2(left, np.cos(cut))))
    assert 0.14 < off.max() < 0.15
    assert np.unravel_index(off.argmax(), off.shape) == (2, 3, 11)  # 12 degrees, 0.3, -0.45
    assert off[:, 10, 20].max() < 0.035  # natural roll without english
    assert 0.001 < np.abs(hit.upward - up).max() < 0.0035
