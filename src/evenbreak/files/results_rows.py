"""From the columns of a results file to `Results`: rows whose cells fit together."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.cells import Values
from evenbreak.files.player_names import PlayerNames, clean_name
from evenbreak.files.problems import quoted
from evenbreak.files.results_columns import INSTEAD, NAMES, REQUIRED
from evenbreak.files.text_table import TextTable
from evenbreak.ratings.consistency import find_problems
from evenbreak.ratings.results import Results

SCORES = ("score_a", "score_b")
_BY_WINNER = ("race_a", "race_b", "winner")
_EMPTY_SCORE = (
    "{name} is empty; write the games won, or race_a, race_b and winner if no more is known, or "
    "mark a forfeit, or leave out a match that was not played"
)
_NOTHING_KNOWN = (
    "nothing says who won; write race_a, race_b and winner, or racks, or mark a forfeit, or leave "
    "out a match that was not played"
)


def results_rows(table: TextTable, names: PlayerNames, columns: Mapping[str, Values]) -> Results:
    """Return the matches of a table; rows that contradict themselves are added to its problems.

    Raises
    ------
    DataError
        with all problems so far, if a column is missing that nothing takes the place of.
    """
    settled, good = _with_scores(table, columns)
    if any(_is_missing(table, name) for name in REQUIRED):
        table.problems.raise_any()
    rows = np.flatnonzero(good)
    given = {
        name: values[rows]
        for name, values in settled.items()
        if name in (*REQUIRED, "unscored") or name in table.found
    }
    results = Results(names.players, **given)
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

    An empty score is taken from the racks; where race and winner are stated it is not known,
    and not needed.
    """
    values = {name: column.values for name, column in columns.items()}
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
    if table.found.isdisjoint(SCORES):
        wrong, message = {"score_a": unknown}, _NOTHING_KNOWN
    elif "score" in table:
        wrong, message = {"score_a": unknown}, _EMPTY_SCORE.replace("{name}", "score")
    else:
        wrong, message = {name: unknown | (empty[name] & ~both) for name in SCORES}, _EMPTY_SCORE
    for name, rows in wrong.items():
        if not _is_missing(table, name):
            for row in np.flatnonzero(rows):
                table.problems.add(int(table.lines[row]), message.format(name=name))
            good = good & ~rows
    return values, good


def _is_missing(table: TextTable, name: str) -> bool:
    replaced = any(table.found >= set(group) for group in INSTEAD.get(name, ()))
    return name not in table.found and not replaced


def _add_contradictions(table: TextTable, results: Results, rows: NDArray[np.int64]) -> None:
    for problem in find_problems(results):
        row = rows[problem.row]
        by_alias = _one_player(table, row) if problem.column == "player_b" else ""
        table.problems.add(int(table.lines[row]), problem.message + by_alias)


def _one_player(table: TextTable, row: int) -> str:
    """Return the two names of a player on both sides, if they are spelt differently."""
    texts = (table.columns[name] for name in NAMES)
    a, b = (clean_name(distinct[codes[row]]) for distinct, codes in texts)
    return "" if a == b else f" ({quoted(a)} and {quoted(b)} are read as one player)"
