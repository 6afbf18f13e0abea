"""`evenbreak matchups`: the round's races from a list of rated players."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from evenbreak.answers.scale_doubts import league_doubts
from evenbreak.cli.kit.faces import faces, page_name
from evenbreak.cli.kit.options import (
    chart_option,
    refuse_both,
    scale_option,
    seed_option,
    which_races,
)
from evenbreak.cli.kit.terminal import say
from evenbreak.cli.kit.values import Number, Whole, refuse

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.answers.answer import Answer
    from evenbreak.answers.round import AnyChart, Round
    from evenbreak.ratings.roster import Roster
    from evenbreak.ratings.scale import Scale

MOST_PAIRS = 1_000_000
"""The most pairs that are written to a file: about a minute and 200 MB."""

MOST_SHOWN = 20_000
"""The most pairs that are shown as text or as JSON."""

MOST_MATCHES = 1_000
"""The most matches of one evening."""

POINTS = Number(-1e6, 1e6, " is not a number of rating points; give one such as 80")
SPREAD = Number(0.0, 1e6, " is not a spread; give 0 or more points, such as 30")
MINUTES = Number(0.001, 1440.0, " is not a number of minutes; give one such as 8 or 7.5")

EXAMPLES = """\b
Examples:
  evenbreak matchups roster.csv --chart npl_10
  evenbreak matchups roster.csv --games 7..13 --pairs tonight.csv --html tonight.html
  evenbreak matchups roster.csv --race-to 7 --minutes-per-game 8 --tables 4
"""


@click.command("matchups", epilog=EXAMPLES)
@click.argument("roster", metavar="ROSTER.csv")
@chart_option("The league's chart, by name or in a file.")
@which_races
@click.option("--pairs", metavar="PAIRS.csv", help="Who meets whom.  [default: all pairs]")
@scale_option("the scale of the chart, else npl", fixed=False)
@click.option(
    "--starter",
    metavar="RATING",
    type=POINTS,
    help="The rating of a new player.  [default: the middle of the scale]",
)
@click.option(
    "--starter-sd",
    metavar="POINTS",
    type=SPREAD,
    help="How far off that may be: one standard deviation.  [default: what doubles the odds]",
)
@click.option(
    "--minutes-per-game", metavar="MINUTES", type=MINUTES, help="Give the lengths in minutes."
)
@click.option(
    "--tables", type=Whole(1, 1000), metavar="T", help="Say when the round ends on T tables."
)
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
    pairs: str | None,
    scale: Scale | None,
    starter: float | None,
    starter_sd: float | None,
    minutes_per_game: float | None,
    tables: int | None,
    seed: int,
    html: str | None,
) -> Answer:
    """Find the race for each pair of players tonight, and what it is worth.

    ROSTER.csv has a row for each player, with the columns player and rating and, if you
    have them, standard_error and games; - is stdin. Races come from --chart, or are the
    fairest ones with --games or --race-to, or both. Where standard errors are given, the
    chances are averaged over what the ratings may be.
    """
    from evenbreak.answers.matchups import matchups_answer
    from evenbreak.answers.offered_races import OfferedRaces
    from evenbreak.answers.roster_matchups import check_roster
    from evenbreak.answers.round import Round
    from evenbreak.answers.scale_doubts import starter_doubts
    from evenbreak.files.roster import read_roster

    refuse_both(games, race_to)
    if chart is None and games is None and race_to is None:
        refuse("say which races; give --chart NAME, --games LO..HI or --race-to N")
    if tables is not None and minutes_per_game is None:
        refuse("--tables needs to know how long a game takes; add --minutes-per-game, such as 8")
    if [roster, pairs, chart].count("-") > 1:
        refuse("only one list can be on stdin; name a file for the other")
    of_league, warnings = (None, []) if chart is None else _chart(chart)
    points = _scale(chart, of_league) if scale is None else scale
    file = read_roster(roster)
    players = _with_starters(file.roster, points, starter, starter_sd)
    check_roster(file, players, of_league, points)
    if scale is None:
        remedy = "if they are on another scale, say which with --scale"
        warnings += league_doubts(points, file.roster.rating, remedy)
    if starter is None:
        warnings += starter_doubts(points, file.roster.rating)
    meet, more = _pairs(pairs, file.source, players, tables, face)
    tonight = Round(
        file=file,
        roster=players,
        pairs=meet,
        scale=points,
        chart=of_league,
        offered=None if games is None and race_to is None else OfferedRaces(games, race_to),
        minutes_per_game=minutes_per_game,
        tables=tables,
        seed=seed,
        listed=pairs is not None,
    )
    if html is not None:
        _write_page(html, tonight)
    return matchups_answer(tonight, warnings=[*warnings, *more])


def _chart(name: str) -> tuple[AnyChart, list[str]]:
    from evenbreak.files.chart import find_chart_file

    file = find_chart_file(name)
    return file.chart, list(file.warnings)


def _scale(name: str | None, chart: AnyChart | None) -> Scale:
    """Return the scale of the chart, else the NPL's."""
    from evenbreak.handicaps.charts.level_chart import LevelChart
    from evenbreak.ratings.scale import SCALES

    if isinstance(chart, LevelChart):
        refuse(
            f"{name} is a chart of skill levels, which have no scale of their own; say how many "
            "levels double the odds of winning a game, such as --scale 2"
        )
    of_chart = "" if chart is None else chart.name.partition("_")[0]
    return SCALES.get(of_chart, SCALES["npl"])


def _with_starters(roster: Roster, scale: Scale, starter: float | None, sd: float | None) -> Roster:
    """Return the roster with new players filled in."""
    import numpy as np

    from evenbreak.handicaps.charts.uncertain import MOST_DOUBLINGS
    from evenbreak.ratings.scale import SCALES

    unrated = np.isnan(roster.rating)
    if unrated.any() and starter is None and scale.name not in SCALES:
        name = roster.players[int(unrated.argmax())]
        refuse(f"{name!r} has no rating; say with --starter RATING what a new player starts with")
    spread = scale.points_per_doubling if sd is None else sd
    most = MOST_DOUBLINGS * scale.points_per_doubling / 2.0
    if spread > most:
        refuse(f"--starter-sd is {spread:g}, which says nothing about a player; {most:g} at most")
    return roster.with_starters(scale.centre if starter is None else starter, spread)


def _pairs(
    path: str | None, source: str, roster: Roster, tables: int | None, face: str
) -> tuple[NDArray[Any], tuple[str, ...]]:
    """Return who meets whom, and the warnings of the list; refuse too many."""
    from evenbreak.answers.roster_matchups import all_pairs
    from evenbreak.files.pairs import read_pairs

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


def _write_page(path: str, tonight: Round) -> None:
    from pathlib import PurePath

    from evenbreak.files.folder import write_files
    from evenbreak.sheets.round_page import MOST_ACROSS, MOST_MATCHES, round_html

    players, matches = len(tonight.roster), len(tonight.pairs)
    if not tonight.listed and players > MOST_ACROSS:
        refuse(
            f"{players:,} players are too many for --html, which holds all pairs of {MOST_ACROSS} "
            "at most; name those who meet with --pairs PAIRS.csv"
        )
    if tonight.listed and matches > MOST_MATCHES:
        refuse(
            f"{matches:,} matches are too many for --html, which holds {MOST_MATCHES} at most; "
            "make a list and a page for each part of the round"
        )
    place = PurePath(path)
    write_files(str(place.parent), {place.name: round_html(tonight)})
    say(f"Wrote {path}")
