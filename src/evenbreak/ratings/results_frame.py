"""Read the columns of a results DataFrame, cell by cell, and the words in them.

The columns are those of a results file. An invalid cell is a problem that names its row, and all
problems are reported at once.
"""

from __future__ import annotations

import unicodedata
import warnings
from collections import Counter
from collections.abc import Callable, Mapping, Sequence, Set
from datetime import date, datetime
from typing import TYPE_CHECKING, Any, TypeVar

from evenbreak.errors import DataError

if TYPE_CHECKING:
    import pandas as pd


Meaning = TypeVar("Meaning")

NAMES, SCORES, RACES = ("player_a", "player_b"), ("score_a", "score_b"), ("race_a", "race_b")
SIDES = ("winner", "first_break")
_PLAIN = str.maketrans(
    {"ø": "o", "ł": "l", "đ": "d", "ð": "d", "ı": "i", "æ": "ae", "œ": "oe", "þ": "th"}
)
GROUPS = ("team_a", "team_b", "division", "level_a", "level_b")
_OTHERS = ("date", "break_format", "racks", "event", *GROUPS, "forfeit")
COLUMNS = (*NAMES, *SCORES, *RACES, *SIDES, *_OTHERS)
_MOST_PROBLEMS = 20


class FrameReader:
    """Reads the columns of a DataFrame with one match per row, and collects the problems in them.

    Rows are named by their index labels.
    """

    def __init__(self, frame: pd.DataFrame) -> None:
        self.problems: list[str] = []
        self.rows: list[Any] = frame.index.tolist()
        self._columns = self._found(frame)

    def _found(self, frame: pd.DataFrame) -> dict[str, list[Any]]:
        """Return the cells of each known column; None for empty cells."""
        spellings = {letters(name): name for name in COLUMNS}
        cells_of: dict[str, list[Any]] = {}
        unused = []
        for place, title in enumerate(frame.columns):
            name = spellings.get(letters(str(title)))
            if name is None:
                unused.append(str(title))
            elif name in cells_of:
                self.problems.append(f"two columns mean {name}. Drop one.")
            else:
                cells, empty = frame.iloc[:, place], frame.iloc[:, place].isna()
                cells_of[name] = [
                    None if gap or (isinstance(cell, str) and not cell.strip()) else cell
                    for cell, gap in zip(cells.tolist(), empty.tolist(), strict=True)
                ]
        if unused:
            warnings.warn(f"columns not used: {', '.join(unused)}", stacklevel=4)
        missing = [name for name in (*NAMES, *SCORES) if name not in cells_of]
        if missing:
            titles = ", ".join(map(repr, map(str, frame.columns)))
            self.problems.append(
                f"there's no column {' or '.join(missing)}; the columns are {titles}. Add it."
            )
        return cells_of

    def __contains__(self, name: str) -> bool:
        return name in self._columns

    def read(
        self, name: str, meaning: Callable[[Any], Meaning | None], wanted: str, empty: Meaning
    ) -> list[Meaning]:
        """Return the values of a column's cells, `empty` for empty ones."""
        read = []
        for row, cell in enumerate(self.cells(name)):
            value = empty if cell is None else meaning(cell)
            if value is None:
                self.add(row, f"{name} must be {wanted}; you gave {cell!r}")
            read.append(empty if value is None else value)
        return read

    def cells(self, name: str) -> list[Any]:
        """Return a column's cells, with None for empty ones or if there is no such column."""
        return self._columns[name] if name in self._columns else [None] * len(self.rows)

    def add(self, row: int, problem: str) -> None:
        """Add a problem in the row at this position."""
        self.problems.append(f"row {self.rows[row]}: {problem}")

    def raise_any(self) -> None:
        """Raise a DataError if there are problems."""
        more = len(self.problems) - _MOST_PROBLEMS
        if self.problems:
            rest = [f"and {more} more problem{'s' * (more > 1)}"] if more > 0 else []
            raise DataError(self.problems[:_MOST_PROBLEMS] + rest)


def columns_of(reader: FrameReader) -> dict[str, Any]:
    """Return the columns of `Results.from_names`; problems are added to the reader's."""
    names = _one_spelling([_names(reader, name) for name in NAMES])
    columns: dict[str, Any] = dict(zip(NAMES, names, strict=True))
    for name in (*SCORES, *RACES):
        columns[name] = reader.read(name, _count, "a whole number, 0 or more", 0)
    columns["forfeit"] = reader.read("forfeit", _answer, "True or False, yes or no", empty=False)
    columns["date"] = reader.read("date", _day, "a date such as 2026-01-31", "NaT")
    formats = "winner, loser, alternate, a or b"
    columns["break_format"] = reader.read("break_format", _format, formats, 0)
    columns["racks"] = reader.read("racks", _racks, "letters a and b, such as 'abba'", "")
    for name in ("event", *GROUPS):
        columns[name] = reader.read(name, str, "text", "")
    for name in SIDES:
        columns[name] = _sides(reader, name, *names)
    columns["unscored"] = _unscored(reader, columns)
    needed = {*NAMES, *SCORES, *(["unscored"] if any(columns["unscored"]) else [])}
    return {name: values for name, values in columns.items() if name in needed or name in reader}


def _names(reader: FrameReader, column: str) -> list[str]:
    names = reader.read(column, _name, "a name", "")
    for row, cell in enumerate(reader.cells(column)):
        if column in reader and cell is None:
            reader.add(row, f"{column} must not be empty. Give a name.")
    return names


def _one_spelling(columns: Sequence[Sequence[str]]) -> list[list[str]]:
    """Return names, with spellings that differ only in case or spaces unified, and a warning."""
    counts = Counter(name for column in columns for name in column)
    spelling = usual_spellings(counts)
    meant = {name: spelling[folded(name)] for name in sorted(counts)}
    for name, usual in meant.items():
        if usual != name:
            warnings.warn(
                f"{name!r} is read as {usual!r}, because names that differ only in case or spaces "
                "mean the same player",
                stacklevel=4,
            )
    return [[meant[name] for name in column] for column in columns]


def _sides(reader: FrameReader, column: str, a: Sequence[str], b: Sequence[str]) -> list[int]:
    """Return 1 where a column names player a, 2 where it names player b, 0 elsewhere."""
    sides = []
    for row, cell in enumerate(reader.cells(column)):
        if cell is None:
            sides.append(0)
            continue
        name = _name(cell) or ""
        either = {folded(a[row]): 1, folded(b[row]): 2, "a": 1, "b": 2, a[row]: 1, b[row]: 2}
        name = name if name in either else folded(name)
        if name not in either:
            reader.add(
                row, f"{column} must be a, b or the name of one of the players; you gave {cell!r}"
            )
        sides.append(either.get(name, 0))
    return sides


def _unscored(reader: FrameReader, columns: dict[str, Any]) -> list[bool]:
    """Return which matches are known only by race and winner; other empty scores are problems."""
    unscored, scores = [], [(name, reader.cells(name)) for name in SCORES]
    for row in range(len(reader.rows)):
        empty = [name for name, cells in scores if cells[row] is None]
        has_winner = len(empty) == 2 and all(columns[name][row] for name in (*RACES, "winner"))
        if not has_winner and not columns["forfeit"][row]:
            for name in empty:
                if name in reader:
                    reader.add(row, f"{name} must not be empty. Give the games won.")
        unscored.append(has_winner and not columns["forfeit"][row])
    return unscored


def _name(cell: Any) -> str | None:
    return " ".join(cell.split()) if isinstance(cell, str) else None


def _count(cell: Any) -> int | None:
    if isinstance(cell, bool):
        return None
    try:
        number = int(cell)
        same = str(number) == cell.strip() if isinstance(cell, str) else number == cell
    except (TypeError, ValueError, OverflowError):
        return None
    return number if same and 0 <= number <= LARGEST_WHOLE else None


def _answer(cell: Any) -> bool | None:
    if isinstance(cell, str):
        return FORFEIT_WORDS.get(letters(cell))
    return bool(cell) if isinstance(cell, int | float) and cell in (0, 1) else None


def _day(cell: Any) -> str | None:
    if isinstance(cell, str):
        try:
            cell = datetime.fromisoformat(cell.strip())
        except ValueError:
            return None
    return f"{cell:%Y-%m-%d}" if isinstance(cell, date) else None


def _format(cell: Any) -> int | None:
    return FORMAT_WORDS.get(letters(cell)) if isinstance(cell, str) else None


def _racks(cell: Any) -> str | None:
    text = "".join(cell.casefold().split()) if isinstance(cell, str) else "?"
    return text if set(text) <= {"a", "b"} else None


def folded(name: str) -> str:
    """Return the common form of names that differ only in case or spaces.

    >>> folded("Ann Lee") == folded("ann  LEE") == folded("AnnLee")
    True
    """
    return "".join(name.casefold().split())


def without_accents(name: str) -> str:
    """Return a name in a form for comparing: in one case, without accents, with single spaces.

    >>> without_accents("Zoë  Łukasz"), without_accents("Sørensen")
    ('zoe lukasz', 'sorensen')
    """
    bare = " ".join(name.split()).casefold()
    letters = unicodedata.normalize("NFKD", bare.translate(_PLAIN))
    return "".join(letter for letter in letters if not unicodedata.combining(letter))


def usual_spellings(counts: Mapping[str, int], meant: Set[str] = frozenset()) -> dict[str, str]:
    """Return the spelling to use for each name, by its `folded` form.

    It is the most frequent spelling; among equally frequent ones, it is the one in mixed case and
    with more spaces. Spellings in `meant` come first.

    >>> usual_spellings({"ann lee": 1, "Ann Lee": 1, "BO": 2, "Bo": 1})
    {'annlee': 'Ann Lee', 'bo': 'BO'}
    """

    def rank(name: str) -> tuple[bool, int, bool, int]:
        mixed = name not in (name.lower(), name.upper())
        return name in meant, counts[name], mixed, name.count(" ")

    spelling: dict[str, str] = {}
    for name in sorted(counts):
        key = folded(name)
        if key not in spelling or rank(name) > rank(spelling[key]):
            spelling[key] = name
    return spelling


FORMATS = ("", "winner", "loser", "alternate", "a", "b")
"""Break formats in the order of their codes in `Results.break_format`; 0 is not stated."""

FORMAT_WORDS = {
    **{form + tail: code for code, form in enumerate(FORMATS) if form for tail in ("", "breaks")},
    **dict.fromkeys(("alternating", "alternatingbreaks"), FORMATS.index("alternate")),
}
"""The code of each word for a break format."""


def letters(text: str) -> str:
    """Return the letters and digits of a string, in one case.

    >>> letters("W/O"), letters("Player A")
    ('wo', 'playera')
    """
    return "".join(letter for letter in text.casefold() if letter.isalnum())


FORFEITS = {
    "en": "forfeit, forfeited, ff, f, fft, walkover, w/o, no show, nsp, dq, default",
    "de": "kampflos, nicht angetreten",
    "fr": "forfait",
    "es": "incomparecencia, no presentado",
    "nl": "niet opgekomen, reglementair",
    "pl": "walkower",
}
"""The words for a forfeit, in place of a score or in their own column, by language."""

FORFEIT_WORDS = {
    **{letters(word): True for words in FORFEITS.values() for word in words.split(", ")},
    **dict.fromkeys(("yes", "y", "true", "t", "1", "x"), True),
    **dict.fromkeys(("no", "n", "false", "f", "0"), False),
}
"""Whether each word means that a match was forfeited; t and f are also recognized."""

LARGEST_WHOLE = 1_000_000
"""The largest whole number accepted, such as a player's games in a match."""
