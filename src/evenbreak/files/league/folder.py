"""What the files in a league's folder are, so that `league.toml` can be written from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from evenbreak.errors import DataError, EvenbreakError
from evenbreak.files.charts import DIFFERENCES, LEVELS, read_chart
from evenbreak.files.foreign.results import export_of
from evenbreak.files.lists.roster import read_roster
from evenbreak.files.lists.teams import FIXTURES, TEAM, TEAM_RESULTS, TEAMS
from evenbreak.files.results.aliases import ALIASES, read_aliases
from evenbreak.files.results.columns import RESULTS_FILE
from evenbreak.files.results.proposals import readings_of
from evenbreak.files.results.results_file import read_results
from evenbreak.files.tables.names import same_name
from evenbreak.files.tables.problems import source_of_form
from evenbreak.files.tables.schema import Schema
from evenbreak.files.tables.table import TextTable
from evenbreak.words import Sentence, say, say_count

ENDINGS = (".csv", ".tsv", ".txt", ".xlsx", ".ods", ".json")
MOST_FILES = 200
"""A folder with more files is unlikely to be a league's."""

OWN = ("tidy.csv",)
"""What `evenbreak league tidy` writes: a copy of the other files' results."""

RESULTS, ROSTER, CHART = "results", "roster", "chart"


@dataclass(frozen=True, kw_only=True)
class SeenFile:
    """A file in a folder, and what it is.

    `what` is results, team_results, roster, fixtures, teams, chart or aliases, or '' for none of
    these; `columns` are the results' unknown titles; `players` are names in the form used for
    comparing.
    """

    name: str
    what: str
    about: Sentence
    columns: Mapping[str, str] = field(default_factory=dict)
    players: frozenset[str] = frozenset()
    sides: bool = False
    """Whether the results' titles are for home and away."""
    teams: frozenset[str] = frozenset()
    """The teams that it names, in the form used for comparing."""
    squads: tuple[str, ...] = ()
    """A roster's teams, as spelled there."""
    holds: Any = None
    warnings: tuple[str, ...] = ()
    """Its format, where worth mentioning."""


def seen_files(folder: str | Path) -> list[SeenFile]:
    """Return what the files in a folder are, by name; raises OSError if it can't be read."""
    places = sorted(
        place
        for place in Path(folder).iterdir()
        if place.suffix.lower() in ENDINGS
        and place.is_file()
        and place.name not in OWN
        and place.name[0] != "."
    )
    every = [_seen(place) for place in places[:MOST_FILES]]
    teams = frozenset[str]().union(*(one.teams for one in every))
    return _one_league(
        [
            replace(one, what="team_results")
            if one.what == RESULTS and one.players and one.players <= teams
            else one
            for one in every
        ]
    )


def _one_league(every: list[SeenFile]) -> list[SeenFile]:
    """Return the files, setting aside another league's: those with no players in common."""
    largest = max(
        (one for one in every if one.what == RESULTS),
        key=lambda one: len(one.players),
        default=None,
    )
    if largest is None:
        return every
    league, known = {largest.name}, largest.players
    while more := [
        one
        for one in every
        if one.name not in league and one.what in (RESULTS, ROSTER) and one.players & known
    ]:
        league |= {one.name for one in more}
        known = known.union(*(one.players for one in more))
    teams = frozenset[str]().union(*(one.teams for one in every if one.name in league))
    about = say("players from a different league than {file}", file=largest.name)
    return [
        replace(one, what="", about=about)
        if one.name not in league and one.players and not one.players & (known | teams)
        else one
        for one in every
    ]


def _seen(path: Path) -> SeenFile:
    looks = (_chart, _aliases, _results, _roster, _results_by_rows, _fixtures, _teams, _perhaps)
    for look in looks:
        try:
            if (seen := look(path)) is not None:
                return seen
        except (EvenbreakError, OSError):
            continue
    return SeenFile(name=path.name, what="", about=say("not used"))


def _table(schema: Schema, path: Path, **how: Any) -> TextTable | None:
    """Return the table in a file if it has every column that a schema needs."""
    table = schema.text(path, **how)
    for name, column in schema.columns.items():
        ways = [{name}, *(set(names.split()) for names in column.instead or ())]
        if column.needed and not any(way <= table.found for way in ways):
            return None
    return table


def _chart(path: Path) -> SeenFile | None:
    table = (DIFFERENCES | LEVELS).text(path)
    if not any(columns <= table.found for columns in _OF_CHARTS):
        return None
    try:
        read_chart(path)
    except DataError:
        about = say("a chart with mistakes: see `evenbreak chart audit {name}`", name=path.name)
        return SeenFile(name=path.name, what="", about=about)
    return SeenFile(name=path.name, what=CHART, about=say("a race chart"))


_OF_CHARTS = ({"stronger_needs", "weaker_needs"}, {"level", "opponent_level", "needs"})


def _aliases(path: Path) -> SeenFile | None:
    table = _table(ALIASES, path)
    if table is None or table.titles["means"].casefold() not in ("means", "stands for"):
        return None
    means = read_aliases(path).means
    about = say_count("{n} other name for a player", "{n} other names for players", len(means))
    return SeenFile(name=path.name, what="aliases", about=about, holds=means)


def _results(path: Path) -> SeenFile | None:
    """Return a results file whose titles are known."""
    table = _table(RESULTS_FILE, path, exported=export_of)
    if table is None:
        return None
    of_sides = _table(TEAM_RESULTS, path)
    one_way = of_sides is not None and not len(of_sides.problems)
    return replace(_results_by(path, {}), sides=one_way)


def _results_by_rows(path: Path) -> SeenFile | None:
    """Return a results file whose titles can be read in only one way."""
    ways = _ways(path)
    return _results_by(path, ways[0]) if len(ways) == 1 else None


def _perhaps(path: Path) -> SeenFile | None:
    """Return a results file whose titles can be read in several ways."""
    ways = _ways(path)
    if not ways:
        return None
    about = say(
        "perhaps results; `evenbreak rate {name}` shows the {n} ways to read them",
        name=path.name,
        n=len(ways),
    )
    return SeenFile(name=path.name, what="", about=about)


def _ways(path: Path) -> list[Mapping[str, str]]:
    ways: list[Mapping[str, str]] = []

    def hint(*of_file: Any) -> str:
        ways.extend(readings_of(*of_file))
        return ""

    RESULTS_FILE.text(path, hint=hint, exported=export_of)
    return ways


def _results_by(path: Path, columns: Mapping[str, str]) -> SeenFile:
    try:
        file = read_results(path, columns=columns)
    except DataError as error:
        about = say_count(
            "match results, with {n} line to fix: see `evenbreak rate {name}`",
            "match results, with {n} lines to fix: see `evenbreak rate {name}`",
            len(error.problems),
            name=path.name,
        )
        return SeenFile(name=path.name, what=RESULTS, about=about, columns=columns)
    results, warnings = file.results, tuple(filter(source_of_form, file.warnings))
    about = say(
        "{n:,} matches among {players:,} players", n=len(results), players=len(results.players)
    )
    names = frozenset(map(same_name, results.players))
    return SeenFile(
        name=path.name,
        what=RESULTS,
        about=about,
        columns=columns,
        players=names,
        holds=results,
        warnings=warnings,
    )


def _roster(path: Path) -> SeenFile | None:
    table = _table(TEAM, path)
    if table is None or not {"rating", "level"} & table.found:
        return None
    file = read_roster(path)
    names = frozenset(map(same_name, file.roster.players))
    about = say("{n:,} players", n=len(names))
    squads = tuple({same_name(team): team for team in table.cells("team") if team}.values())
    return SeenFile(
        name=path.name,
        what=ROSTER,
        about=about,
        players=names,
        teams=frozenset(map(same_name, squads)),
        squads=squads,
        holds=file,
        warnings=tuple(filter(source_of_form, file.warnings)),
    )


def _fixtures(path: Path) -> SeenFile | None:
    table = _table(FIXTURES, path)
    if table is None or not {"round", "date"} & table.found:
        return None
    names = frozenset(map(same_name, (*table.cells("home"), *table.cells("away"))))
    return SeenFile(
        name=path.name,
        what="fixtures",
        about=say("who plays who"),
        players=names,
        warnings=tuple(filter(source_of_form, table.warnings)),
    )


def _teams(path: Path) -> SeenFile | None:
    table = _table(TEAMS, path)
    if table is None or not table.titles["team"].casefold().startswith("team"):
        return None
    names = frozenset(map(same_name, table.cells("team")))
    about = say("{n} teams", n=len(names))
    return SeenFile(name=path.name, what="teams", about=about, teams=names)
