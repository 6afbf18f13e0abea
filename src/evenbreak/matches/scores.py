"""The final score of a match."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, overload

import numpy as np

from evenbreak.arrays import Floats, array_values
from evenbreak.checks import number_probability
from evenbreak.games.ahead import Ahead
from evenbreak.games.match import Match, Score
from evenbreak.games.race import Race
from evenbreak.games.rack import ChanceT, Rack
from evenbreak.matches.endings import endings_of, is_bounded
from evenbreak.matches.form import form_of, on_days
from evenbreak.matches.outcomes import outcomes_of, unit_outcomes
from evenbreak.matches.parameters import at_score, first_breaker, in_shape

_MOST_SETS = 10_000


@array_values
@dataclass(frozen=True, eq=False)
class FinalScores(Generic[ChanceT]):
    """Distribution of a match's final score.

    Parameters
    ----------
    probability
        P(the match ends a:b) by (a, b): racks, or sets for a match of sets. Player 1's wins come
        first, then player 2's, both from the shortest matches up.
    p_never_ends
        P(the match goes on forever).
    tail_mass
        P(the match ends with a score that is not listed); 0 if there is a longest length.
    span
        final scores are listed up to this many racks (or sets) after the start score.
    """

    probability: dict[Score, ChanceT]
    p_never_ends: ChanceT
    tail_mass: ChanceT
    span: int


@overload
def final_scores(
    match: Match[float], score: Score | None = None, *, tail: float = 1e-12, form: float = 0.0
) -> FinalScores[float]: ...
@overload
def final_scores(
    match: Match[Any], score: Score | None = None, *, tail: float = 1e-12, form: float = 0.0
) -> FinalScores[Floats]: ...
def final_scores(
    match: Match, score: Score | None = None, *, tail: float = 1e-12, form: float = 0.0
) -> FinalScores[Any]:
    """Return the distribution of the final score of `match`.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets; p1 and p2 may be arrays, and
        each probability is then an array of their shape.
    score
        the current score (see `win_probability`); None: the match's own start score.
    tail
        probability that may be left out if there is no longest length.
    form
        day-to-day form: standard deviation of a game's log-odds from match to match. A player in
        form wins more games throughout the match, so there are more lopsided scores and fewer close
        ones; the chance in the first game is unchanged. The games of `score` count as played and
        show the day's form; where games are given on the wire, use a shorter race instead.

    Raises
    ------
    InputError
        if the score cannot be reached, `tail` is not a probability, form is not in 0 to 3, or there
        is form, a score, and chances that depend on who breaks.

    Notes
    -----
    Source: problem P5.5, where W is the sum of the probabilities of the final scores.

    >>> from evenbreak.games import Race, Rack
    >>> final_scores(Race(2, 1, Rack(0.5))).probability
    {(2, 0): 0.25, (0, 1): 0.5, (1, 1): 0.25}
    >>> round(final_scores(Race(2, 2, Rack(0.5)), form=0.5).probability[2, 0], 3)
    0.264
    """
    match, shape = at_score(match, score)
    tail = number_probability(tail, "tail")
    if form:
        return _with_form(match, tail, form, shape)
    bounded = is_bounded(match)
    never = 0.0 if bounded else outcomes_of(match, lengths=False).never
    if isinstance(match.rack, Rack):
        by_length = endings_of(match, never, tail)
        span = len(by_length.win_1) - 1
        ends = {
            _final(match, player, k): chance[k]
            for player, chance in zip((1, 2), by_length, strict=True)
            for k in range(span + 1)
            if chance[k].any()
        }
    else:
        ends, span = _by_sets(match, never, None if bounded else tail)
    left = 0.0 if bounded else np.maximum(1.0 - never - sum(ends.values(), 0.0), 0.0)
    return FinalScores(
        probability={at: in_shape(chance, shape) for at, chance in ends.items()},
        p_never_ends=in_shape(never, shape),
        tail_mass=in_shape(left, shape),
        span=span,
    )


def _with_form(match: Match, tail: float, form: float, shape: tuple[int, ...]) -> FinalScores[Any]:
    many, weights = on_days(match, form_of(form))
    by_day = final_scores(many, tail=tail)

    def mixed(value: Floats) -> Any:
        return in_shape((weights * value).sum(axis=-1), shape)

    return FinalScores(
        {score: mixed(chance) for score, chance in by_day.probability.items()},
        mixed(by_day.p_never_ends),
        mixed(by_day.tail_mass),
        by_day.span,
    )


@overload
def hill_hill_probability(match: Match[float], score: Score | None = None) -> float | None: ...
@overload
def hill_hill_probability(match: Match[Any], score: Score | None = None) -> Floats | None: ...
def hill_hill_probability(match: Match, score: Score | None = None) -> Any:
    """Return P(the last possible rack decides): the race m:n comes to m - 1 : n - 1.

    None for n-ahead matches and races won by 2 or more, which have no last possible rack. In a
    match of sets, it refers to the last possible set. Parameters and errors are those of
    `final_scores`; 0 if the match is over at the start.

    >>> from evenbreak.games import Race, Rack
    >>> hill_hill_probability(Race(2, 2, Rack(0.5)))
    0.5
    """
    if not isinstance(match, Race) or match.win_by > 1:
        return None
    match, shape = at_score(match, score)
    if match.decided(*match.score) is not None:
        return in_shape(0.0, shape)
    ends = final_scores(match).probability
    decider = match.m + match.n - 1
    return in_shape(
        sum((chance for (a, b), chance in ends.items() if a + b == decider), 0.0), shape
    )


def _final(match: Match, player: int, k: int) -> Score:
    """Return the score at which `player` wins after k racks; there is one such score."""
    played = sum(match.score) + k
    if isinstance(match, Ahead):
        mine = played + (match.m if player == 1 else match.n)
        won = mine // 2
    else:
        needs = (match.m, match.n) if player == 1 else (match.n, match.m)
        by = match.win_by if isinstance(match, Race) else 1
        won = max(needs[0], -((played + by + needs[0] - needs[1]) // -2))
    if not k:
        return match.score
    return (won, played - won) if player == 1 else (played - won, won)


def _by_sets(match: Match, never: Any, tail: float | None) -> tuple[dict[Score, Any], int]:
    """Return the final scores of a match of sets, and the largest number of sets listed.

    If `tail` is None, the match is followed up to its longest possible length.
    """
    units = unit_outcomes(match, lengths=False)
    mass: dict[tuple[int, int, int], Any] = {(*match.score, first_breaker(match)): 1.0}
    ends: dict[int, dict[Score, Any]] = {1: {}, 2: {}}
    ended: Any = 0.0
    sets = -1
    while mass and sets < _MOST_SETS and not _settled(ended + never, tail):
        sets += 1
        after: dict[tuple[int, int, int], Any] = {}
        for (a, b, breaker), held in mass.items():
            winner = match.decided(a, b)
            if winner is not None:
                ends[winner][a, b] = ends[winner].get((a, b), 0.0) + held
                ended = ended + held
                continue
            for (won, then), outcome in units[breaker].by_result.items():
                target = (a + (won == 1), b + (won == 2), then)
                after[target] = after.get(target, 0.0) + held * outcome.chance
        mass = after
    return ends[1] | ends[2], sets


def _settled(certain: Any, tail: float | None) -> bool:
    return tail is not None and bool(np.all(1.0 - certain <= tail))
