"""Absorption in a small chain by elimination of states, without one subtraction.

To eliminate a state is to watch the chain only while it is elsewhere: who led to the
state now leads, in proportion, to where the state leads. The chance of leaving a
state is summed from the ways out, never formed as 1 minus the chance of staying
(Grassmann, Taksar & Heyman 1985; O'Cinneide 1993), so every answer keeps its relative
accuracy however long play goes on. All values may be floats or arrays of one shape:
the order of elimination does not depend on them.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import Any

NEVER = "never"
"""Where a chain goes that can neither end nor leave a set of states."""


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


class Elimination:
    """The eliminated form of an absorbing chain; solves for any rewards.

    Parameters
    ----------
    rows
        for each state that is not final, the probability of each next state; states
        without a row are final. The first row is that of the state in which play starts.

    >>> walk = Elimination({0: {1: 0.5, -1: 0.5}, 1: {2: 0.5, 0: 0.5}})
    >>> round(walk.solve({2: 1.0})[0], 12)
    0.333333333333
    """

    def __init__(self, rows: Mapping[Hashable, Mapping[Hashable, Any]]) -> None:
        self.order = _farthest_first(rows)
        self._before: dict[Hashable, dict[Hashable, Any]] = {}
        self._after: dict[Hashable, dict[Hashable, Any]] = {}
        self._out: dict[Hashable, Any] = {}
        self._eliminate({state: dict(row) for state, row in rows.items()})

    def _eliminate(self, rows: dict[Hashable, dict[Hashable, Any]]) -> None:
        leading_to: dict[Hashable, set[Hashable]] = {state: set() for state in rows}
        for state, row in rows.items():
            for target in row:
                if target in leading_to:
                    leading_to[target].add(state)
        for state in self.order:
            row = rows.pop(state)
            row.pop(state, None)
            out = _keep_positive(row)
            shares = {target: chance / out for target, chance in row.items()}
            before = {}
            for source in leading_to.pop(state):
                if source in rows:
                    before[source] = weight = rows[source].pop(state)
                    for target, share in shares.items():
                        rows[source][target] = rows[source].get(target, 0.0) + weight * share
                        if target in leading_to:
                            leading_to[target].add(source)
            self._before[state], self._after[state], self._out[state] = before, shares, out

    def solve(
        self,
        final: Mapping[Hashable, Any] | None = None,
        reward: Callable[[Hashable], Any] | None = None,
    ) -> dict[Hashable, Any]:
        """Return the expected total of rewards from each state on.

        Parameters
        ----------
        final
            the reward of each final state, paid once; 0 where it is not listed.
            `NEVER` stands for play that does not end.
        reward
            the reward of each visit of a state that is not final.

        Returns
        -------
        dict
            the expected total, given the state; final states with a reward included.
        """
        total: dict[Hashable, Any] = dict(final or {})
        own = {}
        if reward is not None:
            own = {state: reward(state) for state in self.order}
            for state in self.order:
                own[state] = own[state] / self._out[state]
                for source, weight in self._before[state].items():
                    own[source] = own[source] + weight * own[state]
        for state in reversed(self.order):
            value = own.get(state, 0.0)
            for target, share in self._after[state].items():
                if target in total:
                    value = value + share * total[target]
            total[state] = value
        return total


def _keep_positive(row: dict[Hashable, Any]) -> Any:
    """Return the chance of leaving; where it is zero, play stays for ever: lead to NEVER."""
    out = sum(row.values(), 0.0)
    if isinstance(out, float):
        if out == 0.0:
            row[NEVER] = out = 1.0
        return out
    import numpy as np

    stuck = out == 0.0
    if stuck.any():
        row[NEVER] = row.get(NEVER, 0.0) + stuck
        out = np.where(stuck, 1.0, out)
    return out


def _farthest_first(rows: Mapping[Hashable, Mapping[Hashable, Any]]) -> list[Hashable]:
    """Return the states by the steps that they are away from the first one, most steps first.

    Scores then come after all scores that they lead to, and leads from the two ends of
    the line inwards, so that elimination hardly lengthens a row.
    """
    order = list(rows)[:1]
    seen = set(order)
    for state in order:
        for target in rows[state]:
            if target in rows and target not in seen:
                seen.add(target)
                order.append(target)
    return order[::-1] + [state for state in rows if state not in seen]
