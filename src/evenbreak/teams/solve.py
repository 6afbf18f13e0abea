"""Value of a team night, and of each point in it, by backward induction.

A point of the night consists of the sets played, the players used up on either squad, the lead, and
the winner of the last set if the order depends on it. After the last set, the lead determines the
value of the night. Before that, each pair of picks leads to the points after the set; the team that
names first maximizes over the other team's best answers, and blind picks are a matrix game.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from evenbreak.arrays import Floats, Ints, array_values
from evenbreak.errors import InputError
from evenbreak.teams.matrix_games import matrix_game
from evenbreak.teams.night import BOTH, LOSER, OURS, THEIRS, WINNER, TeamNight
from evenbreak.teams.squad import Squad

MOST_STEPS = 4e9
"""The most multiplications for a night, about half a minute; beyond this, an error is raised."""

_AT_A_TIME = 1 << 22


@array_values
@dataclass(frozen=True, eq=False)
class SolvedNight:
    """Team night with the value of each of its points.

    Parameters
    ----------
    values
        values[k][a, b, w, lead + k reach]: the value of the night to us after k sets, with our
        squad used up as in state a and theirs as in state b of their `LineUps`. The axis w is the
        winner of the last set (0: we did), if the order depends on it; otherwise, it has length 1.

    Notes
    -----
    The value is P(we win the night) plus `tie` times P(it is tied), if both captains play
    optimally.
    """

    night: TeamNight
    values: tuple[Floats, ...]

    @property
    def value(self) -> float:
        """The value of the night before the first nomination."""
        return float(self.values[0][0, 0, 0, 0])

    def mirrored(self, night: TeamNight) -> SolvedNight:
        """Return the solution from the other team's point of view.

        Parameters
        ----------
        night
            the same night, with that team as `ours`.
        """
        seen = tuple(1.0 - v.transpose(1, 0, 2, 3)[:, :, ::-1, ::-1] for v in self.values)
        return SolvedNight(night, seen)


def solved(night: TeamNight) -> SolvedNight:
    """Return the value of every point in a night.

    Raises
    ------
    InputError
        if the night has too many points.

    >>> from evenbreak.teams import Squad, TeamNight
    >>> better, even = np.zeros((2, 1, 1, 2, 3))
    >>> better[..., 0, 2], better[..., 1, 0] = 0.6, 0.4
    >>> night = TeamNight(Squad(("Ann",)), Squad(("Bo",)), [better])
    >>> solved(night).value
    0.6
    """
    refuse_large(night)
    reach, sets = night.reach, night.sets
    leads = np.arange(-sets * reach, sets * reach + 1)
    shape = len(night.our_line_ups.used[sets]), len(night.their_line_ups.used[sets])
    values = [np.broadcast_to(night.payoff(leads), (*shape, 1, len(leads)))]
    for k in reversed(range(sets)):
        values.append(_before(night, k, values[-1]))
    return SolvedNight(night, tuple(values[::-1]))


def pair_values(night: TeamNight, k: int, after: Floats, i: int, j: int) -> Floats:
    """Return the value if picks i and j play set k, for states that allow them.

    `after` holds those states' values after the set; the last axis of the result is the lead before
    it.
    """
    law = night.laws[k][i, j]
    own, leads = law.shape[1] // 2, after.shape[-1] - 2 * night.reach
    found = np.zeros((*after.shape[:2], leads))
    for won, d in zip(*np.nonzero(law), strict=True):
        start = night.reach + d - own
        block = after[:, :, won if after.shape[2] > 1 else 0, start : start + leads]
        found += law[won, d] * block
    return found


def names_first(letter: str, last_won: bool) -> str:
    """Return who names first, if the letter may depend on who won the last set."""
    if letter in (WINNER, LOSER):
        return OURS if last_won == (letter == WINNER) else THEIRS
    return letter


def _before(night: TeamNight, k: int, after: Floats) -> Floats:
    """Return the values before set k, given those after it."""
    letter = night.order[k]
    if letter == BOTH:
        return _blind(night, k, after)[:, :, None]
    if letter in (WINNER, LOSER):
        both = [_in_turn(night, k, after, names_first(letter, won)) for won in (True, False)]
        return np.stack(both, axis=2)
    return _in_turn(night, k, after, letter)[:, :, None]


def _in_turn(night: TeamNight, k: int, after: Floats, first: str) -> Floats:
    """Return the values if one team names first and the other one answers."""
    mine, others = night.our_line_ups.moves[k], night.their_line_ups.moves[k]
    leads = after.shape[-1] - 2 * night.reach
    shape = len(night.our_line_ups.used[k]), len(night.their_line_ups.used[k]), leads
    ours_first = first == OURS
    leading, replying = (mine, others) if ours_first else (others, mine)
    best = np.full(shape, -np.inf if ours_first else np.inf)
    for named, (allowed, _) in enumerate(leading):
        worst = np.full(shape, np.inf if ours_first else -np.inf)
        for reply in range(len(replying)):
            i, j = (named, reply) if ours_first else (reply, named)
            (a, to_a), (b, to_b) = mine[i], others[j]
            if not a.size or not b.size:
                continue
            found = pair_values(night, k, after[to_a[:, None], to_b], i, j)
            at = a[:, None], b
            worst[at] = (np.minimum if ours_first else np.maximum)(worst[at], found)
        if ours_first:
            best[allowed] = np.maximum(best[allowed], worst[allowed])
        else:
            best[:, allowed] = np.minimum(best[:, allowed], worst[:, allowed])
    return best


def _blind(night: TeamNight, k: int, after: Floats) -> Floats:
    """Return the values if both teams name at once."""
    mine, others = night.our_line_ups.after[k], night.their_line_ups.after[k]
    leads = after.shape[-1] - 2 * night.reach
    rows, columns = _allowed(mine), _allowed(others)
    found = np.empty((len(mine), len(others), leads))
    at_once = max(1, _AT_A_TIME // max(1, len(others) * leads * rows.shape[1] * columns.shape[1]))
    for start in range(0, len(mine), at_once):
        part = slice(start, start + at_once)
        games = _games(night, k, after, mine[part], others)
        # Only the picks that are allowed, so that the games are small; padding loses.
        a = np.arange(len(games))[:, None, None, None]
        b = np.arange(len(others))[None, :, None, None]
        small = games[a, b, rows[part][:, None, :, None], columns[None, :, None, :]]
        found[part] = matrix_game(np.moveaxis(small, -1, 2)).value
    return found


def _allowed(table: Ints) -> Ints:
    """Return the picks in each state, allowed ones first, with as few as all states need."""
    most = int((table >= 0).sum(axis=1).max())
    return np.argsort(table < 0, axis=1, kind="stable")[:, :most]


def _games(night: TeamNight, k: int, after: Floats, mine: Ints, others: Ints) -> Floats:
    """Return the value of each pair of picks, shape (ours, theirs, i, j, lead)."""
    leads = after.shape[-1] - 2 * night.reach
    games = np.empty((len(mine), len(others), mine.shape[1], others.shape[1], leads))
    games[:] = 2.0  # they never choose what is not allowed
    games[(mine < 0)[:, None, :, None].repeat(len(others), 1).repeat(others.shape[1], 3)] = -1.0
    for i in range(mine.shape[1]):
        for j in range(others.shape[1]):
            a, b = np.flatnonzero(mine[:, i] >= 0), np.flatnonzero(others[:, j] >= 0)
            if a.size and b.size:
                block = after[np.ix_(mine[a, i], others[b, j])]
                at = np.ix_(a, b)
                games[:, :, i, j][at] = pair_values(night, k, block, i, j)
    return games


def steps_of(night: TeamNight) -> float:
    """Return the approximate number of multiplications needed to solve a night."""
    return sum(
        float(mine.size) * others.size * (2 * k * night.reach + 1) * np.count_nonzero(law[0, 0])
        for k, (mine, others, law) in enumerate(
            zip(night.our_line_ups.after, night.their_line_ups.after, night.laws, strict=True)
        )
    )


def refuse_large(night: TeamNight) -> None:
    """Raise InputError if a night has too many points."""
    if steps_of(night) > MOST_STEPS:
        raise InputError(
            "squads of {ours} and {theirs} players allow too many lineups of {sets} "
            "sets. Leave out those who won't play tonight, or play fewer sets.",
            ours=len(night.ours.names),
            theirs=len(night.theirs.names),
            sets=night.sets,
        )


def league_nights(
    squads: Sequence[Squad],
    laws: Callable[[int, int], Floats],
    *,
    sets: int,
    order: str = "alternate",
) -> Floats:
    """Return each team's chance of winning a night against each other, with optimal captains.

    Parameters
    ----------
    squads
        the squads, with the caps that they must keep.
    laws
        laws(i, j) is the possible results of a set between teams i and j, as returned by
        `set_laws`.
    sets
        per night.
    order
        of nomination; the row's team is A.

    Returns
    -------
    numpy.ndarray
        shape (teams, teams): P(the row's team beats the column's team), with a tie counting half;
        NaN on the diagonal.

    Raises
    ------
    InputError
        if a team cannot fill its sets, or a night is too large.

    >>> from evenbreak.ratings import Roster
    >>> from evenbreak.teams import set_laws
    >>> teams = [Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy", "Di"], [560, 560])]
    >>> squads = [Squad(team.players) for team in teams]
    >>> def laws(i, j):
    ...     return set_laws(teams[i], teams[j], 5)
    >>> league_nights(squads, laws, sets=2, order="A").round(3)
    array([[  nan, 0.463],
           [0.537,   nan]])
    """
    count = len(squads)
    if count < 2:
        raise InputError("there must be at least two teams; you gave {count}", count=count)
    found = np.full((count, count), np.nan)
    for i in range(count):
        for j in range(count):
            if i != j:
                night = TeamNight(squads[i], squads[j], laws(i, j), sets=sets, order=order)
                found[i, j] = solved(night).value
    return found


def against_all(nights: Floats) -> Floats:
    """Return each team's mean chance over all nights, half of them as A and half as B.

    >>> against_all(np.array([[np.nan, 0.6], [0.5, np.nan]]))
    array([0.55, 0.45])
    """
    return np.asarray(0.5 * (np.nanmean(nights, axis=1) + 1.0 - np.nanmean(nights, axis=0)))


def first_edges(nights: Floats) -> Floats:
    """Return each team's advantage from being A against each other: shape (teams, teams).

    It is P(the row's team wins | it is A) - P(it wins | it is B); NaN on the diagonal.

    >>> first_edges(np.array([[np.nan, 0.6], [0.5, np.nan]])).round(12)
    array([[nan, 0.1],
           [0.1, nan]])
    """
    return np.asarray(nights + nights.T - 1.0)
