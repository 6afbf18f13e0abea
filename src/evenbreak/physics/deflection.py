"""Where the cue ball goes once it rolls after a hit (section 4, P4.13 to P4.25).

Without friction between the balls the cue ball leaves at a right angle to the object ball, and
its topspin or draw then bends its path into the deflection angle

    theta = atan2(sin(cut) cos(cut), sin(cut)^2 + 2/5 J_y)

to the shot's direction, from 0 to pi. Equivalently tan(cut + theta) = (1 + k)/k tan(cut) with
k = 2/5 J_y: 7/2 tan(cut) in natural roll.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np

from evenbreak.physics.arrays import Floats, numbers, plain, positive
from evenbreak.physics.throw import shot_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class EnergyShares(NamedTuple):
    """The two balls' energies, over the energy M V_0^2 / 2 of the cue ball's motion before."""

    object_ball: Any
    cue_ball: Any


@overload
def deflection(cut: float, topspin: float = ...) -> float: ...


@overload
def deflection(cut: ArrayLike, topspin: ArrayLike = ...) -> Floats: ...
def deflection(cut: Any, topspin: Any = 1.0) -> Any:
    """Return the cue ball's deflection angle once it rolls, in radians, 0 to pi.

    Parameters
    ----------
    cut
        cut angle in radians, 0 to pi/2. At 0 it is the limit of small angles: pi/2 for stun,
        where the cue ball in truth stands still.
    topspin
        J_y just before the hit: 1 in natural roll, 0 for stun, -1 in reverse natural roll.

    Notes
    -----
    Source: P4.13, P4.21 and P4.23, without friction between the balls; the same by tangents is
    P4.14. Near the largest deflection it hardly changes with the cut (P4.17).

    >>> [round(math.degrees(deflection(math.radians(30.0), spin)), 2) for spin in (1, 0, -1)]
    [33.67, 60.0, 109.11]
    """
    cut, topspin, _ = shot_of(cut, topspin, 0.0)
    # A full hit is the limit of small angles, by the smallest of them.
    sin = np.maximum(np.sin(cut), 1e-300)
    return plain(np.arctan2(sin * np.cos(cut), sin * sin + 0.4 * topspin))


@overload
def deflection_slope(cut: float, topspin: float = ...) -> float: ...


@overload
def deflection_slope(cut: ArrayLike, topspin: ArrayLike = ...) -> Floats: ...
def deflection_slope(cut: Any, topspin: Any = 1.0) -> Any:
    """Return d theta / d cut: how sensitive the cue ball's path is to the cut (P4.15).

    In natural roll it falls from 5/2, the rule for small cut angles (P4.18), to -5/7; for stun it
    is -1 at every cut.

    >>> round(deflection_slope(0.0), 9), round(deflection_slope(math.pi / 2.0), 4)
    (2.5, -0.7143)
    """
    cut, topspin, _ = shot_of(cut, topspin, 0.0)
    k = 0.4 * topspin
    sin2 = np.sin(cut) ** 2
    below = k * k * (1.0 - sin2) + (1.0 + k) ** 2 * sin2
    # Nothing is left below only for a full hit with stun, where the ratio is 0 at every cut.
    return plain(k * (1.0 + k) / np.maximum(below, 1e-300) - 1.0)


@overload
def largest_deflection_cut(topspin: float = ...) -> float: ...


@overload
def largest_deflection_cut(topspin: ArrayLike = ...) -> Floats: ...
def largest_deflection_cut(topspin: Any = 1.0) -> Any:
    """Return the cut angle of the largest deflection with topspin, in radians (P4.15, P4.16).

    The largest deflection itself is pi/2 less twice this angle.

    Parameters
    ----------
    topspin
        J_y, above 0.

    >>> cut = largest_deflection_cut()
    >>> round(math.degrees(cut), 3), round(math.degrees(deflection(cut)), 3)
    (28.126, 33.749)
    """
    spin = positive(topspin, "topspin")
    return plain(np.arcsin(np.sqrt(2.0 * spin / (5.0 + 4.0 * spin))))


@overload
def unit_slope_cut(topspin: float = ...) -> float: ...


@overload
def unit_slope_cut(topspin: ArrayLike = ...) -> Floats: ...
def unit_slope_cut(topspin: Any = 1.0) -> Any:
    """Return the cut angle at which the cue ball's path is as sensitive as the object ball's.

    Up to it d theta / d cut is more than 1 (P4.19).

    Parameters
    ----------
    topspin
        J_y, above 0 up to 5/2, from where on the slope is below 1 at every cut.

    >>> round(math.degrees(unit_slope_cut()), 3)
    14.963
    """
    k = 0.4 * numbers(topspin, "topspin", low=0.0, high=2.5, open_low=True)
    return plain(np.arcsin(np.sqrt(k * (1.0 - k) / (2.0 + 4.0 * k))))


@overload
def right_angle_cut(topspin: float = ...) -> float: ...


@overload
def right_angle_cut(topspin: ArrayLike = ...) -> Floats: ...
def right_angle_cut(topspin: Any = -1.0) -> Any:
    """Return the cut angle at which draw sends the cue ball off at a right angle (P4.25).

    Parameters
    ----------
    topspin
        J_y, from -5/2 to 0.

    >>> round(math.degrees(right_angle_cut()), 3)
    39.232
    """
    return plain(np.arcsin(np.sqrt(-0.4 * numbers(topspin, "topspin", low=-2.5, high=0.0))))


@overload
def split_cut(topspin: float = ...) -> float: ...


@overload
def split_cut(topspin: ArrayLike = ...) -> Floats: ...
def split_cut(topspin: Any = 1.0) -> Any:
    """Return the cut angle that splits all kinetic energy evenly, just after the hit (P4.22).

    In natural roll that is the answer of P4.19, for stun that of P4.20.

    Parameters
    ----------
    topspin
        J_y, from -sqrt(5/2) to sqrt(5/2); the energy of the spin counts.

    >>> round(math.degrees(split_cut(1.0)), 3), round(math.degrees(split_cut(0.0)), 9)
    (33.211, 45.0)
    """
    most = math.sqrt(2.5)
    spin = numbers(topspin, "topspin", low=-most, high=most)
    return plain(np.arccos(np.sqrt(np.minimum(0.5 + 0.2 * spin**2, 1.0))))


@overload
def split_roll_cut(topspin: float = ...) -> float: ...


@overload
def split_roll_cut(topspin: ArrayLike = ...) -> Floats: ...
def split_roll_cut(topspin: Any = 1.0) -> Any:
    """Return the cut angle that splits the energy evenly once both balls roll (P4.22, P4.24).

    There the deflection angle equals the cut angle, whatever the spin.

    Parameters
    ----------
    topspin
        J_y, from -5/2 to 5/2.

    >>> [round(math.degrees(split_roll_cut(spin)), 3) for spin in (1.0, 0.0, -1.0)]
    [33.211, 45.0, 56.789]
    """
    spin = numbers(topspin, "topspin", low=-2.5, high=2.5)
    return plain(np.arccos(np.sqrt(0.5 + 0.2 * spin)))


def energy_after_hit(cut: Any, topspin: Any = 1.0) -> EnergyShares:
    """Return the balls' energies just after the hit, the cue ball's spin included (P4.19, P4.20).

    >>> shares = energy_after_hit(split_cut(1.0), 1.0)
    >>> round(shares.object_ball, 9), round(shares.cue_ball, 9)
    (0.7, 0.7)
    """
    cut, spin, _ = shot_of(cut, topspin, 0.0)
    return EnergyShares(plain(np.cos(cut) ** 2), plain(np.sin(cut) ** 2 + 0.4 * spin**2))


def energy_in_roll(cut: Any, topspin: Any = 1.0) -> EnergyShares:
    """Return the energies of the balls' motion once both roll (P4.19).

    Their spin carries 2/5 as much again.

    >>> shares = energy_in_roll(split_roll_cut(1.0), 1.0)
    >>> round(14.0 * shares.object_ball, 9), round(14.0 * shares.cue_ball, 9)
    (5.0, 5.0)
    """
    cut, topspin, _ = shot_of(cut, topspin, 0.0)
    k = 0.4 * topspin
    sin2, scale = np.sin(cut) ** 2, 25.0 / 49.0
    return EnergyShares(
        plain(scale * np.cos(cut) ** 2),
        plain(scale * ((sin2 + k) ** 2 + sin2 * (1.0 - sin2))),
    )
