"""What the rules of a team league do: every team against every other, each night solved exactly."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.teams.night import TeamNight
from evenbreak.teams.solve import solved
from evenbreak.teams.squad import Squad


def league_nights(
    squads: Sequence[Squad],
    laws: Callable[[int, int], Floats],
    *,
    sets: int,
    order: str = "alternate",
) -> Floats:
    """Return each team's chance of winning a night against each other, both captains at their best.

    Parameters
    ----------
    squads
        the teams, with the caps that they must keep.
    laws
        laws(i, j) is what a set of team i against team j can bring, as `set_laws` returns it.
    sets
        how many sets a night has.
    order
        of nomination; the team of the row is A.

    Returns
    -------
    numpy.ndarray
        shape (teams, teams): P(the team of the row beats that of the column), a tie counting half;
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
        raise InputError("{count} teams; give at least two", count=count)
    found = np.full((count, count), np.nan)
    for i in range(count):
        for j in range(count):
            if i != j:
                night = TeamNight(squads[i], squads[j], laws(i, j), sets=sets, order=order)
                found[i, j] = solved(night).value
    return found


def against_all(nights: Floats) -> Floats:
    """Return each team's chance over all nights, half of them as A and half as B; shape (teams,).

    >>> against_all(np.array([[np.nan, 0.6], [0.5, np.nan]]))
    array([0.55, 0.45])
    """
    return np.asarray(0.5 * (np.nanmean(nights, axis=1) + 1.0 - np.nanmean(nights, axis=0)))


def first_edges(nights: Floats) -> Floats:
    """Return what being A is worth to each team against each other: shape (teams, teams).

    P(the team of the row wins | it is A) - P(it wins | it is B); NaN on the diagonal.

    >>> first_edges(np.array([[np.nan, 0.6], [0.5, np.nan]])).round(12)
    array([[nan, 0.1],
           [0.1, nan]])
    """
    return np.asarray(nights + nights.T - 1.0)
