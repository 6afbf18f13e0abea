"""Results as people write them down, brought to one layout.

A table may list the winner first, hold the score in one cell such as 7-5, and the race in one
such as 7 or 7-5. Afterwards it has the columns player_a, player_b, score_a, score_b, race_a and
race_b, and the readers of those columns need not know how it was written.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from evenbreak.files.date_cells import read_date
from evenbreak.files.problems import quoted
from evenbreak.files.text_table import Texts, TextTable
from evenbreak.matches.formats import BETWEEN
from evenbreak.ratings.result_words import letters

BY_WINNER = {
    "score": ("result", "final score", "match score"),
    "race": ("race to", "match race"),
    "loser": ("losing player", "loser name", "lost by"),
    "winner_score": ("winner games", "winners score", "games won by winner"),
    "loser_score": ("loser games", "losers score", "games won by loser"),
    "winner_race": ("winner needs", "winners race"),
    "loser_race": ("loser needs", "losers race"),
    "winner_team": ("winners team",),
    "loser_team": ("losers team",),
    "winner_level": ("winners level", "winner class", "winner rating"),
    "loser_level": ("losers level", "loser class", "loser rating"),
}
"""The columns that are brought to another layout here, with their other names."""

WALKOVERS = ("walkover", "wo", "forfeit", "forfeited", "ff", "bye", "noshow", "dq", "default")
"""What stands in place of the score of a match that was not played."""

_SCORE = re.compile(rf"(\d{{1,7}})\s*{BETWEEN}\s*(\d{{1,7}})", re.ASCII)
_RACE = re.compile(rf"(?:race to )?(\d{{1,7}})(?:\s*{BETWEEN}\s*(\d{{1,7}}))?", re.ASCII)
_MONTH = re.compile(r"\d{1,4}[-./ ][a-zäéû]{3,4}\.?|[a-zäéû]{3,4}\.?[-./ ]\d{1,4}")
_LEADING_ZERO = re.compile(r"0\d[-/]\d{1,2}|\d{1,2}[-/]0\d", re.ASCII)
_OF_WINNER = {
    "winner": "player_a",
    "loser": "player_b",
    "winner_score": "score_a",
    "loser_score": "score_b",
    "winner_race": "race_a",
    "loser_race": "race_b",
    "winner_team": "team_a",
    "loser_team": "team_b",
    "winner_level": "level_a",
    "loser_level": "level_b",
}

Pair = tuple[str, str]


def one_layout(table: TextTable) -> TextTable:
    """Return a table of results with its players, scores and races in columns of their own.

    Where winner and loser are columns, the winner is player a, and the first number of a score
    or race is the winner's. Cells without a meaning are added to the table's problems.
    """
    by_winner = {"winner", "loser"} <= table.found and not {"player_a", "player_b"} <= table.found
    columns = dict(table.columns)
    read = {name for name in table.found if name not in BY_WINNER}
    if by_winner:
        for name, side in _OF_WINNER.items():
            if name in table and (name in ("winner", "loser") or side not in table):
                columns[side] = table.columns[name]
                read |= {name, side}
    for name, (sides, meaning) in _IN_ONE_CELL.items():
        if name in table and read.isdisjoint(sides):
            columns.update(zip(sides, _split(_pairs(table, name, meaning)), strict=True))
            read |= {name, *sides}
    if "score" in read:
        walkovers = [letters(text) in WALKOVERS for text in table.cells("score")]
        if any(walkovers):
            marked = zip(walkovers, table.cells("forfeit"), strict=True)
            columns["forfeit"] = Texts.of(["yes" if one else text for one, text in marked])
            read.add("forfeit")
    made = replace(
        table,
        columns=columns,
        found=frozenset(read),
        warnings=(*table.warnings, *_not_used(sorted(table.found - read), table.source)),
    )
    return _with_winners(made) if by_winner else made


def _not_used(names: list[str], source: str) -> list[str]:
    """Return a warning if columns say what others say too."""
    if not names:
        return []
    listed = ", ".join(map(quoted, names))
    return [f"{source}: columns not used, since others say the same: {listed}"]


def _pairs(table: TextTable, name: str, read: Callable[[str], Pair | str]) -> list[Pair]:
    """Return the two numbers in each cell of a column, noting cells that have none."""
    distinct, codes = table.columns[name]
    meant = [read(text) for text in distinct]
    pairs: list[Pair] = []
    for row, code in enumerate(codes.tolist()):
        found = meant[code]
        if isinstance(found, str):
            text = quoted(distinct[code])
            table.problems.add(int(table.lines[row]), f"{name} {text} {found}")
            found = "0" if name == "score" else "", "0" if name == "score" else ""
        pairs.append(found)
    return pairs


def _split(pairs: list[Pair]) -> tuple[Texts, Texts]:
    return Texts.of([a for a, _ in pairs]), Texts.of([b for _, b in pairs])


def _score(text: str) -> Pair | str:
    """Return the two numbers of a score, or why it is none.

    >>> _score("7 – 5"), _score("'7/5"), _score("w/o"), _score("7")
    (('7', '5'), ('7', '5'), ('', ''), 'is not a score; write 7-5')
    """
    text = text.removeprefix("'").strip()
    if not text or letters(text) in WALKOVERS:
        return "", ""
    if _is_date(text):
        return (
            "looks like a date that a spreadsheet made of a score; format the column as text and "
            "type the scores again"
        )
    found = _SCORE.fullmatch(text)
    if found is not None:
        return str(int(found[1])), str(int(found[2]))
    if len(_SCORE.findall(text)) > 1:
        return "is more than one score; write a row for each set"
    return "is not a score; write 7-5"


def _race(text: str) -> Pair | str:
    """Return what the two players need, or why a text is no race.

    >>> _race("7"), _race("7:5"), _race("Race to 9"), _race("long")
    (('7', '7'), ('7', '5'), ('9', '9'), 'is not a race; write 7, or 7-5')
    """
    text = " ".join(text.removeprefix("'").lower().split())
    if not text:
        return "", ""
    found = None if _is_date(text) else _RACE.fullmatch(text)
    if found is None:
        return "is not a race; write 7, or 7-5"
    return str(int(found[1])), str(int(found[2] or found[1]))


def _is_date(text: str) -> bool:
    known = read_date(text) is not None or _LEADING_ZERO.fullmatch(text)
    return bool(known or _MONTH.fullmatch(text.lower()))


_IN_ONE_CELL: dict[str, tuple[Pair, Callable[[str], Pair | str]]] = {
    "score": (("score_a", "score_b"), _score),
    "race": (("race_a", "race_b"), _race),
}


def _with_winners(table: TextTable) -> TextTable:
    """Return a table without the winners whose scores say otherwise, noted as problems."""
    cells = [table.cells(name) for name in ("winner", "score_a", "score_b", "race_a", "race_b")]
    winners = []
    for row, (winner, *counts) in enumerate(zip(*cells, strict=True)):
        numbers = [int(text) if text.isdecimal() else 0 for text in counts]
        problem = _not_won(*numbers)
        if problem:
            table.problems.add(int(table.lines[row]), problem)
        winners.append("" if problem else winner)
    return replace(table, columns={**table.columns, "winner": Texts.of(winners)})


def _not_won(won: int, lost: int, needed: int, other: int) -> str:
    """Return why the first player did not win this match, or nothing."""
    score = f"{won}-{lost}"
    if needed and other:
        if won < needed and lost >= other:
            return (
                f"the loser reached the race ({score} in a race {needed}:{other}); write the "
                "winner's number first, in the score and the race"
            )
    elif 0 < won == lost:
        return (
            f"the score is tied ({score}), so there is no winner; correct it, or give the race if "
            "it was a handicap race"
        )
    elif won < lost:
        return (
            f"the loser won more games ({score}); write the winner's games first, or give the "
            "race if it was a handicap race"
        )
    return ""
