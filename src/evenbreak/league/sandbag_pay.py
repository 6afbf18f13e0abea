"""Exact gain from losing on purpose, on the ladder of rating errors.

A player with error e wins the next match with the chance W(e), and the ladder's kernel K moves
the rating. From a distribution v of the error, D matches lost on purpose lead to B^D v, where B
takes each error down by the points that the most costly defeat moves it, and

    P(win match i in earnest | D dumped) = W . K^(i - 1) B^D v

compared with W . K^(D + i - 1) v for a player who plays all D + i matches in earnest.

If a win moves the rating up a point and a loss moves it down a point, wins are conserved: in the
long run, the D points come back as D / 2 more wins than an honest player has, as many as were given
away. Dumping then pays only if the matches in earnest are worth more than those dumped.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from evenbreak.arrays import Bools, Floats, Ints, array_values
from evenbreak.checks import number, whole
from evenbreak.errors import InputError
from evenbreak.handicaps.ladders.error_chain import error_on, move_matrix
from evenbreak.handicaps.ladders.ladder import Ladder
from evenbreak.handicaps.systems.match_table import match_table
from evenbreak.stats.summary import Distribution

MOST_HELD = 1e-6
"""Chance of being held at the ladder's lower end above which the end decides."""

_NOTHING = 1e-9
"""Fewer extra wins than this are due to rounding."""

_MOST = 1000
"""The most matches dumped, or played in earnest."""


class DumpRow(NamedTuple):
    """Effect of losing some matches on purpose, compared with an honest player.

    Parameters
    ----------
    dumped
        matches lost on purpose before the first that counts.
    rating
        mean number of points by which the rating is below the honest player's.
    given_away
        mean number of the dumped matches that the honest player would win.
    p_first
        P(the first match that counts is won).
    extra_wins
        mean number of additional wins in matches that count, compared with the honest player.
    for_the_last
        extra wins from the last dumped match.
    break_even
        how many times a dumped match's stake must be at stake in matches that count for dumping to
        pay; infinite if it brings no extra wins.
    p_in_a_row
        P(the given number of matches in a row are won, at the rating after dumping).
    profit
        profit over the honest player, in the units of the stakes.
    """

    dumped: int
    rating: float
    given_away: float
    p_first: float
    extra_wins: float
    for_the_last: float
    break_even: float
    p_in_a_row: float
    profit: float


@array_values
@dataclass(frozen=True, eq=False)
class Sandbagging:
    """Gain from matches lost on purpose, by their number.

    Parameters
    ----------
    rows
        a `DumpRow` for 0, 1, 2, ... dumped matches.
    p_win
        P(a match in earnest is won), shape (dumped, matches in earnest).
    p_honest
        P(an honest player wins each match), dumped matches first, shape (most dumped + matches in
        earnest,).
    """

    rows: tuple[DumpRow, ...]
    p_win: Floats
    p_honest: Floats

    @property
    def best(self) -> DumpRow:
        """The row with the largest profit, with the fewest dumped matches in case of a tie."""
        return max(self.rows, key=lambda row: (row.profit, -row.dumped))

    @property
    def cheapest(self) -> DumpRow:
        """The row that pays at the smallest stakes in earnest; the first one in case of a tie."""
        return min(self.rows, key=lambda row: row.break_even)


def sandbagging(
    ladder: Ladder,
    *,
    dumped: int = 10,
    earnest: int = 20,
    start: int | Distribution = 0,
    stake: float = 10.0,
    dumped_stake: float = 1.0,
    in_a_row: int = 3,
    prize: float = 0.0,
) -> Sandbagging:
    """Return the profit of losing matches on purpose and then playing to win.

    Each probability is conditional on the ladder's model of the opponents, on a skill that
    does not change, and on no one intervening.

    Parameters
    ----------
    ladder
        the ladder; a match lost on purpose moves the rating by the most costly defeat in the
        race against an opponent who is rated at the player's skill.
    dumped
        the largest number of matches dumped; there is a row for each number from 0.
    earnest
        the number of matches played in earnest afterward, all of which count.
    start
        the rating error at the start, in points: a whole number, or a distribution such as
        `ladder.law()`.
    stake, dumped_stake
        the difference in value between a win and a loss, for a match that counts and for a dumped
        one.
    in_a_row, prize
        how many matches in a row win a tournament, and what it pays. The tournament comes first
        among the matches in earnest, is played entirely at the ratings before it, and moves no
        ratings. Form varies from match to match.

    Raises
    ------
    InputError
        if a number is out of range, the ladder too narrow, or its player drifts.

    Notes
    -----
    profit = stake · extra wins + prize · (P(in a row) - the honest player's)
    - dumped_stake · matches given away.

    >>> from evenbreak.handicaps import Ladder
    >>> pays = sandbagging(Ladder("npl"), dumped=10, earnest=20)
    >>> ten = pays.rows[10]
    >>> round(ten.p_first, 3), round(ten.extra_wins, 2), round(ten.break_even, 2)
    (0.637, 2.13, 2.35)
    """
    most = whole(dumped, "dumped", at_most=_MOST)
    many = whole(earnest, "earnest", at_least=1, at_most=_MOST)
    streak = whole(in_a_row, "in_a_row", at_least=1)
    for name, money in (("stake", stake), ("dumped_stake", dumped_stake), ("prize", prize)):
        number(money, name, low=0.0)
    law = start_law(ladder, start)
    errors, wins = np.asarray(ladder.errors, dtype=float), np.asarray(ladder.wins)
    step, down = earnest_matrix(ladder), dumped_matrix(ladder)
    honest = _laws(step, law, most + many)
    after = _laws(down, law, most + 1)
    if after[-1] @ at_the_end(ladder) > MOST_HELD:
        raise InputError(
            "{dumped} is {most}, which takes the rating to the ladder's end at {widest}. Give a "
            "smaller number, or a wider ladder.",
            most=most,
            widest=-ladder.widest,
        )
    p_honest = honest @ wins
    p_win = np.stack([_laws(step, after_dumps, many) @ wins for after_dumps in after])
    extra = p_win.sum(axis=1) - [p_honest[k : k + many].sum() for k in range(most + 1)]
    away = np.append(0.0, np.cumsum(p_honest[:most]))
    row = after @ wins**streak
    profit = stake * extra + prize * (row - honest[: most + 1] @ wins**streak) - dumped_stake * away
    # No match dumped is no difference; rounding may say otherwise.
    extra[0] = profit[0] = 0.0
    extra[np.abs(extra) < _NOTHING] = 0.0
    return Sandbagging(
        tuple(
            DumpRow(
                k,
                float((honest[k] - after[k]) @ errors),
                float(away[k]),
                float(p_win[k, 0]),
                float(extra[k]),
                float(extra[k] - extra[k - 1]) if k else 0.0,
                float(away[k] / extra[k]) if extra[k] > 0.0 else math.inf,
                float(row[k]),
                float(profit[k]),
            )
            for k in range(most + 1)
        ),
        p_win,
        p_honest,
    )


def entering_low(
    ladder: Ladder, by: int = 30, matches: int = 50, *, newcomer: bool = False
) -> Floats:
    """Return the extra wins of a player who enters the league underrated.

    Parameters
    ----------
    by
        how many points too low the rating is.
    matches
        the number of matches, all played to win.
    newcomer
        whether the first matches follow the system's newcomer schedule.

    Returns
    -------
    array of shape (matches,)
        mean extra wins after each match, compared with a correctly rated player.

    Raises
    ------
    InputError
        if a number is out of range, or the ladder's player drifts.

    >>> from evenbreak.handicaps import Ladder
    >>> entering_low(Ladder("npl"), 30, 100)[[9, 99]].round(2).tolist()
    [3.0, 13.73]
    >>> entering_low(Ladder("npl"), 30, 100, newcomer=True)[[9, 99]].round(2).tolist()
    [2.64, 6.93]
    """
    many = whole(matches, "matches", at_least=1)
    low, right = start_law(ladder, -whole(by, "by")), start_law(ladder, 0)
    schedule = ladder.system.newcomer_steps if newcomer else ()
    factors = [factor for played, factor in schedule for _ in range(played)]
    steps = {factor: earnest_matrix(ladder, factor) for factor in {1, *factors}}
    extra = np.empty(many)
    for k in range(many):
        extra[k] = ladder.wins @ (low - right)
        step = steps[factors[k] if k < len(factors) else 1]
        low, right = step @ low, step @ right
    return np.cumsum(extra)


def most_dumped(ladder: Ladder, start: int | Distribution = 0) -> int:
    """Return how many matches can be dumped before the ladder's end stops the rating.

    >>> from evenbreak.handicaps import Ladder
    >>> most_dumped(Ladder("npl", widest=120)), most_dumped(Ladder("step 3", widest=120), -30)
    (119, 29)
    """
    law, down, last = start_law(ladder, start), dumped_matrix(ladder), at_the_end(ladder)
    # With a point or more a match the end is reached in so many; without moves it never is.
    for many in range(ladder.errors.size):
        law = down @ law
        if law @ last > MOST_HELD:
            return many
    return int(ladder.errors.size)


def start_law(ladder: Ladder, start: int | Distribution) -> Floats:
    """Return the probability of each of the ladder's errors.

    Raises InputError if an error is not a whole number, or is beyond the ladder's ends.

    >>> from evenbreak.handicaps import Ladder
    >>> start_law(Ladder("npl", widest=10), -10)[:2]
    array([1., 0.])
    """
    pairs: Iterable[tuple[Any, Any]] = (
        zip(start.values, start.probability, strict=True)
        if isinstance(start, Distribution)
        else [(start, 1.0)]
    )
    law, widest = np.zeros(ladder.errors.size), int(ladder.errors[-1])
    for error, chance in pairs:
        law[error_on(widest, error) + widest] += float(chance)
    return law


def earnest_matrix(ladder: Ladder, factor: int = 1) -> Floats:
    """Return P(next error | error) for a match that counts, shape (errors, errors).

    Column-stochastic: v' = M v. A move beyond an end of the ladder is not made; a newcomer's moves
    are multiplied by the factor. Raises InputError if the ladder's player drifts.
    """
    refuse_drift(ladder)
    return move_matrix(ladder, factor).T


def dumped_matrix(ladder: Ladder) -> Floats:
    """Return P(next error | error) for a match lost on purpose, shape (errors, errors).

    >>> from evenbreak.handicaps import Ladder
    >>> dumped_matrix(Ladder("npl", widest=1))
    array([[1., 1., 0.],
           [0., 0., 1.],
           [0., 0., 0.]])
    """
    refuse_drift(ladder)
    here = np.arange(ladder.errors.size)
    there = here + dumped_moves(ladder)
    matrix = np.zeros((here.size, here.size))
    matrix[np.where((there < 0) | (there >= here.size), here, there), here] = 1.0
    return matrix


def dumped_moves(ladder: Ladder) -> Ints:
    """Return how far the most costly defeat moves the rating at each error."""
    table = match_table(ladder.system, ladder.chart, widest=int(ladder.errors[-1]))
    lost = ~table.won & (table.games[..., 1] >= 0)
    return np.asarray(np.where(lost, table.moves[..., 0], np.iinfo(np.int64).max).min(axis=1))


def at_the_end(ladder: Ladder) -> Bools:
    """Return which errors are the lowest, or cannot fall because of the ladder's end."""
    here = np.arange(ladder.errors.size)
    return np.asarray((here == 0) | (here + dumped_moves(ladder) < 0))


def refuse_drift(ladder: Ladder) -> None:
    """Raise an error if the player's skill drifts on this ladder."""
    if ladder.drift:
        raise InputError(
            "the player in this ladder drifts by {drift!r}. Use a ladder whose drift is 0.",
            drift=ladder.drift,
        )


def _laws(matrix: Floats, law: Floats, many: int) -> Floats:
    """Return the distribution before each of `many` matches, shape (matches, errors)."""
    laws = np.empty((many, law.size))
    for place in range(many):
        laws[place] = law
        law = matrix @ law
    return laws
