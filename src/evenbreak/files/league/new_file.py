"""A new `league.toml`: suggestions from a folder's files, and the text with comments."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from textwrap import wrap
from typing import Any

import numpy as np

from evenbreak.errors import InputError
from evenbreak.fields.kinds import Number, Whole
from evenbreak.fields.question import Declared, declared
from evenbreak.files.league.folder import CHART, RESULTS, ROSTER, SeenFile
from evenbreak.files.league.league_file import SECTIONS, LeagueFile, Source
from evenbreak.handicaps.charts.level_chart import level_chart

USUAL_SYSTEMS = {"fargo": "fargo-like", "npl": "npl"}
"""The default system for a league whose ratings are on a scale."""

EXAMPLES: Mapping[str, str] = {
    "name": '"Tuesday 8-Ball"',
    "discipline": '"8-ball"',
    "scale": '"fargo"',
    "chart": '"apa_8ball"',
    "race": "5",
    "race_to": "7",
    "system": '"npl"',
    "begins": "2026-09-01",
    "ends": "2026-12-15",
    "venue": '"Corner Pocket"',
    "tables": "6",
    "hours": '["19:00", "23:00"]',
    "minutes_per_game": "8.5",
    "turnover": "5",
    "paper": '"letter"',
    "files.roster": '"players.csv"',
    "files.fixtures": '"fixtures.csv"',
    "files.teams": '"teams.csv"',
    "files.team_results": '"team_results.csv"',
    "team.players": "5",
    "team.sets": "5",
    "team.cap": "23",
    "team.at_most": '"2:6"',
    "team.order": '"alternate"',
    "team.count": '"points"',
    "standings.points": "[2, 1, 0]",
    "standings.ties": '["head-to-head", "difference"]',
    "prices.entry": "10",
    "prices.currency": '"$"',
    "publish.color": '"#1b6e53"',
    "publish.logo": '"logo.png"',
    "publish.names": '"full"',
}
"""An example value for each key, as written in the file."""


@dataclass(frozen=True, kw_only=True)
class NewLeague:
    """The content of a new file: dotted keys, with values as typed for an option, and more.

    `sources` are the results files with their column titles; `levels` is for players who have skill
    levels and no ratings.
    """

    values: Mapping[str, str]
    sources: Sequence[tuple[str, Mapping[str, str]]] = ()
    aliases: Mapping[str, str] = field(default_factory=dict)
    levels: bool = False
    teams: Sequence[str] = ()


def proposed(seen: Sequence[SeenFile], name: str) -> NewLeague:
    """Return a new file's content for the league with this name, based on a folder's files."""
    values = {"name": name, "discipline": "8-ball"}
    of_kind = {
        what: [one for one in seen if one.what == what] for what in {one.what for one in seen}
    }
    results = of_kind.get(RESULTS, [])
    played = frozenset[str]().union(*(one.players for one in results))
    rosters = sorted(
        of_kind.get(ROSTER, []), key=lambda one: (-len(one.players & played), -len(one.players))
    )
    if rosters:
        values["files.roster"] = rosters[0].name
    for what in ("fixtures", "teams", "team_results"):
        if what in of_kind:
            values[f"files.{what}"] = of_kind[what][0].name
    if not rosters and "team_results" not in of_kind and len(results) == 1 and results[0].sides:
        values["files.team_results"] = results[0].name  # of teams or players: nothing says which
    levels = _levels(rosters[0] if rosters else None, results)
    has_ratings = bool(rosters) and not rosters[0].holds.levels
    if has_ratings and (scale := _scale(rosters[0])):
        values["scale"] = scale
        if scale in USUAL_SYSTEMS:
            values["system"] = USUAL_SYSTEMS[scale]
    if CHART in of_kind:
        values["chart"] = of_kind[CHART][0].name
    elif levels and (chart := _chart_of(levels)):
        values |= {"chart": chart, "system": "level review"}
        if chart == "apa_9ball":
            values["discipline"] = "9-ball"
    elif values.get("scale") == "npl":
        values["chart"] = "npl_10"
    else:
        values["race_to"] = "7"
    if values.get("chart") == "apa_8ball" and rosters and rosters[0].teams:
        values |= {"team.players": "5", "team.sets": "5", "team.cap": "23", "team.at_most": "2:6"}
        values |= {"team.count": "points", "standings.points": "apa_8ball"}
    aliases = {
        name: meant for one in of_kind.get("aliases", []) for name, meant in one.holds.items()
    }
    return NewLeague(
        values=values,
        sources=[(one.name, one.columns) for one in results],
        aliases=aliases,
        levels=bool(levels) and not has_ratings,
        teams=rosters[0].squads if rosters else (),
    )


def _levels(roster: SeenFile | None, results: Sequence[SeenFile]) -> set[int]:
    """Return a league's skill levels; none if it has none."""
    if roster is not None:
        level = roster.holds.roster.level
        return {int(one) for one in level[~np.isnan(level)].tolist()}
    stated: Counter[str] = Counter()
    for one in results:
        for side in ("level_a", "level_b"):
            if (column := getattr(one.holds, side, None)) is not None:
                stated.update(str(text) for text in column)
    words = [word for word in stated if word]
    if not words or not all(word.isascii() and word.isdigit() and len(word) == 1 for word in words):
        return set()
    return {int(word) for word in words}


def _chart_of(levels: set[int]) -> str:
    """Return the chart by skill level that has these levels, if any."""
    if levels <= {*level_chart("apa_8ball").levels}:
        return "apa_8ball"
    return "apa_9ball" if levels <= {*range(1, 10)} else ""


def _scale(roster: SeenFile) -> str:
    """Return the scale that a list states or implies; '' if neither."""
    try:
        return str(roster.holds.scale_by(None, "").text)
    except InputError:
        return ""


WIDTH = 90
HEAD = """\
# A league's file. Commands run in this folder take their defaults from it; options override it.
# A line that starts with # is a comment; remove the # to use it.

"""


def league_toml(league: NewLeague) -> str:
    """Return a new file's text: the known keys, and the others as comments.

    >>> text = league_toml(NewLeague(values={"name": "Tuesday", "team.cap": "23"}))
    >>> [line for line in text.splitlines() if line.startswith(("cap", "name"))]
    ['name = "Tuesday"', 'cap = 23']
    """
    parts = [HEAD, *_keys(LeagueFile, "", league.values)]
    parts += ["\n[files]\n", *_keys(SECTIONS["files"], "files.", league.values)]
    parts += _results(league)
    parts.append('\n# Names that mean the same player: "as written" = "the player".\n[aliases]\n')
    parts += [f"{_quoted(name)} = {_quoted(meant)}\n" for name, meant in league.aliases.items()]
    for section, of in SECTIONS.items():
        if section != "files":
            parts += [f"\n[{section}]\n", *_keys(of, f"{section}.", league.values)]
    parts.append(
        '\n# How individual players\' names appear, such as "Ann Lee" = "initials".\n'
        "[publish.players]\n"
    )
    return "".join(parts)


def _keys(of: type, section: str, values: Mapping[str, str]) -> Iterator[str]:
    for one in declared(of):
        key = section + one.name
        note = "".join(f"# {line}\n" for line in wrap(one.field.help, WIDTH))
        if key in values:
            yield f"{note}{one.name} = {_written(one, values[key])}\n"
        else:
            yield f"{note}# {one.name} = {EXAMPLES[key]}\n"


def _written(one: Declared, text: str) -> str:
    """Return a value in TOML form: numbers and dates as they are, lists in brackets."""
    is_number = isinstance(one.kind, Whole | Number)
    return text if is_number or one.name in ("begins", "ends") else _quoted(text)


def _results(league: NewLeague) -> Iterator[str]:
    notes = {one.name: one.field.help for one in declared(Source)}
    yield "\n# One of these for each file of match results.\n"
    for name, columns in league.sources:
        yield f"[[results]]\nfile = {_quoted(name)}\n"
        if columns:
            titles = ", ".join(f"{column} = {_quoted(title)}" for column, title in columns.items())
            yield f"# What the file calls its columns.\ncolumns = {{ {titles} }}\n"
    if not league.sources:
        yield '# [[results]]\n# file = "autumn.csv"\n'
        yield '# columns = { player_a = "Heim", player_b = "Gast" }\n'
    yield f'# {notes["dates"]}\n# dates = "dmy"\n'


def _quoted(text: str) -> Any:
    return json.dumps(text, ensure_ascii=False)
