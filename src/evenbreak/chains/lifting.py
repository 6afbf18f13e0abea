"""Exact solution of a dense system in whole numbers, modulo the powers of a prime.

With each column of I - T brought to whole numbers by its common denominator, A = (I - T) D, and
C = A^-1 modulo a prime p, the digits y_k in base p of the solution of A x = b are

    y_k = C r_k  mod p,   r_0 = b,   r_(k+1) = (r_k - A y_k) / p.

Numerators and denominators are minors of A, and no minor of such a matrix is larger than the
product of its diagonal; with twice the digits of that, each fraction is known. All this takes
n^2 operations a digit on whole numbers of the machine, where elimination would take n^3 on
fractions with thousands of digits.

References: Dixon 1982, "Exact solution of linear equations using p-adic expansions"; Wang 1981
for the fractions.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.arrays import Ints

_BITS = 24
"""Primes and parts of entries have so many: 2^15 products of two of them fit 64 bits."""


_STEP = 16
"""So many products of two numbers of `_BITS` bits add up to a whole number that a float holds."""
_MOST_STATES = 1000
"""More are refused. So many take 5 to 15 seconds."""


class Lifting:
    """(I - T) for fractions, where T holds the arcs of transient states among themselves.

    Parameters
    ----------
    arcs
        `arcs[j][i]`: the probability of i, given j, for i other than j.
    leaks
        `leaks[j]`: the probability of leaving for good, given j.

    Raises
    ------
    AccuracyError
        if there are more than 1000 states.
    """

    def __init__(self, arcs: Sequence[Mapping[int, Fraction]], leaks: Sequence[Fraction]) -> None:
        n = len(leaks)
        if n > _MOST_STATES:
            raise AccuracyError(
                f"{n} states have too many arcs among them for an answer in fractions; leave exact "
                f"out, or split the chain until at most {_MOST_STATES} are left"
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
    """Return the numerators of fractions over their least common denominator, and that.

    >>> whole_numbers([Fraction(1, 2), Fraction(1, 3)])
    ([3, 2], 6)
    """
    pairs = [number.as_integer_ratio() for number in numbers]
    whole = math.lcm(*(below for _, below in pairs))
    return [above * (whole // below) for above, below in pairs], whole


def _parts(A: NDArray[np.object_]) -> Iterator[Ints]:
    """Yield A cut into parts of `_BITS` bits, the lowest first."""
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
    """Return the inverse of W modulo a prime, by Gauss-Jordan elimination of blocks."""
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
    """Yield the primes below 2^24, from the largest on."""
    for q in range(2**_BITS - 1, 2, -2):
        if all(q % d for d in range(3, math.isqrt(q) + 1, 2)):
            yield q


def _fractions(residues: Sequence[int], modulus: int, bound: int) -> Iterator[Fraction]:
    """Yield the fractions that are the residues, no part of any of them above the bound."""
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
