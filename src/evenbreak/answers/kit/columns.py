"""Columns and quantities by registry key, with details that only an answer knows."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from evenbreak.answers.columns.league import LADDERS, LEAGUE, VALIDATION
from evenbreak.answers.columns.match import CHAINS, CHARTS, MATCH
from evenbreak.answers.columns.practice import FILES, PHYSICS, PRACTICE
from evenbreak.answers.columns.tournament import TEAMS, TOURNAMENT
from evenbreak.answers.kit.parts import Column, Quantity, Show, Table
from evenbreak.words import say

if TYPE_CHECKING:
    import pandas as pd

SUBJECTS = {
    "match": MATCH,
    "chain": CHAINS,
    "chart": CHARTS,
    "league": LEAGUE,
    "validation": VALIDATION,
    "ladder": LADDERS,
    "tournament": TOURNAMENT,
    "team": TEAMS,
    "practice": PRACTICE,
    "physics": PHYSICS,
    "files": FILES,
}
"""The registry by subject."""

COLUMNS: Mapping[str, Column] = {key: entry for part in SUBJECTS.values() for key, entry in part}
"""The registry: each column and quantity by its key."""

NOTHING: Mapping[str, Any] = {}


def column_of(
    key: str,
    /,
    *,
    show: Show | None = None,
    detail: bool | None = None,
    unit: str = "",
    **fields: Any,
) -> Column:
    """Return a column by its key; a hyphen in front means the column is in files only.

    `fields` fill in its words and name; `show` and `detail` override the registry; `unit` is added
    to the name.
    """
    entry = COLUMNS[key.removeprefix("-")]
    changes: dict[str, Any] = {}
    if key.startswith("-"):
        changes["words"] = None
    elif entry.words is not None:
        changes["words"] = say(entry.words, **fields) if "{" in entry.words else entry.words
    if isinstance(entry.name, str):
        changes["name"] = "_".join(filter(None, [entry.name.format(**fields), unit]))
    else:
        changes["name"] = tuple(name.format(**fields) for name in entry.name)
    if show is not None:
        changes["show"] = show
    if detail is not None:
        changes["detail"] = detail
    return replace(entry, **changes)


def columns_of(keys: str, /, *, show: Mapping[str, Show] = NOTHING, **fields: Any) -> list[Column]:
    """Return columns by their keys, separated by spaces; `show` overrides the registry by key.

    >>> [one.name for one in columns_of("player rating -scale")]
    ['player', 'rating', 'scale']
    """
    return [column_of(key, show=show.get(key), **fields) for key in keys.split()]


def in_files(
    names: Iterable[Any], *, exact: bool = False, cell: Show | None = None
) -> list[Column]:
    """Return columns that are in files only, with the names in a record or a frame."""
    return [Column(str(name), exact=exact, cell=cell) for name in names]


def table_by_column(
    name: str, values: Mapping[Any, Iterable[Any]], *, order: Iterable[int] | None = None
) -> Table:
    """Return a table from its columns; a column that needs no fields can be given by its key.

    >>> table_by_column("ratings", {"player": ["Ann", "Bo"], "rating": [1, 2]}, order=[1, 0]).rows
    [('Bo', 2), ('Ann', 1)]
    """
    columns = [column_of(key) if isinstance(key, str) else key for key in values]
    plain = [part.tolist() if hasattr(part, "tolist") else part for part in values.values()]
    rows = list(zip(*plain, strict=True))
    return Table(name, columns, rows if order is None else [rows[k] for k in order])


def frame_table(name: str, frame: pd.DataFrame) -> Table:
    """Return a frame as a table that is in files only."""
    from evenbreak.files.csv_writer import rows_of

    return Table(name, in_files(frame.columns), rows_of(frame))


def quantity_of(key: str, value: Any, /, **fields: Any) -> Quantity:
    """Return a quantity: a value, and otherwise as for `column_of`.

    >>> quantity_of("p_win_a", 0.5, a="Ann").words
    'Ann wins the match'
    """
    return Quantity(column_of(key, **fields), value)


def quantities_of(
    values: Mapping[str, Any], /, *, notes: Mapping[str, str] = NOTHING, **fields: Any
) -> list[Quantity]:
    """Return values as quantities by key; a note (an interval, say) follows the value.

    >>> [one.name for one in quantities_of({"mean": 4.5, "-sd": 1.5})]
    ['mean', 'sd']
    """
    return [
        Quantity(column_of(key, **fields), value, notes.get(key, ""))
        for key, value in values.items()
    ]
