"""Table speed: how far a ball rolls (section 1, P1.5)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, overload

from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import kind_of, plain, together
from evenbreak.physics.arrays import numbers, positive
from evenbreak.physics.objects import Ball, Cloth, PoolTable
from evenbreak.physics.units import GRAVITY

TABLE_SPEEDS: Mapping[str, tuple[float, float]] = MappingProxyType(
    {
        "very slow": (50.0, 70.0),
        "normal": (80.0, 100.0),
        "very fast": (120.0, 150.0),
        "fast billiard": (150.0, math.inf),
    }
)
"""Names for ranges of table speed; new worsted cloth has 100 to 130."""


def lag_distance(table: PoolTable, ball: Ball) -> float:
    """Return how far a ball's centre travels from end cushion to end cushion, in metres.

    Parameters
    ----------
    table, ball
        the length of the one and the diameter of the other, in metres, count.

    >>> from evenbreak.physics.units import INCH
    >>> round(lag_distance(PoolTable(), Ball()) / INCH, 9)
    97.75
    """
    return kind_of(table, "table", PoolTable).length - kind_of(ball, "ball", Ball).diameter


@overload
def table_speed(lag_time: float, *, distance: float = ..., gravity: float = ...) -> float: ...


@overload
def table_speed(
    lag_time: ArrayLike, *, distance: ArrayLike = ..., gravity: float = ...
) -> Floats: ...
def table_speed(lag_time: Any, *, distance: Any = None, gravity: float = GRAVITY) -> Any:
    """Return the table speed from the time that a ball takes to roll a distance and stop.

    Exercise 1.1 times it with a ball let go on a ramp of two cues.

    Parameters
    ----------
    lag_time
        seconds from one end cushion until the ball stops just at the other.
    distance
        metres that its centre travels; by default the length of a nine-foot table.
    gravity
        metres per second squared.

    Notes
    -----
    Source: P1.5, g t^2 / (2 d) = 1 / mu_roll; on a nine-foot table nearly 2 t^2.

    >>> round(table_speed(7.0), 1)
    96.7
    """
    metres = positive(_nine_feet() if distance is None else distance, "distance")
    time, pull = positive(lag_time, "lag_time"), positive(gravity, "gravity")
    together(lag_time=time, distance=metres, gravity=pull)
    return plain(0.5 * pull * time**2 / metres)


@overload
def lag_speed(lag_time: float, *, distance: float = ...) -> float: ...


@overload
def lag_speed(lag_time: ArrayLike, *, distance: ArrayLike = ...) -> Floats: ...
def lag_speed(lag_time: Any, *, distance: Any = None) -> Any:
    """Return the speed off the last cushion of a ball that rolls a distance and stops (P1.5).

    In m/s; it is twice the mean speed. The parameters are those of `table_speed`.

    Parameters
    ----------
    lag_time
        seconds from one end cushion until the ball stops just at the other.
    distance
        metres that its centre travels; by default the length of a nine-foot table.

    >>> from evenbreak.physics.units import INCH
    >>> round(lag_speed(7.0) / INCH, 1)
    27.9
    """
    metres = numbers(_nine_feet() if distance is None else distance, "distance", low=0.0)
    time = positive(lag_time, "lag_time")
    together(lag_time=time, distance=metres)
    return plain(2.0 * metres / time)


@overload
def roll_time(speed: float, cloth: Cloth) -> float: ...


@overload
def roll_time(speed: ArrayLike, cloth: Cloth) -> Floats: ...
def roll_time(speed: Any, cloth: Cloth) -> Any:
    """Return how long a ball rolls until it stops, in seconds, from its speed in m/s.

    Parameters
    ----------
    speed
        of natural roll at the start, in m/s.
    cloth
        on which the ball rolls: its rolling resistance, and gravity in m/s^2.

    >>> round(roll_time(1.0, Cloth(mu_roll=0.01, gravity=10.0)), 9)
    10.0
    """
    resistance = kind_of(cloth, "cloth", Cloth).roll_deceleration
    return plain(numbers(speed, "speed", low=0.0) / resistance)


@overload
def roll_distance(speed: float, cloth: Cloth) -> float: ...


@overload
def roll_distance(speed: ArrayLike, cloth: Cloth) -> Floats: ...
def roll_distance(speed: Any, cloth: Cloth) -> Any:
    """Return how far a ball rolls until it stops, in metres, from its speed in m/s.

    Parameters
    ----------
    speed
        of natural roll at the start, in m/s.
    cloth
        on which the ball rolls: its rolling resistance, and gravity in m/s^2.

    >>> round(roll_distance(1.0, Cloth(mu_roll=0.01, gravity=10.0)), 9)
    5.0
    """
    resistance = kind_of(cloth, "cloth", Cloth).roll_deceleration
    return plain(numbers(speed, "speed", low=0.0) ** 2 / (2.0 * resistance))


def _nine_feet() -> float:
    return lag_distance(PoolTable(), Ball())
