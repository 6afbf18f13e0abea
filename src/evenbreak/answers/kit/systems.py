"""What questions about ratings and play share, and which settings contradict each other.

The handicap system, its scale and its chart; new players; how fast matches are played.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from evenbreak import files, handicaps
from evenbreak.answers.kit.scales import chart_doubts
from evenbreak.fields.question import Question, refuse, worded
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.words import Parameter, say

if TYPE_CHECKING:
    from evenbreak.matches.pace import Pace
    from evenbreak.ratings.roster import Roster


SAY_WHICH = worded("Add {scale} npl, {scale} fargo or {scale} elo.")
"""What to do about ratings that don't show their scale."""

CHART_OR_SCALE = worded(
    "Add {chart} apa_8ball or {chart} apa_9ball, or {scale} npl if they are ratings."
)
"""What to do about ratings that look like skill levels, if a chart can be by skill level."""

POINTS_OR_SCALE = worded(
    "Add {scale} npl if they are ratings, otherwise {scale} N, the number of levels that double "
    "the odds."
)
"""What to do about ratings that look like skill levels, if no chart can be by skill level."""

LEAVE_OUT = worded("Leave {scale} out, or correct the file.")
"""What to do about a stated scale that contradicts a file."""

LEVELS_DOUBLE = worded("Add {scale} N, the number of levels that double the odds.")
"""What to do about skill levels when ratings in points are needed."""


def on_scale(system: handicaps.StepSystem, scale: Scale | None) -> handicaps.StepSystem:
    """Return a system on another scale (None: its own), or reject a contradiction."""
    from dataclasses import replace

    if scale is None:
        return system
    if scale.points_per_doubling < 1.0:
        refuse(
            "{scale} {points:g}: ratings are whole points, so at least 1 point must double the "
            "odds",
            points=scale.points_per_doubling,
        )
    if system.scale.name != "npl" and scale != system.scale:
        refuse("the system {name} has a scale of its own. Leave {scale} out.", name=system.name)
    return replace(system, scale=scale)


MOST_SD = 4.0
"""The most that players' form can vary, in doublings of the odds."""


def refuse_too_varying(asked: Question, system: handicaps.StepSystem, *names: str) -> None:
    """Reject form that varies by more than a ladder on this scale can hold."""
    most = MOST_SD * system.scale.points_per_doubling
    for name in names:
        if getattr(asked, name) > most:
            asked.refuse(
                "{part} must be 0 to {most:.0f} points ({times:g} doublings of the odds); "
                "you gave {points:g}",
                part=Parameter(name),
                points=getattr(asked, name),
                most=most,
                times=MOST_SD,
            )


def refuse_other_scale(
    file: files.RosterFile | files.SeasonPlayers,
    scale: Scale,
    whose: str,
    remedy: str,
    *,
    stated: bool = False,
) -> None:
    """Reject a list whose ratings are, or look like they are, on another scale or skill levels.

    A scale stated by the user isn't questioned, and may consist of skill levels. `whose` says where
    the scale comes from, `remedy` what to do.
    """
    from evenbreak.answers.kit.scales import scale_words
    from evenbreak.files.lists.roster import refuse_to_read

    if file.scale is not None and not file.scale.same_points(scale):
        refuse(
            "{file} states that its ratings are {its}, but {whose} is {other}. {remedy}",
            file=file.source,
            its=scale_words(file.scale),
            whose=whose,
            other=scale_words(scale),
            remedy=remedy,
        )
    if file.scale is None and not stated:
        needs = say("{whose} needs ratings in points. {remedy}", whose=whose, remedy=remedy)
        refuse_levels(file, needs)
        refuse_to_read(file, scale, whose, remedy)


def refuse_for_system(file: files.RosterFile, system: handicaps.System) -> None:
    """Reject a list that a system can't move: levels or points, or points on another scale."""
    import numpy as np

    whose = say("the system {name}", name=system.name)
    if system.publishes == "levels":
        if np.isnan(file.roster.level).all():
            refuse(
                "{whose} moves skill levels, but {file} has none. Add a level column.",
                file=file.source,
                whose=whose,
            )
        return
    if file.scale is None:
        refuse_levels(
            file,
            worded(
                "{whose} needs ratings in points. Use a system of levels, such as "
                "{system} level-steps.",
                whose=whose,
            ),
        )
    if system.scale is not None:
        refuse_other_scale(
            file,
            system.scale,
            whose,
            worded("Give another {system}, or state the scale in a column named scale."),
        )


SAY_LEVELS = worded(
    "Use a chart by skill level, such as {chart} apa_8ball, or add {scale} N, the number of "
    "levels that double the odds."
)


def refuse_levels(file: files.RosterFile | files.SeasonPlayers, remedy: str = SAY_LEVELS) -> None:
    """Reject a list of skill levels when ratings in points are needed."""
    if file.levels:
        refuse(
            "the ratings in {file} are skill levels, not points on a scale. {remedy}",
            file=file.source,
            remedy=remedy,
        )


def scale_of_list(file: files.RosterFile, stated: Scale | None, remedy: str = SAY_LEVELS) -> Scale:
    """Return a list's scale: stated, its own, or implied by its ratings; reject skill levels."""
    if stated is not None:
        refuse_other_scale(file, stated, Parameter("scale"), LEAVE_OUT, stated=True)
    else:
        refuse_levels(file, remedy)
    return file.scale_by(stated, SAY_WHICH, POINTS_OR_SCALE)


def chart_by_difference(name: str, parameter: str = "chart") -> handicaps.Chart:
    """Return a chart of rating differences; reject a chart by skill level."""
    found = files.find_chart(name)
    if not isinstance(found, handicaps.Chart):
        refuse(
            "{parameter} {name!r} is a chart of skill levels. Give a chart of rating differences.",
            parameter=Parameter(parameter),
            name=name,
        )
    return found


def level_system(
    system: handicaps.System | None, chart: str | None
) -> handicaps.MarkovSystem | None:
    """Return the finite-state level system that is meant; None for other systems.

    A chart by skill level without a system means `level-steps` with that chart.
    """
    named = None if chart in (None, "-") else files.find_chart(str(chart))
    if system is None and isinstance(named, handicaps.LevelChart):
        return handicaps.LevelSteps(own_chart=named)
    if not isinstance(system, handicaps.MarkovSystem) or named is None:
        return system if isinstance(system, handicaps.MarkovSystem) else None
    return cast("handicaps.MarkovSystem", system.on_chart(named))


def chart_for(system: handicaps.StepSystem, name: str | None) -> tuple[handicaps.Chart, list[str]]:
    """Return the chart of --chart (None: the system's own), and warnings about it."""
    from evenbreak.files.charts import find_chart_file

    if name is None:
        chart: Any = system.usual_chart()
        warnings = []
    else:
        file = find_chart_file(name)
        chart, warnings = file.chart, list(file.warnings)
    if not isinstance(chart, handicaps.Chart):
        refuse(
            "{chart} {name!r} is a chart of skill levels, and levels don't move by points after "
            "a match. Give a chart of rating differences, such as npl_10, or {system} level-steps.",
            name=name,
        )
    return chart, [*warnings, *chart_doubts(chart, system.scale)]


def with_starters(roster: Roster, scale: Scale, starter: float | None, sd: float | None) -> Roster:
    """Return the roster with ratings filled in for new players."""
    import numpy as np

    from evenbreak.handicaps.charts.gap import MOST_DOUBLINGS

    unrated = np.isnan(roster.rating)
    if unrated.any() and starter is None and scale.name not in SCALES:
        name = roster.players[int(unrated.argmax())]
        refuse(
            "{name!r} has no rating. Give the rating of a new player with {starter} RATING.",
            name=name,
        )
    spread = scale.points_per_doubling if sd is None else sd
    most = MOST_DOUBLINGS * scale.points_per_doubling / 2.0
    if spread > most:
        refuse(
            "{starter_sd} must be {most:g} or less to say anything about a player; you gave "
            "{spread:g}",
            spread=spread,
            most=most,
        )
    return roster.with_starters(scale.center if starter is None else starter, spread, scale)


def stated_pace(discipline: str | None, minutes_per_game: float | None) -> Pace | str | None:
    """Return the discipline or pace that a question states; None if it states none."""
    from evenbreak.matches.pace import own_pace

    if discipline is not None and minutes_per_game is not None:
        refuse("{discipline} and {minutes_per_game} can't be used together. Leave one out.")
    return discipline if minutes_per_game is None else own_pace(minutes_per_game)
