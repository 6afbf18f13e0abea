"""What a set can bring, from ratings: who wins it, and what it adds to the lead."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import floats, one_of, whole
from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.gap import Gap, averaging_rule
from evenbreak.handicaps.charts.race_of_pair import Race, games_needed
from evenbreak.matches.endings import race_endings
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale, scale_of


@dataclass(frozen=True)
class Points:
    """The points of a set.

    Parameters
    ----------
    win
        to the winner.
    shutout
        to a winner whose opponent won no game, on top.
    hill
        to a loser who needed one more game.

    Notes
    -----
    The defaults are those of APA 8-ball: 3:0 for a shutout, 2:1 hill-hill, else 2:0.
    """

    win: int = 2
    shutout: int = 1
    hill: int = 1

    def __post_init__(self) -> None:
        for name in ("win", "shutout", "hill"):
            whole(getattr(self, name), name)
        if self.win <= self.hill:
            raise InputError(
                "winning must count more ({win}) than losing hill-hill ({hill})",
                win=self.win,
                hill=self.hill,
            )


Count: TypeAlias = Literal["sets", "games"] | Points
"""What decides the night: sets won, all games won, or points."""


def set_laws(
    ours: Roster,
    theirs: Roster,
    race: Race,
    *,
    scale: Scale | str | float = "fargo",
    count: Count = "sets",
    size: int = 1,
    skills: tuple[ArrayLike, ArrayLike] | None = None,
    form: float = 0.0,
) -> Floats:
    """Return what each of our picks can bring against each of theirs.

    Parameters
    ----------
    ours, theirs
        the squads with their ratings. Where they state standard errors, chances are averaged
        over how far the ratings may be off.
    race
        what is played: an even race to so many games, a `Chart`, or the `Fairest` of a length.
    scale
        the scale of the ratings.
    count
        what decides the night.
    size
        1, or 2 for doubles: a pair plays like a player with the mean of the two ratings.
    skills
        how our players and theirs really play, where it is not as their ratings say.
    form
        how much the log-odds of a game vary from set to set (standard deviation).

    Returns
    -------
    numpy.ndarray
        a law for `TeamNight`: shape (our picks, their picks, 2, 2 reach + 1).

    Raises
    ------
    InputError
        if a player has no rating, or the race cannot be played.

    Notes
    -----
    A race is set by the ratings as they are listed, and won by the skills they may stand for.

    >>> us, them = Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy", "Di"], [560, 520])
    >>> law = set_laws(us, them, 5)
    >>> law[:, :, 0].sum(axis=2).round(3)
    array([[0.665, 0.802],
           [0.261, 0.415]])
    """
    one_of(size, "size", (1, 2))
    if not isinstance(count, Points):
        one_of(count, "count", ("sets", "games"))
    points, errors = rating_differences(ours, theirs, size)
    scale = scale_of(scale)
    needs_1, needs_2 = games_needed(points, race, scale)
    if skills is not None:
        mine, others = (floats(each, "skills") for each in skills)
        points = _of_picks(mine, size)[:, None] - _of_picks(others, size)
        errors = np.zeros(points.shape)
    points, errors = Gap(points, errors, scale, form).normal
    reach = _reach(needs_1, needs_2, count)
    law = np.zeros((*points.shape, 2, 2 * reach + 1))
    for i, j, m, n, endings in _endings(points, errors, needs_1, needs_2, scale):
        for who, ends in enumerate(endings):
            for length, margin in _margins(m, n, who, count):
                law[i, j, who, reach + margin] += ends[length]
    return np.minimum(law, 1.0)  # a sum may round to more


def set_lengths(
    ours: Roster,
    theirs: Roster,
    race: Race,
    *,
    scale: Scale | str | float = "fargo",
    size: int = 1,
    form: float = 0.0,
) -> Floats:
    """Return how many games a set takes, for each of our picks against each of theirs.

    Parameters
    ----------
    ours, theirs, race, scale, size, form
        as for `set_laws`.

    Returns
    -------
    numpy.ndarray
        P(the set takes k games), shape (our picks, their picks, longest + 1).

    >>> set_lengths(Roster(["Ann"], [600]), Roster(["Cy"], [600]), 2).tolist()
    [[[0.0, 0.0, 0.5, 0.5]]]
    """
    points, errors = rating_differences(ours, theirs, size)
    scale = scale_of(scale)
    needs_1, needs_2 = games_needed(points, race, scale)
    points, errors = Gap(points, errors, scale, form).normal
    chance = np.zeros((*points.shape, int((needs_1 + needs_2).max())))
    for i, j, m, n, (won, lost) in _endings(points, errors, needs_1, needs_2, scale):
        chance[i, j, : m + n] = (won + lost)[: m + n].T
    return chance


def _endings(
    points: Floats, errors: Floats, needs_1: Ints, needs_2: Ints, scale: Scale
) -> Iterator[tuple[Ints, Ints, int, int, list[Floats]]]:
    """Yield the pairs that play each race, and P(it is won, or lost, in k games) of each."""
    for m, n in set(zip(needs_1.ravel().tolist(), needs_2.ravel().tolist(), strict=True)):
        i, j = np.nonzero((needs_1 == m) & (needs_2 == n))
        nodes, weights = averaging_rule(float(errors[i, j].max()), m + n, scale)
        p = scale.win_probability(points[i, j] + nodes[:, None] * errors[i, j])
        yield i, j, m, n, [weights @ ends for ends in race_endings(m, n, Rack(p), None, 1)]


def law_in_play(
    ours: Roster,
    theirs: Roster,
    race: Race,
    score: tuple[int, int],
    *,
    scale: Scale | str | float = "fargo",
    count: Count = "sets",
    form: float = 0.0,
) -> Floats:
    """Return what a match that is being played can bring, from its score on.

    Parameters
    ----------
    ours, theirs
        who plays it: one player, or two for doubles, with their ratings.
    race, scale, count, form
        as for `set_laws`.
    score
        the games that we and they have won.

    Returns
    -------
    numpy.ndarray
        a law for `Point.in_play`, shape (2, 2 reach + 1).

    Raises
    ------
    InputError
        as `set_laws` does, or if the score cannot be that of a match in play.

    Notes
    -----
    Where the ratings have errors, or there is form, the score says something about them (Bayes).

    >>> law = law_in_play(Roster(["Ann"], [600]), Roster(["Cy"], [560]), 5, (3, 4))
    >>> law.sum(axis=1).round(3)
    array([0.324, 0.676])
    """
    points, errors = rating_differences(ours, theirs, len(ours))
    scale = scale_of(scale)
    m, n = (int(needs[0, 0]) for needs in games_needed(points, race, scale))
    a, b = (whole(games, "score") for games in score)
    if a >= m or b >= n:
        raise InputError(
            "{a}:{b} ends a race {m}:{n}; enter the score of a match in play", a=a, b=b, m=m, n=n
        )
    points, errors = Gap(points, errors, scale, form).normal
    nodes, weights = averaging_rule(float(errors[0, 0]), m + n, scale)
    p = scale.win_probability(points[0, 0] + nodes * errors[0, 0])
    weights = weights * p**a * (1.0 - p) ** b
    weights /= weights.sum()
    reach = _reach(np.array(m), np.array(n), count)
    law = np.zeros((2, 2 * reach + 1))
    for who, ends in enumerate(race_endings(m - a, n - b, Rack(p), None, 1)):
        for length, margin in _margins(m, n, who, count):
            if 0 < length - a - b < len(ends):
                law[who, reach + margin] += ends[length - a - b] @ weights
    return law


def brought(needs: tuple[int, int], score: tuple[int, int], count: Count) -> tuple[int, int]:
    """Return what a set that has been played brings both teams.

    Parameters
    ----------
    needs, score
        the games that both needed, and won.
    count
        what decides the night.

    Raises
    ------
    InputError
        if the score does not end the set.

    >>> brought((5, 4), (5, 3), "sets"), brought((5, 4), (5, 3), Points())
    ((1, 0), (2, 1))
    """
    (m, n), (a, b) = needs, (whole(games, "score") for games in score)
    if (a == m) == (b == n) or a > m or b > n:
        if m == n:
            raise InputError("{a}:{b} can't be the final score of a race to {n}", a=a, b=b, n=n)
        raise InputError("{a}:{b} can't be the final score of a race {m}:{n}", a=a, b=b, m=m, n=n)
    if count == "games":
        return a, b
    won = a == m
    if count == "sets":
        return int(won), int(not won)
    lost, other = (b, n) if won else (a, m)
    points = (
        count.win + (count.shutout if lost == 0 else 0),
        count.hill if lost == other - 1 and lost > 0 else 0,
    )
    return points if won else points[::-1]


def _margins(m: int, n: int, who: int, count: Count) -> Iterator[tuple[int, int]]:
    """Yield each length of a race m:n won by us (0) or by them (1), and what it adds to our lead.

    >>> list(_margins(2, 2, 0, "games")), list(_margins(2, 2, 1, Points()))
    ([(2, 2), (3, 1)], [(2, -3), (3, -1)])
    """
    needs, other, sign = (m, n, 1) if who == 0 else (n, m, -1)
    for lost in range(other):
        ours, theirs = brought((needs, other), (needs, lost), count)
        yield needs + lost, sign * (ours - theirs)


def _reach(needs_1: Ints, needs_2: Ints, count: Count) -> int:
    if count == "sets":
        return 1
    if count == "games":
        return int(max(needs_1.max(), needs_2.max()))
    return count.win + count.shutout


def rating_differences(ours: Roster, theirs: Roster, size: int = 1) -> tuple[Floats, Floats]:
    """Return the rating difference of every two picks, and its standard error."""
    sides = []
    for roster in (ours, theirs):
        if np.isnan(roster.rating).any():
            name = roster.players[int(np.isnan(roster.rating).argmax())]
            raise InputError(
                "{player!r} has no rating; add one, or leave the player out", player=name
            )
        variance = np.nan_to_num(roster.standard_error) ** 2
        sides.append((_of_picks(roster.rating, size), _of_picks(variance, size) / size))
    (mine, mine_off), (others, others_off) = sides
    return mine[:, None] - others, np.sqrt(mine_off[:, None] + others_off)


def _of_picks(values: Floats, size: int) -> Floats:
    """Return the mean of each pick of `size` players."""
    picks = np.array(list(itertools.combinations(range(len(values)), size)), dtype=np.int64)
    return np.asarray(values[picks.reshape(-1, size)].mean(axis=1))
