"""`evenbreak matchups`: the round's races from a list of rated players."""

from __future__ import annotations

from dataclasses import replace
from datetime import date
from itertools import product
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from evenbreak import answers, files, handicaps, matches, ratings, sheets
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.scales import league_doubts, starter_doubts
from evenbreak.answers.kit.systems import (
    CHART_OR_SCALE,
    LEAVE_OUT,
    SAY_WHICH,
    refuse_levels,
    refuse_other_scale,
    stated_pace,
    with_starters,
)
from evenbreak.answers.league.by_level import (
    SCALE_OF_LEVELS,
    by_level,
    rated_by_level,
    with_known_level,
)
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.faces import without_folders
from evenbreak.cli.kit.league import league_in
from evenbreak.cli.kit.said import refuse
from evenbreak.cli.kit.terminal import say, write_file
from evenbreak.errors import DataError, InputError
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.files.lists.teams import read_squads
from evenbreak.files.tables.names import same_name
from evenbreak.handicaps.charts.level_skills import FARGO
from evenbreak.questions.league import Matchups
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.words import Parameter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from evenbreak.answers.league.round import AnyChart


MOST_PAIRS = 1_000_000
"""The most pairs that are written to a file: about a minute and 200 MB."""

MOST_SHOWN = 20_000
"""The most pairs that are shown as text or as JSON."""

MOST_MATCHES = 1_000
"""The most matches of one evening."""


@command_of(Matchups, "matchups", ask_face=True, ask_page=True)
def command(asked: Matchups, face: str, page_file: str | None) -> Answer:
    """Find the race for each pair of players."""
    stated = stated_pace(asked.discipline, asked.minutes_per_game)
    of_league, warnings = (None, []) if asked.chart is None else _chart(asked.chart)
    file = files.read_roster(asked.roster)
    if asked.players_file is not None:
        file = files.roster_of_entrants(file, files.read_entrants(asked.players_file))
    if isinstance(of_league, handicaps.PointsChart):
        if page_file is not None:
            refuse(
                f"--html can't show points charts yet. Leave it out with the chart {asked.chart}."
            )
        return _by_points(asked, file, of_league, face, warnings)
    file, players, points, levels, doubts = _rated(asked, file, of_league)
    warnings += doubts
    meet, more = _pairs(asked, file, players, face, of_league, points)
    is_offered = asked.games is not None or asked.race_to is not None
    tonight = answers.Round(
        file=file,
        roster=players,
        pairs=meet,
        scale=points,
        chart=of_league,
        levels=levels,
        offered=answers.OfferedRaces(asked.games, asked.race_to) if is_offered else None,
        pace=matches.pace_of(stated) if isinstance(stated, str) else stated,
        tables=asked.tables,
        turnover=matches.Turnover() if asked.turnover is None else matches.Turnover(asked.turnover),
        seed=asked.seed,
        form=file.form if asked.form is None else asked.form,
        listed=asked.pairs is not None,
    )
    if page_file is not None:
        public = without_folders([*warnings, *more], asked.chart, asked.pairs)
        league = None if asked.players_file is None else asked.roster
        about_file = tuple(without_folders(file.warnings, league))
        shown = replace(tonight, file=replace(file, warnings=about_file))
        write_file(page_file, sheets.round_html(shown, warnings=public))
    return answers.matchups_answer(tonight, warnings=[*warnings, *more])


def _rated(
    asked: Matchups, file: files.RosterFile, of_league: AnyChart | None
) -> tuple[files.RosterFile, ratings.Roster, Scale, handicaps.LevelSkills | None, list[str]]:
    """Return the list, its players with strengths, their scale, what levels are worth, doubts."""
    levels = None
    if isinstance(of_league, handicaps.LevelChart):
        file, levels = by_level(file, of_league, asked.results)
    if levels is not None:
        if asked.scale is not None:
            raise InputError(SCALE_OF_LEVELS)
        file, notes = with_known_level(file, asked.starter, asked.results)
        players = replace(file.roster, rating=levels.strength(file.roster.level))
        return file, players, FARGO, levels, list(map(str, notes))
    points = _scale_of_list(file, asked.scale, of_league)
    players = file.roster
    if isinstance(of_league, handicaps.LevelChart):
        players = rated_by_level(players, of_league, points)
    players = with_starters(players, points, asked.starter, asked.starter_sd)
    doubts = []
    if asked.scale is None and file.scale is not None:
        doubts += _other_chart(file.scale, of_league)
    elif asked.scale is None:
        remedy = "If they are on another scale, name it with --scale."
        doubts += league_doubts(points, file.roster.rating, remedy)
    if asked.starter is None:
        doubts += starter_doubts(points, file.roster.rating)
    return file, players, points, None, doubts


def _by_points(
    asked: Matchups,
    file: files.RosterFile,
    chart: handicaps.PointsChart,
    face: str,
    warnings: list[str],
) -> Answer:
    """Return the points of each pair by a chart of points."""
    from evenbreak.answers.league.matchups import points_matchups_answer

    if asked.games is not None or asked.race_to is not None:
        refuse(f"{chart.name} is a points chart, so it sets no race in games")
    file, _ = by_level(file, chart)
    file, notes = with_known_level(file, asked.starter, asked.results)
    warnings = [*warnings, *map(str, notes)]
    level = file.roster.level
    players = ratings.Roster(file.roster.players, level, level=level)
    pairs, more = _pairs(asked, file, players, face, chart, FARGO)
    return points_matchups_answer(file, pairs, chart, warnings=[*warnings, *more])


def _chart(name: str) -> tuple[AnyChart | handicaps.PointsChart, list[str]]:
    from evenbreak.files.charts import find_chart_file

    file = find_chart_file(name)
    return file.chart, list(file.warnings)


def _scale_of_list(
    file: files.RosterFile, stated: Scale | None, of_league: AnyChart | None
) -> Scale:
    """Return the scale of the ratings."""
    if stated is not None:
        refuse_other_scale(file, stated, Parameter("scale"), LEAVE_OUT, stated=True)
        return stated
    if file.scale is not None:
        return file.scale
    refuse_levels(file)
    made_for = _scale_of_chart(of_league)
    if of_league is None or made_for is None:
        return file.scale_by(None, SAY_WHICH, CHART_OR_SCALE)
    refuse_to_read(file, made_for, f"the chart {of_league.name}", SAY_WHICH)
    return made_for


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
    asked: Matchups,
    roster_file: files.RosterFile,
    roster: ratings.Roster,
    face: str,
    chart: AnyChart | handicaps.PointsChart | None,
    scale: Scale,
) -> tuple[NDArray[Any], tuple[str, ...]]:
    """Return who plays who, and the warnings of the list; refuse too many.

    What the list says of those who do not play may be unfit: a player away may lack a level.
    """
    from evenbreak.answers.league.roster_matchups import all_pairs, check_roster
    from evenbreak.files.lists.season import read_pairs

    if asked.pairs is not None:
        file = read_pairs(asked.pairs, roster)
        listed = len(file.pairs)
        check_roster(roster_file, roster, chart, scale, playing=file.pairs)
        _refuse_too_many(f"{asked.pairs} has {listed:,} pairs", listed, asked.tables, face)
        return file.pairs, file.warnings
    check_roster(roster_file, roster, chart, scale)
    if (tonight := _next_night(asked, roster)) is not None:
        return tonight
    many = len(roster) * (len(roster) - 1) // 2
    if not many:
        refuse(f"{roster_file.source} has one player; a match takes two")
    _refuse_too_many(f"{len(roster):,} players make {many:,} pairs", many, asked.tables, face)
    return all_pairs(roster), ()


def _next_night(
    asked: Matchups, roster: ratings.Roster
) -> tuple[NDArray[Any], tuple[str, ...]] | None:
    """Return who can meet on the next day of a league's fixtures; None where it has none."""
    league = league_in(click.get_current_context())
    if league is None or asked.players_file is not None or None in (
        league.files.fixtures,
        league.files.roster,
    ):  # fmt: skip
        return None
    if asked.roster != league.place(league.files.roster or ""):
        return None
    last = np.datetime64(date.today())
    if league.results:
        days = files.read_seasons([str(league.path)]).results.date
        if days is None or np.isnat(days).all():
            return None
        last = days[~np.isnat(days)].max()
    listed, _ = files.read_fixture_list(league.place(league.files.fixtures or ""))
    after = [one for one in listed if one.date is not None and np.datetime64(one.date) > last]
    if not after:
        return None
    day = min(one.date for one in after if one.date is not None)
    place = {same_name(name): k for k, name in enumerate(roster.players)}
    sides = {name: [k] for name, k in place.items()}
    try:
        squads = read_squads(asked.roster)
    except DataError:  # a league of single players
        squads = {}
    for team, members in squads.items():
        names = map(same_name, members.file.roster.players)
        sides[same_name(team)] = [place[name] for name in names if name in place]
    meet = [one for one in after if one.date == day]
    pairs = [
        pair
        for one in meet
        for pair in product(*(sides.get(same_name(name), ()) for name in (one.home, one.away)))
    ]
    if not pairs:
        return None
    teams = ", ".join(f"{one.home} v {one.away}" for one in meet)
    say(f"Teams that meet on {day}: {teams}. To pair others, list them with --players-file.")
    return np.array(pairs), ()


def _refuse_too_many(pairs: str, many: int, tables: int | None, face: str) -> None:
    meet = "list the pairs who meet in a file, with --pairs PAIRS.csv"
    if tables is not None and many > MOST_MATCHES:
        refuse(f"{pairs}; the limit for one evening is {MOST_MATCHES:,}. To choose, {meet}.")
    if many > MOST_PAIRS:
        refuse(f"{pairs}; the limit is {MOST_PAIRS:,}. To choose, {meet}.")
    if many > MOST_SHOWN and face != "csv":
        refuse(f"{pairs}, too many for {face}. Write them with --csv > pairs.csv, or {meet}.")
