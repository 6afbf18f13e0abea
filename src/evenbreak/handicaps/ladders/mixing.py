"""How fast a ladder forgets where a rating started.

With steps of one point either way an even error is even again after any even number of matches
(except at the ends of the line, which are reached once in ages). The chain has the period 2 and an
eigenvalue at -1, up to rounding, and its powers do not converge; the average over two successive
matches does. So the eigenvalue near -1 is set aside, and distances are those of the two-match
average.

Other moves have other periods: up 2 points and down 1 has the period 3, with eigenvalues near all
three cube roots of unity, and the average over three matches converges.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from evenbreak.arrays import Floats
from evenbreak.chains import stochastic_limit
from evenbreak.errors import AccuracyError, InputError
from evenbreak.handicaps.ladders.error_chain import (
    chain_of_errors,
    error_on,
    move_matrix,
    period_of,
    unit_of,
)
from evenbreak.handicaps.ladders.ladder import Ladder

_MOST_MATCHES = 100_000


def ladder_gap(ladder: Ladder) -> float:
    """Return the spectral gap: 1 minus the largest modulus of an eigenvalue.

    The eigenvalues of the period are left out: the one near 1 and, with moves of a point either
    way, the one near -1. The distance of the average over one period from the limit falls like
    (1 - gap)^matches in the end, so about log(2) / gap matches halve it.

    Parameters
    ----------
    ladder
        how the rating moves. If all moves are multiples of some number of points, only errors
        that are multiples of it count.

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
            f"the gap is {gap:.1e}, which rounding hides; follow the ladder with ladder_mixing"
        )
    return gap


def _eigenvalues(matrix: Floats) -> NDArray[Any]:
    if np.abs(matrix - matrix.T).max() <= 1e-9:
        return np.asarray(scipy.linalg.eigvalsh((matrix + matrix.T) / 2.0))
    return np.asarray(scipy.linalg.eigvals(matrix))


def ladder_mixing(ladder: Ladder, start: int, eps: float = 0.25) -> int:
    """Return after how many matches a rating error is within `eps` of the long run.

    The distance is total variation, half the sum of the absolute differences, between the long
    run and the average over one period of matches (that match and the next, with moves of a point
    either way). Both are conditional on the error at the start.

    Parameters
    ----------
    ladder
        how the rating moves.
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
        raise InputError(f"eps is {eps!r}; give a number between 0 and 1")
    place = error_on(ladder.widest, start) + ladder.widest
    chain = chain_of_errors(ladder)
    now = np.eye(len(chain))[place]
    found, matrix = stochastic_limit(chain, now), chain.matrix
    limit = np.array([float(found.get(error, 0.0)) for error in chain.states])
    laws = [now]
    for _ in range(period_of(ladder) - 1):
        laws.append(matrix @ laws[-1])
    average = np.mean(laws, axis=0)
    for matches in range(_MOST_MATCHES + 1):
        if np.abs(average - limit).sum() / 2.0 <= eps:
            return matches
        average = matrix @ average
    raise AccuracyError(
        f"the error is not within {eps:g} of the long run after {_MOST_MATCHES} matches; give a "
        "larger eps"
    )
