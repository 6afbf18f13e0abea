"""A whole shot: the tip, the slide, the hit, and both balls until they stop.

The cue ball goes straight, since a level cue gives it no spin about its direction of travel. It
slides and rolls until it touches the object ball and enters the hit with the spin that is left;
then both balls slide, the cue ball on a parabola, and roll until they stop. The path of a ball ends
at the first cushion or pocket: the model has no rebounds. If friction makes a ball hop, it stays on
the cloth in this model, and the energy of the hop counts as lost in the hit.

On the table (0, 0) is a corner, x runs along the table and y to the left of that.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import kind_of, kind_or_usual, number, one_of
from evenbreak.errors import InputError
from evenbreak.physics.collision import Collision, collide
from evenbreak.physics.friction import BALL_FRICTION, SlipFriction, miscue_offset, one_friction
from evenbreak.physics.leg import Leg, Phase, State, leg_until, on_table, place_of, time_to
from evenbreak.physics.objects import Ball, Cloth, PoolTable
from evenbreak.physics.rolling import Energy
from evenbreak.physics.slide import Slide
from evenbreak.physics.strike import Strike
from evenbreak.physics.throw import FRICTION_LAWS

_ROUNDING = 1e-12
"""The rounding error allowed in the distance between touching balls, in diameters."""


@own_arrays
@dataclass(frozen=True, eq=False)
class Shot:
    """Shot from the tip until both balls stop or reach a cushion or a pocket.

    Parameters
    ----------
    cloth, table
        on which it is played.
    direction
        of the shot on the table, in radians from x, counterclockwise.
    cut
        the cut angle in radians, above 0 if the object ball is cut to the right.
    object_position
        where the object ball is at first, in meters; shape (2,).
    mu, friction
        the friction between the balls, and the law of friction.
    approach
        the cue ball's path until the hit, or until it ends without one.
    collision
        the hit; None if there is none.
    cue_leg, object_leg
        the paths of the balls after the hit; None if there is none.
    """

    strike: Strike
    cloth: Cloth
    table: PoolTable
    direction: float
    cut: float
    object_position: Floats
    mu: float | SlipFriction
    friction: str
    approach: Leg
    collision: Collision | None
    cue_leg: Leg | None
    object_leg: Leg | None

    @property
    def reached(self) -> bool:
        """Whether the cue ball hits the object ball."""
        return self.collision is not None

    @property
    def at_hit(self) -> State | None:
        """The cue ball just before the hit; None without a hit."""
        return self.approach.state(self.approach.end) if self.reached else None

    @property
    def ghost_position(self) -> Floats:
        """Where the cue ball's center is at the hit, or would be, in meters; shape (2,)."""
        return self.object_position - self.strike.ball.diameter * self.line_of_centers

    @property
    def line_of_centers(self) -> Floats:
        """The unit vector from the cue ball to the object ball at the hit; shape (2,)."""
        return _unit(self.direction - self.cut)

    @property
    def tangent(self) -> Floats:
        """The unit vector along which the cue ball would leave without friction; shape (2,)."""
        return _unit(self.direction - self.cut + math.copysign(0.5 * math.pi, self.cut))

    @property
    def throw(self) -> float | None:
        """The angle between the object ball's path and the line of centers, in radians.

        Above 0 if the ball is thrown forward, toward the direction of the shot. None without
        a hit.
        """
        return None if self.collision is None else float(self.collision.throw)

    @property
    def object_direction(self) -> float | None:
        """The direction in which the object ball leaves, in radians from x; None without a hit."""
        turn = math.copysign(1.0, self.cut)
        return None if self.throw is None else self.direction - self.cut + turn * self.throw

    @property
    def deflection(self) -> float | None:
        """The angle between the shot and the cue ball's path once the ball rolls, in radians.

        Above 0 on the side away from the object ball. None if there is no hit, or if the cue
        ball stands still after it.
        """
        if self.cue_leg is None:
            return None
        x, y = _turned(self.cue_leg.slide.roll_velocity, -self.direction)
        if math.hypot(x, y) <= 1e-9 * self.strike.speed:
            return None
        return math.copysign(1.0, self.cut) * math.atan2(y, x)

    @property
    def legs(self) -> tuple[Leg, ...]:
        """The paths: the cue ball's before the hit, the cue ball's after it, the object ball's."""
        return tuple(
            leg for leg in (self.approach, self.cue_leg, self.object_leg) if leg is not None
        )

    @property
    def phases(self) -> tuple[Phase, ...]:
        """The phases of all paths, path by path."""
        return tuple(phase for leg in self.legs for phase in leg.phases)

    @property
    def end(self) -> float:
        """When the last path ends, in seconds."""
        return max(leg.end for leg in self.legs)

    def energy(self, time: float) -> Energy:
        """Return the kinetic energy of both balls at a time, in joules; at the hit, after it."""
        begun = [leg for leg in self.legs if leg.begin <= time]
        if len(begun) > 1:
            begun = begun[1:]  # The cue ball's second leg takes over from its first.
        energies = [leg.energy(time) for leg in begun]
        return Energy(sum(e.translational for e in energies), sum(e.rotational for e in energies))


def shot(
    strike: Strike,
    cut: float,
    distance: float,
    *,
    cloth: Cloth | None = None,
    table: PoolTable | None = None,
    cue_ball: Sequence[float] | None = None,
    direction: float = 0.0,
    mu: float | SlipFriction = BALL_FRICTION,
    friction: str = "limited",
) -> Shot:
    """Trace a shot at an object ball.

    Parameters
    ----------
    strike
        one strike, not a miscue; the object ball is equal to its ball.
    cut
        the cut angle in radians, above 0 to the right and below 0 to the left, less than a
        right angle either way.
    distance
        between the centers of the two balls at the start, in meters.
    cloth, table
        default: a cloth with speed 100 and a nine-foot table.
    cue_ball
        the position of its center, in meters; default: the middle of the head string.
    direction
        of the shot, in radians from x, which runs along the table.
    mu, friction
        as for `collide`.

    Raises
    ------
    InputError
        if a number is out of range, the strike is a miscue, or a ball is not on the table.

    Notes
    -----
    Source: P3.10, P2.1 to P2.3 and P4.2, one after another.

    >>> from evenbreak.physics.strike import strike
    >>> from evenbreak.physics.units import INCH
    >>> found = shot(strike(0.7, 0.1), math.radians(30.0), 20.0 * INCH)
    >>> [(phase.ball, phase.motion) for phase in found.phases[:3]]
    [('cue ball', 'slides'), ('cue ball', 'rolls'), ('cue ball', 'slides')]
    >>> [leg.ending for leg in found.legs], round(math.degrees(found.deflection), 1)
    (['hit', 'rest', 'rest'], 35.7)
    """
    cloth, table = kind_or_usual(cloth, "cloth", Cloth), kind_or_usual(table, "table", PoolTable)
    sound_strike(strike)
    # Check these even if no ball is hit.
    one_of(friction, "friction", FRICTION_LAWS)
    mu = one_friction(mu)
    cut, direction = number(cut, "cut"), number(direction, "direction")
    if abs(cut) >= 0.5 * math.pi:
        raise InputError("cut must be an angle between -pi/2 and pi/2; you gave {cut:.6g}", cut=cut)
    ball = strike.ball
    travel = travel_for(cut, number(distance, "distance"), ball.diameter)
    if cue_ball is None:
        cue_ball = (0.25 * table.length, 0.5 * table.width)
    place = place_of(cue_ball, "cue_ball")
    struck = place + travel * _unit(direction)
    standing = struck + ball.diameter * _unit(direction - cut)
    on_table(place, "cue_ball", table, ball.radius)
    on_table(standing, "the object ball", table, ball.radius)
    slide = Slide(
        ball, cloth, place, _turned(strike.velocity, direction), _turned(strike.spin, direction)
    )
    hit = time_to(slide, _unit(direction), float(struck @ _unit(direction)))
    approach = leg_until("cue ball", slide, 0.0, table, hit=hit)
    collision = None
    cue_leg = object_leg = None
    if approach.ending == "hit":
        collision = _collision(approach, cut, mu, friction)
        after = {
            "cue ball": (struck, collision.cue_velocity, collision.cue_spin),
            "object ball": (standing, collision.object_velocity, collision.object_spin),
        }
        cue_leg, object_leg = (
            leg_until(name, _set_off(ball, cloth, *state, direction), approach.end, table)
            for name, state in after.items()
        )
    setting = (strike, cloth, table, direction, cut, standing, mu, friction)
    return Shot(*setting, approach, collision, cue_leg, object_leg)


def sound_strike(strike: Strike) -> None:
    """Raise an error if there is more than one strike, or it is a miscue."""
    if np.ndim(kind_of(strike, "strike", Strike).speed):
        raise InputError(
            "strike must be a single strike; you gave {speed}", speed=np.size(strike.speed)
        )
    if strike.miscue:
        raise InputError(
            "the total offset is {off_center:.4g} of the radius, a miscue: this tip slips "
            "beyond {tip_friction:.4g}. Give a smaller offset, or a tip with more friction.",
            off_center=strike.off_center,
            tip_friction=miscue_offset(strike.cue.tip_friction),
        )


def travel_for(cut: float, distance: float, diameter: float) -> float:
    """Return how far the cue ball travels to the hit, in the unit of the two lengths.

    The cut angle is in radians, the distance between centers.

    >>> travel_for(0.0, 10.0, 2.0)
    8.0
    """
    if distance < diameter * (1.0 - _ROUNDING):
        raise InputError(
            "distance between the centers is {distance:.4g} m. Give {diameter:.4g} m (where the "
            "balls touch) or more.",
            distance=distance,
            diameter=diameter,
        )
    distance = max(distance, diameter)
    sideways = diameter * math.sin(cut)
    return math.sqrt((distance - sideways) * (distance + sideways)) - diameter * math.cos(cut)


def spin_ratios(state: State, radius: float) -> tuple[float, float]:
    """Return J_y and J_z of a ball that moves in a straight line.

    >>> ball = State(0.0, np.zeros(2), np.array([2.0, 0.0]), np.array([0.0, 40.0, -8.0]))
    >>> spin_ratios(ball, 0.025)
    (0.5, -0.1)
    """
    around = (state.velocity[0] * state.spin[1] - state.velocity[1] * state.spin[0]) / state.speed
    return float(radius * around / state.speed), float(radius * state.spin[2] / state.speed)


def _collision(approach: Leg, cut: float, mu: float | SlipFriction, friction: str) -> Collision:
    state = approach.state(approach.end)
    ball = approach.slide.ball
    topspin, side = spin_ratios(state, ball.radius)
    return collide(cut, topspin, side, speed=state.speed, mu=mu, friction=friction, ball=ball)


def _set_off(
    ball: Ball,
    cloth: Cloth,
    position: Floats,
    velocity: Floats,
    spin: Floats,
    direction: float,
) -> Slide:
    """Return a ball that leaves the hit; its state is given in the frame of the shot."""
    velocity = _turned(velocity[:2], direction)
    return Slide(ball, cloth, position, velocity, _turned(spin, direction))


def _turned(vector: Floats, angle: float) -> Floats:
    """Return a vector with its horizontal part turned counterclockwise by an angle in radians."""
    sin, cos = math.sin(angle), math.cos(angle)
    turned = np.array(vector, dtype=float)
    turned[0], turned[1] = vector[0] * cos - vector[1] * sin, vector[0] * sin + vector[1] * cos
    return turned


def _unit(angle: float) -> Floats:
    return np.array([math.cos(angle), math.sin(angle)])
