"""A match in progress: the odds at every score, and the value of the next rack.

One pass over the scores that are still possible gives the odds at all of them, and from these come
the course of the match, the leverage of a rack and the comeback table.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, NamedTuple

from evenbreak.checks import one_of
from evenbreak.errors import InputError
from evenbreak.games.match import Match, Score
from evenbreak.games.race import Race
from evenbreak.games.rack import Rack
from evenbreak.matches.outcomes import NEVER, ScoreChain
from evenbreak.matches.parameters import checked_match, rack_in, unit_of
from evenbreak.matches.rack_by_rack import RackMoves, breaker_in, rack_moves, racks_within
from evenbreak.words import Parameter, say


class Standing(NamedTuple):
    """A match at one moment; all probabilities are conditional on it.

    Parameters
    ----------
    scores
        the score of the match, then of the current set, and so on inward.
    breaker
        who breaks the next rack; None if the break does not matter or the match is over.
    p_win_1, p_win_2
        P(player 1, 2 wins the match); they add up to 1 minus P(it never ends).
    p_win_1_after
        P(player 1 wins the match), given that player 1, player 2 wins the next rack; None
        if the match is over.
    mean_racks
        mean number of racks left; None if the match may never end.
    racks_p90
        the smallest number of racks within which the match ends with probability .9; None
        in a comeback table, if the match never ends with that probability, or if it takes
        more than 100,000 racks and has more than 1,000 states.
    """

    scores: tuple[Score, ...]
    breaker: int | None
    p_win_1: float
    p_win_2: float
    p_win_1_after: tuple[float, float] | None
    mean_racks: float | None
    racks_p90: int | None

    @property
    def leverage(self) -> float | None:
        """Value of the next rack: player 1's chance after winning it minus that after losing."""
        after = self.p_win_1_after
        return None if after is None else after[0] - after[1]


@dataclass(frozen=True, eq=False)
class LiveOdds:
    """A match so far, and its possible continuations.

    Parameters
    ----------
    course
        the standing before the first rack, and after each rack.
    winners
        who won each rack, 1 or 2.
    """

    course: tuple[Standing, ...]
    winners: tuple[int, ...]
    _values: _Values
    _state: Any

    @property
    def now(self) -> Standing:
        """The match now: the last entry of the course."""
        return self.course[-1]

    @property
    def swings(self) -> tuple[float, ...]:
        """How much each rack moved P(player 1 wins the match)."""
        wins = [standing.p_win_1 for standing in self.course]
        return tuple(after - before for before, after in pairwise(wins))

    def comebacks(self) -> list[Standing]:
        """Return the standing at every score that is still possible: the comeback table.

        Scores that differ only in racks that no longer matter share one entry: in an n-ahead match,
        the lead. Scores at which the match is over are left out.
        """
        states = self._values.from_(self._state)
        return sorted(
            (self._values.standing(state) for state in states),
            key=lambda standing: (standing.scores, standing.breaker or 0),
        )


def live_odds(
    match: Match,
    winners: Sequence[int] = (),
    *,
    set_score: Score | None = None,
    form: float = 0.0,
) -> LiveOdds:
    """Return the odds of a match in progress, after each of the racks played so far.

    Parameters
    ----------
    match
        a race or an n-ahead match, of racks or of sets, with plain numbers as probabilities.
        The course starts at its start score; its first breaker breaks the first rack.
    winners
        who has won each rack since then, 1 or 2.
    set_score
        in a match of sets of racks, the score of the current set at the start of the course; None:
        the set's own start score. If the match has its own break format for sets, the first breaker
        is assumed to have broken first in that set too.
    form
        standard deviation of a game's log-odds from match to match, for races of racks in which the
        break does not matter. Each rack played shows something of today's form.

    Raises
    ------
    InputError
        if the probabilities are arrays, a winner is not 1 or 2, the match is over before the
        last rack, the set cannot have the score `set_score`, form is not in 0 to 3, or it is given
        for a match in which the order of the racks matters.

    Notes
    -----
    Source: problems P5.5 and P5.6, whose table W(p; m, n) has every score in the course of a race;
    P5.8, P5.24 and P5.27 for the other matches.

    >>> from evenbreak.games import Race, Rack
    >>> live = live_odds(Race(3, 2, Rack(0.5)), [1, 2])
    >>> [standing.p_win_1 for standing in live.course], live.swings
    ([0.3125, 0.5, 0.25], (0.1875, -0.25))
    >>> live.now.scores, live.now.leverage, live.now.racks_p90
    (((1, 1),), 0.5, 2)
    >>> [(standing.scores[0], standing.p_win_1) for standing in live.comebacks()]
    [((1, 1), 0.25), ((2, 1), 0.5)]
    """
    match = checked_match(match)
    rack_in(match).of_numbers()
    values = _Values(match, _state_at(match, set_score), form)
    state, scores = values.start, _scores_of(match, values.start)
    scores = (match.score, *scores[1:])
    states, listed = [state], [scores]
    for i, winner in enumerate(winners, 1):
        one_of(winner, f"winner of rack {i}", (1, 2))
        if state not in values.moves:
            raise InputError(
                "the match is over after {i} of {n_winners} racks, at {score}-{score_2}. "
                "Leave out the other racks.",
                i=i - 1,
                n_winners=len(winners),
                score=scores[0][0],
                score_2=scores[0][1],
            )
        state, scores = values.moves[state][winner - 1][0], _counted(match, scores, winner)
        states.append(state)
        listed.append(scores)
    ends = racks_within(values.moves, [(state, 0.9) for state in states], values.never)
    course = [
        values.standing(state)._replace(scores=scores, racks_p90=end)
        for state, scores, end in zip(states, listed, ends, strict=True)
    ]
    return LiveOdds(tuple(course), tuple(winners), values, state)


class _Values:
    """The odds at every state that can be reached from `start`."""

    def __init__(self, match: Match, start: Any, form: float) -> None:
        self.match, self.start = match, start
        self.moves = _moves_in_form(match, form) if form else rack_moves(match, start)
        reached = {start} | {state for row in self.moves.values() for state, _ in row}
        won: dict[int, dict[Any, float]] = {1: {}, 2: {}}
        for state in reached - self.moves.keys():
            won[match.winner(state) or 0][state] = 1.0
        chain = ScoreChain({state: dict(row) for state, row in self.moves.items()})
        self.win = {player: chain.solve(won[player]) for player in (1, 2)}
        self.never = chain.solve({NEVER: 1.0})
        self.mean = chain.solve(reward=lambda _: 1.0)

    def standing(self, state: Any) -> Standing:
        """Return the standing of the match in a state, without `racks_p90`."""
        row = self.moves.get(state)
        after = None if row is None else [self._chance(1, target) for target, _ in row]
        breaks = self.match.break_matters and row is not None
        return Standing(
            scores=_scores_of(self.match, state),
            breaker=breaker_in(self.match, state) if breaks else None,
            p_win_1=self._chance(1, state),
            p_win_2=self._chance(2, state),
            p_win_1_after=None if after is None else (after[0], after[1]),
            mean_racks=None if self.never.get(state, 0.0) > 0.0 else self.mean.get(state, 0.0),
            racks_p90=None,
        )

    def _chance(self, player: int, state: Any) -> float:
        return min(1.0, float(self.win[player].get(state, 0.0)))  # rounding may bring a sum above 1

    def from_(self, state: Any) -> Iterator[Any]:
        """Yield the states reachable from `state` in which the match continues."""
        queue = [state]
        seen = set()
        for here in queue:
            if here in self.moves and here not in seen:
                seen.add(here)
                yield here
                queue += [target for target, _ in self.moves[here]]


def order_is_free(match: Match) -> bool:
    """Return whether the score shows the same about form regardless of how it came about."""
    plain = isinstance(match, Race) and match.win_by == 1 and isinstance(match.rack, Rack)
    return plain and not match.break_matters


def _moves_in_form(match: Match, form: float) -> RackMoves:
    """Return the moves of a race in which the racks played show how well both are playing today.

    The chance in the next rack is its average over the days on which the score may have come about.
    With these chances, the scores form a Markov chain as in any other race.
    """
    from evenbreak.matches.form import form_of, given_score, on_days

    if not order_is_free(match):
        raise InputError(
            "form works only in a race of racks in which the break doesn't matter, and this "
            "match isn't one. Leave out form."
        )
    fresh, weights = on_days(replace(match, score=(0, 0)), form_of(form))
    p = rack_in(fresh).chance(1)
    moves = {}
    for score, ((won, _), (lost, _)) in rack_moves(match).items():
        likely = given_score(replace(fresh, score=score), weights)
        moves[score] = (won, float(likely @ p)), (lost, float(likely @ (1.0 - p)))
    return moves


def _state_at(match: Match, set_score: Score | None) -> Any:
    if set_score is None:
        return match.start
    inside, of_set = unit_of(match), Parameter("set_score")
    if isinstance(inside, Rack) or not isinstance(inside.rack, Rack):
        raise InputError(
            "{set_score} is given, but this match isn't played in sets of racks. Leave it out.",
            set_score=of_set,
        )
    try:
        under_way = replace(inside, score=set_score, first_breaker=match.first_breaker)
    except InputError as error:  # the set calls it its score
        said = error.sentence
        raise InputError(say(said.template, **{**said.values, "score": of_set})) from None
    if under_way.decided(*under_way.score) is not None:
        a, b = under_way.score
        raise InputError(
            "{set_score} is {a}-{b}, which ends the set. Add the set to the score instead.",
            a=a,
            b=b,
        )
    if match.decided(*match.score) is not None:
        raise InputError(
            "{set_score} is given, but the match is over. Leave it out.", set_score=of_set
        )
    return (*match.start[:-1], under_way.start)


def _scores_of(match: Match, state: Any) -> tuple[Score, ...]:
    """Return the scores in a state, starting with the match score."""
    own = (state[0], state[1])
    rack = unit_of(match)
    if isinstance(rack, Rack) or match.winner(state) is not None:
        return (own,)
    return (own, *_scores_of(rack, state[-1]))


def _counted(match: Match, scores: tuple[Score, ...], winner: int) -> tuple[Score, ...]:
    """Return the scores after a rack, including racks that a state leaves out."""
    (a, b), *inside = scores
    rack = unit_of(match)
    if not isinstance(rack, Rack):
        inner = _counted(rack, tuple(inside), winner)
        if rack.decided(*inner[0]) is None:
            return ((a, b), *inner)
    score = (a + 1, b) if winner == 1 else (a, b + 1)
    if isinstance(rack, Rack) or match.decided(*score) is not None:
        return (score,)
    return (score, *_scores_of(rack, rack.start))
