"""Matches that weren't played, however a file says so: forfeits, byes, postponements.

The words in `evenbreak.files.tables.titles` are recognized in place of a score or a player, or in a
column of statuses or remarks.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

from evenbreak.files.tables.problems import quoted_list, warning
from evenbreak.files.tables.table import Texts, TextTable
from evenbreak.files.tables.titles import BYE, FORFEIT, UNPLAYED, WAS_PLAYED, key_of
from evenbreak.words import joined, say, say_count

_SCORES = ("score", "score_a", "score_b", "home_score", "away_score")
_NO_SCORE = {"", "00", "0"}
_MOST_LINES = 10


class LeftOut(NamedTuple):
    """A row that isn't a match: its line, and the reason."""

    line: int
    why: str


_BYE, _NOT_YET = say("a bye"), say("not played")


def played_matches(
    table: TextTable, names: Sequence[str], *, to_come: bool = False
) -> tuple[TextTable, tuple[LeftOut, ...]]:
    """Return a table without byes and unplayed matches, with its forfeits marked as such.

    With `to_come`, matches not played yet are kept, without a score.
    """
    said = {
        name: [key_of(text) for text in table.cells(name)]
        for name in (*_SCORES, "status", "remark")
        if name in table
    }
    scores = [name for name in said if name in _SCORES]
    who = [
        [not text or key_of(text) in BYE for text in table.cells(name)]
        for name in names
        if name in table
    ]
    called = [
        [key_of(text) in BYE for text in table.cells(name)] for name in names if name in table
    ]
    forfeits, left_out = [], []
    for row, line in enumerate(table.lines.tolist()):
        words = {name: cells[row] for name, cells in said.items()}
        blank = all(words[name] in _NO_SCORE | UNPLAYED for name in scores)
        status = {*words.values()}
        nobody = any(column[row] for column in who)
        if any(column[row] for column in called) or (nobody and status & BYE):
            left_out.append(LeftOut(line, _BYE))
        elif blank and status & UNPLAYED and not to_come:
            left_out.append(LeftOut(line, _NOT_YET))
        forfeits.append(bool(status & (FORFEIT | BYE)))
    columns = dict(table.columns)
    for name in scores:
        no_score = {*(UNPLAYED if to_come else ()), *(FORFEIT | BYE if name != "score" else ())}
        if not no_score.isdisjoint(said[name]):
            cells = zip(table.cells(name), said[name], strict=True)
            columns[name] = Texts.of([("" if word in no_score else text) for text, word in cells])
    found = table.found
    if any(forfeits) and "forfeit" in columns:
        marked = zip(forfeits, table.cells("forfeit"), strict=True)
        columns["forfeit"] = Texts.of(["yes" if forfeit else text for forfeit, text in marked])
        found |= {"forfeit"}
    table = replace(
        table,
        columns=columns,
        found=found,
        warnings=(*table.warnings, *_unknown(table, said), *_counted(table, left_out)),
    )
    return (table.without([row.line for row in left_out]) if left_out else table), tuple(left_out)


def _unknown(table: TextTable, said: Mapping[str, Sequence[str]]) -> list[str]:
    """Return a warning about unknown statuses."""
    known = FORFEIT | BYE | UNPLAYED | WAS_PLAYED | {""}
    cells = zip(table.cells("status"), said["status"], strict=True) if "status" in said else ()
    words = {cell: None for cell, word in cells if word not in known}
    if not words:
        return []
    text = say(
        "matches with an unknown status count as played: {words}. If a match wasn't played, "
        "write forfeit, bye or postponed.",
        words=quoted_list(list(words)),
    )
    return [warning(table.source, None, text)]


def _counted(table: TextTable, left_out: Sequence[LeftOut]) -> list[str]:
    """Return a warning that counts the byes and unplayed matches, each kind with its lines."""
    warnings: list[str] = []
    for why, one, several in (
        (_BYE, "{n} bye is left out (line {lines})", "{n:,} byes are left out (lines {lines})"),
        (
            _NOT_YET,
            "{n} match that wasn't played is left out (line {lines})",
            "{n:,} matches that weren't played are left out (lines {lines})",
        ),
    ):
        lines = [row.line for row in left_out if row.why == why]
        if lines:
            shown: list[str] = [str(line) for line in lines[:_MOST_LINES]]
            shown += ["..."] if len(lines) > _MOST_LINES else []
            text = say_count(one, several, len(lines), lines=joined(shown, ", "))
            warnings.append(warning(table.source, None, text))
    return warnings
