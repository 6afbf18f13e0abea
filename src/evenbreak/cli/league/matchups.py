"""`evenbreak matchups`: the round's races from a list of rated players."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import click

from evenbreak import answers, files, handicaps, matches, ratings, sheets
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.scales import league_doubts, starter_doubts
from evenbreak.cli.kit.faces import faces, page_name, without_folders
from evenbreak.cli.kit.options import (
    SAY_WHICH,
    chart_option,
    form_option,
    players_file_option,
    race_limit_options,
    refuse_both,
    scale_option,
    seed_option,
)
from evenbreak.cli.kit.paces import TURNOVER, pace_options, stated_pace
from evenbreak.cli.kit.starters import starter_options, with_starters
from evenbreak.cli.kit.systems import refuse_levels, refuse_other_scale
from evenbreak.cli.kit.terminal import write_file
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.ratings.scale import SCALES, Scale

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.answers.league.round import AnyChart


MOST_PAIRS = 1_000_000
"""The most pairs that are written to a file: about a minute and 200 MB."""

MOST_SHOWN = 20_000
"""The most pairs that are shown as text or as JSON."""

MOST_MATCHES = 1_000
"""The most matches of one evening."""

EXAMPLES = """\b
Examples:
  evenbreak matchups roster.csv --chart npl_10
  evenbreak matchups roster.csv --games 7..13 --pairs tonight.csv --html tonight.html
  evenbreak matchups roster.csv --race-to 7 --players-file entrants.txt
  evenbreak matchups roster.csv --race-to 7 --discipline 9-ball --tables 4
"""


@click.command("matchups", epilog=EXAMPLES)
@click.argument("roster", metavar="ROSTER.csv")
@chart_option("The league's chart, by name or in a file.")
@race_limit_options
@players_file_option
@click.option("--pairs", metavar="PAIRS.csv", help="Who meets whom.  [default: all pairs]")
@scale_option(
    "the one that the file states, else the chart's, else the only one that the ratings can be on; "
    "for skill levels, where the chart's own races put them",
    fixed=False,
)
@starter_options
@pace_options
@click.option(
    "--tables", type=Whole(1, 1000), metavar="T", help="Say when the round ends on T tables."
)
@click.option(
    "--turnover",
    metavar="MINUTES",
    type=TURNOVER,
    help="The time between two matches on a table, on average.  [default: 10.8]",
)
@form_option
@seed_option("The seed of the evenings that have to be simulated.", default=0)
@click.option(
    "--html",
    metavar="FILE",
    callback=page_name,
    help="Also write a page to FILE, to print or to send.",
)
@faces(page=False, ask_face=True)
def command(
    face: str,
    roster: str,
    chart: str | None,
    games: tuple[int, int] | None,
    race_to: int | None,
    players_file: str | None,
    pairs: str | None,
    scale: Scale | None,
    starter: float | None,
    starter_sd: float | None,
    discipline: str | None,
    minutes_per_game: float | None,
    tables: int | None,
    turnover: float | None,
    form: float | None,
    seed: int,
    html: str | None,
) -> Answer:
    """Find the race for each pair of players tonight, and how often each player wins it.

    ROSTER.csv has a row for each player, with the columns player and rating and, if you
    have them, standard_error and games; - reads standard input. --chart looks the
    races up, --games or --race-to finds the fairest ones; with both, they stand side by side.
    --players-file says who has entered, if not all of them; those not on the list are new players.
    Where standard errors are given, the chances are averaged over how far the ratings may be
    off.
    """
    from evenbreak.answers.league.roster_matchups import check_roster

    refuse_both(games, race_to)
    if chart is None and games is None and race_to is None:
        refuse("say which races; give --chart NAME, --games LO..HI or --race-to N")
    stated = stated_pace(discipline, minutes_per_game)
    pace = matches.pace_of(stated) if isinstance(stated, str) else stated
    if tables is not None and pace is None:
        refuse(
            "--tables needs to know how long games take; add --discipline, such as 9-ball, or "
            "--minutes-per-game, such as 8"
        )
    if turnover is not None and tables is None:
        refuse("--turnover is the time between two matches on a table; say how many --tables")
    if [roster, pairs, chart].count("-") > 1:
        refuse("only one list can come from standard input; name a file for the other")
    of_league, warnings = (None, []) if chart is None else _chart(chart)
    file = files.read_roster(roster)
    if players_file is not None:
        file = files.roster_of_entrants(file, files.read_entrants(players_file))
    points, levels = _scale_of_list(file, scale, of_league)
    players = with_starters(file.roster, points, starter, starter_sd)
    check_roster(file, players, of_league, points)
    if scale is None and file.scale is not None:
        warnings += _other_chart(file.scale, of_league)
    elif scale is None:
        remedy = "if they are on another scale, name it with --scale"
        warnings += league_doubts(points, file.roster.rating, remedy)
    if starter is None:
        warnings += starter_doubts(points, file.roster.rating)
    meet, more = _pairs(pairs, file.source, players, tables, face)
    tonight = answers.Round(
        file=file,
        roster=players,
        pairs=meet,
        scale=points,
        chart=of_league,
        levels=levels,
        offered=None if games is None and race_to is None else answers.OfferedRaces(games, race_to),
        pace=pace,
        tables=tables,
        turnover=matches.Turnover() if turnover is None else matches.Turnover(turnover),
        seed=seed,
        form=file.form if form is None else form,
        listed=pairs is not None,
    )
    if html is not None:
        public = without_folders([*warnings, *more], chart, pairs)
        league = None if players_file is None else roster
        about_file = tuple(without_folders(file.warnings, league))
        shown = replace(tonight, file=replace(file, warnings=about_file))
        write_file(html, sheets.round_html(shown, warnings=public))
    return answers.matchups_answer(tonight, warnings=[*warnings, *more])


def _chart(name: str) -> tuple[AnyChart, list[str]]:
    from evenbreak.files.charts import find_chart_file

    file = find_chart_file(name)
    if isinstance(file.chart, handicaps.PointsChart):
        refuse(
            f"{name} is a chart of points, not of games, so it gives no races here; `evenbreak "
            f"chart show {name}` has the points of each level"
        )
    return file.chart, list(file.warnings)


def _scale_of_list(
    file: files.RosterFile, stated: Scale | None, of_league: AnyChart | None
) -> tuple[Scale, handicaps.LevelScale | None]:
    """Return the scale of the ratings, and what skill levels are worth if the chart says it."""
    if stated is not None:
        refuse_other_scale(
            file, stated, "--scale", "leave --scale out, or correct the file", stated=True
        )
        return stated, None
    if file.scale is not None:
        return file.scale, None
    if isinstance(of_league, handicaps.LevelChart):
        levels = handicaps.level_scale(of_league)
        return levels.scale, levels
    refuse_levels(
        file,
        "add a chart by skill level, such as --chart apa_8ball, or say with --scale how many "
        "levels double the odds",
    )
    made_for = _scale_of_chart(of_league)
    if of_league is None or made_for is None:
        return file.scale_by(None, SAY_WHICH), None
    refuse_to_read(file, made_for, f"the chart {of_league.name}", SAY_WHICH)
    return made_for, None


def _scale_of_chart(chart: AnyChart | None) -> Scale | None:
    """Return the scale that a chart is made for, if its name says it."""
    return None if chart is None else SCALES.get(chart.name.partition("_")[0])


def _other_chart(stated: Scale, chart: AnyChart | None) -> list[str]:
    """Return a warning if a chart is made for another scale than the one of the ratings."""
    from evenbreak.answers.kit.scales import scale_words

    made_for = _scale_of_chart(chart)
    if chart is None or made_for is None or made_for.same_points(stated):
        return []
    return [
        f"the ratings are {scale_words(stated)}, but {chart.name} is made for ratings "
        f"{scale_words(made_for)}"
    ]


def _pairs(
    path: str | None, source: str, roster: ratings.Roster, tables: int | None, face: str
) -> tuple[NDArray[Any], tuple[str, ...]]:
    """Return who meets whom, and the warnings of the list; refuse too many."""
    from evenbreak.answers.league.roster_matchups import all_pairs
    from evenbreak.files.lists.season import read_pairs

    if path is not None:
        file = read_pairs(path, roster)
        _refuse_too_many(f"{path} has {len(file.pairs):,} pairs", len(file.pairs), tables, face)
        return file.pairs, file.warnings
    many = len(roster) * (len(roster) - 1) // 2
    if not many:
        refuse(f"{source} has one player; a match takes two")
    _refuse_too_many(f"{len(roster):,} players make {many:,} pairs", many, tables, face)
    return all_pairs(roster), ()


def _refuse_too_many(found: str, many: int, tables: int | None, face: str) -> None:
    meet = "name those who meet with --pairs PAIRS.csv"
    if tables is not None and many > MOST_MATCHES:
        refuse(f"{found}, and {MOST_MATCHES:,} are the most for one evening; {meet}")
    if many > MOST_PAIRS:
        refuse(f"{found}, and {MOST_PAIRS:,} are the most; {meet}")
    if many > MOST_SHOWN and face != "csv":
        refuse(f"{found}, too many for {face}; write them with --csv > pairs.csv, or {meet}")
