"""How fast a chain forgets where it started: the spectral gap and the mixing time.

    gap = 1 - the largest modulus of an eigenvalue off the unit circle,
    mixing time = the first n at which M^n v is within eps of its limit from every start v.

The transition matrix is block triangular in its classes, so its eigenvalues are those of
the classes, each found by the method that suits it: the self-loop of a single state; for a line of
states, the eigenvalues of a similar symmetric tridiagonal matrix (S_ij^2 = M_ij M_ji); LAPACK for
any other class, or ARPACK if it is large. Defectiveness between classes, as in races, does no harm
here.

Reference: Levin, Peres and Wilmer, Markov Chains and Mixing Times, chapters 4 and 12.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigvalsh_tridiagonal
from scipy.sparse import csc_array, diags_array
from scipy.sparse.linalg import ArpackNoConvergence, eigs

from evenbreak.arrays import Bools, Floats
from evenbreak.chains.birth_death import line_of
from evenbreak.chains.chain import Chain, check_chain
from evenbreak.chains.eigenpairs import DENSE, EPS
from evenbreak.chains.limits import limit_matrix
from evenbreak.chains.powers import evened
from evenbreak.chains.stationary import laws_of
from evenbreak.checks import number
from evenbreak.errors import AccuracyError, ChainError

_ON_CIRCLE = 1e-8
"""Distance from a root of 1 (other than 1) within which an eigenvalue counts as that root."""
_LEAST = 1e-290
"""States with less probability than this are scaled alike."""
_BASIS = 60
"""Minimum number of vectors for ARPACK: with its default of 20, it may not converge."""


def spectral_gap(chain: Chain) -> float:
    """Return 1 minus the largest modulus of an eigenvalue off the unit circle.

    A closed class of period d has d eigenvalues on the unit circle, the d-th roots of 1.
    They are left out: for a ladder with +-1 steps (period 2, spectrum symmetric about 0) the gap is
    1 minus the largest eigenvalue below 1 and describes the two-step average. Eventually, the
    distance to the limit falls like (1 - gap)^n. Eigenvalues of an `apparent_period`, within 1e-8
    of such roots, are left out too: a ladder that very rarely holds an error at its ends has period
    1, but alternates for longer than anyone plays.

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
    sizes = np.diff(structure.offsets)
    alone = (sizes == 1)[structure.label] & ~structure.recurrent
    largest = worst = float(evened(chain).diagonal()[alone].max(initial=0.0))
    for values, error, seen in _classes(chain, sizes > 1):
        # Of a stochastic matrix no eigenvalue is beyond the unit circle.
        modulus = min(float(np.abs(values[seen:]).max(initial=0.0)), 1.0)
        largest, worst = max(largest, modulus), max(worst, modulus + error)
    gap = 1.0 - largest
    if not worst - largest <= 1e-3 * gap:
        raise AccuracyError(
            f"the gap is about {gap:.3g}, but one eigenvalue is only known to within "
            f"{worst - largest:.1e}. Follow the chain with propagate."
        )
    return gap


def apparent_period(chain: Chain) -> int:
    """Return the apparent period of a chain: the least common multiple of its classes' periods.

    It is the period, or a multiple d of it if there are eigenvalues within 1e-8 of the d-th roots
    of 1: their components cycle for a hundred million steps. Raises AccuracyError as `spectral_gap`
    does.
    """
    seen = [seen for _, _, seen in _classes(chain, chain.structure.closed)]
    # In Python's integers: the least common multiple of a dozen periods may exceed 64 bits.
    return math.lcm(*seen)


def _classes(chain: Chain, wanted: Bools) -> Iterator[tuple[NDArray[Any], float, int]]:
    """Yield each wanted class's eigenvalues, the error of the first off the circle, and the period.

    The eigenvalues are in order of decreasing modulus; as many as the period are on the unit
    circle, or indistinguishable from it.
    """
    structure, M = chain.structure, evened(chain)
    large = wanted & (np.diff(structure.offsets) > structure.periods)
    try:
        laws, _ = laws_of(chain, large & structure.closed)
    except AccuracyError:  # the scale matters to the accuracy alone
        laws = np.ones(len(chain))
    for label in np.flatnonzero(wanted).tolist():
        states, period = structure.members(label), int(structure.periods[label])
        if not large[label]:
            yield np.ones(period), 0.0, period
            continue
        law = laws[states] if structure.closed[label] else np.ones(len(states))
        yield _values(csc_array(M[:, states][states]), law, period)


def _values(block: csc_array, law: Floats, period: int) -> tuple[NDArray[Any], float, int]:
    """Return a class's eigenvalues by decreasing modulus, an error, and its `_period`.

    If D is the square roots of the stationary distribution, D^-1 M D has the norm 1, no matter how
    many decades the distribution spans, and is symmetric for a reversible class. The accuracy of
    its eigenvalues is found by perturbing the matrix by the size of rounding errors.
    """
    n = block.shape[0]
    line = line_of(block)
    if line is not None:
        _, walk = line
        beside = np.sqrt(walk.up) * np.sqrt(walk.down)
        values = _falling(_ends_of_symmetric(walk.loops, beside))
        return values, n * EPS, _period(values, period)
    roots = np.sqrt(np.maximum(law, _LEAST))
    scaled = diags_array(1.0 / roots) @ block @ diags_array(roots)
    if n > DENSE:
        values = _largest(csc_array(scaled), period)
        return values, 0.0, _period(values, period)
    dense = scaled.toarray()
    change = np.random.default_rng(0).standard_normal((n, n)) * (EPS * np.sqrt(n) / 2.0)
    # numpy lets Ctrl-C through.
    values, moved = (_falling(np.linalg.eigvals(A)) for A in (dense, dense + change))
    seen = _period(values, period)
    return values, abs(float(abs(values[seen]) - abs(moved[seen]))) if seen < n else 0.0, seen


def _falling(values: NDArray[Any]) -> NDArray[Any]:
    return values[np.argsort(-np.abs(values), kind="stable")]


def _period(values: NDArray[Any], period: int) -> int:
    """Return a period from which eigenvalues, by decreasing modulus, cannot be told apart."""
    count = int((np.abs(values) >= 1.0 - _ON_CIRCLE).sum())
    if not period or count % period:
        return period
    turns = np.angle(values[:count]) * count / (2.0 * np.pi)
    places = turns.round()
    each_once = len(set((places % count).tolist())) == count
    return count if each_once and np.abs(turns - places).max() <= count * _ON_CIRCLE else period


def _ends_of_symmetric(diagonal: Floats, beside: Floats) -> Floats:
    """Return the two lowest and the two highest eigenvalues (all, if there are up to four)."""
    n = len(diagonal)
    if n <= 4:
        return np.asarray(eigvalsh_tridiagonal(diagonal, beside))
    ends = [
        eigvalsh_tridiagonal(diagonal, beside, select="i", select_range=ends)
        for ends in ((0, 1), (n - 2, n - 1))
    ]
    return np.concatenate(ends)


def _largest(block: csc_array, period: int) -> NDArray[Any]:
    """Return the largest eigenvalues of a large class, and one off the unit circle among them."""
    n = block.shape[0]
    start, count = np.random.default_rng(0).random(n), period
    while True:
        count = min(2 * count, n - 2) if count > period else period + 1
        try:
            basis = min(max(2 * count + 1, _BASIS), n)
            values = eigs(block, count, v0=start, ncv=basis, maxiter=300, return_eigenvectors=False)
        except ArpackNoConvergence as error:
            raise AccuracyError(
                f"the iteration for the eigenvalues of a class of {n} states didn't converge, "
                "because its gap is so small. Follow the chain with propagate."
            ) from error
        if count == n - 2 or (np.abs(values) < 1.0 - _ON_CIRCLE).any():
            return _falling(values)


def mixing_time(chain: Chain, eps: float = 0.25) -> int:
    """Return the number of steps after which every start is within `eps` of its limit.

    The distance is total variation, half the sum of absolute differences, from the worst start. If
    a closed class is periodic, the average over the next d steps is compared, with d the
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
            f"the chain has {n} states, too many to find its mixing time: the limit is {DENSE}. "
            "Ask for spectral_gap instead."
        )
    period = apparent_period(chain)
    M = evened(chain).toarray()
    average = _average_of_powers(M, period)
    limit = limit_matrix(chain).toarray()

    def far(power: Floats) -> bool:
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
                f"the chain isn't within {eps} of its limit after 2^60 steps, as far as "
                "floats can show. Give a larger eps."
            )
    for i in reversed(range(len(powers) - 1)):
        further = powers[i] @ reached
        if far(further):
            steps, reached = steps + 2**i, further
    return steps + 1


def _average_of_powers(M: Floats, terms: int) -> Floats:
    """Return (I + M + ... + M^(terms - 1)) / terms by doubling, with columns that sum to 1."""
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
