"""A table in a file as columns of text, each row with the line where it starts.

Every table is read here, which takes care of the format, the column names and the row widths. What
the cells mean is up to `evenbreak.files.tables.schema` and each file type's reader.
"""

from __future__ import annotations

from array import array
from collections import defaultdict
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import compress, count
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.arrays import array_values
from evenbreak.files.tables.header import Header, Hint
from evenbreak.files.tables.problems import Problems, form_warning, quoted_list
from evenbreak.files.tables.rows import Export, Rows, fingerprint, table_content, table_rows
from evenbreak.words import say, say_count

ENOUGH_ROWS = 10
"""If this many rows or cells are wrong, and they all are, they count as one problem."""


class Texts(NamedTuple):
    """A column of text: the distinct cells, and each row's position among them.

    Most columns repeat a few strings, so each one's value is calculated only once.
    """

    distinct: list[str]
    codes: NDArray[np.int64]

    @classmethod
    def of(cls, cells: Sequence[str]) -> Texts:
        """Return the column with these cells, row by row.

        >>> Texts.of(["7", "5", "7"])
        Texts(distinct=['7', '5'], codes=array([0, 1, 0]))
        """
        numbers: defaultdict[str, int] = defaultdict(count().__next__)
        codes = np.array([numbers[text] for text in cells], dtype=np.int64)
        return cls(list(numbers), codes)


class Values(NamedTuple):
    """A column's values; `good` cells are valid or may be empty, `stated` cells aren't empty."""

    values: NDArray[Any]
    good: NDArray[np.bool_]
    stated: NDArray[np.bool_]


@array_values
@dataclass(frozen=True, eq=False)
class TextTable:
    """The rows of a file that match its header; `table["x"]` has the values of column x.

    Parameters
    ----------
    source
        the file's name in messages.
    lines
        the line where each row starts (1 is the file's first line), ascending.
    columns
        all requested columns, by the requested names, with cells stripped of surrounding spaces; a
        column that the file lacks is all empty.
    problems
        what is wrong so far; a reader adds to it and calls `raise_any` at the end, so that all of a
        file's problems are reported at once.
    warnings
        things to know although the file can be used, one per line.
    sha256
        the fingerprint of the bytes read.
    titles
        the file's titles for the columns it has.
    header
        the line where the header starts.
    read
        the cells' values by column, if a schema has read them.
    """

    source: str
    lines: NDArray[np.int64]
    columns: Mapping[str, Texts]
    found: frozenset[str]
    problems: Problems
    warnings: tuple[str, ...]
    sha256: str
    titles: Mapping[str, str] = field(default_factory=dict)
    header: int = 0
    read: Mapping[str, Values] = field(default_factory=dict)

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.read[name].values

    def __len__(self) -> int:
        return len(self.lines)

    def __contains__(self, name: str) -> bool:
        return name in self.found

    def repeated(self) -> NDArray[np.bool_]:
        """Return which rows repeat an earlier row in every column that was read."""
        same, many = np.zeros(len(self), dtype=np.int64), 1
        for distinct, codes in (self.columns[name] for name in self.found):
            if many * len(distinct) > np.iinfo(np.int64).max:
                numbers, same = np.unique(same, return_inverse=True)
                many = len(numbers)
            same, many = same * len(distinct) + codes, many * len(distinct)
        again = np.ones(len(self), dtype=bool)
        again[np.unique(same, return_index=True)[1]] = False
        return again

    def note(self, rows: Any, template: str, /, **values: Any) -> None:
        """Note a problem in a row, in several rows, or in the rows of a mask.

        The template and its values are as for `evenbreak.words.say`; in an array, each row has its
        own value.
        """
        mask = isinstance(rows, np.ndarray) and rows.dtype == bool
        for row in np.flatnonzero(rows) if mask else np.atleast_1d(np.asarray(rows, dtype=int)):
            own = {
                name: value[row] if isinstance(value, np.ndarray) else value
                for name, value in values.items()
            }
            self.problems.add(int(self.lines[row]), template, **own)

    def without(self, lines: Collection[int]) -> TextTable:
        """Return the table without the rows on some lines, and without those rows' problems."""
        kept = ~np.isin(self.lines, list(lines))
        columns = {}
        for name, (distinct, codes) in self.columns.items():
            used, renumbered = np.unique(codes[kept], return_inverse=True)
            columns[name] = Texts([distinct[code] for code in used.tolist()], renumbered)
        problems = self.problems.outside(lines)
        return replace(self, lines=self.lines[kept], columns=columns, problems=problems, read={})

    def cells(self, name: str) -> list[str]:
        """Return a column's text, row by row; all '' if the file lacks the column."""
        distinct, codes = self.columns[name]
        return [distinct[code] for code in codes.tolist()]


def read_table(
    path: str | Path,
    required: Mapping[str, Sequence[str]],
    optional: Mapping[str, Sequence[str]] | None = None,
    instead: Mapping[str, Sequence[Collection[str]]] | None = None,
    *,
    rows: str = "",
    called: Mapping[str, str] | None = None,
    maybe: bool = False,
    hint: Hint | None = None,
    exported: Callable[[bytes, str], Export | None] | None = None,
) -> TextTable:
    r"""Read a CSV file, or a sheet in a workbook, as columns of text.

    A CSV file is UTF-8 or UTF-16 with a byte order mark, UTF-8 without, or else Windows-1252 with a
    warning; comma, semicolon or tab, or what a first line such as `sep=|` declares; LF, CRLF or CR;
    quoted cells may contain line breaks. In a workbook (.xlsx, .ods), the first sheet whose header
    fits is read. Column names are compared without regard to case, spacing and punctuation. Lines
    above the header are skipped and unknown columns are ignored, both with a warning; blank rows
    are ignored without one.

    Parameters
    ----------
    required, optional
        each column's other names.
    instead
        sets of columns that can replace a required column.
    rows
        what its rows are, such as matches: a file without any has a problem; '' if that is
        checked elsewhere.
    called
        this file's titles for some columns.
    maybe
        whether titles that the file lacks are ignored.
    hint
        what to do if required columns are missing (see `Header`).
    exported
        reads other programs' exports, if they are accepted too.

    Returns
    -------
    TextTable
        missing columns and rows of the wrong width are in its `problems`, not raised yet, because a
        reader may find more.

    Raises
    ------
    DataError
        if the file cannot be read as text at all, or is empty.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "arcs.csv"
    ...     _ = path.write_text("From;To\n\nS1;W\nS1;L\n", encoding="utf-8")
    ...     table = read_table(path, {"source": ["from"], "target": ["to"]})
    >>> table.cells("target"), table.lines, len(table.problems)
    (['W', 'L'], array([3, 4]), 0)
    """
    source, content = table_content(path)
    problems = Problems(source)
    header = Header(required, optional or {}, instead or {}, called, hint, maybe=maybe)
    titles, line, body, unreadable, warnings, sample = table_rows(content, source, header, exported)
    if not titles:
        _add_unreadable(unreadable, problems)
        problems.add(None, "has no rows. Write a header line, then one line for each row.")
        problems.raise_any()
    places, unused = header.places(titles, line, problems, sample)
    if unused:
        names = quoted_list(unused)
        warnings.append(form_warning(source, None, "columns not used: {titles}", titles=names))
    misfits = Problems(source)
    row_lines, columns = _columns(body, len(titles), places, misfits)
    if len(misfits) >= ENOUGH_ROWS and not len(row_lines):
        problem = say(
            "none of the {n:,} rows below this header has {width} cells, as the header does. "
            "Correct the header, or put cells that contain the separator in quotes.",
            n=len(misfits),
            width=len(titles),
        )
        problems.add(line, problem)
    else:
        problems.include(misfits)
    _add_unreadable(unreadable, problems)
    if rows and not len(row_lines) and not len(problems):
        problems.add(None, "has no {rows} below its header. Write one line for each.", rows=rows)
    absent = Texts([""], np.zeros(len(row_lines), dtype=np.int64))
    return TextTable(
        source,
        row_lines,
        {name: columns.get(name, absent) for name in header.columns},
        frozenset(columns),
        problems,
        tuple(warnings),
        fingerprint(content),
        {name: titles[place] for name, place in places.items()},
        line,
    )


def _add_unreadable(lines: list[int], problems: Problems) -> None:
    for line in lines:
        problems.add(
            line, 'can\'t be split into cells. Close every ", and write "" for a " inside a cell.'
        )


def _columns(
    parts: Iterator[Rows], width: int, places: Mapping[str, int], problems: Problems
) -> tuple[NDArray[np.int64], dict[str, Texts]]:
    """Return the line of each row that matches the header's width, and its cells by column."""
    # Each text gets the next free number when it is first met.
    numbers = {name: defaultdict[str, int](count().__next__) for name in places}
    codes = {name: array("q") for name in places}
    all_lines = array("q")
    for lines, rows in parts:
        if set(map(len, rows)) != {width}:
            fit = [_fits(line, row, width, problems) for line, row in zip(lines, rows, strict=True)]
            lines, rows = list(compress(lines, fit)), list(compress(rows, fit))
        all_lines.extend(lines)
        cells = list(zip(*rows, strict=False))
        for name, place in places.items():
            codes[name].extend(map(numbers[name].__getitem__, cells[place] if cells else ()))
    columns = {
        name: _stripped(list(numbers[name]), np.array(codes[name], dtype=np.int64))
        for name in places
    }
    return np.array(all_lines, dtype=np.int64), columns


def _fits(line: int, row: list[str], width: int, problems: Problems) -> bool:
    """Return whether a row has the header's width; extra blank cells do no harm."""
    if len(row) == width or (len(row) > width and not "".join(row[width:]).strip()):
        return True
    if "".join(row).strip():
        problem = say_count(
            "has {n} cell, but the header has {width}. Add what's missing, or put cells that "
            "contain the separator in quotes.",
            "has {n} cells, but the header has {width}. Add what's missing, or put cells that "
            "contain the separator in quotes.",
            len(row),
            width=width,
        )
        problems.add(line, problem)
    return False


def _stripped(raw: list[str], codes: NDArray[np.int64]) -> Texts:
    """Return a column without the spaces around its cells."""
    bare = [text.strip() for text in raw]
    if bare == raw:  # as nearly always
        return Texts(raw, codes)
    distinct, renumbered = Texts.of(bare)
    return Texts(distinct, renumbered[codes])
