"""A shot that allows for throw: aimed so that the object ball goes to a point or a pocket (P4.6).

The throw depends on the spin with which the cue ball arrives, the spin depends on how far the cue
ball travels, and the distance depends on where it is aimed. So the cut is found for the shot as a
whole.

At a pocket the aim is the middle of its mouth, or one side of it if a cushion is in the way. A ball
on a cushion cannot be sent to the middle of the mouth of a corner pocket, since the cue ball would
have to be inside the cushion; but if it rolls along the cushion, it still drops.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import kind_of, kind_or_usual
from evenbreak.errors import InputError
from evenbreak.physics.friction import BALL_FRICTION, SlipFriction, one_friction
from evenbreak.physics.leg import Pocket, State, on_table, place_of, time_to
from evenbreak.physics.objects import Cloth, PoolTable
from evenbreak.physics.shot import Shot, shot, sound_strike, spin_ratios, travel_for
from evenbreak.physics.slide import Slide
from evenbreak.physics.strike import Strike
from evenbreak.physics.throw import throw_angle

_THINNEST = 0.5 * math.pi - 1e-9
"""Just under a right angle, at which nothing is hit."""


@own_arrays
@dataclass(frozen=True, eq=False)
class AimedShot:
    """Shot that sends the object ball to a target, with and without allowing for throw.

    Parameters
    ----------
    shot
        the shot that allows for throw.
    unaided
        the same strike aimed with the line of centers through the target; throw makes it miss.
    target
        in meters; shape (2,).
    """

    shot: Shot
    unaided: Shot
    target: Floats

    @property
    def distance(self) -> float:
        """The distance from the object ball to the target, in meters."""
        return float(np.linalg.norm(self.target - self.shot.object_position))

    @property
    def turn(self) -> float:
        """The angle between the line of centers and the target, in radians.

        Above 0 toward the thinner cut.
        """
        thinner = math.copysign(1.0, self.unaided.cut)
        return thinner * _between(self.shot.line_of_centers, self.unaided.line_of_centers)

    @property
    def offset(self) -> float:
        """How far beside the target the line of centers points, in meters, signed as `turn`."""
        return self.distance * math.tan(self.turn)

    @property
    def miss(self) -> float:
        """Miss distance of the unaided shot, in meters.

        Above 0 on the thick side, where throw usually takes it; 0 without a hit.
        """
        return self.distance * math.tan(self.unaided.throw or 0.0)


def aimed_shot(
    strike: Strike,
    cue_ball: Sequence[float],
    object_ball: Sequence[float],
    target: Sequence[float],
    *,
    cloth: Cloth | None = None,
    table: PoolTable | None = None,
    mu: float | SlipFriction = BALL_FRICTION,
    friction: str = "limited",
) -> AimedShot:
    """Trace the shot that sends an object ball to a target, allowing for throw.

    Parameters
    ----------
    strike, cloth, table, mu, friction
        as for `shot`.
    cue_ball, object_ball, target
        positions on the table: x and y in meters.

    Raises
    ------
    InputError
        if no shot sends the ball there: it would take a cut of a right angle or more.

    Notes
    -----
    Source: P4.6, where the spin is given.

    >>> from evenbreak.physics.leg import pockets
    >>> from evenbreak.physics.strike import strike
    >>> corner = pockets(PoolTable())[3]
    >>> found = aimed_shot(strike(1.5, -0.2), (0.7, 0.4), (1.2, 0.4), (corner.x, corner.y))
    >>> found.shot.object_leg.ending, found.unaided.object_leg.ending
    ('pocket', 'cushion')
    >>> round(math.degrees(found.turn), 2), round(math.degrees(found.shot.throw), 2)
    (3.16, 3.16)
    """
    cloth, table = kind_or_usual(cloth, "cloth", Cloth), kind_or_usual(table, "table", PoolTable)
    sound_strike(strike)
    mu = one_friction(mu)
    places = {"cue_ball": cue_ball, "object_ball": object_ball, "target": target}
    start, standing, goal = (place_of(value, name) for name, value in places.items())
    diameter = strike.ball.diameter
    distance = float(np.linalg.norm(standing - start))
    if np.linalg.norm(goal - standing) <= strike.ball.radius:
        raise InputError("target is inside the object ball. Give a point farther away.")
    for name, place in (("cue_ball", start), ("object_ball", standing)):
        on_table(place, name, table, strike.ball.radius)
    travel_for(0.0, distance, diameter)  # refuses balls that overlap
    distance = max(distance, diameter)  # rounding may bring touching balls closer
    # The angle of the target to the right of the line through the balls.
    wanted = -_between(standing - start, goal - standing)

    def trace(cut: float) -> Shot:
        return shot(
            strike,
            cut,
            distance,
            cloth=cloth,
            table=table,
            cue_ball=start.tolist(),
            direction=_heading(standing - start) + math.asin(diameter * math.sin(cut) / distance),
            mu=mu,
            friction=friction,
        )

    def throw(cut: float) -> float:
        """Return the throw to the left, as the angles are to the right."""
        now = _state_after(strike, cloth, travel_for(cut, distance, diameter))
        if now is None:
            return 0.0
        spin = spin_ratios(now, strike.ball.radius)
        thrown: float = throw_angle(cut, *spin, mu=mu, friction=friction, speed=now.speed)
        return -thrown if cut < 0.0 else thrown

    def short(cut: float, thrown: float) -> float:
        return wanted - (cut - thrown - math.asin(diameter * math.sin(cut) / distance))

    plain = _solve(lambda cut: short(cut, 0.0))
    return AimedShot(trace(_solve(lambda cut: short(cut, throw(cut)))), trace(plain), goal)


def _state_after(strike: Strike, cloth: Cloth, travel: float) -> State | None:
    """Return the cue ball after it has traveled this far, or None if it stops before that."""
    slide = Slide(strike.ball, cloth, np.zeros(2), strike.velocity, strike.spin)
    time = time_to(slide, np.array([1.0, 0.0]), travel)
    if time >= (1.0 - 1e-9) * float(slide.stop_time):
        return None
    return State(time, slide.at(time), slide.velocity_at(time), slide.spin_at(time))


def _solve(short: Callable[[float], float]) -> float:
    """Return the cut angle at which `short` is 0, in radians."""
    low, high = -_THINNEST, _THINNEST
    if short(low) < 0.0 or short(high) > 0.0:
        raise InputError(
            "target can't be reached: the cut would be a right angle or more. Give a "
            "target farther ahead of the cue ball, or move the balls."
        )
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if short(middle) > 0.0 else (low, middle)
    return 0.5 * (low + high)


def _heading(vector: Floats) -> float:
    return math.atan2(vector[1], vector[0])


def _between(first: Floats, second: Floats) -> float:
    """Return the angle from one vector to another, counterclockwise, in radians."""
    across = float(first[0] * second[1] - first[1] * second[0])
    return math.atan2(across, float(first @ second))


_STEPS = 8
"""The number of points in the mouth to try on each side of its middle."""


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

    Returns
    -------
    the shot at the middle of the mouth; if a cushion is in the way of one of the balls, the shot
    at the nearest point of the mouth that is free; if there is none, the shot at the middle

    Raises
    ------
    InputError
        as for `aimed_shot`.

    >>> from evenbreak.physics.leg import pockets
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
            aimed = aim_at(target.tolist())
        except InputError:  # this side of the mouth cannot be reached
            continue
        if not _blocked(aimed, pocket):
            return aimed
    return straight


def _blocked(aimed: AimedShot, pocket: Pocket) -> bool:
    """Return whether a cushion or another pocket is in the way of one of the balls."""
    leg = aimed.shot.object_leg
    if leg is None:
        return aimed.shot.approach.ending != "rest"
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
