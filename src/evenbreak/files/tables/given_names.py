"""Names written as Lee, Ann: converted to Ann Lee if nearly all in a column are like that."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from evenbreak.files.tables.problems import form_warning, quoted, quoted_list, warning
from evenbreak.files.tables.table import Texts, TextTable
from evenbreak.files.tables.titles import BYE, TEAM_WORDS, key_of
from evenbreak.words import say_count

_LAST_FIRST = re.compile(r"([^,\d]*[^\W\d_]),\s*([^\W\d_][^,\d]*)")
_SUFFIX = {"jr", "sr", "ii", "iii", "iv"}
_NEARLY_ALL = 0.9
_TEAM_ROW = re.compile(
    rf"(?:{', '.join(TEAM_WORDS.values()).replace(', ', '|')})\s*[:\-]\s*(.+)", re.IGNORECASE
)
"""A row such as Team: Racks."""


def given_name_first(name: str) -> str:
    """Return a name with the given name first; unchanged if it has no comma.

    >>> given_name_first("Lee, Ann"), given_name_first("Sammy Davis, Jr."), given_name_first("Bo")
    ('Ann Lee', 'Sammy Davis, Jr.', 'Bo')
    """
    parts = _LAST_FIRST.fullmatch(name.strip())
    if parts is None or key_of(parts[2]) in _SUFFIX:
        return name
    return f"{parts[2]} {parts[1]}"


def with_given_names_first(table: TextTable, names: Sequence[str]) -> TextTable:
    """Return a table with Lee, Ann converted in some columns, and a warning if any were.

    Columns where more than a few names aren't written that way are left alone; other columns that
    name one of the players are converted along with them.
    """
    turned: dict[str, str] = {}
    for column in names:
        stated = [
            text for text in table.columns[column].distinct if text and key_of(text) not in BYE
        ]
        own = {text: name for text in stated if (name := given_name_first(text)) != text}
        if own and len(own) >= _NEARLY_ALL * len(stated):
            turned |= own
    if len(turned) < 2:
        return table
    columns = {}
    for column, (distinct, codes) in table.columns.items():
        if turned.keys().isdisjoint(distinct):
            columns[column] = Texts(distinct, codes)
        else:
            new, numbers = Texts.of([turned.get(text, text) for text in distinct])
            columns[column] = Texts(new, numbers[codes])
    first = next(iter(turned))
    text = say_count(
        "{n} name is written with the last name first; {name} is read as {turned}",
        "{n:,} names are written with the last name first; {name} is read as {turned}",
        len(turned),
        name=quoted(first),
        turned=quoted(turned[first]),
    )
    warnings = (*table.warnings, form_warning(table.source, None, text))
    return replace(table, columns=columns, warnings=warnings)


def with_full_names(table: TextTable) -> TextTable:
    """Return a table of players with given names and surnames joined, if it splits them.

    Next to a column of given names, the player column has the surnames, like Name next to Vorname.
    """
    last = next((name for name in ("surname", "player") if name in table), "")
    if "given_name" not in table or not last:
        return table
    names = [
        rest if _begins_with(rest, given) else f"{given} {rest}".strip()
        for given, rest in zip(table.cells("given_name"), table.cells(last), strict=True)
    ]
    columns = {**table.columns, "player": Texts.of(names)}
    titles = {**table.titles, "player": table.titles[last]}
    return replace(table, columns=columns, found=table.found | {"player"}, titles=titles)


def _begins_with(rest: str, given: str) -> bool:
    """Return whether a name includes the given name: Ann Lee includes Ann, but Diaz not Di."""
    words, first = ([key_of(word) for word in text.split()] for text in (rest, given))
    return words[: len(first)] == first and len(words) > len(first)


def with_teams_of_titles(table: TextTable) -> TextTable:
    """Return a list of players without rows that only name the team of the players below.

    Such a row has a name and nothing else. It is a team's name if it says so (Team: Racks), or if
    nearly all players are written as Lee, Ann and it isn't. The first row must be such a row.
    """
    others = [table.cells(name) for name in table.found - {"player"}]
    if "player" not in table or "team" in table or not others or not len(table):
        return table
    names = table.cells("player")
    alone = [not any(row) for row in zip(*others, strict=True)]
    players = [name for name, is_alone in zip(names, alone, strict=True) if not is_alone]
    by_comma = sum("," in name for name in players) >= _NEARLY_ALL * max(len(players), 1)
    teams = []
    for name, is_alone in zip(names, alone, strict=True):
        stated = _TEAM_ROW.fullmatch(name) if is_alone else None
        is_team = is_alone and (stated or (by_comma and "," not in name))
        teams.append((stated[1] if stated else name) if is_team else "")
    if not teams[0]:
        return table
    of_player = [teams[0]]
    for team in teams[1:]:
        of_player.append(team or of_player[-1])
    columns, found = dict(table.columns), table.found
    if "team" in columns:
        columns["team"], found = Texts.of(of_player), found | {"team"}
    text = say_count(
        "{n} row names the team of the players below it: {teams}",
        "{n:,} rows name the team of the players below them: {teams}",
        sum(map(bool, teams)),
        teams=quoted_list(list(dict.fromkeys(filter(None, teams)))),
    )
    warnings = (*table.warnings, warning(table.source, None, text))
    titles = {**table.titles, "team": table.titles["player"]}
    made = replace(table, columns=columns, found=found, warnings=warnings, titles=titles)
    return made.without(table.lines[list(map(bool, teams))].tolist())
