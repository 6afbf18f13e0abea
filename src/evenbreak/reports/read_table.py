"""A CSV file as columns of text, each row with the line it stands in.

This is the one door through which tables come in: it settles the encoding, the
separator, the names of the columns and the shape of the rows. What the cells mean
is for `evenbreak.reports.cells` and for the reader of each kind of file.
"""

from __future__ import annotations

import csv
import io
import sys
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, islice
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.errors import DataError
from evenbreak.reports.problems import Problems, quoted

__all__ = ["Table", "Texts", "read_table"]

SEPARATORS = {",": "comma", ";": "semicolon", "\t": "tab"}
ROWS_AT_A_TIME = 65_536
MAGIC = {
    b"PK\x03\x04": "a spreadsheet or a zip archive",
    b"\xd0\xcf\x11\xe0": "an old Excel workbook",
    b"%PDF": "a PDF document",
    b"\xff\xfe": "UTF-16 text",
    b"\xfe\xff": "UTF-16 text",
}


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

    def cells(self, name: str) -> list[str]:
        """Return the text of a column, row by row; '' throughout where the file lacks it."""
        distinct, codes = self.texts(name)
        return [distinct[code] for code in codes.tolist()]


def read_table(
    path: str | Path,
    required: Mapping[str, Sequence[str]],
    optional: Mapping[str, Sequence[str]] | None = None,
) -> Table:
    r"""Read a CSV file as columns of text.

    UTF-8 with or without BOM, else Windows-1252 with a warning; comma, semicolon or
    tab; LF, CRLF or CR; quoted cells may hold line ends. Names of columns are compared
    without regard to case, blanks and punctuation. Blank rows are skipped, unknown
    columns are ignored with a warning.

    Parameters
    ----------
    path
        the file; '-' is standard input.
    required, optional
        for each column its other names.

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
    source, content = _content(path)
    text, warnings = _decoded(content, source)
    problems = Problems(source)
    names = {**required, **(optional or {})}
    separator = _separator(text, names)
    rows = _rows(text, separator, problems)
    header_line, header = next(rows, (1, []))
    if not header:
        problems.add(None, "holds no rows; write a header line and one line for each row")
        problems.raise_any()
    places, unused = _places(header, names, problems)
    missing = [name for name in required if name not in places]
    for name in missing:
        others = f" (or {', '.join(required[name])})" if required[name] else ""
        problems.add(
            header_line,
            f"there is no column {name!r}{others} among {_listed(header)}; add it",
        )
    if unused:
        warnings.append(f"{source}: columns not used: {_listed(unused)}")
    lines, columns = _columns(rows, len(header), places, problems)
    return Table(source, lines, columns, problems, tuple(warnings), content)


def _content(path: str | Path) -> tuple[str, bytes]:
    """Return what to call the file, and its bytes."""
    if str(path) == "-":
        return "stdin", sys.stdin.buffer.read()
    # A name that is not text must still print.
    source = str(path).encode("utf-8", "backslashreplace").decode()
    try:
        return source, Path(path).read_bytes()
    except FileNotFoundError:
        raise DataError([f"{source}: there is no such file; check its name"]) from None
    except IsADirectoryError:
        raise DataError([f"{source}: is a folder; name a file in it"]) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DataError([f"{source}: cannot be read ({reason}); check the file"]) from None


def _decoded(content: bytes, source: str) -> tuple[str, list[str]]:
    """Return the text of a file, and a warning if it had to be guessed how it is encoded."""
    for magic, kind in MAGIC.items():
        if content.startswith(magic):
            raise DataError([f"{source}: is {kind}; save it as CSV, in UTF-8"])
    nul = content.find(b"\0")
    if nul >= 0:
        line = content.count(b"\n", 0, nul) + 1
        raise DataError([f"{source}:{line}: holds a NUL byte; save the file as CSV, in UTF-8"])
    try:
        text, warnings = content.decode("utf-8-sig"), []
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        try:
            text = content.decode("cp1252")
        except UnicodeDecodeError as also:
            line = content.count(b"\n", 0, also.start) + 1
            raise DataError(
                [f"{source}:{line}: is neither UTF-8 nor Windows-1252 text; save it as UTF-8"]
            ) from None
        warnings = [
            f"{source}:{line}: is not UTF-8; read as Windows-1252, so look at the accents in names"
        ]
    if not text.strip():
        raise DataError(
            [f"{source}: is empty; write a header line and one line for each row below it"]
        )
    return text, warnings


def _key(name: str) -> str:
    """Return what a column's name is compared by: letters and digits, in one case."""
    return "".join(letter for letter in name.casefold() if letter.isalnum())


def _separator(text: str, names: Mapping[str, Sequence[str]]) -> str:
    """Return the separator that makes the most known names of the header."""
    known = {_key(name) for canonical, others in names.items() for name in (canonical, *others)}

    def fit(separator: str) -> tuple[int, int]:
        _, header = next(_rows(text, separator, Problems("")), (1, []))
        return sum(_key(name) in known for name in header), len(header)

    return max(SEPARATORS, key=fit)


def _rows(text: str, separator: str, problems: Problems) -> Iterator[tuple[int, list[str]]]:
    """Yield each row that is not blank with the line it begins in."""
    lines = io.StringIO(text, newline="")
    reader = csv.reader(lines, delimiter=separator, skipinitialspace=True, strict=True)
    line = 1
    while True:
        try:
            row = next(reader)
        except StopIteration:
            return
        except csv.Error:
            problems.add(
                line, 'cannot be split into cells; close every " and write "" for one in a cell'
            )
        else:
            if any(row) and not all(map(str.isspace, filter(None, row))):
                yield line, row
        line = reader.line_num + 1


def _places(
    header: list[str], names: Mapping[str, Sequence[str]], problems: Problems
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
                None,
                f"columns {quoted(header[places[name]])} and {quoted(title)} both mean {name}; "
                "leave one out",
            )
        else:
            places[name] = place
    return places, unused


def _columns(
    rows: Iterator[tuple[int, list[str]]],
    width: int,
    places: Mapping[str, int],
    problems: Problems,
) -> tuple[NDArray[np.int64], dict[str, Texts]]:
    """Return the line of each row that has the header's width, and its cells by column."""
    # Each text gets the next free number when it is first met.
    numbers: dict[str, defaultdict[str, int]] = {
        name: defaultdict(count().__next__) for name in places
    }
    parts: dict[str, list[NDArray[np.int64]]] = {name: [] for name in places}
    line_parts: list[NDArray[np.int64]] = []
    while chunk := list(islice(rows, ROWS_AT_A_TIME)):
        kept = [(line, row) for line, row in chunk if _fits(line, row, width, problems)]
        line_parts.append(np.array([line for line, _ in kept], dtype=np.int64))
        for name, place in places.items():
            cells = map(numbers[name].__getitem__, [row[place] for _, row in kept])
            parts[name].append(np.fromiter(cells, dtype=np.int64, count=len(kept)))
    nothing = [np.zeros(0, dtype=np.int64)]
    columns = {
        name: _stripped(list(numbers[name]), np.concatenate(parts[name] or nothing))
        for name in places
    }
    return np.concatenate(line_parts or nothing), columns


def _fits(line: int, row: list[str], width: int, problems: Problems) -> bool:
    """Tell whether a row has the header's width; blank cells beyond it do no harm."""
    if len(row) == width or (len(row) > width and not "".join(row[width:]).strip()):
        return True
    problems.add(
        line,
        f"has {len(row)} cells, but the header has {width}; "
        "add what is missing, or quote cells that hold the separator",
    )
    return False


def _stripped(raw: list[str], codes: NDArray[np.int64]) -> Texts:
    """Return a column with the blanks around its cells taken away."""
    numbers: defaultdict[str, int] = defaultdict(count().__next__)
    renumbered = np.array([numbers[text.strip()] for text in raw], dtype=np.int64)
    return Texts(list(numbers), renumbered[codes] if len(raw) else codes)


def _listed(names: Sequence[str]) -> str:
    shown = ", ".join(quoted(name.strip()) for name in names[:12])
    return shown + (f" and {len(names) - 12} more" if len(names) > 12 else "")
