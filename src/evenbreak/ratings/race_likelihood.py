"""What winning or losing a race says about the rating difference, when no score is known.

With d the difference in natural log-odds, p = 1 / (1 + exp(-d)) and q = 1 - p, the race
m:n is won with chance W = I_p(m, n), the regularised incomplete beta function. Then

    d/dd log W = h,    d²/dd² log W = h (m q - n p - h),    h = p^m q^n / (B(m, n) W),

and the second is nowhere above zero: log W is concave, so matches known by their winners
alone have one most likely set of ratings. (The integrand of I_p, written in d, is
log-concave, and so is every integral of it from -∞: Prékopa 1973.)
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import betainc, betaln, expit, hyp2f1, log_expit

from evenbreak.arrays import Floats
from evenbreak.errors import InputError

_FAR = 1e-200
"""For smaller chances the logarithm is worked out without W, which would underflow."""


class RaceSlopes(NamedTuple):
    """log W(p(d); m, n), and its first and second derivative in d, elementwise."""

    log_win: Floats
    slope: Floats
    curvature: Floats


def race_slopes(difference: ArrayLike, m: ArrayLike, n: ArrayLike) -> RaceSlopes:
    """Return the logarithm of the chance to win a race, with its derivatives.

    Parameters
    ----------
    difference
        the winner's skill less the loser's, in natural log-odds of a game.
    m, n
        the games that the winner and the loser of the match needed, 1 or more. The three
        are broadcast together.

    Returns
    -------
    RaceSlopes
        given that the games are independent and the break does not matter; finite for
        any finite difference.

    Raises
    ------
    InputError
        if the difference is not finite, or m or n is below 1.

    Notes
    -----
    The race: problem P5.5. Where W underflows: W = p^m q^n / (m B(m, n)) F(m + n, 1;
    m + 1; p), DLMF 8.17.8.

    >>> level = race_slopes(0.0, 2, 1)  # W = p²
    >>> [round(float(part), 6) for part in level]
    [-1.386294, 1.0, -0.5]
    """
    d, m, n = (np.asarray(part, dtype=np.float64) for part in (difference, m, n))
    if not np.isfinite(d).all():
        raise InputError("difference holds a value that is not finite; give finite numbers")
    if not ((m >= 1).all() and (n >= 1).all()):
        raise InputError("m or n is below 1 somewhere; give the games that each player needs")
    d, m, n = np.broadcast_arrays(d, m, n)
    if not d.size:
        return RaceSlopes(d, d, d)
    p, q = expit(d), expit(-d)
    win = betainc(m, n, p)
    density = m * log_expit(d) + n * log_expit(-d) - betaln(m, n)
    far = win < _FAR
    with np.errstate(divide="ignore"):
        log_win = np.where(win < 0.5, np.log(win), np.log1p(-betainc(n, m, q)))
    if far.any():
        log_win = np.where(far, density + _log_tail(m, n, np.where(far, p, 0.0)), log_win)
    slope: Any = np.exp(density - log_win)
    # What is left of rounding must not bend the other way.
    curvature = np.minimum(slope * (m * q - n * p - slope), 0.0)
    return RaceSlopes(log_win, slope, curvature)


def _log_tail(m: Any, n: Any, p: Any) -> Any:
    """Return log W less the density's logarithm, for a p far below m / (m + n)."""
    return np.log(hyp2f1(m + n, 1.0, m + 1.0, p) / m)
