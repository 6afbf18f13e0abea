"""A cue ball struck in the centre (section 3, P3.1 to P3.3).

The speed and energy that the cue gives to the ball, and the best cue to break with. The cue is
level and moves freely while the tip touches the ball, and the hit is elastic.
"""

from __future__ import annotations

from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats
from evenbreak.checks import plain, together
from evenbreak.physics.units import numbers, positive


class CentreHit(NamedTuple):
    """The speeds after a hit in the centre, over the speed of the stick before it.

    Parameters
    ----------
    ball, stick
        of the ball and the stick; the stick's is below 0 if it bounces back.
    """

    ball: Any
    stick: Any


def stroke_speed(force: Any, length: Any, mass: Any) -> Any:
    """Return the speed of a stick pushed by a constant force along a stroke, in m/s (P3.1).

    Parameters
    ----------
    force, length, mass
        newtons, metres and kilograms, or any consistent units.

    >>> round(stroke_speed(10.0, 12.0, 18.0), 4)
    3.6515
    """
    force, length = numbers(force, "force", low=0.0), numbers(length, "length", low=0.0)
    mass = positive(mass, "mass")
    together(force=force, length=length, mass=mass)
    return plain(np.sqrt(2.0 * force * length / mass))


def centre_hit(stick_ratio: Any) -> CentreHit:
    """Return the speeds after a hit in the centre (P3.2).

    Parameters
    ----------
    stick_ratio
        mass of the stick over mass of the ball, such as 3 for 18 and 6 ounces.

    >>> centre_hit(3.0)
    CentreHit(ball=1.5, stick=0.5)
    """
    ratio = numbers(stick_ratio, "stick_ratio", low=0.0)
    return CentreHit(plain(2.0 * ratio / (1.0 + ratio)), plain((ratio - 1.0) / (ratio + 1.0)))


@overload
def energy_share(stick_ratio: float) -> float: ...


@overload
def energy_share(stick_ratio: ArrayLike) -> Floats: ...
def energy_share(stick_ratio: Any) -> Any:
    """Return the share of the stick's energy that a hit in the centre gives the ball (P3.3).

    Parameters
    ----------
    stick_ratio
        mass of the stick over mass of the ball, such as 3 for 18 and 6 ounces.

    >>> energy_share(3.0), energy_share(1.0)
    (0.75, 1.0)
    """
    ratio = numbers(stick_ratio, "stick_ratio", low=0.0)
    return plain(4.0 * ratio / (1.0 + ratio) ** 2)


def stroke_energy(stick_energy: Any, stick_ratio: Any, forearm_ratio: Any) -> Any:
    """Return the energy of stick and forearm together, from that of the stick (P3.3).

    The forearm is a thin uniform rod turning about the elbow; the stick moves with its end.

    Parameters
    ----------
    stick_energy
        in any unit.
    stick_ratio, forearm_ratio
        the masses of stick and forearm over that of the ball.

    Notes
    -----
    Source: P3.3, T = T_0 (1 + M_f / (3 M_s)); the text drops the factor T_0.

    >>> stroke_energy(3.0, 3.0, 6.0)
    5.0
    """
    stick = positive(stick_ratio, "stick_ratio")
    forearm = numbers(forearm_ratio, "forearm_ratio", low=0.0)
    energy = numbers(stick_energy, "stick_energy", low=0.0)
    together(stick_energy=energy, stick_ratio=stick, forearm_ratio=forearm)
    return plain(energy * (1.0 + forearm / (3.0 * stick)))


@overload
def break_energy_share(stick_ratio: float, forearm_ratio: float) -> float: ...


@overload
def break_energy_share(stick_ratio: ArrayLike, forearm_ratio: ArrayLike) -> Floats: ...
def break_energy_share(stick_ratio: Any, forearm_ratio: Any) -> Any:
    """Return the share of the energy of stick and forearm that goes into the ball (P3.3).

    Parameters
    ----------
    stick_ratio
        mass of the stick over mass of the ball, such as 3 for 18 and 6 ounces.
    forearm_ratio
        mass of the forearm over that of the ball, such as 6 for 36 ounces.

    >>> break_energy_share(3.0, 6.0)
    0.45
    """
    stick = positive(stick_ratio, "stick_ratio")
    forearm = numbers(forearm_ratio, "forearm_ratio", low=0.0)
    together(stick_ratio=stick, forearm_ratio=forearm)
    return plain(4.0 * stick**2 / ((1.0 + stick) ** 2 * (stick + forearm / 3.0)))


@overload
def best_stick_ratio(forearm_ratio: float) -> float: ...


@overload
def best_stick_ratio(forearm_ratio: ArrayLike) -> Floats: ...
def best_stick_ratio(forearm_ratio: Any) -> Any:
    """Return the mass of the best stick to break with, over that of the ball (P3.3).

    Parameters
    ----------
    forearm_ratio
        mass of the forearm over that of the ball, such as 6 for 36 ounces; of the whole arm
        for a stroke from the shoulder.

    >>> round(6.0 * best_stick_ratio(36.0 / 6.0), 1), round(6.0 * best_stick_ratio(25.0), 1)
    (15.4, 27.7)
    """
    forearm = numbers(forearm_ratio, "forearm_ratio", low=0.0)
    return plain(0.5 + np.sqrt(0.25 + 2.0 / 3.0 * forearm))
