"""What a question takes from the league's file, where neither an option nor a field says it.

One map says which key of `league.toml` is the default of which field, for all questions. What is
typed wins: a default that a question refuses next to it is left out, such as the league's chart
where a race is typed. How far that goes is in decisions/0026-defaults-of-a-league.md.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from evenbreak.errors import DataError, InputError
from evenbreak.fields.question import AskedError, Declared, declared
from evenbreak.files.league.values import FILE
from evenbreak.words import FilePath, Parameter, joined, say

if TYPE_CHECKING:
    from evenbreak.files.league.league_file import LeagueFile

KEYS: Mapping[str, str] = {
    "results": "results",
    "columns": "results.columns",
    "dates": "results.dates",
    "aliases": "aliases",
    "roster": "files.roster",
    "from_file": "files.roster",
    "schedule": "files.fixtures",
    "teams": "files.teams",
    "chart": "chart",
    "race": "race",
    "race_to": "race_to",
    "scale": "scale",
    "system": "system",
    "minutes_per_game": "minutes_per_game",
    "discipline": "discipline",
    "tables": "tables",
    "turnover": "turnover",
    "start": "hours",
    "time": "hours",
    "begins": "begins",
    "ends": "ends",
    "venue": "venue",
    "sets": "team.sets",
    "order": "team.order",
    "cap": "team.cap",
    "at_most": "team.at_most",
    "count": "team.count",
    "table_points": "standings.points",
    "ties": "standings.ties",
    "fee": "prices.entry",
    "color": "publish.color",
    "logo": "publish.logo",
    "title": "name",
    "paper": "paper",
    "naming": "publish.names",
}
"""The key of the file that is the default of a field, those first that others need."""

OTHERWISE: Mapping[tuple[str, str], str] = {
    ("Change", "race"): "",  # a tournament under way has its own
    ("Change", "tables"): "",
    ("ChipAudit", "chart"): "",  # of chips
    ("Compare", "from_file"): "",  # names and formats could not be told apart
    ("Scores", "dates"): "",
    ("Rate", "system"): "",  # it asks for another way to rate
    ("Rate", "roster"): "",  # the ratings before the results, not today's
    ("Simulate", "schedule"): "",  # by weeks, not by dates
    ("Season", "race"): "",  # of sets, not of games
    ("Season", "sets"): "",
    ("Season", "results"): "files.team_results",
    ("Season", "columns"): "",  # of the players' results
    ("Fixtures", "names"): "files.teams or files.roster",
    ("Show", "title"): "",  # a tournament has its own name
    ("Print", "title"): "",
    ("LeagueTable", "results"): "results or files.team_results",
}
"""The fields of some questions that have another key, or none."""

ONLY_WITH: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("Matchups", "tables"): ("pairs", "players_file")  # no night has all pairs of a league
}
"""The fields whose default is taken only if one of some others is typed."""

INSTEAD: Mapping[tuple[str, str], str] = {("Fixtures", "names"): "schedule"}
"""The fields whose default is taken only where another field has none."""

BY_LEVEL = {("Fair", "chart"), ("FairTonight", "chart"), ("Compare", "chart")}
"""The fields that take a chart by skill level alone; so do `results` that may be left out."""

NEEDED = ("from_file",)
"""The fields whose default is taken only where the question is refused without it."""


class Taken(NamedTuple):
    """A default from the league's file.

    Parameters
    ----------
    name
        the field.
    key
        the key of the file.
    value
        the value, as the question has it.
    text
        the value, as it is typed.
    """

    name: str
    key: str
    value: Any
    text: str


@cache
def key_of(question: type, name: str) -> str:
    """Return the key of the file that is the default of a field; '' if there is none."""
    for one in question.__mro__:
        if one.__name__ == "LeagueInit":  # which writes the file
            return ""
        if (one.__name__, name) in OTHERWISE:
            return OTHERWISE[one.__name__, name]
    return KEYS.get(name, "")


def takes_any(question: type) -> bool:
    """Return whether a question takes anything from a league's file."""
    return any(key_of(question, one.name) for one in declared(question))


def taken(question: Any, typed: Mapping[str, Any], league: LeagueFile) -> list[Taken]:
    """Return what a question takes from a league's file for fields without a value."""
    every = list(_offered(question, typed, league))
    has = {*typed, *(one.name for one in every)}
    if not all(one.name in has for one in declared(question) if one.required):
        return [one for one in every if one.name not in NEEDED]
    needless = [one for one in every if one.name in NEEDED]
    if needless and _refusal(question, typed, _settled(question, typed, _without(every, needless))):
        needless = []
    by_level = [one for one in every if _is_for_levels(question, one.name, typed)]
    if by_level and not _has_levels(typed, _without(every, needless), league):
        needless += by_level
    return _settled(question, typed, _without(every, needless))


def _settled(question: Any, typed: Mapping[str, Any], every: list[Taken]) -> list[Taken]:
    """Return defaults without those that a question refuses next to what is typed."""
    kept, left_out = [*every], list[Taken]()
    while (why := _refusal(question, typed, kept)) is not None:
        named = _parameters(why)
        wrong = [one for one in kept if one.name in named]
        if not wrong:  # it lacks something, or what is typed contradicts itself
            break
        left_out.append(wrong[-1])
        kept.remove(wrong[-1])
    for one in left_out:
        if _refusal(question, typed, [*kept, one]) is None:
            kept.append(one)
    return kept


_BY_ANY_CHART = ("Publish", "LeagueTable")
"""Questions whose chart sets the races of results whether or not it is one of levels."""


def _is_for_levels(question: Any, name: str, typed: Mapping[str, Any]) -> bool:
    from evenbreak.questions.results import ByChart

    if name == "chart" and issubclass(question, ByChart) and "system" not in typed:
        return question.__name__ not in _BY_ANY_CHART
    if name == "results":
        return not next(one.required for one in declared(question) if one.name == name)
    return any((one.__name__, name) in BY_LEVEL for one in question.__mro__)


def _has_levels(typed: Mapping[str, Any], taken: list[Taken], league: LeagueFile) -> bool:
    """Return whether a league is one of skill levels without ratings, by its chart and roster."""
    charts = [one.value for one in taken if one.name == "chart"]
    chart = typed.get("chart", charts[0] if charts else None)
    if chart is None or league.scale is not None or "scale" in typed:
        return False
    from evenbreak.files.charts import find_chart
    from evenbreak.files.lists.roster import read_roster
    from evenbreak.handicaps.charts.level_chart import LevelChart

    roster = league.files.roster
    return isinstance(find_chart(chart), LevelChart) and (
        roster is None or read_roster(league.place(roster)).levels
    )


def _without(every: list[Taken], others: list[Taken]) -> list[Taken]:
    return [one for one in every if one not in others]


def _refusal(question: Any, typed: Mapping[str, Any], more: list[Taken]) -> AskedError | None:
    try:
        question(**{one.name: one.value for one in more} | dict(typed))
    except AskedError as error:
        return error
    return None


def _parameters(error: AskedError) -> set[str]:
    return {str(value) for value in error.sentence.values.values() if isinstance(value, Parameter)}


def _offered(question: Any, typed: Mapping[str, Any], league: LeagueFile) -> Iterator[Taken]:
    """Yield what the file has for the fields that have no value yet, in the order of `KEYS`."""
    order = {name: place for place, name in enumerate(KEYS)}
    fields = [one for one in declared(question) if key_of(question, one.name)]
    for one in sorted(fields, key=lambda field: order.get(field.name, 0)):
        wanted = ONLY_WITH.get((question.__name__, one.name), ())
        if one.name in typed or (wanted and not {*wanted} & {*typed}):
            continue
        other = INSTEAD.get((question.__name__, one.name), "")
        if other in typed or (other and text_of(league, key_of(question, other)) is not None):
            continue
        key = key_of(question, one.name)
        if key.startswith("results."):
            text = _of_sources(
                league, typed.get("results", typed.get("left", ())), key.removeprefix("results.")
            )
        else:
            text = text_of(league, key)
        if text is None:
            continue
        if key == "hours":
            text = text.partition(",")[0]
        yield Taken(one.name, key, _value(one, text, f"{league.path}: {key}"), text)


def _value(one: Declared, text: str, of: str) -> Any:
    try:
        value = one.kind.read(text)
    except InputError as error:
        raise DataError([f"{of}: {error}"]) from None
    return (value,) if one.field.many else value


def text_of(league: LeagueFile, key: str) -> str | None:
    """Return what a league's file has for a key, as an option takes it; None if nothing.

    Files are named with the league's folder. Its results, each with its own titles, and its aliases
    are read from the file itself.
    """
    from evenbreak.files.league.league_file import SECTIONS

    key, _, otherwise = key.partition(" or ")
    if key in ("results", "aliases"):
        if getattr(league, key):
            return str(league.path)
        return text_of(league, otherwise) if otherwise else None
    section, _, name = key.rpartition(".")
    of: Any = getattr(league, section) if section else league
    value = getattr(of, name)
    if value is None:
        return text_of(league, otherwise) if otherwise else None
    held = SECTIONS.get(section, type(league))
    kind = next(one.kind for one in declared(held) if one.name == name)
    if kind is FILE and (name != "chart" or Path(league.place(value)).is_file()):
        return league.place(value)
    return kind.words(value)


def _of_sources(league: LeagueFile, typed: str | tuple[str, ...], name: str) -> str | None:
    """Return how the league reads the files of results that are typed, if they are its own."""
    places = {Path(league.place(one.file)).resolve(): one for one in league.results}
    files = (typed,) if isinstance(typed, str) else typed
    texts = []
    for file in files:
        value: Any = getattr(places.get(Path(file).resolve()), name, None)
        if name == "columns":
            value = ",".join(f"{column}={title}" for column, title in (value or {}).items())
        texts.append(value)
    return texts[0] or None if texts and texts.count(texts[0]) == len(texts) else None


def says_taken(every: list[Taken], league: LeagueFile) -> str:
    """Return what was taken from a league's file, as a sentence."""
    parts = [
        say("{key} {value}", key=Parameter(one.name), value=_shown(one, league)) for one in every
    ]
    return say("From {file}: {taken}", file=FilePath(league.path), taken=joined(parts, ", "))


def _shown(one: Taken, league: LeagueFile) -> str:
    if one.key == "aliases":
        return "[aliases]"
    if one.text == str(league.path):
        return ", ".join(source.file for source in league.results)
    return one.text
