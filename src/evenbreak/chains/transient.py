"""The transient part of a chain, and the two solves on which everything else is based.

With T the arcs among the transient states (T[i, j] = P(j -> i)):

- visits: x = (I - T)^-1 b, the expected number of visits to each state from the vector b;
- values: y = (I - T)^-T r, the expected sum of r over all visits, from each state.

Both are free of subtraction for nonnegative b and r; callers split a right-hand side of
both signs into its positive and its negative part. The states are taken class by class,
upstream first, and each class is solved by the method that suits it (see `factorization`). An
answer that overflow or underflow may have affected is recomputed in decimal numbers.

References: Kemeny and Snell 1960, Finite Markov Chains, chapter III, for the fundamental
matrix (I - T)^-1; Alfa, Xue and Ye 2002 for its accuracy, entry by entry.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from evenbreak.arrays import Bools, Floats
from evenbreak.chains.arcs import Arcs, Places, reachable
from evenbreak.chains.elimination import MOST_ARCS, DecimalElimination, PlainElimination
from evenbreak.chains.factorization import Factorization
from evenbreak.errors import AccuracyError

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

    def __repr__(self) -> str:
        return f"<TransientPart of {len(self.states)} states, {len(self._arcs.chances)} arcs>"

    @cached_property
    def _factor(self) -> PlainElimination | Factorization:
        if len(self.states) <= _FEW_STATES and len(self._arcs.chances) <= _FEW_ARCS:
            return PlainElimination(self._arcs, self._leak)
        return Factorization(self._arcs, self._leak, self._outflow)

    @cached_property
    def _steps(self) -> Floats:
        """The expected steps until the states are left, from each of them; none underflows.

        They bound the effect of underflow: a loss in r at a state is lost again at each visit to
        it. Visits lose only the loss in the flow through a state, divided by its pivot.
        """
        return self._factor.values(np.ones((len(self.states), 1)))[:, 0]

    @property
    def bound(self) -> float | None:
        """A proved bound on the relative errors of the answers so far.

        None if all classes were eliminated without subtraction: then every entry is accurate to a
        few units in the last place times the length of the paths to it.
        """
        factor = self.__dict__.get("_factor")
        return None if factor is None else factor.bound

    def visits(self, b: Floats) -> Floats:
        """Return (I - T)^-1 b: the expected visits to each state, given starting chances b.

        Parameters
        ----------
        b
            shape (m,) or (m, k), in the order of `states`; nonnegative, not necessarily with sum 1.

        Raises
        ------
        AccuracyError
            if an entry is larger than any float, or cannot be guaranteed.
        """
        return self._guaranteed(b, transposed=False)

    def values(self, r: Floats) -> Floats:
        """Return (I - T)^-T r: the expected sum of r over all visits, given each start state.

        Parameters
        ----------
        r
            shape (m,) or (m, k), in the order of `states`; nonnegative.

        Raises
        ------
        AccuracyError
            if an entry is larger than any float, or cannot be guaranteed.
        """
        return self._guaranteed(r, transposed=True)

    def attempt(self, b: Floats, *, transposed: bool = False) -> tuple[Floats, Bools]:
        """Return the visits (or values), and where overflow or underflow may have affected them.

        Both have the shape (m, k) of `b`.
        """
        try:
            with np.errstate(all="ignore"):
                x = self._factor.values(b) if transposed else self._factor.visits(b)
                if self._factor.is_proved and x.max() < np.inf:
                    return x, np.zeros(b.shape, dtype=bool)
                gain = self._steps if transposed else 1.0 / self._factor.pivots
                doubtful = where_doubtful(x, gain)
        except (np.linalg.LinAlgError, ZeroDivisionError):
            # A pivot, a sum of positive arcs, was smaller than any float.
            x, doubtful = np.full(b.shape, np.nan), np.ones(b.shape, dtype=bool)
        # Answers differ from 0 only where arcs, forwards or backwards, lead from what is given.
        ends = self._arcs.sources, self._arcs.targets
        for k in np.flatnonzero(doubtful.any(axis=0)):
            near, far = reversed(ends) if transposed else ends
            doubtful[:, k] &= reachable(len(b), near, far, b[:, k] != 0.0)
        return x, doubtful

    def _guaranteed(self, b: Floats, *, transposed: bool) -> Floats:
        right = np.asarray(b, dtype=np.float64)
        if not right.size:
            return right.copy()
        columns = right.reshape(len(self.states), -1)
        x, doubtful = self.attempt(columns, transposed=transposed)
        again = np.flatnonzero(doubtful.any(axis=0))
        if len(again):
            factor = DecimalElimination(self._arcs, self._leak, MOST_ARCS)
            x[:, again] = (factor.values if transposed else factor.visits)(columns[:, again])
        if not np.isfinite(x).all():
            raise AccuracyError(
                "an expected number of visits, or a sum of several, is too large for a float: "
                "the chain leaves some states too rarely"
            )
        return x.reshape(right.shape)


def where_doubtful(x: Floats, gain: Floats) -> Bools:
    """Return where underflow may affect x, of shape (m, k); everywhere if x has overflowed.

    Underflow loses at most 2^-1074 per term, times the largest entry of x; `gain`, of shape (m,),
    is the effect of a loss on the answer. It matters where the effect is not small compared with x,
    unless x is below all normal floats anyway.
    """
    top = x.max()
    if not top < np.inf:
        return np.ones(x.shape, dtype=bool)
    scale = len(x) * max(1.0, top)
    low: Bools = ~(x >= 1e-290 * scale * gain[:, None])
    if low.any():
        # By logarithms, in which neither side can leave the range of floats.
        lost = np.log2(scale) - 1074 + np.log2(gain)[:, None]
        low &= ~(lost <= np.where(x < 2.0**-1021, -1022, np.log2(x) - 47))
    return low
