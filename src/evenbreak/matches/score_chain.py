"""The Markov chain of a match's scores, solved by elimination of states.

Only positive numbers are added, multiplied and divided (see `evenbreak.chains.elimination`), so
every answer keeps its relative accuracy however long play goes on. All values may be floats,
arrays of one shape, or fractions.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import Any

from evenbreak.chains.elimination import Elimination

NEVER = "never"
"""The final state that stands for play that never ends."""


def ratio(x: Any, y: Any) -> Any:
    """Return x / y, and 0 where y is 0; floats or arrays.

    >>> ratio(1.0, 4.0), ratio(0.0, 0.0)
    (0.25, 0.0)
    """
    if isinstance(y, float) and isinstance(x, float):
        return x / y if y > 0.0 else 0.0
    import numpy as np

    x, y = np.broadcast_arrays(x, y)
    return np.divide(x, y, out=np.zeros(y.shape), where=y > 0.0)


class _Elimination(Elimination):
    """Elimination of states, some of which may never be left (in arrays, for some entries)."""

    def __init__(self, arcs: list[dict[int, Any]], leaks: list[Any]) -> None:
        self.stays: dict[int, Any] = {}
        super().__init__(arcs, leaks)

    def pivot(self, k: int, outflow: Any) -> Any:
        """Return the outflow, and 1 where it is 0, which is kept in `stays`."""
        stays = outflow == 0.0
        if stays is True or (stays is not False and stays.any()):
            self.stays[k] = stays
            return outflow + stays
        return outflow


class ScoreChain:
    """The absorbing chain of a match's scores, solved for any rewards.

    Parameters
    ----------
    rows
        for each state that is not final, the probability of each next state, with the start
        first; states without a row are final.

    >>> walk = ScoreChain({0: {1: 0.5, -1: 0.5}, 1: {2: 0.5, 0: 0.5}})
    >>> round(walk.solve({2: 1.0})[0], 12)
    0.333333333333
    """

    def __init__(self, rows: Mapping[Hashable, Mapping[Hashable, Any]]) -> None:
        # The states farthest from the start first, so that ties are eliminated from the ends.
        self._place = {state: k for k, state in enumerate(reversed(rows))}
        self._ends: list[dict[Hashable, Any]] = []
        among: list[dict[int, Any]] = []
        for state in self._place:
            row = {t: chance for t, chance in rows[state].items() if t != state}
            self._ends.append({t: chance for t, chance in row.items() if t not in self._place})
            among.append({self._place[t]: chance for t, chance in row.items() if t in self._place})
        self._factor = _Elimination(among, [sum(row.values()) for row in self._ends])

    def solve(
        self,
        final: Mapping[Hashable, Any] | None = None,
        reward: Callable[[Hashable], Any] | None = None,
    ) -> dict[Hashable, Any]:
        """Return the expected total of rewards from each state on.

        Parameters
        ----------
        final
            the reward of each final state, paid once; 0 for states that are not listed.
            `NEVER` stands for play that does not end.
        reward
            the reward of each visit to a state that is not final.

        Returns
        -------
        dict
            the expected total, given the state; final states with a reward included.
        """
        final = final or {}
        own = [0 if reward is None else reward(state) for state in self._place]
        for k, row in enumerate(self._ends):
            for target in row.keys() & final.keys():
                own[k] = own[k] + row[target] * final[target]
        if NEVER in final:
            for k, stays in self._factor.stays.items():
                own[k] = own[k] + stays * final[NEVER]
        return {**final, **dict(zip(self._place, self._factor.values(own), strict=True))}
