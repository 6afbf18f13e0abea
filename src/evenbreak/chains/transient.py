"""The transient part of a chain, and the two solves from which all else is made.

With T the arcs among the transient states (T[i, j] = P(j -> i)):

- visits: x = (I - T)^-1 b, the expected number of visits to each state from the density b;
- values: y = (I - T)^-T r, the expected sum of r over all visits, from each state.

Both are free of subtraction for nonnegative b and r; a right-hand side with both signs is
to be split in its positive and its negative part by who asks. The states are taken class by
class, upstream first, and each class by the method that suits it: see `factorisation`. An
answer that over- or underflow may have touched is worked out again in wider numbers.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.chains.arcs import reachable
from evenbreak.chains.decimal_elimination import decimal_solve, rows_of
from evenbreak.chains.elimination import Elimination
from evenbreak.chains.factorisation import Factorisation
from evenbreak.errors import AccuracyError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.chains.arcs import Arcs, Places

_FEW_STATES, _FEW_ARCS = 100, 300


class TransientPart:
    """(I - T)^-1 for a set of states, from each of which the other states can be reached.

    Parameters
    ----------
    arcs
        the arcs of the whole chain.
    states
        positions of the states, increasing; shape (m,).

    >>> from scipy.sparse import csc_array
    >>> from evenbreak.chains import Chain
    >>> chain = Chain("ab", csc_array([[0.75, 0.0], [0.25, 1.0]]))
    >>> chain.transient.visits(np.array([1.0]))
    array([4.])
    """

    def __init__(self, arcs: Arcs, states: Places) -> None:
        self.states = states
        self._arcs, self._leak = arcs.among(states)
        self._outflow = arcs.outflow[states]

    @cached_property
    def _factor(self) -> _InPlainPython | Factorisation:
        if len(self.states) <= _FEW_STATES and len(self._arcs.chances) <= _FEW_ARCS:
            return _InPlainPython(self._arcs, self._leak)
        return Factorisation(self._arcs, self._leak, self._outflow)

    @cached_property
    def _steps(self) -> NDArray[np.float64]:
        """The steps before the states are left, from each; nothing of them can underflow.

        What is lost from r at one state is lost at each visit to it. The visits themselves
        lose only what is lost of the flow through a state over its pivot.
        """
        return self._factor.values(np.ones((len(self.states), 1)))[:, 0]

    @property
    def residual(self) -> float | None:
        """None where each entry of the answers so far is right to about machine precision.

        Otherwise, after a large class without a narrow band: the largest entry of
        b - (I - T) x, in units of the largest of b, where no better could be certified.
        """
        factor = self.__dict__.get("_factor")
        return None if factor is None else factor.residual

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-1 b: the expected visits to each state, given the start density b.

        Parameters
        ----------
        b
            shape (m,) or (m, k), in the order of `states`; nonnegative, but need not be a
            density.

        Raises
        ------
        AccuracyError
            if an entry is larger than any float, or cannot be vouched for.
        """
        return self._vouched(b, transposed=False)

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-T r: the expected sum of r over all visits, given each start state.

        Parameters
        ----------
        r
            shape (m,) or (m, k), in the order of `states`; nonnegative.

        Raises
        ------
        AccuracyError
            if an entry is larger than any float, or cannot be vouched for.
        """
        return self._vouched(r, transposed=True)

    def attempt(
        self, b: NDArray[np.float64], *, transposed: bool = False
    ) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """Return the visits (or values), and where under- or overflow may have touched them.

        Both have the shape (m, k) of `b`.
        """
        try:
            with np.errstate(all="ignore"):
                if transposed:
                    x, gain = self._factor.values(b), self._steps
                else:
                    x = self._factor.visits(b)
                    gain = 1.0 / self._factor.pivots
                doubtful = _doubtful(x, gain)
        except (np.linalg.LinAlgError, ZeroDivisionError):
            # A pivot, which is a sum of positive arcs, has vanished: it was below all floats.
            x, doubtful = np.full(b.shape, np.nan), np.ones(b.shape, dtype=bool)
        for k in np.flatnonzero(doubtful.any(axis=0)):
            doubtful[:, k] &= self._reached(b[:, k], transposed=transposed)
        return x, doubtful

    def _vouched(self, b: NDArray[np.float64], *, transposed: bool) -> NDArray[np.float64]:
        given = np.asarray(b, dtype=np.float64)
        if not given.size:
            return given.copy()
        columns = given.reshape(len(self.states), -1)
        x, doubtful = self.attempt(columns, transposed=transposed)
        again = np.flatnonzero(doubtful.any(axis=0))
        if len(again):
            x[:, again] = decimal_solve(
                self._arcs, self._leak, columns[:, again], transposed=transposed
            )
        if not np.isfinite(x).all():
            raise AccuracyError(
                "an expected number of visits, or a sum over them, is larger than any float; "
                "the chain leaves some states too rarely"
            )
        return x.reshape(given.shape)

    def _reached(self, b: NDArray[np.float64], *, transposed: bool) -> NDArray[np.bool_]:
        """Return the states that the graph joins to those where b is not 0."""
        near, far = self._arcs.sources, self._arcs.targets
        if transposed:
            near, far = far, near
        return reachable(len(self.states), near, far, b != 0.0)


class _InPlainPython:
    """Elimination with a dictionary for each state: the fastest for some dozen states."""

    residual = None

    def __init__(self, arcs: Arcs, leak: NDArray[np.float64]) -> None:
        self._elimination = Elimination(rows_of(arcs), leak.tolist())
        self.pivots = np.array(self._elimination.pivots)

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([self._elimination.visits(column) for column in b.T.tolist()]).T

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([self._elimination.values(column) for column in r.T.tolist()]).T


def _doubtful(x: NDArray[np.float64], gain: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Return where underflow may show in x, of shape (m, k); all where x has overflowed.

    What underflows is lost by at most 2^-1074 a term, times the largest of x, and `gain`,
    of shape (m,), is what becomes of a loss. That matters where it is not small beside x,
    unless x is below all normal floats anyway.
    """
    top = x.max()
    if not top < np.inf:
        return np.ones(x.shape, dtype=bool)
    scale = len(x) * max(1.0, top)
    low: NDArray[np.bool_] = ~(x >= 1e-290 * scale * gain[:, None])
    if low.any():
        # By logarithms, in which neither side can leave the range of floats.
        lost = np.log2(scale) - 1074 + np.log2(gain)[:, None]
        low &= ~(lost <= np.maximum(np.log2(x) - 47, -1022))
    return low
