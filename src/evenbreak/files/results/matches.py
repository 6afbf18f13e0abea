"""From a results table to its matches: columns, layouts, contradictory rows.

A table may list the winner first, put the score in one cell such as 7-5, and the race in one cell
such as 7 or 7-5: `one_layout` converts all of these to player_a, player_b, score_a, score_b, race_a
and race_b, so code that reads those columns doesn't need to know how they were written.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.results.columns import LAYOUTS, NAMES, RESULTS
from evenbreak.files.tables.dates import DateOrder, read_date
from evenbreak.files.tables.names import PlayerNames, clean_name
from evenbreak.files.tables.problems import form_warning, quoted, quoted_list
from evenbreak.files.tables.table import Texts, TextTable, Values
from evenbreak.files.tables.titles import BYE, FORFEIT, key_of
from evenbreak.matches.formats import BETWEEN
from evenbreak.ratings.results import Results, find_problems
from evenbreak.words import Sentence, joined, say

_SCORE_CELL = re.compile(rf"(\d{{1,7}})\s*{BETWEEN}\s*(\d{{1,7}})", re.ASCII)
_RACE_CELL = re.compile(rf"(?:race to )?(\d{{1,7}})(?:\s*{BETWEEN}\s*(\d{{1,7}}))?", re.ASCII)
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

_STATUS = frozenset({"status", "remark"})

Pair = tuple[str, str]


def one_layout(table: TextTable) -> TextTable:
    """Return a results table with players, scores and races in separate columns.

    If the columns are winner and loser, the winner is player a, and the first number in a score or
    race is the winner's. Cells that can't be read are added to the table's problems.
    """
    by_winner = {"winner", "loser"} <= table.found and not {"player_a", "player_b"} <= table.found
    columns = dict(table.columns)
    read = {name for name in table.found if name not in LAYOUTS.columns} | _STATUS & table.found
    if by_winner:
        for name, side in _OF_WINNER.items():
            if name in table and (name in ("winner", "loser") or side not in table):
                columns[side] = table.columns[name]
                read |= {name, side}
    for name, (sides, meaning) in _IN_ONE_CELL.items():
        if name in table and read.isdisjoint(sides):
            columns.update(zip(sides, _split(_pairs(table, name, meaning)), strict=True))
            read |= {name, *sides}
    made = replace(
        table,
        columns=columns,
        found=frozenset(read),
        warnings=(*table.warnings, *_not_used(sorted(table.found - read), table.source)),
    )
    return _with_winners(made) if by_winner else made


def with_scores_apart(table: TextTable, sides: Pair) -> TextTable:
    """Return a table with its column `score` split in two, unless it already has both scores."""
    if "score" not in table or table.found >= {*sides}:
        return table
    columns = dict(zip(sides, _split(_pairs(table, "score", _score)), strict=True))
    return replace(table, columns={**table.columns, **columns}, found=table.found | {*sides})


def _not_used(names: list[str], source: str) -> list[str]:
    """Return a warning if some columns repeat what other columns say."""
    if not names:
        return []
    text = say(
        "columns not used, because other columns hold the same information: {names}",
        names=quoted_list(names),
    )
    return [form_warning(source, None, text)]


def _pairs(table: TextTable, name: str, read: Callable[[str], Pair | str]) -> list[Pair]:
    """Return the two numbers in each cell of a column, noting cells that have none."""
    distinct, codes = table.columns[name]
    meant = [read(text) for text in distinct]
    pairs: list[Pair] = []
    for row, code in enumerate(codes.tolist()):
        pair = meant[code]
        if isinstance(pair, str):
            table.note(
                row, "{column} {cell} {fault}", column=name, cell=quoted(distinct[code]), fault=pair
            )
            pair = ("0", "0") if name == "score" else ("", "")
        pairs.append(pair)
    return pairs


def _split(pairs: list[Pair]) -> tuple[Texts, Texts]:
    return Texts.of([a for a, _ in pairs]), Texts.of([b for _, b in pairs])


def _score(text: str) -> Pair | str:
    """Return the two numbers in a score, or why the string isn't a score.

    >>> _score("7 – 5"), _score("'7/5"), _score("w/o"), _score("7")
    (('7', '5'), ('7', '5'), ('', ''), "isn't a score. Write 7-5.")
    """
    text = text.removeprefix("'").strip()
    if not text or key_of(text) in FORFEIT | BYE:
        return "", ""
    if _is_date(text):
        return say(
            "looks like a date that a spreadsheet made from a score; format the column as text "
            "and type the scores again"
        )
    score = _SCORE_CELL.fullmatch(text)
    if score is not None:
        return str(int(score[1])), str(int(score[2]))
    if len(_SCORE_CELL.findall(text)) > 1:
        return say("has more than one score. Write a row for each set.")
    return say("isn't a score. Write 7-5.")


def _race(text: str) -> Pair | str:
    """Return the games both players need, or why a string isn't a race.

    >>> _race("7"), _race("7:5"), _race("Race to 9"), _race("long")
    (('7', '7'), ('7', '5'), ('9', '9'), "isn't a race. Write 7, or 7-5.")
    """
    text = " ".join(text.removeprefix("'").lower().split())
    if not text:
        return "", ""
    race = None if _is_date(text) else _RACE_CELL.fullmatch(text)
    if race is None:
        return say("isn't a race. Write 7, or 7-5.")
    return str(int(race[1])), str(int(race[2] or race[1]))


def _is_date(text: str) -> bool:
    is_day = read_date(text) is not None or _LEADING_ZERO.fullmatch(text)
    return bool(is_day or _MONTH.fullmatch(text.lower()))


_IN_ONE_CELL: dict[str, tuple[Pair, Callable[[str], Pair | str]]] = {
    "score": (("score_a", "score_b"), _score),
    "race": (("race_a", "race_b"), _race),
}


def _with_winners(table: TextTable) -> TextTable:
    """Return a table without winners that contradict their scores, noting them as problems."""
    cells = [table.cells(name) for name in ("winner", "score_a", "score_b", "race_a", "race_b")]
    winners = []
    for row, (winner, *counts) in enumerate(zip(*cells, strict=True)):
        numbers = [int(text) if text.isdecimal() else 0 for text in counts]
        problem = _not_won(*numbers)
        if problem:
            table.note(row, problem)
        winners.append("" if problem else winner)
    return replace(table, columns={**table.columns, "winner": Texts.of(winners)})


def _not_won(won: int, lost: int, needed: int, other: int) -> str:
    """Return why the first player didn't win this match, or nothing."""
    score = {"won": won, "lost": lost}
    if needed and other:
        if won < needed and lost >= other:
            return say(
                "the loser would have won this race ({won}-{lost} in a {needed}:{other} race). "
                "Write the winner's number first, in both the score and the race.",
                needed=needed,
                other=other,
                **score,
            )
    elif 0 < won == lost:
        return say(
            "the score is tied ({won}-{lost}), so there's no winner. Correct it, or give "
            "the race if it was a handicap race.",
            **score,
        )
    elif won < lost:
        return say(
            "the loser won more games ({won}-{lost}). Write the winner's games first, or "
            "give the race if it was a handicap race.",
            **score,
        )
    return ""


_SIDES = ("winner", "first_break")
_PLAIN = RESULTS.only(*(name for name in RESULTS.columns if name not in (*NAMES, *_SIDES)))


def results_columns(
    table: TextTable, names: PlayerNames, order: DateOrder | None = None
) -> dict[str, Values]:
    """Return the values of a results file's cells, column by column.

    Cells that can't be read are added to the table's problems. A column that the file lacks is all
    empty. `order` is the order of day and month in dates such as 9/3/2024.
    """
    sides = ("player_a", "loser") if "loser" in table else NAMES
    a, b = (names.read(table, name) for name in sides)
    plain = _PLAIN.but(date={"order": order}).of(table).read
    return {
        "player_a": a,
        "player_b": b,
        **plain,
        **{name: names.read_side(table, name, a, b) for name in _SIDES},
    }


SCORES = ("score_a", "score_b")
NEEDED = (*NAMES, *SCORES)
_BY_WINNER = ("race_a", "race_b", "winner")


def results_rows(table: TextTable, names: PlayerNames, columns: Mapping[str, Values]) -> Results:
    """Return a table's matches, adding rows that contradict themselves to its problems.

    Raises DataError, with all problems so far, if a column is missing and has no substitute.
    """
    settled, good = _with_scores(table, columns)
    if any(_is_missing(table, name) for name in NEEDED):
        table.problems.raise_any()
    rows = np.flatnonzero(good)
    columns_by_name = {
        name: values[rows]
        for name, values in settled.items()
        if name in (*NEEDED, "unscored") or name in table.found
    }
    results = Results(names.players, **columns_by_name)
    _add_contradictions(table, results, rows)
    # Where only the names could be read, they can still be the same.
    a, b = (columns[name] for name in NAMES)
    rows = np.flatnonzero(a.good & b.good & ~good)
    zeros = np.zeros(len(rows), dtype=np.int64)
    named = Results(names.players, a.values[rows], b.values[rows], zeros, zeros)
    _add_contradictions(table, named, rows)
    return results


def _with_scores(
    table: TextTable, columns: Mapping[str, Values]
) -> tuple[dict[str, NDArray[Any]], NDArray[np.bool_]]:
    """Return the values with empty scores filled in, and which rows are good.

    An empty score is taken from the racks; if the race and the winner are stated, the score isn't
    known and isn't needed.
    """
    values = {name: column.values.copy() for name, column in columns.items()}
    good = np.logical_and.reduce([column.good for column in columns.values()])
    empty = {name: ~columns[name].stated & ~values["forfeit"] for name in SCORES}
    both = empty["score_a"] & empty["score_b"]
    by_rack = both & columns["racks"].stated
    for row in np.flatnonzero(by_rack):
        racks = values["racks"][row]
        values["score_a"][row], values["score_b"][row] = racks.count("a"), racks.count("b")
    by_winner = [columns[name] for name in _BY_WINNER]
    unscored = both & ~by_rack & np.logical_and.reduce([one.values > 0 for one in by_winner])
    if unscored.any():
        values["unscored"] = unscored
    # A cell that could not be read has been reported, and may be all that is missing.
    unreadable = np.logical_or.reduce([one.stated & (one.values == 0) for one in by_winner])
    unknown = both & ~by_rack & ~unscored & ~unreadable
    wrong = {"score_a": unknown}
    if not (table.found.isdisjoint(SCORES) or "score" in table):
        wrong = {name: unknown | (empty[name] & ~both) for name in SCORES}
    for name, rows in wrong.items():
        if not _is_missing(table, name):
            problem = _unknown("score" if "score" in table else name if name in table else "")
            table.note(rows, problem)
            good = good & ~rows
    return values, good


def _unknown(column: str) -> Sentence:
    """Return the error message for a row without a score, in the score column if there is one."""
    if not column:
        return say(
            "nothing shows who won. Write race_a, race_b and winner, or racks, or mark a "
            "forfeit; if the match wasn't played, leave it out."
        )
    return say(
        "{column} is empty. Write the games won, or race_a, race_b and winner if that's all you "
        "know, or mark a forfeit; if the match wasn't played, leave it out.",
        column=column,
    )


def _is_missing(table: TextTable, name: str) -> bool:
    replaced = any(table.found >= set(names.split()) for names in RESULTS[name].instead)
    return name not in table.found and not replaced


def _add_contradictions(table: TextTable, results: Results, rows: NDArray[np.int64]) -> None:
    for problem in find_problems(results):
        row = rows[problem.row]
        by_alias = _one_player(table, row) if problem.column == "player_b" else ""
        table.note(row, joined([problem.message, by_alias], ""))


def _one_player(table: TextTable, row: int) -> str:
    """Return both spellings of a player who is on both sides of a match, if they differ."""
    texts = (table.columns[name] for name in NAMES)
    a, b = (clean_name(distinct[codes[row]]) for distinct, codes in texts)
    return "" if a == b else say(" ({a} and {b} are read as one player)", a=quoted(a), b=quoted(b))
