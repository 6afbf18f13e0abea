"""How strong teams' players are: by ratings, or by a chart's skill levels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from evenbreak.answers.kit.scales import scale_words
from evenbreak.answers.league.by_level import by_level, skills_of
from evenbreak.files.lists.roster import RosterFile
from evenbreak.handicaps.charts.level_chart import LevelChart, PointsChart
from evenbreak.handicaps.charts.level_skills import LevelSkills
from evenbreak.ratings.scale import Scale
from evenbreak.teams.pairs import SetRace
from evenbreak.words import Sentence, say


def lists_by_level(
    lists: Sequence[RosterFile], chart: LevelChart | PointsChart, results: str | None = None
) -> tuple[list[RosterFile], LevelSkills | None]:
    """Return the teams' lists with the levels that a chart uses, and how strong these levels are.

    The strengths are None if all lists have ratings, which then give the chances, or if it's a
    points chart. With levels, the lists' ratings are the levels' strengths in Fargo points. Raises
    InputError if a list has no levels.
    """
    read = [by_level(file, chart) for file in lists]
    files = [file for file, _ in read]
    if isinstance(chart, PointsChart) or all(levels is None for _, levels in read):
        return files, None
    levels = skills_of(chart, results)
    strong = [
        replace(file, roster=replace(file.roster, rating=levels.strength(file.roster.level)))
        for file in files
    ]
    return strong, levels


def strengths_words(race: SetRace, levels: LevelSkills | None, scale: Scale) -> Sentence:
    """Return where the players' strengths come from.

    >>> from evenbreak.handicaps.charts.level_chart import points_chart
    >>> from evenbreak.ratings import SCALES
    >>> print(strengths_words(5, None, SCALES["npl"]))
    Ratings on the NPL scale (30 points double the odds)
    >>> strengths_words(points_chart("apa_9ball"), None, SCALES["fargo"])
    'Players by skill level'
    """
    if levels is not None or isinstance(race, PointsChart):
        return say("Players by skill level")
    return say("Ratings {scale}", scale=scale_words(scale))


def level_words(race: SetRace, levels: LevelSkills | None) -> Sentence | None:
    """Return what the chances are based on if they come from skill levels; None otherwise."""
    if isinstance(race, PointsChart):
        return say(
            "The chances rest on an assumption, not a measurement: that players of every level "
            "in {chart} need about the same number of innings to reach their points.",
            chart=race.name,
        )
    return None if levels is None else levels.why
