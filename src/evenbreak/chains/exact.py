"""A chain's answers in exact fractions.

A chance given as a `Fraction` or a string is used unchanged, and a float as the decimal that it
prints: 0.6 is 3/5. A listed self-loop gets the remainder of its state's other arcs; the arcs of
every other state must sum to exactly 1.

States with few arcs are eliminated. With many arcs, the fractions would grow with every step, so
the rest is solved differently.

The rest is solved modulo the powers of a prime. With each column of I - T brought to whole numbers
by its common denominator, A = (I - T) D, and C = A^-1 modulo a prime p, the digits y_k in base p of
the solution of A x = b are

    y_k = C r_k  mod p,   r_0 = b,   r_(k+1) = (r_k - A y_k) / p.

Numerators and denominators are minors of A, and no minor of such a matrix is larger than the
product of its diagonal; twice as many digits as that determine each fraction. This takes n^2
operations per digit on machine integers, while elimination would take n^3 on fractions with
thousands of digits.

References: Kemeny and Snell 1960, Finite Markov Chains, chapter III; Dixon 1982, "Exact solution
of linear equations using p-adic expansions"; Wang 1981 for the fractions.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import Bools, Ints
from evenbreak.chains.arcs import reachable
from evenbreak.chains.elimination import Elimination, Rows, eliminated, limit_in, masses_in, rows_of
from evenbreak.errors import AccuracyError, ChainError

if TYPE_CHECKING:
    from evenbreak.chains.chain import Chain


_FILL = 8
"""New arcs per state up to which states are eliminated in fractions."""


class ExactPassage(NamedTuple):
    """The number of steps to a target, in fractions.

    Parameters
    ----------
    p_reached, p_never
        the chances that the target is reached, and that it never is.
    mean_if_reached, variance_if_reached
        of the number of steps, given that the target is reached; None if it cannot be.
    """

    p_reached: Fraction
    p_never: Fraction
    mean_if_reached: Fraction | None
    variance_if_reached: Fraction | None


def exact_limit(chain: Chain, start: Any) -> dict[Any, Fraction]:
    """Return the stochastic limit of each state.

    >>> from evenbreak.chains import chain_of
    >>> exact_limit(chain_of([("rain", "sun", "1/3"), ("rain", "rain", "2/3"), ("sun", "rain", 1)],
    ...                      start="sun"), None)
    {'rain': Fraction(3, 4), 'sun': Fraction(1, 4)}
    """
    rows, v = exact_rows(chain), exact_start(chain, start)
    limit = limit_in(chain.structure, rows, v, _visits)
    return {state: Fraction(limit.get(k, 0)) for k, state in enumerate(chain.states)}


def exact_absorption(chain: Chain, start: Any) -> NDArray[np.object_]:
    """Return the probability of ending in each class, given the start."""
    rows, v = exact_rows(chain), exact_start(chain, start)
    masses = masses_in(chain.structure, rows, v, _visits)
    return np.array([Fraction(masses.get(k, 0)) for k in range(chain.structure.count)], object)


def exact_passage(chain: Chain, start: Any, ends: Bools) -> ExactPassage:
    """Return how many steps it takes to reach any of the `ends`.

    If u is the expected number of steps on the paths that reach them, and w is the expected sum of
    u, the second moment is 2 w - u.
    """
    rows, v = exact_rows(chain), exact_start(chain, start)
    arcs = chain.arcs
    hopeful = reachable(len(chain), arcs.targets, arcs.sources, ends) & ~ends
    states = np.flatnonzero(hopeful).tolist()
    factor = _factor(rows, states)
    hope = factor.values([sum(p for i, p in rows[j].items() if ends[i]) for j in states])
    steps = factor.values(hope)
    squares = factor.values(steps)
    begun = [v.get(j, Fraction(0)) for j in states]
    reached = sum((x for j, x in v.items() if ends[j]), _dot(begun, hope))
    mean = variance = None
    if reached:
        mean = _dot(begun, steps) / reached
        variance = 2 * _dot(begun, squares) / reached - mean - mean**2
    return ExactPassage(reached, 1 - reached, mean, variance)


def exact_chance(value: Any) -> Fraction:
    """Convert a number to a fraction: a float as the decimal that it prints.

    >>> exact_chance(0.6), exact_chance("0.6"), exact_chance(Fraction(2, 3))
    (Fraction(3, 5), Fraction(3, 5), Fraction(2, 3))
    """
    return Fraction(repr(float(value)) if isinstance(value, float) else value)


def exact_rows(chain: Chain) -> Rows:
    """Return the arcs between different states, by source.

    Raises ChainError if the arcs of a state without a self-loop do not sum to exactly 1, or if the
    arcs of a state with one sum to more than 1.
    """
    rows: Rows = [
        {i: chain.given.get((j, i)) or exact_chance(p) for i, p in row.items()}
        for j, row in enumerate(rows_of(chain.arcs))
    ]
    loops = (chain.matrix.diagonal() > 0.0).tolist()
    for state, row, loop in zip(chain.states, rows, loops, strict=True):
        numerators, whole = whole_numbers(row.values())
        total = Fraction(sum(numerators), whole)
        if total > 1 or (total < 1 and not loop):
            raise ChainError(
                f"the arcs out of state {state!r} sum to {_shown(total)}, not to exactly 1. For "
                "an exact answer, give them as fractions, or as decimals that sum to 1."
            )
    return rows


def exact_start(chain: Chain, start: Any) -> dict[int, Fraction]:
    """Return the start as a vector: the probability at each position that has one."""
    at = chain.start_index(start)
    if at is not None:
        return {at: Fraction(1)}
    chain.density(start)  # refuses what is no density
    chances = start.items() if isinstance(start, Mapping) else zip(chain.states, start, strict=True)
    density = {chain.index(state): exact_chance(p) for state, p in chances if p}
    if sum(density.values()) != 1:
        raise ChainError(
            f"the start vector sums to {_shown(sum(density.values()))}, not to exactly 1. For an "
            "exact answer, give fractions, or decimals that sum to 1."
        )
    return density


def _visits(rows: Rows, states: Sequence[int], b: list[Any]) -> list[Any]:
    return _factor(rows, states).visits(b)


def _factor(rows: Rows, states: Sequence[int]) -> Elimination:
    """Return I - T factored, with T the arcs among the states."""
    return eliminated(rows, states, _FILL * len(states), Lifting)


def _dot(x: Sequence[Fraction], y: Sequence[Fraction]) -> Fraction:
    return sum((a * b for a, b in zip(x, y, strict=True) if a), Fraction(0))


def _shown(total: Any) -> str:
    text = str(total)
    return text if len(text) <= 40 else f"1 {'+' if total > 1 else '-'} {abs(float(total - 1)):.2g}"


_BITS = 24
"""Bits of primes and of parts of entries: 2^15 products of two of them fit 64 bits."""


_STEP = 16
"""Number of products of two `_BITS`-bit numbers whose sum a float holds exactly."""
_MOST_STATES = 1000
"""Limit on states; this many take 5 to 15 seconds. So many take 5 to 15 seconds."""


class Lifting:
    """(I - T) in fractions, where T holds the arcs among transient states.

    `arcs[j][i]` is the probability of i, given j, for i other than j; `leaks[j]` is that of leaving
    for good, given j. Raises AccuracyError if there are more than 1000 states.
    """

    def __init__(self, arcs: Sequence[Mapping[int, Fraction]], leaks: Sequence[Fraction]) -> None:
        n = len(leaks)
        if n > _MOST_STATES:
            raise AccuracyError(
                f"there are too many arcs among {n} states for an answer in fractions. Leave out "
                f"exact, or split the chain until at most {_MOST_STATES} states are left."
            )
        A = np.zeros((n, n), dtype=object)
        self._whole = []
        for j, (row, leak) in enumerate(zip(arcs, leaks, strict=True)):
            numerators, whole = whole_numbers([*row.values(), leak])
            self._whole.append(whole)
            A[list(row), j] = [-x for x in numerators[:-1]]
            A[j, j] = sum(numerators)
        self._bound = math.prod(A.diagonal().tolist())
        self._parts = list(_parts(A))
        self._prime, self._inverse = _inverse(A)

    def visits(self, b: Sequence[Fraction]) -> list[Fraction]:
        """Return x = (I - T)^-1 b, for b >= 0: the expected visits to each state."""
        scaled = self._solved(b, transposed=False)
        return [x * whole for x, whole in zip(scaled, self._whole, strict=True)]

    def values(self, r: Sequence[Fraction]) -> list[Fraction]:
        """Return y = (I - T)^-T r, for r >= 0: the expected sum of r over the visits."""
        right = [x * whole for x, whole in zip(r, self._whole, strict=True)]
        return self._solved(right, transposed=True)

    def _solved(self, b: Sequence[Fraction], *, transposed: bool) -> list[Fraction]:
        """Return A^-1 b or A^-T b."""
        numerators, whole = whole_numbers(b)
        p, bound = self._prime, self._bound * max(sum(numerators), 1)
        inverse = self._inverse.T if transposed else self._inverse
        rest = np.array(numerators, dtype=object)
        modulus, digits = 1, []
        while modulus <= 2 * bound * bound:
            digit = inverse @ (rest % p).astype(np.int64) % p
            for k, part in enumerate(self._parts):
                product = (part.T if transposed else part) @ digit
                rest = rest - (product.astype(object) << _BITS * k)
            rest //= p
            digits.append(digit)
            modulus *= p
        x = np.zeros(len(b), dtype=object)
        for digit in reversed(digits):
            x = x * p + digit.astype(object)
        return [value / whole for value in _fractions(x.tolist(), modulus, bound)]


def whole_numbers(numbers: Iterable[Fraction]) -> tuple[list[int], int]:
    """Return the numerators of fractions over their least common denominator, and the denominator.

    >>> whole_numbers([Fraction(1, 2), Fraction(1, 3)])
    ([3, 2], 6)
    """
    pairs = [number.as_integer_ratio() for number in numbers]
    whole = math.lcm(*(below for _, below in pairs))
    return [above * (whole // below) for above, below in pairs], whole


def _parts(A: NDArray[np.object_]) -> Iterator[Ints]:
    """Yield A split into parts of `_BITS` bits, lowest first."""
    sign, rest = np.where(A < 0, -1, 1), abs(A)
    while rest.any():
        yield sign * (rest % (1 << _BITS)).astype(np.int64)
        rest = rest >> _BITS


def _inverse(A: NDArray[np.object_]) -> tuple[int, Ints]:
    """Return a prime, and the inverse of A modulo that prime."""
    for prime in _primes():
        with suppress(ValueError):  # a pivot is 0 modulo this prime
            return prime, _inverse_modulo(prime, (A % prime).astype(np.int64))
    raise AssertionError("unreachable")


def _inverse_modulo(prime: int, W: Ints) -> Ints:
    """Return the inverse of W modulo a prime, by block Gauss-Jordan elimination."""
    n = len(W)
    if n == 1:
        return np.array([[pow(int(W[0, 0]), -1, prime)]])
    step = _STEP if n > _STEP else 1
    for first in range(0, n, step):
        block = slice(first, first + step)
        inner = _inverse_modulo(prime, W[block, block].copy())
        rows = inner @ W[block] % prime
        rows[:, block] = inner
        columns = W[:, block].astype(np.float64)
        columns[block] = 0.0
        W[:, block] = 0
        W = (W - (columns @ rows.astype(np.float64)).astype(np.int64)) % prime
        W[block] = rows
    return W


def _primes() -> Iterator[int]:
    """Yield the primes below 2^24, from the largest down."""
    for q in range(2**_BITS - 1, 2, -2):
        if all(q % d for d in range(3, math.isqrt(q) + 1, 2)):
            yield q


def _fractions(residues: Sequence[int], modulus: int, bound: int) -> Iterator[Fraction]:
    """Yield the fractions represented by the residues, with no part above the bound."""
    common = 1
    for residue in residues:
        above = residue * common % modulus
        if above > bound:
            # Euclid's algorithm, as far as the numerator
            before, s, t = modulus, 0, 1
            while above > bound:
                quotient = before // above
                before, above = above, before - quotient * above
                s, t = t, s - quotient * t
            common *= abs(t)
            above = residue * common % modulus
        yield Fraction(above, common)
