"""The players that a chart by skill level can pair, and where their chances come from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.errors import InputError
from evenbreak.files.lists.roster import RosterFile
from evenbreak.files.results.seasons import read_seasons
from evenbreak.files.tables.names import same_name
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.level_skills import LevelSkills, level_skills
from evenbreak.handicaps.charts.played_chart import last_levels
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import Scale
from evenbreak.words import FilePath, Parameter, Sentence, listed, say


def by_level(
    file: RosterFile, chart: LevelChart | PointsChart, results: str | None = None
) -> tuple[RosterFile, LevelSkills | None]:
    """Return a list with the levels that a chart uses, and how strong these levels are.

    If a list has no scale and its ratings are all levels in the chart, they are taken as levels.
    The strengths are None if the list has ratings, which then give the chances, or if it's a points
    chart. Raises InputError if the list has no levels.
    """
    roster = file.roster
    if np.isnan(roster.level).all():
        stated = roster.rating[~np.isnan(roster.rating)]
        if file.scale is not None or not np.isin(stated, chart.levels).all():
            raise InputError(
                "the chart {chart} needs skill levels, but {list} has only ratings. Add a "
                "{level} column with {levels}, or give a chart of rating differences.",
                chart=chart.name,
                list=FilePath(file.source),
                level="level",
                levels=", ".join(map(str, chart.levels)),
            )
        file = replace(file, roster=replace(roster, level=roster.rating), levels=True)
    if not file.levels or isinstance(chart, PointsChart):
        return file, None
    return file, skills_of(chart, results)


def skills_of(chart: LevelChart, results: str | None) -> LevelSkills:
    """Return how strong a chart's levels are, from the league's own results if possible."""
    if results is None:
        return level_skills(chart)
    return level_skills(chart, read_seasons([results]).results)


def levels_of(players: Sequence[str], roster: Roster | None, results: Results | None) -> Floats:
    """Return players' skill levels: on the league's list, or else the latest in its results.

    >>> sheet = Results.from_names(["Bo"], ["Ann"], [2], [1], level_a=["5"], level_b=["3"])
    >>> levels_of(["Ann", "Bo", "Cy"], Roster(["ann"], [np.nan], level=[4]), sheet)
    array([ 4.,  5., nan])
    """
    known: dict[str, float] = {}
    if results is not None and results.level_a is not None:
        known |= zip(map(same_name, results.players), last_levels(results).tolist(), strict=True)
    if roster is not None:
        stated = zip(map(same_name, roster.players), roster.level.tolist(), strict=True)
        known |= {name: level for name, level in stated if not np.isnan(level)}
    return np.array([known.get(same_name(name), np.nan) for name in players], dtype=np.float64)


MANY = 10
"""How many players with both a rating and a level are needed to see how well they agree."""


def rated_by_level(roster: Roster, chart: LevelChart, scale: Scale) -> Roster:
    """Return a roster in which unrated players get the rating of their level.

    A level's rating is the one in `level_skills`, shifted to fit the players who have both. The
    error is the spread of those players' differences, or half a doubling of the odds if there are
    few of them.

    >>> from evenbreak.handicaps import level_chart
    >>> from evenbreak.ratings import scale_of
    >>> club = Roster(["Ann", "Bo", "Cy"], [600, 400, np.nan], level=[6, 4, 5])
    >>> rated_by_level(club, level_chart("apa_8ball"), scale_of("fargo")).rating.round()
    array([600., 400., 498.])
    """
    on_chart = np.isin(roster.level, chart.levels)
    rated, new = on_chart & ~np.isnan(roster.rating), on_chart & np.isnan(roster.rating)
    if not rated.any() or not new.any():
        return roster
    points = level_skills(chart).strength(roster.level) * scale.points_per_doubling / 100.0
    shift = (roster.rating - points)[rated]
    off = float(shift.std()) if rated.sum() >= MANY else scale.points_per_doubling / 2.0
    unknown = new & np.isnan(roster.standard_error)
    return replace(
        roster,
        rating=np.where(new, shift.mean() + points, roster.rating),
        standard_error=np.where(unknown, off, roster.standard_error),
    )


def with_level(file: RosterFile, starter: float | None) -> RosterFile:
    """Return a list in which players without a level get the new players' level, if given."""
    if starter is None:
        return file
    roster = file.roster
    level = np.where(np.isnan(roster.level), starter, roster.level)
    return replace(file, roster=replace(roster, level=level))


def with_known_level(
    file: RosterFile, starter: float | None, results: str | None
) -> tuple[RosterFile, list[Sentence]]:
    """Return a list in which new players have their last level in the results, or the starter's.

    Also return what to say about those players.
    """
    roster, notes = file.roster, list[Sentence]()
    new = np.isnan(roster.level)
    if new.any() and results is not None:
        found = levels_of(roster.players, roster, read_seasons([results]).results)
        file = replace(file, roster=replace(roster, level=found))
        if (known := new & ~np.isnan(found)).any():
            each = [f"{roster.players[k]} {found[k]:g}" for k in np.flatnonzero(known)]
            notes.append(
                say(
                    "some players' levels are in the results but not in {file}; each player's "
                    "last one is used: {players}",
                    file=FilePath(file.source),
                    players=listed(each),
                )
            )
        new &= ~known
    if new.any() and starter is not None:
        who = listed([roster.players[k] for k in np.flatnonzero(new)])
        notes.append(
            say(
                "No level is known for {players}; it is assumed to be {level:g}",
                players=who,
                level=starter,
            )
        )
    return with_level(file, starter), notes


SCALE_OF_LEVELS = say(
    "{scale} is for ratings, but here the chances come from skill levels. Leave it out.",
    scale=Parameter("scale"),
)
