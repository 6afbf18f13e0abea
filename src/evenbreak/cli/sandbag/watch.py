"""`evenbreak sandbag watch`: whose results look like sandbagging."""

from __future__ import annotations

from typing import Any

import click

from evenbreak import files, handicaps, league
from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.options import (
    OF_LIST,
    SAY_WHICH,
    chart_option,
    results_options,
    scale_option,
)
from evenbreak.cli.kit.plot import plot_option, write_plot
from evenbreak.cli.kit.systems import (
    on_scale,
    refuse_levels,
    refuse_other_scale,
    system_option,
)
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.sandbag.options import watch_options, watched_ladder
from evenbreak.files.tables.names import KnownNames
from evenbreak.ratings.scale import DEFAULT_SCALE, Scale

EXAMPLES = """\b
Examples:
  evenbreak sandbag watch season.csv --roster start.csv
  evenbreak sandbag watch season.csv --roster start.csv --dumps-in "League night"
  evenbreak sandbag watch season.csv --roster start.csv --player "Bo Diaz"
"""


@click.command("watch", epilog=EXAMPLES)
@click.argument("results", metavar="RESULTS.csv")
@click.option(
    "--roster",
    required=True,
    metavar="ROSTER.csv",
    help="The ratings before the first match of the results.",
)
@chart_option("The chart that sets the races where the results do not state them.")
@system_option()
@scale_option(OF_LIST, fixed=False)
@watch_options
@click.option(
    "--dumps-in",
    "events",
    multiple=True,
    metavar="EVENT",
    help="An event that counts for little; dumped matches are then looked for only there. Can be "
    "repeated.  [default: each event of the file is tried]",
)
@click.option(
    "--player", metavar="NAME", help="Show what each match of one player adds to the evidence."
)
@results_options
@plot_option
@faces()
def command(
    results: str,
    roster: str,
    *,
    chart: str | None,
    system: handicaps.System,
    scale: Scale | None,
    alpha: float,
    honest: str,
    events: tuple[str, ...],
    day_sd: float,
    player: str | None,
    reading: dict[str, Any],
    plot: str | None,
) -> Answer:
    """Check the results of a league for sandbagging.

    RESULTS.csv is a file as for `report`; - reads standard input. The ratings of ROSTER.csv
    are updated night by night. The evidence against a player grows with results that are
    likelier from a sandbagger than from an honest player; at 1 / alpha the player is flagged.
    It is evidence, not a verdict.
    """
    from evenbreak.answers.league.nights import (
        events_marked,
        events_to_try,
        nights_of_files,
        with_even_races,
    )
    from evenbreak.answers.sandbag.watch import (
        day_sd_doubts,
        sandbag_player_answer,
        sandbag_watch_answer,
        unrated_doubts,
    )

    if [results, roster, chart, reading["aliases"]].count("-") > 1:
        refuse("- stands for standard input, which only one file can be; name the others")
    first, season = files.read_roster(roster), files.read_results(results, **reading)
    system, doubts = _moved(system, scale, first, season)
    ladder, warnings = watched_ladder(system, chart, day_sd)
    warnings += [*first.warnings, *season.warnings, *doubts]
    if honest == "established":
        warnings += unrated_doubts(first.roster, season.results)
    if not day_sd:
        warnings += day_sd_doubts(season.results, system.scale)
    if chart is None:
        season, assumed = with_even_races(season)
        warnings += assumed
    marked = events_marked(season.results, events) if events else None
    nights = nights_of_files(system, first, season, chart=ladder.chart if chart else None)
    found = league.watch(
        nights,
        system,
        ladder.law(),
        alpha=alpha,
        honest=honest,
        marked=marked,
        tried=None if events else events_to_try(season.results),
        day_sd=day_sd,
    )
    if player is not None:
        known = KnownNames([one.player for one in found])
        place = known.place(player)
        if place is None:
            hint = known.hint(player)
            refuse(f"--player: {player!r} has no match in {season.source}{hint}")
        found = [found[place]]
    if plot is not None:
        from evenbreak.plots.league import watch_figure

        write_plot(watch_figure(found, alpha=alpha), plot)
    if player is not None:
        return sandbag_player_answer(found[0], nights, season.results, warnings=warnings)
    return sandbag_watch_answer(found, season.results, season.source, warnings=warnings)


def _moved(
    system: handicaps.System,
    scale: Scale | None,
    first: files.RosterFile,
    season: files.ResultsFile,
) -> tuple[handicaps.System, list[str]]:
    """Return the system on the scale of the list; refuse or doubt one that results contradict."""
    from evenbreak.answers.kit.scales import contradiction, far_doubts

    refuse_levels(first, f"the system {system.name} needs ratings in points; give a list of those")
    own = system.scale.name != DEFAULT_SCALE
    assumed = own and scale is None
    points = system.scale if assumed else first.scale_by(scale, SAY_WHICH)
    whose = f"the system {system.name}" if scale is None else "--scale"
    remedy = "name the scale of the ratings, or correct the file"
    refuse_other_scale(first, points, whose, remedy, stated=not assumed)
    doubts = far_doubts(points, first.roster.rating)  # a slip does not make another scale
    if not doubts and (against := contradiction(points, first.roster, season.results)):
        if scale is None:
            refuse(f"{first.source}: {against}; {SAY_WHICH}")
        doubts = [against]
    return on_scale(system, points), doubts
