"""Where the cue ball goes after a hit, once it rolls (section 4, P4.13 to P4.25).

Without friction between the balls the cue ball leaves at a right angle to the object ball. Its
topspin or draw then bends its path, until it rolls at the deflection angle

    theta = atan2(sin(cut) cos(cut), sin(cut)^2 + 2/5 J_y)

from the direction of the shot, between 0 and pi. Equivalently, with k = 2/5 J_y,
tan(cut + theta) = (1 + k)/k tan(cut), which is 7/2 tan(cut) in natural roll.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import FloatOrArray
from evenbreak.checks import plain
from evenbreak.physics.throw import shot_of
from evenbreak.physics.units import LEAST, numbers, positive


class EnergyShares(NamedTuple):
    """Energies of the two balls, relative to the cue ball's energy M V_0^2 / 2 before the hit.

    Parameters
    ----------
    object_ball, cue_ball
        shares, 0 or more; their sum is above 1 if the cue ball's spin contributes energy.
    """

    object_ball: Any
    cue_ball: Any


def deflection(cut: FloatOrArray, topspin: FloatOrArray = 1.0) -> FloatOrArray:
    """Return the cue ball's deflection angle once it rolls, in radians, 0 to pi.

    Parameters
    ----------
    cut
        cut angle in radians, -pi/2 to pi/2; a cut to the left is the mirror image. The value at 0
        is the limit of small angles: pi/2 for stun, although the cue ball then stands still.
    topspin
        J_y just before the hit: 1 in natural roll, 0 for stun, -1 in reverse natural roll.

    Notes
    -----
    Source: P4.13, P4.21 and P4.23, without friction between the balls; P4.14 by tangents. Near
    the largest deflection it hardly changes with the cut (P4.17).

    >>> [round(math.degrees(deflection(math.radians(30.0), spin)), 2) for spin in (1, 0, -1)]
    [33.67, 60.0, 109.11]
    """
    cut, topspin, _ = shot_of(cut, topspin, 0.0)
    # A full hit is the limit of small angles, by the smallest of them.
    sin = np.maximum(np.abs(np.sin(cut)), 1e-300)
    return plain(np.arctan2(sin * np.cos(cut), sin * sin + 0.4 * topspin))


def deflection_slope(cut: FloatOrArray, topspin: FloatOrArray = 1.0) -> FloatOrArray:
    """Return d theta / d cut, the cue ball's sensitivity to the size of the cut (P4.15).

    In natural roll it falls from 5/2 at small cut angles (P4.18) to -5/7; for stun it is -1 at
    every cut.

    Parameters
    ----------
    cut
        cut angle in radians, -pi/2 to pi/2; a cut to the left is the mirror image.
    topspin
        J_y just before the hit: 1 in natural roll, 0 for stun, -1 in reverse natural roll.

    >>> round(deflection_slope(0.0), 9), round(deflection_slope(math.pi / 2.0), 4)
    (2.5, -0.7143)
    """
    cut, topspin, _ = shot_of(cut, topspin, 0.0)
    k = 0.4 * topspin
    sin2 = np.sin(cut) ** 2
    below = k * k * (1.0 - sin2) + (1.0 + k) ** 2 * sin2
    # Only a full hit with stun leaves 0 below, where the ratio is 0 at every cut.
    return plain(k * (1.0 + k) / np.maximum(below, 1e-300) - 1.0)


def largest_deflection_cut(topspin: FloatOrArray = 1.0) -> FloatOrArray:
    """Return the cut angle of the largest deflection with topspin, in radians (P4.15, P4.16).

    The largest deflection is pi/2 minus twice this angle.

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


def unit_slope_cut(topspin: FloatOrArray = 1.0) -> FloatOrArray:
    """Return the cut at which both paths are equally sensitive to the cut, in radians.

    At smaller cuts d theta / d cut is more than 1 (P4.19).

    Parameters
    ----------
    topspin
        J_y, above 0 and at most 5/2; beyond that the slope is below 1 at every cut.

    >>> round(math.degrees(unit_slope_cut()), 3)
    14.963
    """
    k = 0.4 * numbers(topspin, "topspin", low=LEAST, high=2.5)
    return plain(np.arcsin(np.sqrt(k * (1.0 - k) / (2.0 + 4.0 * k))))


def right_angle_cut(topspin: FloatOrArray = -1.0) -> FloatOrArray:
    """Return the cut at which draw deflects the cue ball by a right angle, in radians (P4.25).

    Parameters
    ----------
    topspin
        J_y, from -5/2 to 0.

    >>> round(math.degrees(right_angle_cut()), 3)
    39.232
    """
    return plain(np.arcsin(np.sqrt(-0.4 * numbers(topspin, "topspin", low=-2.5, high=0.0))))


def split_cut(topspin: FloatOrArray = 1.0) -> FloatOrArray:
    """Return the cut that splits the energy evenly just after the hit, in radians (P4.22).

    For natural roll, this is the answer to P4.19; for stun, it is the answer to P4.20.

    Parameters
    ----------
    topspin
        J_y, from -sqrt(5/2) to sqrt(5/2); the energy includes spin.

    >>> round(math.degrees(split_cut(1.0)), 3), round(math.degrees(split_cut(0.0)), 9)
    (33.211, 45.0)
    """
    most = math.sqrt(2.5)
    spin = numbers(topspin, "topspin", low=-most, high=most)
    return plain(np.arccos(np.sqrt(np.minimum(0.5 + 0.2 * spin**2, 1.0))))


def split_roll_cut(topspin: FloatOrArray = 1.0) -> FloatOrArray:
    """Return the cut that splits the energy evenly once both balls roll, in radians (P4.22, P4.24).

    At this cut the deflection equals the cut angle, regardless of the spin.

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
    """Return the energies just after the hit, the cue ball's spin included (P4.19, P4.20).

    Parameters
    ----------
    cut
        cut angle in radians, -pi/2 to pi/2; a cut to the left is the mirror image.
    topspin
        J_y just before the hit: 1 in natural roll, 0 for stun, -1 in reverse natural roll.

    >>> shares = energy_after_hit(split_cut(1.0), 1.0)
    >>> round(shares.object_ball, 9), round(shares.cue_ball, 9)
    (0.7, 0.7)
    """
    cut, spin, _ = shot_of(cut, topspin, 0.0)
    return EnergyShares(plain(np.cos(cut) ** 2), plain(np.sin(cut) ** 2 + 0.4 * spin**2))


def energy_in_roll(cut: Any, topspin: Any = 1.0) -> EnergyShares:
    """Return the energies of the motion of both balls once they roll (P4.19).

    Their spins hold 2/5 as much in addition.

    Parameters
    ----------
    cut
        cut angle in radians, -pi/2 to pi/2; a cut to the left is the mirror image.
    topspin
        J_y just before the hit: 1 in natural roll, 0 for stun, -1 in reverse natural roll.

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
