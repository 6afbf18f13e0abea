"""Possible results of a set, from ratings: who wins it, and its effect on the lead."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from evenbreak.arrays import Floats, Ints
from evenbreak.checks import floats, one_of, whole
from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.gap import Gap, averaging_rule
from evenbreak.handicaps.charts.level_chart import PointsChart, points_chart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.handicaps.charts.points_odds import MATCH_POINTS, loser_share
from evenbreak.matches.endings import race_endings
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale, scale_of
from evenbreak.teams.pairs import Pairs, SetRace, by_points, of_picks, pairs_of
from evenbreak.words import Parameter

POINTS_OF_A_RACK = 10
"""The points in a rack under a chart of points such as APA 9-ball's."""


@dataclass(frozen=True)
class Points:
    """Points for a set.

    Parameters
    ----------
    win
        to the winner.
    shutout
        additional points to a winner whose opponent won no game.
    hill
        points to a loser who needed one more game.

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
                "a win must count more ({win}) than a hill-hill loss ({hill})",
                win=self.win,
                hill=self.hill,
            )


@dataclass(frozen=True)
class Shares:
    """The 20 match points shared by the two players in an APA 9-ball match; see `loser_share`."""


Count: TypeAlias = Literal["sets", "games"] | Points | Shares
"""What decides the night: sets won, all games won, or match points."""


COUNTS = ("sets", "games", "points")
"""The options for what decides a night, by name."""


def count_by(text: str, race: SetRace) -> Count:
    """Return what decides a night: 'sets', 'games' or 'points' (match points).

    Raises
    ------
    InputError
        if it is none of them, or the chart is one of points whose match points are not known.

    >>> count_by("points", 5), count_by("points", points_chart("apa_9ball"))
    (Points(win=2, shutout=1, hill=1), Shares())
    """
    if one_of(text, "count", COUNTS) != "points":
        return text  # type: ignore[return-value]
    if not isinstance(race, PointsChart):
        return Points()
    own = points_chart("apa_9ball")
    if (race.levels, race.points) != (own.levels, own.points):
        raise InputError(
            "only apa_9ball has a known way to share match points. With {chart}, count sets.",
            chart=race.name,
        )
    return Shares()


def set_laws(
    ours: Roster,
    theirs: Roster,
    race: SetRace,
    *,
    scale: Scale | str | float = "fargo",
    count: Count = "sets",
    size: int = 1,
    skills: tuple[ArrayLike, ArrayLike] | None = None,
    form: float = 0.0,
    levels: LevelSkills | None = None,
) -> Floats:
    """Return the possible results of each of our picks against each of theirs.

    Parameters
    ----------
    ours, theirs
        squads with ratings. If these have standard errors, chances are averaged over them.
    race
        an even race to a number of games, a `Chart`, the `Fairest` race of a length, a `LevelChart`
        or a `PointsChart`.
    count
        what decides the night.
    size
        1, or 2 for doubles: a pair plays like a player with the mean of the two ratings.
    skills
        true skills of our players and theirs, if they differ from the ratings.
    form
        standard deviation of a game's log-odds from set to set.
    levels
        strengths of skill levels, if the chances come from levels, not ratings; the scale is then
        Fargo's. With a chart of points, they always come from the levels.

    Returns
    -------
    numpy.ndarray
        a distribution for `TeamNight`: shape (our picks, their picks, 2, 2 reach + 1).

    Raises
    ------
    InputError
        if a player has no rating, or the race cannot be played.

    Notes
    -----
    The race depends on the listed ratings, and the result on the possible true skills.

    >>> us, them = Roster(["Ann", "Bo"], [600, 500]), Roster(["Cy", "Di"], [560, 520])
    >>> law = set_laws(us, them, 5)
    >>> law[:, :, 0].sum(axis=2).round(3)
    array([[0.665, 0.802],
           [0.261, 0.415]])
    """
    one_of(size, "size", (1, 2))
    _check_count(count, race)
    scale = scale_of(scale)
    pairs = pairs_of(ours, theirs, race, scale, size=size, levels=levels)
    if skills is not None:
        mine, others = (floats(each, "skills") for each in skills)
        points = of_picks(mine, size)[:, None] - of_picks(others, size)
        pairs = replace(pairs, points=points, errors=np.zeros(points.shape))
    reach = _reach(pairs, count)
    law = np.zeros((*pairs.points.shape, 2, 2 * reach + 1))
    for i, j, m, n, endings in _endings(pairs, race, scale, form):
        for who, ends in enumerate(endings):
            for length, margin in _margins(m, n, who, count):
                law[i, j, who, reach + margin] += ends[length]
    return np.minimum(law, 1.0)  # a sum may round to more


def set_lengths(
    ours: Roster,
    theirs: Roster,
    race: SetRace,
    *,
    scale: Scale | str | float = "fargo",
    size: int = 1,
    form: float = 0.0,
    levels: LevelSkills | None = None,
) -> Floats:
    """Return the length of a set in games, for each of our picks against each of theirs.

    Parameters
    ----------
    ours, theirs, race, scale, size, form, levels
        as for `set_laws`. With a chart of points, ten points count as a game.

    Returns
    -------
    numpy.ndarray
        P(the set takes k games), shape (our picks, their picks, longest + 1).

    >>> set_lengths(Roster(["Ann"], [600]), Roster(["Cy"], [600]), 2).tolist()
    [[[0.0, 0.0, 0.5, 0.5]]]
    """
    scale = scale_of(scale)
    pairs = pairs_of(ours, theirs, race, scale, size=size, levels=levels)
    chance = np.zeros((*pairs.points.shape, int((pairs.needs_1 + pairs.needs_2).max())))
    for i, j, m, n, (won, lost) in _endings(pairs, race, scale, form):
        chance[i, j, : m + n] = (won + lost)[: m + n].T
    if not isinstance(race, PointsChart):
        return chance
    games = -(-np.arange(chance.shape[2]) // POINTS_OF_A_RACK)
    return np.stack([chance[..., games == k].sum(axis=2) for k in range(games[-1] + 1)], axis=2)


def _endings(
    pairs: Pairs, race: SetRace, scale: Scale, form: float
) -> Iterator[tuple[Ints, Ints, int, int, list[Floats]]]:
    """Yield the pairs with the same race, and each pair's P(win, or lose, in k games).

    With a chart of points, k is the total points of both.
    """
    points, errors = Gap(pairs.points, pairs.errors, scale, form).normal
    needs = zip(pairs.needs_1.ravel().tolist(), pairs.needs_2.ravel().tolist(), strict=True)
    for m, n in sorted(set(needs)):
        i, j = np.nonzero((pairs.needs_1 == m) & (pairs.needs_2 == n))
        if isinstance(race, PointsChart):
            yield i, j, m, n, [ends[:, None] for ends in _points_endings(race, (m, n))]
            continue
        nodes, weights = averaging_rule(float(errors[i, j].max()), m + n, scale)
        p = scale.win_probability(points[i, j] + nodes[:, None] * errors[i, j])
        yield i, j, m, n, [weights @ ends for ends in race_endings(m, n, Rack(p), None, 1)]


def _points_endings(
    chart: PointsChart, needs: tuple[int, int], score: tuple[int, int] = (0, 0)
) -> list[Floats]:
    """Return P(we win, or lose, with a total of k points)."""
    odds = by_points(chart, needs, score)
    ends = []
    for need, law in zip(needs, (odds.lost_2, odds.lost_1), strict=True):
        ends.append(np.zeros(sum(needs)))
        ends[-1][need : need + len(law)] = law
    return ends


def law_in_play(
    ours: Roster,
    theirs: Roster,
    race: SetRace,
    score: tuple[int, int],
    *,
    scale: Scale | str | float = "fargo",
    count: Count = "sets",
    form: float = 0.0,
    levels: LevelSkills | None = None,
) -> Floats:
    """Return the possible results of a match in play, from its score on.

    Parameters
    ----------
    ours, theirs
        the players, one or two for doubles, with their ratings.
    race, scale, count, form, levels
        as for `set_laws`.
    score
        the games that we and they have won, or the points made.

    Returns
    -------
    numpy.ndarray
        a distribution for `Point.in_play`, shape (2, 2 reach + 1).

    Raises
    ------
    InputError
        as `set_laws` does, or if the score is impossible for a match in play.

    Notes
    -----
    If the ratings have errors, or there is form, the score is evidence about them (Bayes).

    >>> law = law_in_play(Roster(["Ann"], [600]), Roster(["Cy"], [560]), 5, (3, 4))
    >>> law.sum(axis=1).round(3)
    array([0.324, 0.676])
    """
    scale = scale_of(scale)
    pairs = pairs_of(ours, theirs, race, scale, size=len(ours), levels=levels)
    m, n = int(pairs.needs_1[0, 0]), int(pairs.needs_2[0, 0])
    a, b = (whole(games, "score") for games in score)
    if a >= m or b >= n:
        raise InputError(
            "{a}-{b} ends a race {m}:{n}. Enter the score of a match still in play.",
            a=a,
            b=b,
            m=m,
            n=n,
        )
    if isinstance(race, PointsChart):
        ends = _points_endings(race, (m, n), (a, b))
    else:
        points, errors = Gap(pairs.points, pairs.errors, scale, form).normal
        nodes, weights = averaging_rule(float(errors[0, 0]), m + n, scale)
        p = scale.win_probability(points[0, 0] + nodes * errors[0, 0])
        weights = weights * p**a * (1.0 - p) ** b
        weights /= weights.sum()
        left = race_endings(m - a, n - b, Rack(p), None, 1)
        ends = [np.pad(each @ weights, (a + b, 0)) for each in left]
    reach = _reach(pairs, count)
    law = np.zeros((2, 2 * reach + 1))
    for who, each in enumerate(ends):
        for length, margin in _margins(m, n, who, count):
            if a + b < length < len(each):
                law[who, reach + margin] += each[length]
    return law


def brought(needs: tuple[int, int], score: tuple[int, int], count: Count) -> tuple[int, int]:
    """Return what both teams get from a finished set.

    `needs` and `score` are games, or points with a chart of points. Raises InputError if the score
    doesn't end the set.

    >>> brought((5, 4), (5, 3), "sets"), brought((5, 4), (5, 3), Points())
    ((1, 0), (2, 1))
    """
    (m, n), (a, b) = needs, (whole(games, "score") for games in score)
    if (a == m) == (b == n) or a > m or b > n:
        if m == n:
            raise InputError("{a}-{b} can't be the final score of a race to {n}", a=a, b=b, n=n)
        raise InputError("{a}-{b} can't be the final score of a race {m}:{n}", a=a, b=b, m=m, n=n)
    if count == "games":
        return a, b
    won = a == m
    if count == "sets":
        return int(won), int(not won)
    lost, other = (b, n) if won else (a, m)
    if isinstance(count, Shares):
        chart = points_chart("apa_9ball")
        share = loser_share(chart.levels[chart.points.index(other)], lost)
        return (MATCH_POINTS - share, share) if won else (share, MATCH_POINTS - share)
    points = (
        count.win + (count.shutout if lost == 0 else 0),
        count.hill if lost == other - 1 and lost > 0 else 0,
    )
    return points if won else points[::-1]


def _margins(m: int, n: int, who: int, count: Count) -> Iterator[tuple[int, int]]:
    """Yield each length of a race m:n won by us (0) or by them (1), and its effect on our lead.

    >>> list(_margins(2, 2, 0, "games")), list(_margins(2, 2, 1, Points()))
    ([(2, 2), (3, 1)], [(2, -3), (3, -1)])
    """
    needs, other, sign = (m, n, 1) if who == 0 else (n, m, -1)
    for lost in range(other):
        ours, theirs = brought((needs, other), (needs, lost), count)
        yield needs + lost, sign * (ours - theirs)


def _reach(pairs: Pairs, count: Count) -> int:
    if count == "sets":
        return 1
    if count == "games":
        return int(max(pairs.needs_1.max(), pairs.needs_2.max()))
    return MATCH_POINTS if isinstance(count, Shares) else count.win + count.shutout


def _check_count(count: Count, race: SetRace) -> None:
    """Raise an error for a way of counting that doesn't fit this kind of set."""
    if isinstance(count, Points | Shares):
        if isinstance(count, Shares) != isinstance(race, PointsChart):
            raise InputError("these match points don't go with the chart. See `count_by`")
        return
    one_of(count, "count", ("sets", "games"))
    if count == "games" and isinstance(race, PointsChart):
        raise InputError(
            "players score points, not games, on the chart {chart}. Use {count} sets or {count} "
            "points.",
            chart=race.name,
            count=Parameter("count"),
        )
