"""Points for a match, and tie-breaks for players or teams with equal points."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Bools, Floats, Ints, array_values, own_arrays
from evenbreak.checks import number, one_of
from evenbreak.errors import InputError

POINTS, WIN_SHARE, WINS = "points", "win-share", "wins"
HEAD_TO_HEAD, DIFFERENCE, SCORED, FORFEITS = "head-to-head", "difference", "scored", "forfeits"
TIE_BREAKS = (DIFFERENCE, SCORED, WINS, HEAD_TO_HEAD, WIN_SHARE, FORFEITS, POINTS)
"""Possible tie-breaks: games (or sets) won minus lost, games won, matches won, points from the tied
sides' meetings, the share of matches won, fewer forfeits, points."""


@dataclass(frozen=True)
class TableRules:
    """Rules for a table.

    Parameters
    ----------
    win, draw, loss
        the points for a match.
    a_set
        additional points for each game won (in a team match, for each set).
    shutout
        additional points for a shutout.
    split
        'apa_8ball' or 'apa_9ball': a match's points are divided by that league's table, instead of
        the above.
    forfeit
        the points for a match won by forfeit; None: the same as for a win (2 and 20 in the two
        splits).
    bye
        the points for a round without an opponent.
    ties
        the tie-breaks, in order; those still tied share a place. If 'points' is listed, points
        count in that position, not before everything else.

    Raises
    ------
    InputError
        if a loss gives more than a draw, or a draw gives more than a win, or a tie-break is
        unknown.

    >>> TableRules(win=0, draw=0, loss=0, a_set=1).points(3, 2)
    (3.0, 2.0)
    >>> TableRules(ties=("head-to-head",)).ladder
    ('points', 'head-to-head')
    """

    win: float = 2.0
    draw: float = 1.0
    loss: float = 0.0
    a_set: float = 0.0
    ties: tuple[str, ...] = (DIFFERENCE, SCORED)
    shutout: float = 0.0
    split: str = ""
    forfeit: float | None = None
    bye: float = 0.0

    def __post_init__(self) -> None:
        for name in ("win", "draw", "loss", "a_set", "shutout", "bye", "forfeit"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, number(getattr(self, name), name))
        if not self.loss <= self.draw <= self.win or min(self.a_set, self.shutout) < 0.0:
            raise InputError(
                "points are {win:g}, {draw:g}, {loss:g} for a win, a draw and a loss. A loss "
                "can't be worth more than a draw, or a draw more than a win.",
                win=self.win,
                draw=self.draw,
                loss=self.loss,
            )
        if self.split:
            one_of(self.split, "split", tuple(SPLITS))
        elif self.win == self.loss and self.a_set == 0.0:
            raise InputError(
                "a win must be worth more than a loss; it isn't. Give points for a win or a set."
            )
        for name in self.ties:
            one_of(name, "ties", TIE_BREAKS)

    @property
    def ladder(self) -> tuple[str, ...]:
        """The deciding criteria, in order."""
        return self.ties if POINTS in self.ties else (POINTS, *self.ties)

    def points(self, scored: int, other: int) -> tuple[float, float]:
        """Return the points of both sides for a match with this score."""
        first, second = self.points_of(Outcomes([[scored, other]]))[0].tolist()
        return first, second

    def points_of(self, outcomes: Outcomes) -> Floats:
        """Return the points of both sides for each match, shape (matches, 2).

        Raises
        ------
        InputError
            if matches are split by races that they do not state.
        """
        given = outcomes.given
        if given is None:
            given = SPLITS[self.split](outcomes) if self.split else self._by_result(outcomes)
        if self.forfeit is None and not self.split:
            return given
        won = 2.0 if self.split == "apa_8ball" else 20.0
        alone = (self.forfeit if self.forfeit is not None else won) * outcomes.won
        lost = self.loss * outcomes.won[:, ::-1] * (not self.split)
        return np.where(outcomes.forfeit[:, None], alone + lost, given)

    def _by_result(self, outcomes: Outcomes) -> Floats:
        won, lost = outcomes.won, outcomes.won[:, ::-1]
        to_nil = won & (outcomes.score[:, ::-1] == 0) & ~outcomes.forfeit[:, None]
        result = np.where(won, self.win, np.where(lost, self.loss, self.draw))
        return np.asarray(result + self.a_set * outcomes.score + self.shutout * to_nil)


@own_arrays
@array_values
@dataclass(frozen=True, eq=False, init=False)
class Outcomes:
    """How matches ended, one per row.

    Without `winner` (1 or 2; 0: a draw), the score decides; a race is 0 if not stated; `given` is
    both sides' points if already known; otherwise the rules set them.

    >>> Outcomes([[3, 2], [2, 2]]).winner.tolist()
    [1, 0]
    """

    score: Ints
    winner: Ints
    race: Ints
    forfeit: Bools
    given: Floats | None

    def __init__(
        self,
        score: ArrayLike,
        winner: ArrayLike | None = None,
        race: ArrayLike | None = None,
        forfeit: ArrayLike | None = None,
        given: Floats | None = None,
    ) -> None:
        games = np.asarray(score, dtype=np.int64).reshape(-1, 2)
        a, b = games.T
        none = np.zeros(games.shape, dtype=np.int64)
        for name, value in {
            "score": games,
            "winner": 1 * (a > b) + 2 * (b > a) if winner is None else np.asarray(winner),
            "race": none if race is None else np.asarray(race),
            "forfeit": none[:, 0] > 0 if forfeit is None else np.asarray(forfeit),
            "given": given,
        }.items():
            object.__setattr__(self, name, value)

    def __len__(self) -> int:
        return len(self.score)

    def among(self, rows: Bools) -> Outcomes:
        """Return the outcomes in the given rows."""
        given = None if self.given is None else self.given[rows]
        return Outcomes(
            self.score[rows], self.winner[rows], self.race[rows], self.forfeit[rows], given
        )

    @property
    def won(self) -> Bools:
        """Which side won, shape (matches, 2)."""
        return np.asarray(self.winner[:, None] == [1, 2])


def _apa_8ball(outcomes: Outcomes) -> Floats:
    """3:0 for a shutout, 2:1 if the loser needed one more game, else 2:0."""
    won = outcomes.won
    lost = won[:, ::-1]
    nil = (np.where(lost, outcomes.score, 0).sum(axis=1) == 0)[:, None]
    hill = lost & (outcomes.score == _stated_races(outcomes) - 1)
    return np.asarray(won * (2.0 + nil) + hill)


_LEAST_OF_9BALL = {
    # the loser's points to win, by level 1 to 9: the least score that is worth 1, 2, ... 8 of 20
    14: (3, 4, 5, 7, 8, 9, 11, 12),
    19: (4, 6, 8, 9, 11, 13, 15, 17),
    25: (5, 7, 10, 12, 15, 17, 20, 22),
    31: (6, 9, 12, 15, 19, 22, 25, 28),
    38: (7, 11, 15, 19, 23, 27, 30, 34),
    46: (9, 13, 18, 23, 28, 32, 37, 41),
    55: (11, 16, 22, 27, 33, 38, 44, 50),
    65: (14, 20, 27, 33, 40, 46, 53, 59),
    75: (18, 25, 32, 39, 47, 54, 61, 68),
}


def _apa_9ball(outcomes: Outcomes) -> Floats:
    """Divide 20 points by how close the loser came to their target."""
    found = np.zeros((len(outcomes), 2))
    races = _stated_races(outcomes)
    for row, won in enumerate(outcomes.winner.tolist()):
        if not won or outcomes.forfeit[row]:
            continue
        score, target = int(outcomes.score[row, 2 - won]), int(races[row, 2 - won])
        if target not in _LEAST_OF_9BALL:
            raise InputError(
                "a player needed {target} points, but APA 9-ball races are to {targets}",
                target=target,
                targets=", ".join(map(str, _LEAST_OF_9BALL)),
            )
        share = int(np.searchsorted(_LEAST_OF_9BALL[target], score, side="right"))
        found[row, 2 - won], found[row, won - 1] = share, 20 - share
    return found


def _stated_races(outcomes: Outcomes) -> Ints:
    unstated = (outcomes.race == 0).any(axis=1) & ~outcomes.forfeit
    if unstated.any():
        raise InputError(
            "{n} of {n_all} matches have no race. To split points as the APA does, add the "
            "games (or points) that each player needed.",
            n=int(unstated.sum()),
            n_all=len(unstated),
        )
    return outcomes.race


SPLITS: dict[str, Callable[[Outcomes], Floats]] = {"apa_8ball": _apa_8ball, "apa_9ball": _apa_9ball}
"""How leagues divide a match's points according to its result. The 9-ball table comes from two
public score programs; the 8-ball table reproduces the mean points in 40,000 published matches."""

USUAL_RULES = TableRules()
"""Two points for a win and one for a draw; then games won minus lost, and games won."""
