"""Form: how much better or worse than their skill a player is today; normal, in whole points.

Distributions are arrays over the whole points -k, ..., k. Sums of independent deviations are
convolutions of such arrays, and so are averages of a smooth function over them.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.fft import irfft, next_fast_len, rfft
from scipy.special import ndtr

from evenbreak.arrays import Floats, Ints

_FARTHEST = 8.3
"""Standard deviations beyond which a normal distribution has no more than 1e-16."""

_FINE = 4.0
"""Largest standard deviation, in points, for which a grid has every whole point."""

_FEW = 1 << 18
"""Number of products up to which a sum is faster than a Fourier transform."""


def deviations(sd: float) -> Floats:
    """Return the distribution of a normal deviation rounded to whole points, over -k, ..., k.

    >>> deviations(0.0), deviations(0.5)[3:8].round(4)
    (array([1.]), array([0.0013, 0.1573, 0.6827, 0.1573, 0.0013]))
    """
    if sd < 0.01:  # no deviation rounds to a point then
        return np.ones(1)
    far = math.ceil(_FARTHEST * sd)
    # Below 0 no digit is lost, and the two sides are alike.
    edges = ndtr((np.arange(-far, 1) - 0.5) / sd)
    below = np.diff(edges)
    law = np.concatenate([below, [2.0 * (0.5 - edges[-1])], below[::-1]])
    return np.asarray(law / law.sum())


def difference_law(*sds: float) -> Floats:
    """Return the distribution of the difference between two players' forms, over -k, ..., k.

    Each player has deviations with these standard deviations, all of them independent.

    >>> difference_law(0.0), difference_law(0.5)[8:13].round(4)
    (array([1.]), array([0.0266, 0.2152, 0.5156, 0.2152, 0.0266]))
    """
    law = np.ones(1)
    for sd in sds:
        law = np.convolve(np.convolve(law, deviations(sd)), deviations(sd))
    return law


def deviation_grid(law: Floats, doubling: float) -> tuple[Ints, Floats]:
    """Return points and weights that represent a distribution over -k, ..., k in a mean.

    Above a standard deviation of 4 points the spacing is half of it, or half a `doubling` of the
    odds if that is less: for a function as smooth as a chance of winning, the trapezoidal rule is
    then exact to 1e-11.

    >>> points, chances = deviation_grid(deviations(8.0), 30.0)
    >>> len(points), round(float(chances @ points**2), 9)
    (33, 64.083333333)
    """
    half = len(law) // 2
    sd = math.sqrt(law @ (np.arange(len(law)) - half) ** 2)
    apart = max(int(min(sd, doubling) / 2.0), 1) if sd > _FINE else 1
    points = apart * np.arange(-(half // apart), half // apart + 1)
    weights = law[half + points]
    return points, weights / weights.sum()


def averages(values: Floats, law: Floats) -> Floats:
    """Return sum over k of law[k] values[..., i + k] for each i at which all of them are known.

    A few terms are added up directly; many are handled by a Fourier transform, whose error is about
    1e-16 of the largest value.

    >>> averages(np.array([0.0, 1.0, 4.0, 9.0]), np.array([0.5, 0.5]))
    array([0.5, 2.5, 6.5])
    """
    many, width = values.shape[-1], len(law)
    if width == 1:
        return np.asarray(values * law[0])
    if values.size * width <= _FEW or many - width < 2:
        windows = np.lib.stride_tricks.sliding_window_view(values, width, axis=-1)
        return np.asarray(windows @ law)
    size = next_fast_len(many, real=True)
    spectrum = rfft(values, size, axis=-1) * rfft(law[::-1], size)
    return np.asarray(irfft(spectrum, size, axis=-1)[..., width - 1 : many])
