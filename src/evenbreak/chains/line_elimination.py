"""Elimination for a class whose states stand in a line, every second state at a time.

No two states at odd places are neighbours, so they can all be eliminated at once, in one
vector operation; half the states are left, again in a line. After log2(n) rounds none is.
This is the elimination of Grassmann, Taksar and Heyman in the order of cyclic reduction
(Hockney 1965), and as free of subtraction as any other order.

It works in the platform's extended precision: where all arcs are alike, each round repeats
the rounding errors of the round before, and n units in the last place of a double would
show at n = 10,000; and the arcs between states far apart are smaller than any double.

Where a long double is no wider than a double (Windows, some ARM) there are no extra digits to
work in: a line of n equal states may then be off by some n units in the last place, and arcs
between states far apart may underflow, which the solves that use this notice.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Wide = NDArray[np.longdouble]


class _Round(NamedTuple):
    """The states at odd places: their pivots, their shares down and up, and arcs to them."""

    pivot: Wide
    down: Wide
    up: Wide
    from_left: Wide
    from_right: Wide


class PathElimination:
    """(I - T) factored, where T moves each state of a line to its neighbours only.

    Parameters
    ----------
    up, down
        shape (m - 1,): the arcs from i to i + 1, and from i + 1 to i; positive.
    leak
        shape (m,): the probability to leave the line, given the state; not all zero.
    """

    def __init__(
        self, up: NDArray[np.float64], down: NDArray[np.float64], leak: NDArray[np.float64]
    ) -> None:
        self._rounds: list[_Round] = []
        u = np.append(up, 0.0).astype(np.longdouble)
        d = np.concatenate(([0.0], down)).astype(np.longdouble)
        leaks = leak.astype(np.longdouble)
        pivots = np.empty(len(leak))
        place = np.arange(len(leak))
        while len(leaks) > 1:
            pivot = u[1::2] + d[1::2] + leaks[1::2]
            share_up, share_down, share_leak = u[1::2] / pivot, d[1::2] / pivot, leaks[1::2] / pivot
            from_left, from_right = u[0::2][: len(pivot)], d[2::2]
            self._rounds.append(_Round(pivot, share_down, share_up, from_left, from_right))
            pivots[place[1::2]] = pivot
            inner = len(from_right)
            leaks = leaks[0::2].copy()
            leaks[: len(pivot)] += from_left * share_leak
            leaks[1 : inner + 1] += from_right * share_leak[:inner]
            u, d = np.zeros_like(leaks), np.zeros_like(leaks)
            u[: len(pivot)] = from_left * share_up
            d[1 : inner + 1] = from_right * share_down[:inner]
            place = place[0::2]
        self._last = leaks
        pivots[place] = leaks
        self.pivots: NDArray[np.float64] = pivots

    def visits(self, b: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-1 b for b >= 0 of shape (m, k)."""
        x = b.astype(np.longdouble)
        waiting = []
        for pivot, down, up, _, from_right in self._rounds:
            odd, x = x[1::2], x[0::2].copy()
            inner = len(from_right)
            x[: len(pivot)] += odd * down[:, None]
            x[1 : inner + 1] += (odd * up[:, None])[:inner]
            waiting.append(odd)
        x /= self._last[:, None]
        for (pivot, _, _, from_left, from_right), odd in zip(
            reversed(self._rounds), reversed(waiting), strict=True
        ):
            inner = len(from_right)
            odd = odd + x[: len(pivot)] * from_left[:, None]
            odd[:inner] += x[1 : inner + 1] * from_right[:, None]
            x = _interleaved(x, odd / pivot[:, None])
        return x.astype(np.float64)

    def values(self, r: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return (I - T)^-T r for r >= 0 of shape (m, k)."""
        y = r.astype(np.longdouble)
        waiting = []
        for pivot, _, _, from_left, from_right in self._rounds:
            odd, y = y[1::2] / pivot[:, None], y[0::2].copy()
            inner = len(from_right)
            y[: len(pivot)] += odd * from_left[:, None]
            y[1 : inner + 1] += odd[:inner] * from_right[:, None]
            waiting.append(odd)
        y /= self._last[:, None]
        for (pivot, down, up, _, from_right), odd in zip(
            reversed(self._rounds), reversed(waiting), strict=True
        ):
            inner = len(from_right)
            odd = odd + y[: len(pivot)] * down[:, None]
            odd[:inner] += y[1 : inner + 1] * up[:inner, None]
            y = _interleaved(y, odd)
        return y.astype(np.float64)


def _interleaved(even: Wide, odd: Wide) -> Wide:
    whole = np.empty((len(even) + len(odd), even.shape[1]), dtype=np.longdouble)
    whole[0::2], whole[1::2] = even, odd
    return whole
