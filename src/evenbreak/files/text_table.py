"""A CSV file as columns of text, each row with the line it stands in.

This is the one door through which tables come in: it settles the encoding, the
separator, the names of the columns and the shape of the rows. What the cells mean
is for `evenbreak.files.cells` and for the reader of each kind of file.
"""

from __future__ import annotations

import csv
import io
import re
from array import array
from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain, compress, count
from operator import itemgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.encoding import content_of, encoding_of
from evenbreak.files.problems import Problems, quoted

SEPARATORS = {",": "comma", ";": "semicolon", "\t": "tab"}
_DECLARED = re.compile(rb'(?:\xef\xbb\xbf)?"?sep=([^\w\s"\x80-\xff]|\t)"?[ \t]*(?=[\r\n])', re.I)
"""The first line in which Excel says what separates the cells, such as sep=;"""

_NUMBER = re.compile(r"[+-]?[0-9]+([.,][0-9]+)?", re.ASCII)
"""What stands in a row of values, hardly in a header."""

ROWS_AT_A_TIME = 1024  # few enough to stay in the processor's cache


class Texts(NamedTuple):
    """A column of text: the distinct cells, and for each row the position of its cell in them.

    Most columns repeat a few texts, so what a cell means is worked out once a text.
    """

    distinct: list[str]
    codes: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Table:
    """The rows of a file that have the shape of its header.

    Parameters
    ----------
    source
        what the file is called in messages.
    lines
        the line in which each row begins (1 is the first line of the file), rising.
    columns
        the columns that were asked for and found, by the names they were asked for;
        cells are stripped of surrounding blanks.
    problems
        what is wrong so far; a reader adds to it and calls `raise_any` at the end, so
        that all problems of a file are told at once.
    warnings
        what a person should know although the file can be used, a line each.
    content
        the bytes that were read.
    """

    source: str
    lines: NDArray[np.int64]
    columns: dict[str, Texts]
    problems: Problems
    warnings: tuple[str, ...]
    content: bytes

    def __len__(self) -> int:
        return len(self.lines)

    def __contains__(self, name: str) -> bool:
        return name in self.columns

    def texts(self, name: str) -> Texts:
        """Return a column; one that the file lacks reads as empty in every row."""
        if name in self.columns:
            return self.columns[name]
        return Texts([""], np.zeros(len(self), dtype=np.int64))

    def repeated(self) -> NDArray[np.bool_]:
        """Return which rows are the same as an earlier one in every column that was read."""
        import pandas as pd

        codes = {name: texts.codes for name, texts in self.columns.items()}
        return pd.DataFrame(codes).duplicated().to_numpy()

    def cells(self, name: str) -> list[str]:
        """Return the text of a column, row by row; '' throughout where the file lacks it."""
        distinct, codes = self.texts(name)
        return [distinct[code] for code in codes.tolist()]


def read_table(
    path: str | Path,
    required: Mapping[str, Sequence[str]],
    optional: Mapping[str, Sequence[str]] | None = None,
    instead: Mapping[str, Sequence[Collection[str]]] | None = None,
) -> Table:
    r"""Read a CSV file as columns of text.

    UTF-8 with or without BOM, else Windows-1252 with a warning; comma, semicolon or
    tab, or what a first line such as `sep=|` says; LF, CRLF or CR; quoted cells may hold
    line ends. Names of columns are compared
    without regard to case, blanks and punctuation. Blank rows are skipped, unknown
    columns are ignored with a warning.

    Parameters
    ----------
    path
        the file; '-' is standard input.
    required, optional
        for each column its other names.
    instead
        for a required column the sets of columns of which one may take its place.

    Returns
    -------
    Table
        missing columns and rows of the wrong shape are in its `problems`, not raised
        yet: a reader may find more.

    Raises
    ------
    DataError
        if the file cannot be read as text at all, or holds nothing.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "arcs.csv"
    ...     _ = path.write_text("From;To\n\nS1;W\nS1;L\n", encoding="utf-8")
    ...     table = read_table(path, {"source": ["from"], "target": ["to"]})
    >>> table.cells("target"), table.lines, len(table.problems)
    (['W', 'L'], array([3, 4]), 0)
    """
    source, content = content_of(path)
    encoding, warnings = encoding_of(content, source)
    problems = Problems(source)
    names = {**required, **(optional or {})}
    declared = _DECLARED.match(content)
    if declared:
        # The line that names the separator stays as a blank one, so that lines keep their numbers.
        body, separator = content[declared.end() :], declared[1].decode()
    else:
        body, separator = content, _separator(content, encoding, names)
    chunks = _chunks(body, encoding, separator, problems)
    lines, rows = next(chunks)
    if not rows:
        problems.add(None, "holds no rows; write a header line and one line for each row below it")
        problems.raise_any()
    header_line, header = lines[0], rows[0]
    chunks = chain([(lines[1:], rows[1:])], chunks)
    places, unused = _places(header, header_line, names, problems)
    others_do = {
        name: any(places.keys() >= set(group) for group in groups)
        for name, groups in (instead or {}).items()
    }
    missing = [name for name in required if name not in places and not others_do.get(name)]
    if not places and any(_NUMBER.fullmatch(title.strip()) for title in header):
        problems.add(
            header_line,
            f"{_listed(header)} names no column; write a line above it with the names of the "
            f"columns, such as {','.join(required)}",
        )
        missing = []
    for name in missing:
        others = " or ".join(map(quoted, required[name][:3]))
        problems.add(
            header_line,
            f"there is no column {name!r} among {_listed(header)}; add it"
            + (f" (it may also be called {others})" if others else ""),
        )
    if unused:
        warnings.append(f"{source}: columns not used: {_listed(unused)}")
    row_lines, columns = _columns(chunks, len(header), places, problems)
    return Table(source, row_lines, columns, problems, tuple(warnings), content)


def _key(name: str) -> str:
    """Return what a column's name is compared by: letters and digits, in one case."""
    return "".join(letter for letter in name.casefold() if letter.isalnum())


def _separator(content: bytes, encoding: str, names: Mapping[str, Sequence[str]]) -> str:
    """Return the separator that makes the most known names of the header."""
    known = {_key(name) for canonical, others in names.items() for name in (canonical, *others)}

    def fit(separator: str) -> tuple[int, int]:
        _, rows = next(_chunks(content, encoding, separator, Problems("")))
        header = rows[0] if rows else []
        return sum(_key(name) in known for name in header), len(header)

    return max(SEPARATORS, key=fit)


def _chunks(
    content: bytes, encoding: str, separator: str, problems: Problems
) -> Iterator[tuple[list[int], list[list[str]]]]:
    """Yield the rows that are not blank, a few at a time, with the line each begins in."""
    text = io.TextIOWrapper(io.BytesIO(content), encoding=encoding, newline="")
    reader = csv.reader(text, delimiter=separator, skipinitialspace=True, strict=True)
    lines: list[int] = []
    rows: list[list[str]] = []
    line = 1
    ended = False
    while not ended:
        try:
            for row in reader:
                if any(row):
                    lines.append(line)
                    rows.append(row)
                line = reader.line_num + 1
                if len(rows) == ROWS_AT_A_TIME:
                    yield lines, rows
                    lines, rows = [], []
            ended = True
        except csv.Error:
            problems.add(
                line, 'cannot be split into cells; close every " and write "" for one in a cell'
            )
            line = reader.line_num + 1
    yield lines, rows


def _places(
    header: list[str], line: int, names: Mapping[str, Sequence[str]], problems: Problems
) -> tuple[dict[str, int], list[str]]:
    """Return where each known column is, and the columns that nobody asked for."""
    canonical = {_key(other): name for name, others in names.items() for other in (*others, name)}
    places: dict[str, int] = {}
    unused = []
    for place, title in enumerate(header):
        name = canonical.get(_key(title))
        if name is None:
            unused += [title] if title.strip() else []
        elif name in places:
            problems.add(
                line,
                f"columns {quoted(header[places[name]])} and {quoted(title)} both mean {name}; "
                "leave one out",
            )
        else:
            places[name] = place
    return places, unused


def _columns(
    chunks: Iterator[tuple[list[int], list[list[str]]]],
    width: int,
    places: Mapping[str, int],
    problems: Problems,
) -> tuple[NDArray[np.int64], dict[str, Texts]]:
    """Return the line of each row that has the header's width, and its cells by column."""
    # Each text gets the next free number when it is first met.
    numbers = {name: defaultdict[str, int](count().__next__) for name in places}
    codes = {name: array("q") for name in places}
    all_lines = array("q")
    for lines, rows in chunks:
        if set(map(len, rows)) != {width}:
            fit = [_fits(line, row, width, problems) for line, row in zip(lines, rows, strict=True)]
            lines, rows = list(compress(lines, fit)), list(compress(rows, fit))
        all_lines.extend(lines)
        for name, place in places.items():
            codes[name].extend(map(numbers[name].__getitem__, map(itemgetter(place), rows)))
    columns = {
        name: _stripped(list(numbers[name]), np.array(codes[name], dtype=np.int64))
        for name in places
    }
    return np.array(all_lines, dtype=np.int64), columns


def _fits(line: int, row: list[str], width: int, problems: Problems) -> bool:
    """Tell whether a row has the header's width; blank cells beyond it do no harm."""
    if len(row) == width or (len(row) > width and not "".join(row[width:]).strip()):
        return True
    if "".join(row).strip():
        problems.add(
            line,
            f"has {len(row)} cells, but the header has {width}; "
            "add what is missing, or quote cells that hold the separator",
        )
    return False


def _stripped(raw: list[str], codes: NDArray[np.int64]) -> Texts:
    """Return a column with the blanks around its cells taken away."""
    bare = [text.strip() for text in raw]
    if bare == raw:  # as nearly always
        return Texts(raw, codes)
    numbers: defaultdict[str, int] = defaultdict(count().__next__)
    renumbered = np.array([numbers[text] for text in bare], dtype=np.int64)
    return Texts(list(numbers), renumbered[codes])


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(quoted(name.strip()) for name in names[:12])
    return shown + (f" and {len(names) - 12} more" if len(names) > 12 else "")
