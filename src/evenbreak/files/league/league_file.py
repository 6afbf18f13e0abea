"""`league.toml`, a league's file: its content, and how it is read.

Each key is declared once, with its value type, in the classes below; the reference has a table of
them. Commands take their defaults from it (`evenbreak.questions.of_league`).
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date, time
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any, TypeVar, cast

from evenbreak.errors import DataError, InputError
from evenbreak.fields.kinds import Choice, Kind, Whole
from evenbreak.fields.question import Declared, Field, declared
from evenbreak.files.league import LEAGUE_TOML, values
from evenbreak.files.league import find_league as find_league
from evenbreak.files.league import is_league as is_league
from evenbreak.files.league.toml_lines import Keys, lines_of
from evenbreak.files.tables.problems import Problems, printable, quoted
from evenbreak.files.tables.rows import content_of
from evenbreak.league.tables.rules import TableRules
from evenbreak.ratings.scale import Scale
from evenbreak.tournaments.evening.format import DISCIPLINES, LONGEST_RACE, MOST_TABLES
from evenbreak.words import say

_NOTHING: Mapping[str, str] = {}
Section = TypeVar("Section")


@dataclass(frozen=True, kw_only=True)
class LeagueFiles:
    """`[files]`: the files in the league's folder."""

    roster: Annotated[
        str | None,
        Field(
            values.FILE, "The players, with their ratings, skill levels or both, and their teams."
        ),
    ] = None
    fixtures: Annotated[str | None, Field(values.FILE, "Who plays who, and when.")] = None
    teams: Annotated[
        str | None, Field(values.FILE, "All teams, with any extra points they have.")
    ] = None
    team_results: Annotated[
        str | None, Field(values.FILE, "Team results: home team, away team, and sets won by each.")
    ] = None


@dataclass(frozen=True, kw_only=True)
class Source:
    """`[[results]]`: a file of match results; each file has its own table."""

    file: Annotated[str, Field(values.FILE, "The file.")]
    columns: Mapping[str, str] = field(default_factory=lambda: _NOTHING)
    """The file's column titles, where they aren't known ones."""
    dates: Annotated[
        str | None,
        Field(
            Choice(("mdy", "dmy")),
            "The order of day and month in dates such as 9/3/2024, if no date shows it.",
        ),
    ] = None


@dataclass(frozen=True, kw_only=True)
class TeamRules:
    """`[team]`: the rules for a team match."""

    players: Annotated[int | None, Field(Whole(1, 100), "How many players a team puts up.")] = None
    sets: Annotated[int | None, Field(values.SETS, "How many sets are played.")] = None
    cap: Annotated[
        float | None, Field(values.CAP, "The highest total of skill levels allowed in a lineup.")
    ] = None
    at_most: Annotated[
        tuple[int, float] | None,
        Field(
            values.STRONG,
            "The most players allowed at or above a level, such as 2:6 (two at level 6 or above).",
        ),
    ] = None
    order: Annotated[
        str | None, Field(values.ORDER, "Who names a player first, as in `evenbreak lineup`.")
    ] = None
    count: Annotated[
        str | None, Field(values.COUNT, "What decides a match: sets won, all games, or points.")
    ] = None


@dataclass(frozen=True, kw_only=True)
class StandingsRules:
    """`[standings]`: how standings for teams or players are calculated."""

    points: Annotated[
        TableRules | None,
        Field(
            values.TABLE_POINTS,
            "The points for a win, a draw and a loss (and for each game or set won, and for a "
            "shutout), or `sets`, `apa_8ball` or `apa_9ball`.",
        ),
    ] = None
    ties: Annotated[
        tuple[str, ...] | None,
        Field(values.TIES, "Tiebreakers, in this order."),
    ] = None

    @property
    def rules(self) -> TableRules:
        """The rules for the standings."""
        points = self.points or TableRules()
        return points if self.ties is None else replace(points, ties=self.ties)


@dataclass(frozen=True, kw_only=True)
class Prices:
    """`[prices]`: what it costs to play."""

    entry: Annotated[float | None, Field(values.MONEY, "What each player pays to enter.")] = None
    currency: Annotated[str | None, Field(values.CURRENCY, "The currency symbol.")] = None


@dataclass(frozen=True, kw_only=True)
class Published:
    """`[publish]`: what the league's site shows."""

    color: Annotated[str | None, Field(values.COLOR, "The site's color.")] = None
    logo: Annotated[str | None, Field(values.FILE, "A logo for the top of the site.")] = None
    names: Annotated[
        str,
        Field(
            values.NAMES, "How players' names appear: in full, as initials, or not at all (hidden)."
        ),
    ] = "full"
    players: Mapping[str, str] = field(default_factory=lambda: _NOTHING)
    """The same for individual players."""


@dataclass(frozen=True, kw_only=True)
class LeagueFile:
    """A league file's content; anything left out is None or empty.

    `aliases` maps names as written to the names that are meant.
    """

    folder: Path
    file: str = LEAGUE_TOML
    name: Annotated[str | None, Field(values.LINE, "The league's name.")] = None
    discipline: Annotated[str | None, Field(Choice(DISCIPLINES), "The game.")] = None
    scale: Annotated[
        Scale | None,
        Field(values.SCALE, "The rating scale, unless the league uses skill levels."),
    ] = None
    chart: Annotated[
        str | None, Field(values.FILE, "The race chart: a name, or a file in the folder.")
    ] = None
    race: Annotated[
        int | None,
        Field(
            Whole(1, LONGEST_RACE),
            "Without a chart: every race is to this many games for both players.",
        ),
    ] = None
    race_to: Annotated[
        int | None,
        Field(
            Whole(1, LONGEST_RACE),
            "Without a chart: the stronger player races to this many games, and the weaker "
            "player gets the fairest race.",
        ),
    ] = None
    system: Annotated[
        str | None, Field(values.SYSTEM_NAME, "The handicap system: how ratings move.")
    ] = None
    begins: Annotated[date | None, Field(values.DAY, "The first day of the season.")] = None
    ends: Annotated[date | None, Field(values.DAY, "The last day of the season.")] = None
    venue: Annotated[str | None, Field(values.LINE, "Where the league plays.")] = None
    tables: Annotated[int | None, Field(Whole(1, MOST_TABLES), "The number of tables.")] = None
    hours: Annotated[
        tuple[time, time] | None, Field(values.HOURS, "When a night starts and ends.")
    ] = None
    minutes_per_game: Annotated[
        float | None,
        Field(
            values.MINUTES,
            "How long a game takes, if that differs from the discipline's usual time.",
        ),
    ] = None
    turnover: Annotated[
        float | None, Field(values.TURNOVER, "The minutes between two matches on a table.")
    ] = None
    paper: Annotated[str | None, Field(values.PAPER, "The paper size for sheets.")] = None
    files: LeagueFiles = LeagueFiles()
    results: tuple[Source, ...] = ()
    aliases: Mapping[str, str] = field(default_factory=lambda: _NOTHING)
    team: TeamRules = TeamRules()
    standings: StandingsRules = StandingsRules()
    prices: Prices = Prices()
    publish: Published = Published()

    @property
    def path(self) -> Path:
        """The file itself."""
        return self.folder / self.file

    def place(self, name: str) -> str:
        """Return the path of one of its files, in the form a command takes."""
        return str(self.folder / name)


SECTIONS: Mapping[str, type] = {
    "files": LeagueFiles,
    "team": TeamRules,
    "standings": StandingsRules,
    "prices": Prices,
    "publish": Published,
}
"""The file's tables that have fixed keys; `[[results]]` is `Source`."""

_FREE = {"aliases", "columns", "players"}
"""The tables whose keys are names."""


def read_league(place: str | Path = ".", *, quickly: bool = False) -> LeagueFile:
    """Read a league's file, given its folder or the file itself.

    With `quickly`, the chart and system are left to be checked by the command that uses them:
    loading them takes a quarter of a second. Raises DataError listing every problem, one per line.
    """
    path = Path(place)
    if path.is_dir():
        path = path / LEAGUE_TOML
    _, content = content_of(path)
    return league_of(content, path, quickly=quickly)


def league_of(content: bytes, path: Path, *, quickly: bool = False) -> LeagueFile:
    """Return the league described by a file's content; raises the same errors as `read_league`."""
    problems = Problems(printable(str(path)))
    try:
        text = content.decode("utf-8-sig")
        table = tomllib.loads(text)
    except UnicodeDecodeError:
        problems.add(None, "isn't UTF-8. Save it as UTF-8 in a text editor.")
    except tomllib.TOMLDecodeError as error:
        what, _, place_of = str(error).partition(" (at ")
        line = re.match(r"line (\d+)", place_of)
        problems.add(
            int(line[1]) if line else text.count("\n") + 1,
            "can't be read: {what}. Write a key, = and a value, with text in quotes: name = "
            '"Ann".',
            what=what,
        )
    problems.raise_any()
    reader = _Reader(path.parent, problems, lines_of(text), quickly)
    league: LeagueFile = reader.section(LeagueFile, table, (), folder=path.parent, file=path.name)
    problems.raise_any()
    return league


class _Reader:
    """Reads the file's tables, and notes every problem."""

    def __init__(
        self, folder: Path, problems: Problems, lines: Mapping[Keys, int], quickly: bool
    ) -> None:
        self.folder, self.problems, self.lines = folder, problems, lines
        self.quickly = quickly

    def note(self, keys: Keys, template: str, /, **said: Any) -> None:
        """Note a problem at a key's line."""
        at = next(self.lines[keys[:k]] for k in range(len(keys), 0, -1) if keys[:k] in self.lines)
        self.problems.add(at, template, **said)

    def section(self, of: type[Section], table: Mapping[str, Any], at: Keys, **more: Any) -> Any:
        """Return a table in the file as an object of its class."""
        fields = {one.name: one for one in declared(cast(Any, of))}
        tables = _tables(of)
        read = dict(more)
        for key, value in table.items():
            keys = (*at, key)
            if key in fields:
                read[key] = self.value(fields[key], value, keys)
            elif key not in tables:
                self.unknown(key, [*fields, *tables], keys)
            elif key == "results":
                read[key] = self.sources(value, keys)
            elif not isinstance(value, Mapping):
                self.note(
                    keys,
                    "{key} is a table. Write its keys below a line [{path}].",
                    key=quoted(key),
                    path=_dotted(keys),
                )
            elif key in _FREE:
                read[key] = getattr(self, key)(value, keys)
            else:
                read[key] = self.section(SECTIONS[key], value, keys)
        missing = [name for name, one in fields.items() if one.required and name not in table]
        for name in missing:
            self.note(at, '{key} is missing. Add {key} = "...".', key=name)
        if missing:
            return None
        league: Any = of(**read)
        if isinstance(league, LeagueFile):
            self.whole(league)
        return league

    def whole(self, league: LeagueFile) -> None:
        """Note settings that contradict each other."""
        if league.begins and league.ends and league.ends < league.begins:
            self.note(("ends",), "the season ends before it starts. Correct one of the two dates.")
        races = [name for name in ("chart", "race", "race_to") if getattr(league, name) is not None]
        if len(races) > 1:
            self.note(
                (races[1],),
                "{key} and {other} both set the length of races. Keep one.",
                key=races[1],
                other=races[0],
            )

    def value(self, one: Declared, value: Any, keys: Keys) -> Any:
        """Return a value converted to its type, or None if it isn't valid."""
        text = _text_of(value)
        if text is None:
            self.note(keys, "{key} takes a single value. Write {key} = ...", key=_dotted(keys))
            return None
        if one.kind is values.FILE:
            return self.file(one.name, text, keys)
        if one.kind is values.SYSTEM_NAME and self.quickly:
            return text
        return self.read(one.kind, text, keys)

    def read(self, kind: Kind, text: str, keys: Keys) -> Any:
        """Return the value that a string stands for, or note why it isn't valid."""
        try:
            return kind.read(text)
        except InputError as error:
            self.note(keys, "{key}: {why}", key=_dotted(keys), why=error.sentence)
            return None

    def file(self, key: str, name: str, keys: Keys) -> str | None:
        """Return the name of a file in the folder, or note that the file is missing."""
        if (self.folder / name).is_file():
            return name
        if key == "chart" and self.quickly:
            return name
        if key == "chart":
            from evenbreak.files.charts import find_chart_file

            try:
                find_chart_file(name)
            except (DataError, InputError) as error:
                for problem in getattr(error, "problems", (error.sentence,)):
                    self.note(keys, "chart: {problem}", problem=problem)
            return name
        near = get_close_matches(name, [one.name for one in self.folder.iterdir()], n=1)
        self.note(
            keys,
            "there's no file {name} in the folder. Correct the name{near}, or delete the line.",
            name=quoted(name),
            near=say(" (did you mean {near}?)", near=quoted(near[0])) if near else "",
        )
        return None

    def sources(self, value: Any, keys: Keys) -> tuple[Source, ...]:
        """Return the results files."""
        if not isinstance(value, list) or not all(isinstance(one, Mapping) for one in value):
            self.note(keys, 'write a [[results]] line for each file, with file = "..." below it')
            return ()
        every = [self.section(Source, one, (*keys, k)) for k, one in enumerate(value)]
        names = [one.get("file") for one in value]
        for k, name in enumerate(names):
            if name is not None and name in names[:k]:
                self.note(
                    (*keys, k, "file"), "{file} is listed twice. Keep one.", file=quoted(name)
                )
        return tuple(filter(None, every))

    def names(self, table: Mapping[str, Any], keys: Keys) -> Iterator[tuple[str, str]]:
        """Yield the strings in a table whose keys are names."""
        for name, value in table.items():
            if isinstance(value, str) and value.strip():
                yield name, value
            else:
                self.note(
                    (*keys, name), "the value of {name} must be text in quotes", name=quoted(name)
                )

    def columns(self, table: Mapping[str, Any], keys: Keys) -> dict[str, str]:
        """Return column titles by column."""
        from evenbreak.files.results.columns import RESULTS_FILE

        every = dict(self.names(table, keys))
        for name in every:
            if name not in RESULTS_FILE.columns:
                self.unknown(name, list(RESULTS_FILE.columns), (*keys, name))
        return every

    def players(self, table: Mapping[str, Any], keys: Keys) -> dict[str, str]:
        """Return how individual players' names are published."""
        return {
            name: self.read(values.NAMES, text, (*keys, name))
            for name, text in self.names(table, keys)
        }

    def aliases(self, table: Mapping[str, Any], keys: Keys) -> dict[str, str]:
        """Return the aliases: names, and the players they mean."""
        from evenbreak.files.tables.names import clean_name

        means = {clean_name(name): clean_name(text) for name, text in self.names(table, keys)}
        for name in table:
            meant = means.get(clean_name(name), "")
            if means.get(meant, meant) != meant:
                self.note(
                    (*keys, name),
                    "{name} means {meant}, which means {other}. Write the player's real "
                    "name in both lines.",
                    name=quoted(name),
                    meant=quoted(meant),
                    other=quoted(means[meant]),
                )
        return means

    def unknown(self, key: str, known: Sequence[str], keys: Keys) -> None:
        """Note an unknown key, with the table where it may belong or the nearest known key."""
        if section := _belongs(key, keys[:-1]):
            self.note(
                keys, "{key} doesn't belong here. Move it {place}.", key=quoted(key), place=section
            )
        elif near := get_close_matches(key, known, n=1):
            self.note(
                keys, "there's no key {key}. Write {near}.", key=quoted(key), near=quoted(near[0])
            )
        else:
            self.note(
                keys,
                "there's no key {key}. The keys here are {known}.",
                key=quoted(key),
                known=", ".join(known),
            )


def _tables(of: type) -> list[str]:
    """Return the subtables that a table in the file may have."""
    if of is LeagueFile:
        return ["results", "aliases", *SECTIONS]
    return {Source: ["columns"], Published: ["players"]}.get(of, [])


def _belongs(key: str, at: Keys) -> str:
    """Return the table where a misplaced key belongs; '' if there is none."""
    if at and any(one.name == key for one in declared(LeagueFile)):
        return say("to the top, above the first [table]")
    places = [name for name, of in SECTIONS.items() if key in {one.name for one in declared(of)}]
    return say("below a line [{table}]", table=places[0]) if len(places) == 1 else ""


def _dotted(keys: Keys) -> str:
    return ".".join(str(key) for key in keys if isinstance(key, str))


def _text_of(value: Any) -> str | None:
    """Return a value in the form an option takes; None for a table."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        parts = [_text_of(one) for one in value]
        return None if None in parts else ",".join(filter(None, parts))
    if isinstance(value, date | time):
        return value.isoformat()
    return None if isinstance(value, Mapping) else str(value)
