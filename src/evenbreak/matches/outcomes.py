"""Outcomes of a match, from the outcomes of its racks or sets, and the chance of a shutout.

The outcome of a unit (a rack or a set) is (winner, next breaker), with its probability and the
mean and standard deviation of the number of racks it takes, given who breaks first in it. The
score after each unit is a small Markov chain; absorption in it gives the outcomes of the match
in the same form, so a match can be a unit of a longer match. Floats and arrays of the same shape
are treated alike.

A mean may be as large as 1e300 racks, whose square is too large for a float, so squares are in
units of the largest mean.

The chain of the scores is solved by elimination of states. Only positive numbers are added,
multiplied and divided (see `evenbreak.chains.elimination`), so every answer keeps its relative
accuracy no matter how long play continues. All values may be floats, arrays of one shape, or
fractions.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, overload

from evenbreak.chains.elimination import Elimination
from evenbreak.checks import one_of
from evenbreak.games.ahead import Ahead
from evenbreak.games.match import Match, Score
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.ahead_chances import ahead_chances
from evenbreak.matches.parameters import at_score, first_breaker, in_shape, unit_of

if TYPE_CHECKING:
    from evenbreak.arrays import Floats


class Outcome(NamedTuple):
    """Probability of one outcome, with the mean and standard deviation of its racks, given it."""

    chance: Any
    mean: Any
    sd: Any


@dataclass(frozen=True)
class Outcomes:
    """All outcomes of a match from one start, by (winner, next breaker), and P(it never ends)."""

    by_result: dict[tuple[int, int], Outcome]
    never: Any

    def p_win(self, player: int) -> Any:
        """P(`player` wins the match)."""
        chance = sum((o.chance for (won, _), o in self.by_result.items() if won == player), 0.0)
        # Rounding may take a sum above 1.
        return min(chance, 1.0) if isinstance(chance, float) else chance.clip(max=1.0)

    @property
    def length(self) -> Outcome:
        """P(the match ends), with the mean and standard deviation of its racks if it does."""
        return _mixture(list(self.by_result.values()))


def outcomes_of(match: Match, *, lengths: bool = True) -> Outcomes:
    """Return the outcomes of `match` from its start score and first breaker.

    Without `lengths`, means and standard deviations are 0.

    >>> from evenbreak.games import Race, Rack
    >>> round(outcomes_of(Race(3, 1, Race(3, 3, Rack(2 / 3)))).p_win(1), 12)
    0.493270184273
    """
    return _absorb(match, match.score, first_breaker(match), lengths=lengths)


def unit_outcomes(match: Match, *, lengths: bool = True) -> dict[int, Outcomes]:
    """Return the outcomes of one rack or set of `match`, by who breaks first in it.

    If the break does not matter, breaker 1 stands for both.
    """
    breakers = (1, 2) if match.break_matters else (1,)
    return {breaker: _unit(match, breaker, lengths=lengths) for breaker in breakers}


def _unit(match: Match, breaker: int, *, lengths: bool) -> Outcomes:
    rack = unit_of(match)
    if isinstance(rack, Rack):
        inside: dict[tuple[int, int], Outcome] = {
            (winner, breaker): Outcome(rack.chance(winner, breaker), 1.0, 0.0) for winner in (1, 2)
        }
        never = 0.0
    else:
        of_set = _absorb(rack, rack.score, breaker, lengths=lengths)
        inside, never = of_set.by_result, of_set.never
    grouped: dict[tuple[int, int], list[Outcome]] = {}
    for (winner, carried), outcome in inside.items():
        after = match.breaks(breaker, winner) if match.breaks is not None else carried
        grouped.setdefault((winner, after if match.break_matters else 1), []).append(outcome)
    return Outcomes({result: _mixture(parts) for result, parts in grouped.items()}, never)


def _mixture(parts: list[Outcome]) -> Outcome:
    """Return the outcome that any of these occurs, by the law of total variance."""
    if len(parts) == 1:
        return parts[0]
    chance = sum((part.chance for part in parts), 0.0)
    mean = ratio(sum((part.chance * part.mean for part in parts), 0.0), chance)
    unit = _unit_of_length([mean, *(part.sd for part in parts)])
    spread = sum((part.chance * _square(part.sd, part.mean - mean, unit) for part in parts), 0.0)
    return Outcome(chance, mean, unit * ratio(spread, chance) ** 0.5)


def _square(sd: Any, surprise: Any, unit: Any) -> Any:
    return (sd / unit) ** 2 + (surprise / unit) ** 2


def _unit_of_length(lengths: Iterable[Any]) -> Any:
    """Return the largest of some lengths, at least 1; elementwise for arrays."""
    return reduce(_greater, lengths, 1.0)


def _greater(x: Any, y: Any) -> Any:
    if isinstance(x, float) and isinstance(y, float):
        return max(x, y)
    import numpy as np

    return np.maximum(x, y)


def _absorb(match: Match, score: Score, breaker: int, *, lengths: bool) -> Outcomes:
    winner = match.decided(*score)
    if winner is not None:
        return Outcomes({(winner, breaker): Outcome(1.0, 0.0, 0.0)}, 0.0)
    start = (*match.fold(*score), breaker)
    if isinstance(match, Ahead) and not lengths:
        closed = _in_closed_form(match, start)
        if closed is not None:
            return closed
    units = unit_outcomes(match, lengths=lengths)
    arcs = score_arcs(match, start, {breaker: unit.by_result for breaker, unit in units.items()})
    chain = ScoreChain(
        {
            state: {target: outcome.chance for target, outcome in row.items()}
            | {NEVER: units[state[2]].never}
            for state, row in arcs.items()
        }
    )
    by_result = {}
    for result in sorted({target for row in arcs.values() for target in row if len(target) == 2}):
        reach = chain.solve({result: 1.0})
        by_result[result] = (
            _with_length(chain, arcs, reach, start) if lengths else Outcome(reach[start], 0.0, 0.0)
        )
    return Outcomes(by_result, chain.solve({NEVER: 1.0})[start])


def _in_closed_form(match: Ahead, start: _State) -> Outcomes | None:
    """Return the chances in an n-ahead match; None if its units have no closed form."""
    a, b, breaker = start
    rack, after = match.rack, {1: (1, 1)}
    if isinstance(rack, Rack):
        racks = {1: (rack.p1, rack.q1), 2: (rack.q2, rack.p2)}
        if match.breaks is not None and match.break_matters:
            breaks = match.breaks
            after = {first: (breaks(first, 1), breaks(first, 2)) for first in (1, 2)}
    else:
        racks = {}
        for first, unit in unit_outcomes(match, lengths=False).items():
            never = unit.never if isinstance(unit.never, float) else unit.never.any()
            if never or sorted(winner for winner, _ in unit.by_result) != [1, 2]:
                return None
            result_1, result_2 = sorted(unit.by_result)
            racks[first] = unit.by_result[result_1].chance, unit.by_result[result_2].chance
            after[first] = result_1[1], result_2[1]
    closed = ahead_chances(match.m - a + b, match.n + a - b, breaker, racks, after)
    if closed is None:
        return None
    chances, never = closed
    return Outcomes({result: Outcome(p, 0.0, 0.0) for result, p in chances.items()}, never)


_State = tuple[int, int, int]
_Result = tuple[int, int]
_Arcs = dict[_State, dict[_State | _Result, Outcome]]
_Of = TypeVar("_Of")


def score_arcs(
    match: Match, start: _State, units: dict[int, dict[_Result, _Of]]
) -> dict[_State, dict[_State | _Result, _Of]]:
    """Return the arcs from each (a, b, breaker) to the next one, or to (winner, next breaker).

    An arc carries the entry in `units` for its unit and result. All scores with the same result are
    one final state, which keeps eliminated rows short.
    """
    arcs: dict[_State, dict[_State | _Result, _Of]] = {}
    queue = [start]
    for state in queue:
        if state in arcs:
            continue
        a, b, breaker = state
        row: dict[_State | _Result, _Of] = {}
        for (won, after), outcome in units[breaker].items():
            score = match.fold(a + (won == 1), b + (won == 2))
            winner = match.decided(*score)
            if winner is None:
                row[*score, after] = outcome
                queue.append((*score, after))
            else:
                row[winner, after] = outcome
        arcs[state] = row
    return arcs


def _with_length(
    chain: ScoreChain, arcs: _Arcs, reach: dict[Hashable, Any], start: _State
) -> Outcome:
    """Return the outcome whose probability from each state is `reach`, with its length.

    Every reward is weighted by the probability that this outcome follows, so the sums are
    conditional on the outcome. The variance adds up squared surprises (how far each unit moves the
    mean), so it is accurate even if it is tiny.
    """

    def mean_reward(state: Any) -> Any:
        return sum(
            (o.chance * reach.get(target, 0.0) * o.mean for target, o in arcs[state].items()), 0.0
        )

    weighted = chain.solve(reward=mean_reward)
    mean: dict[Any, Any] = {state: ratio(weighted[state], reach[state]) for state in arcs}
    unit = _unit_of_length(mean.values())

    def variance_reward(state: Any) -> Any:
        return sum(
            (
                o.chance
                * reach.get(target, 0.0)
                * _square(o.sd, o.mean + mean.get(target, 0.0) - mean[state], unit)
                for target, o in arcs[state].items()
            ),
            0.0,
        )

    spread = chain.solve(reward=variance_reward)[start]
    return Outcome(reach[start], mean[start], unit * ratio(spread, reach[start]) ** 0.5)


NEVER = "never"
"""The final state that represents play that never ends."""


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

    `rows` are the probabilities of each next state, with the start first; states without a row are
    final.

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
        """Return the expected total of rewards from each state on, final ones included.

        `final` rewards are paid once, 0 where not listed; `NEVER` means play that does not end.
        `reward` is paid on each visit to a state that is not final.
        """
        final = final or {}
        own = [0 if reward is None else reward(state) for state in self._place]
        for k, row in enumerate(self._ends):
            for target in row.keys() & final.keys():
                own[k] = own[k] + row[target] * final[target]
        return {**final, **dict(zip(self._place, self._factor.values(own), strict=True))}


def _endless(rows: Mapping[Hashable, Mapping[Hashable, Any]]) -> dict[Hashable, Any]:
    """Return 1 for each state from which play cannot end; an array if this differs by entry."""
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
            before_now = ends.get(state, False)
            reached = _truth(before_now | (possible & ends[target]))
            if before_now is not True and _truth(reached == before_now) is not True:
                ends[state] = reached
                queue.append(state)
    return {state: 1 - 1 * ends.get(state, False) for state in rows if ends.get(state) is not True}


def _truth(answer: Any) -> Any:
    """Return a single True or False if all entries agree; else the array."""
    if isinstance(answer, bool):
        return answer
    return True if answer.all() else answer if answer.any() else False


@overload
def shutout_probability(
    match: Match[float], score: Score | None = None, *, player: int = 1
) -> float | None: ...
@overload
def shutout_probability(
    match: Match[Any], score: Score | None = None, *, player: int = 1
) -> Floats | None: ...
def shutout_probability(match: Match, score: Score | None = None, *, player: int = 1) -> Any:
    """Return P(`player` wins and the other player scores nothing from the start score on).

    It is a product of probabilities, accurate even if it is tiny. None for n-ahead matches, which
    depend on the lead, not the score. In a match of sets, it counts sets.

    Parameters
    ----------
    match
        a race, of racks or of sets; p1 and p2 may be arrays.
    score
        the current score (see `win_probability`); None: the match's own start score.
    player
        1 or 2.

    Returns
    -------
    float, numpy.ndarray or None
        a float for plain numbers, otherwise an array of the shape of the parameters.

    Raises
    ------
    InputError
        if the score cannot be reached, or `player` is not 1 or 2.

    >>> from evenbreak.games import Race, Rack
    >>> shutout_probability(Race(2, 2, Rack(0.5)), player=2)
    0.25
    """
    one_of(player, "player", (1, 2))
    if not isinstance(match, Race):
        return None
    match, shape = at_score(match, score)
    a, b = match.score
    # P(the run has come this far and this player breaks next), by breaker.
    run: dict[int, Any] = {first_breaker(match): 1.0}
    if match.decided(a, b) is None:
        units = unit_outcomes(match, lengths=False)
    while match.decided(a, b) is None:
        a, b = (a + 1, b) if player == 1 else (a, b + 1)
        after: dict[int, Any] = {}
        for breaker, held in run.items():
            for (winner, then), outcome in units[breaker].by_result.items():
                if winner == player:
                    after[then] = after.get(then, 0.0) + held * outcome.chance
        run = after
    return in_shape(sum(run.values(), 0.0) if match.decided(a, b) == player else 0.0, shape)
