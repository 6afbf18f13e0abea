"""A shot at a pocket: at the middle of its mouth, or to one side if a cushion is in the way.

A ball at a cushion cannot be sent at the middle of the mouth of a corner pocket, since the cue ball
would have to be inside the cushion; along the cushion it drops all the same.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.checks import kind_of
from evenbreak.errors import InputError
from evenbreak.physics.aimed import AimedShot, aimed_shot
from evenbreak.physics.ball_friction import BALL_FRICTION, SlipFriction
from evenbreak.physics.leg import place_of
from evenbreak.physics.objects import Cloth, PoolTable
from evenbreak.physics.pockets import Pocket
from evenbreak.physics.strike import Strike

_STEPS = 8
"""The number of points of the mouth to try on each side of its middle."""


def pocketed_shot(
    strike: Strike,
    cue_ball: Sequence[float],
    object_ball: Sequence[float],
    pocket: Pocket,
    *,
    cloth: Cloth | None = None,
    table: PoolTable | None = None,
    mu: float | SlipFriction = BALL_FRICTION,
    friction: str = "limited",
) -> AimedShot:
    """Trace the shot that sends an object ball into a pocket, allowing for throw.

    Parameters
    ----------
    strike, cue_ball, object_ball, cloth, table, mu, friction
        as for `aimed_shot`.
    pocket
        one of the pockets of the table.

    Returns
    -------
    the shot at the middle of the mouth; if a cushion is in the way of one of the balls, the shot
    at the nearest point of the mouth that is free; if there is none, the shot at the middle

    Raises
    ------
    InputError
        as for `aimed_shot`.

    >>> from evenbreak.physics.pockets import pockets
    >>> from evenbreak.physics.strike import strike
    >>> corner, radius = pockets(PoolTable())[2], 0.028575
    >>> found = pocketed_shot(strike(1.5), (0.5, radius), (1.3, radius), corner)
    >>> found.shot.object_leg.pocket, bool(found.target[1] < corner.y)
    ('foot-right', True)
    """
    aim_at = partial(
        aimed_shot,
        strike,
        cue_ball,
        object_ball,
        cloth=cloth,
        table=table,
        mu=mu,
        friction=friction,
    )
    kind_of(pocket, "pocket", Pocket)
    straight = aim_at([pocket.x, pocket.y])
    if not _blocked(straight, pocket):
        return straight
    for target in _beside(pocket, place_of(object_ball, "object_ball"), strike.ball.radius):
        try:
            found = aim_at(target.tolist())
        except InputError:  # this side of the mouth cannot be reached
            continue
        if not _blocked(found, pocket):
            return found
    return straight


def _blocked(found: AimedShot, pocket: Pocket) -> bool:
    """Return whether a cushion or another pocket is in the way of one of the balls."""
    leg = found.shot.object_leg
    if leg is None:
        return found.shot.approach.ending != "rest"
    return leg.ending != "rest" and leg.pocket != pocket.name


def _beside(pocket: Pocket, standing: Floats, radius: float) -> Iterator[Floats]:
    """Yield points of a mouth through which a ball may fit, starting near the middle."""
    middle = np.array([pocket.x, pocket.y])
    into = np.array([pocket.into_x, pocket.into_y])
    across = np.array([-into[1], into[0]])
    room = 0.5 * pocket.mouth - radius
    steps = {sign * room * step / _STEPS for step in range(1, _STEPS + 1) for sign in (-1.0, 1.0)}
    # Also straight ahead along either cushion, the only way for a ball at a cushion.
    for axis in (np.array([1.0, 0.0]), np.array([0.0, 1.0])):
        if axis @ into:
            ahead = ((middle - standing) @ into) / (axis @ into)
            steps.add(float((standing + ahead * axis - middle) @ across))
    for step in sorted(steps, key=abs):
        if abs(step) <= room:
            yield middle + step * across
