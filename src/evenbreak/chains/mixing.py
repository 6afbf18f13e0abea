"""How fast a chain forgets where it started: the spectral gap and the mixing time.

    gap = 1 - the largest modulus of an eigenvalue off the unit circle,
    mixing time = the first n at which M^n v is within eps of its limit from every start v.

The transition matrix is block triangular in its classes, so its eigenvalues are those of
the classes, each found by the method that suits it: the self-loop of a single state; for a
line of states those of a similar symmetric tridiagonal matrix (S_ij^2 = M_ij M_ji); LAPACK
for any other class, or ARPACK if it is large. Defects between classes, as in races, do no
harm here.

Reference: Levin, Peres and Wilmer, Markov Chains and Mixing Times, chapters 4 and 12.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg
import scipy.sparse.linalg
from scipy.sparse import csc_array

from evenbreak.chains.chain import check_chain
from evenbreak.chains.eigenpairs import DENSE, EPS
from evenbreak.chains.limit_matrix import limit_matrix
from evenbreak.chains.line_elimination import line_order
from evenbreak.chains.powers import evened
from evenbreak.checks import number
from evenbreak.errors import AccuracyError, ChainError

_ON_CIRCLE = 1e-8
"""Eigenvalues as close to a root of 1 as this, other than 1 itself, count as it."""

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.chain import Chain


def spectral_gap(chain: Chain) -> float:
    """Return 1 minus the largest modulus of an eigenvalue off the unit circle.

    A closed class of period d has d eigenvalues on the unit circle, the d-th roots of 1.
    They are left out: for a ladder of +-1 steps (period 2, spectrum symmetric about 0) the
    gap is 1 minus the largest eigenvalue below 1 and describes the two-step average. In
    the end the distance to the limit falls like (1 - gap)^n. So are those of an
    `apparent_period`, within 1e-8 of such roots: a ladder that holds an error at its ends
    once in ages has period 1, but goes back and forth for longer than anyone plays.

    Raises
    ------
    AccuracyError
        if the gap cannot be found to three digits: an eigenvalue is too ill-conditioned,
        or the iteration for a class of more than 1000 states does not converge.

    Notes
    -----
    For classes of more than 1000 states that are not lines, ARPACK searches for the largest
    moduli; it may miss one, and the gap is then an upper bound.

    >>> from evenbreak.chains import chain_of
    >>> round(spectral_gap(chain_of([(1, 1, 0.75), (1, 2, 0.25), (2, 1, 0.5), (2, 2, 0.5)])), 12)
    0.75
    """
    check_chain(chain)
    structure = chain.structure
    M = evened(chain)
    sizes = np.diff(structure.offsets)
    alone = (sizes == 1)[structure.label] & ~structure.recurrent
    moduli = [0.0, float(M.diagonal()[alone].max(initial=0.0))]
    bounds = list(moduli)
    for label in np.flatnonzero(sizes > 1):
        states = structure.members(int(label))
        block = M[:, states][states]
        values, errors = _eigenvalues(block, int(structure.periods[label]))
        found = np.minimum(np.abs(values), 1.0)  # of a stochastic matrix none is larger
        moduli += found.tolist()
        bounds += (found + errors).tolist()
    gap = 1.0 - max(moduli)
    if not max(bounds) - max(moduli) <= 1e-3 * gap:
        raise AccuracyError(
            f"the gap is about {gap:.3g}, but an eigenvalue is known only to within "
            f"{max(bounds) - max(moduli):.1e}; follow the chain with propagate"
        )
    return gap


def apparent_period(chain: Chain) -> int:
    """Return the period of a chain as far as anyone can see: the least common one of its classes.

    It is the period, or a multiple d of it where the d-th roots of 1 have eigenvalues within 1e-8
    of them: what these carry goes round for a hundred million steps.

    Raises
    ------
    AccuracyError
        as for `spectral_gap`.

    >>> from evenbreak.chains import chain_of
    >>> rare = 1e-12
    >>> chain = chain_of([(1, 2, 1.0), (2, 1, 1.0 - rare), (2, 2, rare)])
    >>> int(chain.structure.periods[0]), apparent_period(chain)
    (1, 2)
    """
    structure, M = chain.structure, evened(chain)
    periods = []
    for label in np.flatnonzero(structure.closed):
        states, period = structure.members(int(label)), int(structure.periods[label])
        if 1 < len(states) != period:
            period = _values(M[:, states][states], period)[2]
        periods.append(period)
    # In Python's integers: the least common multiple of a dozen periods may exceed 64 bits.
    return math.lcm(*periods)


def _eigenvalues(block: csc_array, period: int) -> tuple[NDArray[Any], NDArray[np.float64]]:
    """Return the eigenvalues of a class with their errors, less those on the unit circle."""
    if period == block.shape[0]:
        return np.empty(0), np.empty(0)
    values, errors, seen = _values(block, period)
    return values[seen:], errors[seen:]


def _values(block: csc_array, period: int) -> tuple[NDArray[Any], NDArray[np.float64], int]:
    """Return the eigenvalues of a class by falling modulus, their errors, and its `_period`."""
    n = block.shape[0]
    line = _line(block)
    if line is not None:
        values = _ends_of_symmetric(*line)
        errors = np.full(len(values), n * EPS)
    elif n > DENSE:
        values = _largest(block, period + 1)
        errors = np.zeros(len(values))
    else:
        values, left, right = scipy.linalg.eig(block.toarray(), left=True, right=True)
        errors = n * EPS / _overlaps(values, left, right)
    order = np.argsort(-np.abs(values), kind="stable")
    values, errors = values[order], errors[order]
    return values, errors, _period(values, period)


def _period(values: NDArray[Any], period: int) -> int:
    """Return a period that eigenvalues, by falling modulus, cannot be told from; see above."""
    count = int((np.abs(values) >= 1.0 - _ON_CIRCLE).sum())
    if not period or count % period:
        return period
    turns = np.angle(values[:count]) * count / (2.0 * np.pi)
    places = turns.round()
    each_once = len(set((places % count).tolist())) == count
    return count if each_once and np.abs(turns - places).max() <= count * _ON_CIRCLE else period


def _overlaps(values: NDArray[Any], left: NDArray[Any], right: NDArray[Any]) -> NDArray[np.float64]:
    """Return 1 over the condition number of each eigenvalue: |y^H x| (Wilkinson).

    The vectors of a repeated eigenvalue need not come in pairs: their overlaps are taken
    together, as the smallest singular value.
    """
    overlaps = np.abs(np.sum(left.conj() * right, axis=0))
    for i in np.flatnonzero(overlaps < 1e-6):
        near = np.abs(values - values[i]) < 1e-6
        overlaps[i] = np.linalg.norm(left[:, near].conj().T @ right[:, near], ord=-2)
    return np.asarray(np.maximum(overlaps, EPS * EPS))


def _line(block: csc_array) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """Return the diagonal and off-diagonal of a similar symmetric matrix, if there is one."""
    T = block.copy()
    T.setdiag(0.0)
    T.eliminate_zeros()
    order = line_order(T)
    if order is None:
        return None
    line = csc_array(T[:, order])[order]
    up, down = line.diagonal(-1), line.diagonal(1)
    return block.diagonal()[order], np.sqrt(up) * np.sqrt(down)


def _ends_of_symmetric(
    diagonal: NDArray[np.float64], beside: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the two lowest and the two highest eigenvalues (all, if there are up to four)."""
    n = len(diagonal)
    if n <= 4:
        return np.asarray(scipy.linalg.eigvalsh_tridiagonal(diagonal, beside))
    ends = [
        scipy.linalg.eigvalsh_tridiagonal(diagonal, beside, select="i", select_range=ends)
        for ends in ((0, 1), (n - 2, n - 1))
    ]
    return np.concatenate(ends)


def _largest(block: csc_array, k: int) -> NDArray[Any]:
    start = np.random.default_rng(0).random(block.shape[0])
    try:
        return np.asarray(
            scipy.sparse.linalg.eigs(block, k=k, v0=start, maxiter=300, return_eigenvectors=False)
        )
    except scipy.sparse.linalg.ArpackNoConvergence as error:
        raise AccuracyError(
            f"the iteration for the eigenvalues of a class of {block.shape[0]} states did not "
            "converge: its gap is small; follow the chain with propagate"
        ) from error


def mixing_time(chain: Chain, eps: float = 0.25) -> int:
    """Return the number of steps after which every start is within `eps` of its limit.

    Distance is total variation, half the sum of absolute differences, from the worst start.
    If a closed class is periodic, the average over the next d steps is compared, with d the
    `apparent_period`.

    Raises
    ------
    InputError
        if `eps` is not between 0 and 1.
    ChainError
        if the chain has more than 1000 states: the powers are dense.
    AccuracyError
        if `eps` is too small for rounding, or more than 2^60 steps are needed.

    Notes
    -----
    The distance never grows, so repeated squaring and bisection find the step (Levin, Peres
    and Wilmer, section 4.5).

    >>> from evenbreak.chains import chain_of
    >>> winner_breaks = chain_of([(1, 1, 0.75), (1, 2, 0.25), (2, 1, 0.5), (2, 2, 0.5)])
    >>> [mixing_time(winner_breaks, eps) for eps in (0.7, 0.25, 0.01)]
    [0, 1, 4]
    """
    check_chain(chain)
    eps = number(eps, "eps", above=0.0, below=1.0)
    n = len(chain)
    if n > DENSE:
        raise ChainError(
            f"the chain has {n} states; a mixing time needs {DENSE} or fewer, ask for spectral_gap"
        )
    period = apparent_period(chain)
    M = evened(chain).toarray()
    average = _average_of_powers(M, period)
    limit = limit_matrix(chain).toarray()

    def far(power: NDArray[np.float64]) -> bool:
        return bool(np.abs(average @ power - limit).sum(axis=0).max() / 2.0 > eps)

    steps, reached = 0, np.eye(n)
    if not far(reached):
        return 0
    powers = [M]
    while far(powers[-1]):
        square = powers[-1] @ powers[-1]
        powers.append(square / square.sum(axis=0))
        if len(powers) > 60:
            raise AccuracyError(
                f"the chain is not within {eps} of its limit after 2^60 steps, as far as floats "
                "can show; give a larger eps"
            )
    for i in reversed(range(len(powers) - 1)):
        further = powers[i] @ reached
        if far(further):
            steps, reached = steps + 2**i, further
    return steps + 1


def _average_of_powers(M: NDArray[np.float64], terms: int) -> NDArray[np.float64]:
    """Return (I + M + ... + M^(terms - 1)) / terms by doubling, its columns summing to 1."""
    eye = np.eye(len(M))
    average, power, count = eye, M, 1
    for bit in f"{terms:b}"[1:]:
        average, power, count = (average + power @ average) / 2, power @ power, 2 * count
        if bit == "1":
            average = (eye + count * (M @ average)) / (count + 1)
            power, count = M @ power, count + 1
        # Otherwise rounding errors of the sums would double with each square.
        power, average = power / power.sum(axis=0), average / average.sum(axis=0)
    return average
