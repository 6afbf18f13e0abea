"""`evenbreak sandbag watch`: whether losing on purpose can be seen."""

from __future__ import annotations

from dataclasses import replace

import click
from click.core import ParameterSource

from evenbreak import files, handicaps, league
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.systems import (
    POINTS_OR_SCALE,
    SAY_WHICH,
    chart_for,
    level_system,
    on_scale,
    refuse_for_system,
    refuse_levels,
    refuse_other_scale,
    refuse_too_varying,
)
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.kit.terminal import write_plot
from evenbreak.files.tables.names import KnownNames
from evenbreak.questions.ladders import SandbagWatch
from evenbreak.ratings.scale import DEFAULT_SCALE, SCALES, Scale
from evenbreak.words import FilePath, Parameter, say


@command_of(SandbagWatch, "watch")
def watch(asked: SandbagWatch) -> Answer:
    """Check results for sandbagging."""
    from evenbreak.answers.league.rating_changes import has_levels, nights_of_files
    from evenbreak.answers.sandbag.season import events_marked, events_to_try, with_even_races
    from evenbreak.answers.sandbag.watch import (
        day_sd_doubts,
        sandbag_player_answer,
        sandbag_watch_answer,
        unrated_doubts,
    )

    typed = click.get_current_context().get_parameter_source("roster")
    of_league = typed is ParameterSource.DEFAULT
    first = files.read_roster(asked.roster)
    season = files.read_seasons([asked.results], **asked.reading)
    meant = level_system(asked.system, asked.chart) or asked.system or "npl"
    system: handicaps.System = handicaps.system_of(meant)
    warnings: list[str] = []
    races: handicaps.Chart | handicaps.System | None = system
    if isinstance(system, handicaps.StepSystem):
        system, doubts = _moved(system, asked.scale, first, season)
        ladder, warnings = watched_ladder(asked, system)
        error, scale = ladder.law(), system.scale
        warnings += doubts
        races = ladder.chart if asked.chart else None
    else:
        system, first = _reviewed(asked, system, first)
        error, scale = league.errors_played(system), SCALES["fargo"]
    warnings += [*first.warnings, *season.warnings]
    if asked.honest == "established":
        warnings += unrated_doubts(first.roster, season.results)
    if not asked.day_sd:
        warnings += day_sd_doubts(season.results, scale)
    if races is None:
        season, assumed = with_even_races(season)
        warnings += assumed
    marked = events_marked(season.results, asked.dumps_in) if asked.dumps_in else None
    stated = has_levels(system, season.results)
    if of_league and not stated:
        warnings.append(say(_OF_TODAY, file=FilePath(first.source), roster=Parameter("roster")))
    nights = nights_of_files(system, first, season, chart=races, stated=stated)
    watched = league.watch(
        nights,
        system,
        error,
        alpha=asked.alpha,
        honest=asked.honest,
        marked=marked,
        tried=None if asked.dumps_in else events_to_try(season.results),
        day_sd=asked.day_sd,
    )
    if asked.player is not None:
        names = KnownNames([player.player for player in watched])
        place = names.place(asked.player)
        if place is None:
            hint = names.hint(asked.player)
            refuse(f"--player: {asked.player!r} has no match in {season.source}{hint}")
        watched = [watched[place]]
    if asked.plot is not None:
        from evenbreak.plots.league import draw_watch

        write_plot(draw_watch(watched, alpha=asked.alpha), asked.plot)
    if asked.player is not None:
        return sandbag_player_answer(watched[0], nights, season.results, warnings=warnings)
    return sandbag_watch_answer(watched, season.results, season.source, warnings=warnings)


_OF_TODAY = (
    "the ratings in {file} are treated as the ratings before the first match; if they are "
    "later, evidence may be lost, so give the earlier list with {roster}"
)


def _reviewed(
    asked: SandbagWatch, system: handicaps.System, first: files.RosterFile
) -> tuple[handicaps.System, files.RosterFile]:
    """Return a system that looks at all results, and the list as it publishes it at the start."""
    from evenbreak.handicaps.systems.night_table import listed

    if asked.scale is not None and not asked.scale.same_points(SCALES["fargo"]):
        asked.refuse("{scale} is for systems that move points after each match. Leave it out.")
    refuse_for_system(first, system)
    if asked.chart is not None and not isinstance(system, handicaps.MarkovSystem):
        system = system.on_chart(files.find_chart(asked.chart))
    return system, replace(first, roster=listed(system, first.roster))


def watched_ladder(
    asked: SandbagWatch, system: handicaps.StepSystem
) -> tuple[handicaps.Ladder, list[str]]:
    """Return the ladder whose rating errors the watch assumes, and warnings about its chart."""
    chart, warnings = chart_for(system, asked.chart)
    refuse_too_varying(asked, system, "day_sd")
    return handicaps.Ladder(system, chart, day_sd=asked.day_sd), warnings


def _moved(
    system: handicaps.StepSystem,
    scale: Scale | None,
    first: files.RosterFile,
    season: files.ResultsFile,
) -> tuple[handicaps.StepSystem, list[str]]:
    """Return the system on the scale of the list; refuse or doubt one that results contradict."""
    from evenbreak.answers.kit.scales import contradiction, far_doubts

    refuse_levels(
        first, f"the system {system.name} needs ratings in points. Give a list with points."
    )
    own = system.scale.name != DEFAULT_SCALE
    assumed = own and scale is None
    points = system.scale if assumed else first.scale_by(scale, SAY_WHICH, POINTS_OR_SCALE)
    whose = f"the system {system.name}" if scale is None else Parameter("scale")
    remedy = "Name the scale of the ratings, or correct the file."
    refuse_other_scale(first, points, whose, remedy, stated=not assumed)
    doubts = far_doubts(points, first.roster.rating)  # a slip does not make another scale
    if not doubts and (against := contradiction(points, first.roster, season.results)):
        if scale is None:
            refuse(
                "{file}: {against}. {remedy}", file=first.source, against=against, remedy=SAY_WHICH
            )
        doubts = [against]
    return on_scale(system, points), doubts
