"""Two picks compared: their races in a set, and the difference in strength."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from evenbreak.arrays import Floats, Ints, own_arrays
from evenbreak.errors import InputError
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.handicaps.charts.points_odds import PointsOdds, points_odds
from evenbreak.handicaps.charts.race_of_pair import Race, games_needed
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale

SetRace: TypeAlias = Race | LevelChart | PointsChart
"""What is played in a set: an even race, a race from a chart, or points from a chart of points."""


@own_arrays
@dataclass(frozen=True, eq=False)
class Pairs:
    """Each of our picks against each of theirs; all of shape (ours, theirs).

    Parameters
    ----------
    points, errors
        our pick's rating minus theirs, and its standard error, in points of the scale.
    needs_1, needs_2
        the games (or points, for a chart of points) that both need.
    """

    points: Floats
    errors: Floats
    needs_1: Ints
    needs_2: Ints


def pairs_of(
    ours: Roster,
    theirs: Roster,
    race: SetRace,
    scale: Scale,
    *,
    size: int = 1,
    levels: LevelSkills | None = None,
) -> Pairs:
    """Return how the picks of two squads compare.

    Parameters
    ----------
    ours, theirs
        the squads, with ratings, or with skill levels if `levels` is given; a chart by skill level
        uses the levels in both cases.
    size
        1, or 2 for doubles: a pair is as strong as the mean of the two, and has the mean of their
        levels, rounded up.
    levels
        the strength of skill levels, if the chances come from levels.

    Raises
    ------
    InputError
        if a player has no rating or level, and it is needed.
    """
    if isinstance(race, PointsChart):
        needed = [
            [race.race(a, b) for b in _levels(theirs, size, race)]
            for a in _levels(ours, size, race)
        ]
        first, second = np.moveaxis(np.array(needed, dtype=np.int64), -1, 0)
        nothing = np.zeros(first.shape)
        return Pairs(nothing, nothing, first, second)
    if levels is None:
        points, errors = rating_differences(ours, theirs, size)
    else:
        points, errors = _level_differences(ours, theirs, size, levels)
    if isinstance(race, LevelChart):
        needs = race.races(_levels(ours, size, race)[:, None], _levels(theirs, size, race))
    else:
        needs = games_needed(points, race, scale)
    return Pairs(points, errors, *needs)


def rating_differences(ours: Roster, theirs: Roster, size: int = 1) -> tuple[Floats, Floats]:
    """Return the rating difference for every pair of picks, and its standard error."""
    sides = []
    for roster in (ours, theirs):
        _refuse_without(roster, roster.rating, "rating")
        variance = np.nan_to_num(roster.standard_error) ** 2
        sides.append((of_picks(roster.rating, size), of_picks(variance, size) / size))
    (mine, mine_off), (others, others_off) = sides
    return mine[:, None] - others, np.sqrt(mine_off[:, None] + others_off)


def of_picks(values: Floats, size: int) -> Floats:
    """Return the mean of each pick of `size` players."""
    return np.asarray(values[_picks(len(values), size)].mean(axis=1))


def _picks(many: int, size: int) -> Ints:
    picks = np.array(list(itertools.combinations(range(many), size)), dtype=np.int64)
    return picks.reshape(-1, size)


def _levels(roster: Roster, size: int, chart: LevelChart | PointsChart) -> Floats:
    """Return the skill level of each pick."""
    _check_levels(roster, chart)
    return np.ceil(of_picks(roster.level, size))


def _check_levels(roster: Roster, chart: LevelChart | PointsChart) -> None:
    """Raise an error for a player without a level, or with one that a chart does not have."""
    _refuse_without(roster, roster.level, "level")
    other = ~np.isin(roster.level, chart.levels)
    if other.any():
        place = int(other.argmax())
        raise InputError(
            "{player!r} has skill level {level:g}, but {chart} has levels {levels}",
            player=roster.players[place],
            level=roster.level[place],
            chart=chart.name,
            levels=", ".join(map(str, chart.levels)),
        )


def _level_differences(
    ours: Roster, theirs: Roster, size: int, levels: LevelSkills
) -> tuple[Floats, Floats]:
    """Return the strength difference for every pair of picks, from their levels, and its error."""
    for roster in (ours, theirs):
        _check_levels(roster, levels.chart)
    of_pairs = ours.level[:, None], theirs.level
    mine, others = (_picks(len(roster), size) for roster in (ours, theirs))
    each = mine[:, None, :, None], others[None, :, None, :]
    points, errors = (
        np.asarray(values)[each].mean(axis=(2, 3))
        for values in (levels.difference(*of_pairs), levels.error(*of_pairs))
    )
    return points, errors


def _refuse_without(roster: Roster, values: Floats, column: str) -> None:
    if np.isnan(values).any():
        name = roster.players[int(np.isnan(values).argmax())]
        if column == "rating":
            raise InputError(
                "{player!r} has no rating. Add one, or leave the player out.", player=name
            )
        raise InputError(
            "{player!r} has no skill level. Add one, or leave the player out.", player=name
        )


@lru_cache(maxsize=512)
def by_points(
    chart: PointsChart, needs: tuple[int, int], score: tuple[int, int] = (0, 0)
) -> PointsOdds:
    """Return the outcome of a match by a chart of points, given the points that both need."""
    first, second = (chart.levels[chart.points.index(points)] for points in needs)
    return points_odds(chart, first, second, score=score)
