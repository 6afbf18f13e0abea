"""A submitted list of entrants, with doubtful lines asked about before it is accepted."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from evenbreak.files.lists.entrants import APART, ENTRANTS, read_entrants
from evenbreak.files.lists.pasted import Typed, choice_words, readings
from evenbreak.files.lists.typed_list import typed_lines
from evenbreak.web.forms import Form, read_upload
from evenbreak.web.guard import RefusalError
from evenbreak.words import Figure, say

Known = Callable[[str], tuple[str, float, float, bool] | None]
"""Looks up a player in the league's results: the name there, the rating, its error, provisional."""


class Row(NamedTuple):
    """A player as entered; `counts` is "list" if the league's rating shouldn't be used."""

    name: str
    rating: str = ""
    counts: str = ""


class Choice(NamedTuple):
    """A possible meaning of a line: as its field sends it, and in words."""

    value: str
    words: str


@dataclass(frozen=True)
class Line:
    """A line in the list, how it is read, and what else it may mean."""

    number: int
    text: str
    rows: tuple[Row, ...]
    why: str = ""
    choices: tuple[Choice, ...] = ()


class ListError(Exception):
    """Raised if a list has doubtful lines; `content` is the list as a field holds it.

    `stated` says whose ratings count, as answered before.
    """

    def __init__(self, lines: Sequence[Line], content: str, stated: Collection[str] = ()) -> None:
        super().__init__()
        self.lines, self.content, self.stated = lines, content, stated


def entered_list(content: bytes, form: Form, known: Known | None) -> tuple[bytes, frozenset[str]]:
    """Return a list without doubts, and the players whose stated ratings count over the league's.

    Raises ListError if the form leaves a question open.
    """
    stated = frozenset(form.texts("stated"))
    typed = typed_lines(content, ENTRANTS)
    lines, _ = lines_of(content)
    if form.text("checked"):
        rows = [row for line in lines for row in _answer(line, form)]
        stated |= {row.name for row in rows if row.counts}
        if typed is not None:
            content = _as_table(rows)
            lines = _table_lines(content)
    lines = [_with_league(line, known, stated) for line in lines] if known else lines
    if any(line.why for line in lines):
        raise ListError(lines, _as_text(content, lines), stated)
    return content, stated


def lines_of(content: bytes) -> tuple[list[Line], str]:
    """Return a list's lines, and the list in the form a field can hold."""
    typed = typed_lines(content, ENTRANTS)
    lines = _table_lines(content) if typed is None else _typed(typed)
    return lines, _as_text(content, lines)


def _typed(texts: Sequence[str]) -> list[Line]:
    found = []
    for one in readings(texts):
        rows = tuple(map(_row, one.players))
        choices = tuple(
            Choice(_value(map(_row, choice)), choice_words(choice)) for choice in one.choices
        )
        found.append(Line(one.number, one.text, rows, one.doubt, choices))
    return found


def _row(player: Typed) -> Row:
    return Row(player.name, player.cells[0].replace(",", ".") if player.cells else "")


def _table_lines(content: bytes) -> list[Line]:
    file = read_upload(content, read_entrants)
    roster = file.roster
    rows = zip(file.lines.tolist(), roster.players, roster.rating.tolist(), strict=True)
    return [
        Line(line, name, (Row(name, "" if np.isnan(rating) else f"{rating:.10g}"),))
        for line, name, rating in rows
    ]


def _with_league(line: Line, known: Known | None, stated: Collection[str]) -> Line:
    """Ask which of two ratings counts, if the list's and the league's differ."""
    if line.why or known is None or len(line.rows) != 1:
        return line
    (row,) = line.rows
    found = known(row.name)
    if not row.rating or found is None or row.name in stated:
        return line
    own, its = float(row.rating), round(found[1], 1)
    if abs(own - its) <= APART:
        return line
    why = say(
        "The list has {own:g} for {player}, but the league's results give {its:g}. Which one "
        "counts?",
        own=own,
        player=row.name,
        its=its,
    )
    of_league = Choice(
        _value([row._replace(rating=f"{its:.10g}")]), say("{n}, the league", n=_g(its))
    )
    of_list = Choice(_value([row._replace(counts="list")]), say("{n}, the list", n=_g(own)))
    return replace(line, why=why, choices=(of_league, of_list))


def _g(number: float) -> Figure:
    return Figure(number, "g")


def _answer(line: Line, form: Form) -> list[Row]:
    """Return the form's answer about a line."""
    if not line.choices:
        if f"name-{line.number}" not in form.fields:
            return list(line.rows)
        name = form.text(f"name-{line.number}")
        return [Row(name, form.text(f"rating-{line.number}"))] if name else []
    chosen = form.text(f"line-{line.number}", longest=2000)
    if chosen != "other":
        return [Row(*cells[:3]) for cells in csv.reader(chosen.splitlines()) if cells]
    own = readings([form.text(f"other-{line.number}")])
    if len(own) != 1 or own[0].doubt:
        raise RefusalError(
            "Line {line}: write a name and a rating, such as Ann Lee, 612.", line=line.number
        )
    return list(map(_row, own[0].players))


def _value(rows: Iterable[Row]) -> str:
    out = io.StringIO()
    csv.writer(out, lineterminator="\n").writerows(rows)
    return out.getvalue().strip("\n")


def _as_table(rows: Sequence[Row]) -> bytes:
    if not rows:
        raise RefusalError("Enter at least one player.")
    return ("player,rating\n" + _value(Row(*row[:2]) for row in rows)).encode()


def _as_text(content: bytes, lines: Sequence[Line]) -> str:
    """Return a list in the form a field can hold: text unchanged, a workbook as a table."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return _as_table([row for line in lines for row in line.rows]).decode()
