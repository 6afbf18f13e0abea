"""How many matches a wrong rating takes to become about right.

A rating settles with the first match after which its error is within a band around 0. The number of
matches follows from the chain of errors with the band made absorbing. Under a newcomer schedule,
each stage has its own chain; a rating that has not settled by the end of the schedule continues
like an established player's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from evenbreak.arrays import Floats
from evenbreak.chains import first_passage, stochastic_limit
from evenbreak.checks import whole
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.ladders.error_chain import (
    chain_of_errors,
    error_on,
    move_matrix,
    period_of,
    unit_of,
)
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.stats.summary import Distribution

_TAIL = 1e-12
_HORIZON = 100_000


@dataclass(frozen=True)
class Settling:
    """Number of matches until a rating is close to the skill.

    Parameters
    ----------
    start
        the rating error before the first match, in points.
    within
        an error of at most this many points counts as settled.
    newcomer
        whether the first matches follow the system's newcomer schedule.
    mean, sd
        mean and standard deviation of the number of matches, from linear solves, so without a
        cutoff.
    chances
        P(settled after t matches and not before), for t = 0, 1, ..., horizon.
    tail
        P(it takes more matches than the horizon): 1e-12 at most.
    """

    start: int
    within: int
    newcomer: bool
    mean: float
    sd: float
    chances: tuple[float, ...]
    tail: float

    @property
    def matches(self) -> Distribution:
        """Distribution of the number of matches; the tail is added to the horizon."""
        *before, last = self.chances
        return Distribution(tuple(range(len(self.chances))), (*before, last + self.tail))

    @property
    def horizon(self) -> int:
        """The largest number of matches in `chances`."""
        return len(self.chances) - 1

    def after(self, matches: int) -> float:
        """Return P(settled within this many matches | the start)."""
        return min(math.fsum(self.chances[: whole(matches, "matches") + 1]), 1.0)


def settling(ladder: Ladder, start: int, within: int = 5, *, newcomer: bool = False) -> Settling:
    """Return how many matches a rating takes to get close to the skill.

    Each probability is conditional on the error before the first match, and on the ladder's
    opponents, whose ratings have settled.

    Parameters
    ----------
    start
        the rating minus the skill before the first match, in whole points.
    within
        an error of at most this many points either way counts as settled.
    newcomer
        whether the player is new and follows the system's newcomer schedule at first.

    Raises
    ------
    InputError
        if start is not on the ladder, within is not a whole number from 0 up, the rating may never
        get this close (long steps may jump over the band forever), or newcomer is True for a system
        without a newcomer schedule.
    AccuracyError
        if more than 1e-12 of the players take more than 100,000 matches.

    Notes
    -----
    The band is made absorbing, and the mean is the mean first passage time (Kemeny & Snell,
    Finite Markov Chains, chapter III), taken from the errors at the end of the newcomer schedule.

    >>> from evenbreak.handicaps import Ladder
    >>> ladder = Ladder("npl")
    >>> slow, fast = settling(ladder, -30), settling(ladder, -30, newcomer=True)
    >>> round(slow.mean, 1), slow.matches.quantile(0.9), round(slow.after(50), 3)
    (60.3, 85, 0.332)
    >>> round(fast.mean, 1), fast.matches.quantile(0.9), round(fast.after(50), 3)
    (27.6, 53, 0.88)
    """
    error, band = error_on(ladder.widest, start), whole(within, "within")
    left = np.zeros(len(ladder.errors))
    left[error + ladder.widest] = 1.0
    inside = np.abs(ladder.errors) <= band
    chances = [float(left[inside].sum())]
    left[inside] = 0.0
    for played, factor in _schedule(ladder) if newcomer else ():
        matrix = move_matrix(ladder, factor)
        for _ in range(played if left.any() else 0):
            left = left @ matrix
            chances.append(float(left[inside].sum()))
            left[inside] = 0.0
    remaining = float(left.sum())
    mean, square = _moments(np.array(chances))
    if remaining > 0.0:
        target = ladder.errors[inside].tolist()
        passage = first_passage(chain_of_errors(ladder), left / remaining, target)
        if not passage.certain or passage.mean is None or passage.variance is None:
            raise InputError(
                "{within} is {band}, but with steps of {max}, an error of {error} may never get "
                "that small. Give a wider band.",
                band=band,
                max=ladder.steps.max(),
                error=error,
            )
        later, tail = passage.distribution(tail=_TAIL / remaining, max_steps=_HORIZON)
        if tail * remaining > _TAIL:
            raise AccuracyError(
                "from an error of {error}, a rating {mean} to come within {band}. Give a wider "
                "band, a closer start, or less drift.",
                error=error,
                mean=_too_long(passage.mean),
                band=band,
            )
        gone = len(chances) - 1
        mean += remaining * (gone + passage.mean)
        square += remaining * (passage.variance + (gone + passage.mean) ** 2)
        chances += (remaining * later[1:]).tolist()
    tail_left = max(0.0, 1.0 - math.fsum(chances)) if remaining > 0.0 else 0.0
    sd = math.sqrt(max(square - mean * mean, 0.0))
    return Settling(error, band, newcomer, mean, sd, tuple(chances), tail_left)


def _too_long(mean: float) -> str:
    """Return how long a rating takes, from the mean, without a number if it is huge."""
    if mean > _HORIZON:
        return f"needs more than {_HORIZON:,} matches on average"
    return f"may need more than {_HORIZON:,} matches ({mean:,.0f} on average)"


def _schedule(ladder: Ladder) -> tuple[tuple[int, int], ...]:
    if not ladder.system.newcomer_steps:
        raise InputError(
            "newcomer is True, but in the system {name} newcomers' ratings move like everyone "
            "else's. Leave out newcomer.",
            name=ladder.system.name,
        )
    return ladder.system.newcomer_steps


def _moments(chances: NDArray[Any]) -> tuple[float, float]:
    """Return the weighted sums of t and of t squared."""
    t = np.arange(len(chances))
    return float(t @ chances), float(t * t @ chances)


# How fast a ladder forgets where a rating started.
#
# With steps of one point either way an even error is even again after any even number of matches
# (except at the ends of the line, which are reached once in ages). The chain has the period 2 and
# an eigenvalue at -1, up to rounding, and its powers do not converge; the average over two
# successive matches does. So the eigenvalue near -1 is set aside, and distances are those of the
# two-match average.
#
# Other moves have other periods: up 2 points and down 1 has the period 3, with eigenvalues near
# all three cube roots of unity, and the average over three matches converges.


_MOST_MATCHES = 100_000


def ladder_gap(ladder: Ladder) -> float:
    """Return the spectral gap: 1 minus the largest modulus of an eigenvalue.

    The eigenvalues of the period are left out: the one near 1 and, with moves of a point either
    way, the one near -1. The distance between the average over one period and the limit eventually
    falls like (1 - gap)^matches, so about log(2) / gap matches halve it.

    Parameters
    ----------
    ladder
        the ladder on which the rating moves. If all moves are multiples of some number of points,
        only errors that are multiples of it count.

    Raises
    ------
    AccuracyError
        if the gap is so small that rounding hides it.

    Notes
    -----
    With moves of one point either way the spectrum is symmetric about 0 except for the ends, and
    the gap is 1 minus the largest eigenvalue below 1. The matrix is first scaled by the square
    roots of the limit, which makes a reversible chain symmetric and its eigenvalues well
    conditioned. Source: Levin, Peres & Wilmer, Markov Chains and Mixing Times, chapter 12.

    >>> from evenbreak.handicaps import Ladder, chart
    >>> round(ladder_gap(Ladder("npl", chart("npl_10"))), 4)
    0.0217
    """
    law = np.asarray(ladder.law().probability, dtype=float)
    # Errors rarer than this are never seen in any season.
    kept = (law > 1e-280) & (ladder.errors % max(unit_of(ladder), 1) == 0)
    root = np.sqrt(law[kept])
    scaled = move_matrix(ladder)[np.ix_(kept, kept)] * root[:, None] / root
    values = _eigenvalues(scaled)
    period = period_of(ladder)
    for unity in np.exp(2j * np.pi * np.arange(period) / period)[: len(values)]:
        values = np.delete(values, np.abs(values - unity).argmin())
    gap = 1.0 - float(np.abs(values).max(initial=0.0))
    if gap < 1e-9:
        raise AccuracyError(
            "the gap is {gap:.1e}, less than the rounding errors. Follow the ladder with "
            "ladder_mixing.",
            gap=gap,
        )
    return gap


def _eigenvalues(matrix: Floats) -> NDArray[Any]:
    if np.abs(matrix - matrix.T).max() <= 1e-9:
        return np.asarray(scipy.linalg.eigvalsh((matrix + matrix.T) / 2.0))
    return np.asarray(scipy.linalg.eigvals(matrix))


def ladder_mixing(ladder: Ladder, start: int, eps: float = 0.25) -> int:
    """Return the number of matches after which a rating error is within `eps` of the long run.

    The distance is total variation, half the sum of the absolute differences, between the long
    run and the average over one period of matches (that match and the next, with moves of a point
    either way). Both are conditional on the error at the start.

    Parameters
    ----------
    start
        the rating error before the first match, in whole points.
    eps
        the distance, between 0 and 1.

    Raises
    ------
    InputError
        if start is not on the ladder or eps is not between 0 and 1.
    AccuracyError
        if more than 100,000 matches are needed.

    Notes
    -----
    Source: Levin, Peres & Wilmer, Markov Chains and Mixing Times, section 4.5. The distance
    never grows, so once within eps it stays there.

    >>> from evenbreak.handicaps import Ladder, chart
    >>> ladder = Ladder("npl", chart("npl_10"))
    >>> ladder_mixing(ladder, 0), ladder_mixing(ladder, 30), ladder_mixing(ladder, 30, 0.01)
    (10, 97, 245)
    """
    if not 0.0 < eps < 1.0:
        raise InputError("{eps} must be a number between 0 and 1; you gave {value!r}", value=eps)
    place = error_on(ladder.widest, start) + ladder.widest
    chain = chain_of_errors(ladder)
    now = np.eye(len(chain))[place]
    settled, matrix = stochastic_limit(chain, now), chain.matrix
    limit = np.array([float(settled.get(error, 0.0)) for error in chain.states])
    laws = [now]
    for _ in range(period_of(ladder) - 1):
        laws.append(matrix @ laws[-1])
    average = np.mean(laws, axis=0)
    for matches in range(_MOST_MATCHES + 1):
        if np.abs(average - limit).sum() / 2.0 <= eps:
            return matches
        average = matrix @ average
    raise AccuracyError(
        "the error isn't within {eps:g} of the long run after {most_matches} matches. "
        "Give a larger eps.",
        eps=eps,
        most_matches=_MOST_MATCHES,
    )
