"""The Markov chain of a match's scores, solved by elimination of states.

Only positive numbers are added, multiplied and divided (see `evenbreak.chains.elimination`), so
every answer keeps its relative accuracy however long play goes on. All values may be floats,
arrays of one shape, or fractions.
"""

from __future__ import annotations

from collections import defaultdict
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
        endless = _endless(rows)
        # The states farthest from the start first, so that ties are eliminated from the ends.
        self._place = {state: k for k, state in enumerate(reversed(rows))}
        self._ends: list[dict[Hashable, Any]] = []
        among: list[dict[int, Any]] = []
        for state in self._place:
            row = {t: chance for t, chance in rows[state].items() if t != state}
            if state in endless:
                row[NEVER] = row.get(NEVER, 0) + endless[state]
            self._ends.append({t: chance for t, chance in row.items() if t not in self._place})
            among.append({self._place[t]: chance for t, chance in row.items() if t in self._place})
        self._factor = Elimination(among, [sum(row.values()) for row in self._ends])

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
        return {**final, **dict(zip(self._place, self._factor.values(own), strict=True))}


def _endless(rows: Mapping[Hashable, Mapping[Hashable, Any]]) -> dict[Hashable, Any]:
    """Return 1 for each state from which play cannot end; arrays where that differs by entry."""
    before = defaultdict[Hashable, list[tuple[Hashable, Any]]](list)
    for state, row in rows.items():
        for target, chance in row.items():
            if (possible := _truth(chance > 0)) is not False:
                before[target].append((state, possible))
    ends: dict[Hashable, Any] = dict.fromkeys(before.keys() - rows.keys(), True)
    queue = list(ends)
    while queue:
        target = queue.pop()
        for state, possible in before[target]:
            known = ends.get(state, False)
            reached = _truth(known | (possible & ends[target]))
            if known is not True and _truth(reached == known) is not True:
                ends[state] = reached
                queue.append(state)
    return {state: 1 - 1 * ends.get(state, False) for state in rows if ends.get(state) is not True}


def _truth(answer: Any) -> Any:
    """Return True or False for what is so everywhere or nowhere; else the array."""
    if isinstance(answer, bool):
        return answer
    return True if answer.all() else answer if answer.any() else False
