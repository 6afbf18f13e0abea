"""From a results file to `Results`: what each column may be called, and what its cells may say."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections import defaultdict
from dataclasses import dataclass
from datetime import date
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.ratings.results import FORMATS, Results, find_problems
from evenbreak.reports.cells import Values, read_cells, whole_numbers
from evenbreak.reports.problems import quoted
from evenbreak.reports.read_table import Table, read_table
from evenbreak.reports.similar_names import similar_names

__all__ = ["OPTIONAL", "REQUIRED", "ResultsFile", "read_results"]

REQUIRED = {
    "date": ("day", "match date", "played", "played on"),
    "player_a": ("player 1", "player a name", "home", "home player", "a"),
    "player_b": ("player 2", "player b name", "away", "away player", "b"),
    "score_a": ("score 1", "games a", "games 1", "home score", "frames a", "racks won a"),
    "score_b": ("score 2", "games b", "games 2", "away score", "frames b", "racks won b"),
}
"""The columns that a results file must have, with their other names."""

OPTIONAL = {
    "race_a": ("race 1", "race to a", "needs a", "home race"),
    "race_b": ("race 2", "race to b", "needs b", "away race"),
    "winner": ("won by", "match winner"),
    "first_break": ("first breaker", "breaks first", "lag won by"),
    "break_format": ("who breaks", "breaks next"),
    "racks": ("rack winners", "games in order"),
    "event": ("tournament", "competition", "league", "division"),
    "forfeit": ("walkover", "forfeited", "no show", "w/o"),
}
"""The columns that a results file may have, with their other names."""

WARNED = 20
"""How many groups of similar names are told; the rest are counted."""

_DATE = re.compile(r"(\d{4})[-/](\d{1,2})[-/](\d{1,2})([T ]\d{1,2}:\d{2}\S*)?", re.ASCII)
_SIDES = {"a": 1, "playera": 1, "1": 1, "player1": 1, "b": 2, "playerb": 2, "2": 2, "player2": 2}
_FORFEIT = {
    **dict.fromkeys(("yes", "y", "true", "t", "1", "x", "forfeit", "walkover", "wo"), True),
    **dict.fromkeys(("no", "n", "false", "f", "0"), False),
}


@dataclass(frozen=True, eq=False)
class ResultsFile:
    """What a results file says.

    Parameters
    ----------
    results
        its matches, in the order of the file; players in the order of their names.
    source
        what the file is called in messages.
    warnings
        what a person should look at although the file can be used, a line each.
    similar_names
        groups of names that may mean one player.
    sha256
        fingerprint of the bytes that were read.
    """

    results: Results
    source: str
    warnings: tuple[str, ...]
    similar_names: tuple[tuple[str, ...], ...]
    sha256: str


def read_results(path: str | Path) -> ResultsFile:
    r"""Read match results from a CSV file; '-' is standard input.

    Encoding, separator and header are read as `evenbreak.reports.read_table` says; the
    columns are those of `REQUIRED` and `OPTIONAL`. Names lose blanks around and double
    blanks inside, and are put into Unicode's form NFC. `winner` and `first_break` are
    a, b or the name of one of the two. A forfeit may leave its scores empty.

    Raises
    ------
    DataError
        with every problem of the file, a line each, if there is any.

    >>> import tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "results.csv"
    ...     _ = path.write_text("Date;Player A;Player B;Score A;Score B\n2024-09-03;Bo;Ann;5;7\n")
    ...     season = read_results(path)
    >>> season.results.players, season.results.score_b
    (('Ann', 'Bo'), array([7]))
    """
    table = read_table(path, REQUIRED, OPTIONAL)
    if not len(table) and not len(table.problems):
        table.problems.add(None, "has no matches below its header; write one line for each")
    columns = _Columns(table)
    results = columns.results()
    table.problems.raise_any()
    groups = tuple(similar_names(results.players))
    warnings = [*table.warnings, *columns.merged_names(), *_warnings(groups, table.source)]
    sha256 = hashlib.sha256(table.content).hexdigest()
    return ResultsFile(results, table.source, tuple(warnings), groups, sha256)


class _Columns:
    """The columns of a table on their way to becoming `Results`."""

    def __init__(self, table: Table) -> None:
        self.table = table
        self.numbers: defaultdict[str, int] = defaultdict(count().__next__)
        self.values: dict[str, NDArray[Any]] = {}
        self.good = np.ones(len(table), dtype=bool)

    def results(self) -> Results:
        """Read every column, note every problem, and return the rows that could be read."""
        for name in ("player_a", "player_b"):
            self._keep(name, self._names(name))
        self._keep("date", self._dates())
        if "forfeit" in self.table:
            self._keep("forfeit", self._words("forfeit", _FORFEIT, "yes or no", False))
        for name in ("score_a", "score_b"):
            self._keep(name, whole_numbers(self.table, name, may_be_empty=True))
            self._refuse_empty_score(name)
        for name in ("race_a", "race_b"):
            if name in self.table:
                self._keep(name, self._races(name))
        for name in ("winner", "first_break"):
            if name in self.table:
                self._keep(name, self._sides(name))
        if "break_format" in self.table:
            self._keep("break_format", self._formats())
        for name in ("racks", "event"):
            if name in self.table:
                distinct, codes = self.table.texts(name)
                meaning = _racks if name == "racks" else _plain
                self.values[name] = np.array([*map(meaning, distinct)], dtype=object)[codes]
        return self._checked()

    def _checked(self) -> Results:
        """Return the rows that could be read, with their contradictions noted."""
        rows = np.flatnonzero(self.good)
        players = sorted(self.numbers)
        rank = np.zeros(len(players), dtype=np.int64)
        for place, name in enumerate(players):
            rank[self.numbers[name]] = place
        columns = {name: values[rows] for name, values in self.values.items()}
        for name in ("player_a", "player_b"):
            columns[name] = rank[columns[name]]
        results = Results(tuple(players), **columns)
        for problem in find_problems(results):
            self.table.problems.add(int(self.table.lines[rows[problem.row]]), problem.message)
        return results

    def merged_names(self) -> list[str]:
        """Return a warning for each name that was also written with other blanks."""
        written = {
            text
            for column in ("player_a", "player_b")
            for text in map(_plain, self.table.texts(column).distinct)
        }
        return [
            f"{self.table.source}: {quoted(text)} is read as {quoted(' '.join(text.split()))}"
            for text in sorted(written)
            if " ".join(text.split()) not in ("", text) and " ".join(text.split()) in written
        ]

    def _keep(self, name: str, column: Values) -> None:
        self.values[name] = column.values
        self.good &= column.good

    def _names(self, name: str) -> Values:
        def meaning(text: str) -> int | None:
            clean = " ".join(_plain(text).split())
            return self.numbers[clean] if clean.isprintable() else None

        return read_cells(
            self.table,
            name,
            meaning,
            wanted="a name that can be printed",
            remedy="write the player's name without control characters",
            dtype=np.int64,
            empty=0,
        )

    def _dates(self) -> Values:
        return read_cells(
            self.table,
            "date",
            _date,
            wanted="a date",
            remedy="write year-month-day, such as 2024-09-03, or leave it empty",
            dtype="datetime64[D]",
            empty=np.datetime64("NaT"),
            may_be_empty=True,
        )

    def _words(self, name: str, words: dict[str, Any], choices: str, empty: Any) -> Values:
        return read_cells(
            self.table,
            name,
            lambda text: words.get(_letters(text)),
            wanted=choices,
            remedy=f"write {choices}, or leave it empty",
            dtype=type(empty),
            empty=empty,
            may_be_empty=True,
        )

    def _formats(self) -> Values:
        words = {form + tail: code for code, form in enumerate(FORMATS) for tail in ("", "breaks")}
        words |= {"alternating": words["alternate"], "alternatingbreaks": words["alternate"]}
        del words[""], words["breaks"]
        return self._words("break_format", words, "winner, loser, alternate, a or b", 0)

    def _refuse_empty_score(self, name: str) -> None:
        if name not in self.table:
            return
        distinct, codes = self.table.texts(name)
        empty = np.array([not text for text in distinct], dtype=bool)[codes]
        if "forfeit" in self.values:
            empty &= ~self.values["forfeit"]
        self._refuse(
            empty,
            lambda _: (
                f"{name} is empty; write the games won, or mark a forfeit, or leave out a "
                "match that was not played"
            ),
        )

    def _races(self, name: str) -> Values:
        remedy = "write 1, 2, 3, ..., or leave both races empty"
        column = whole_numbers(self.table, name, remedy=remedy, may_be_empty=True)
        distinct, codes = self.table.texts(name)
        stated = np.array([bool(text) for text in distinct], dtype=bool)[codes]
        self._refuse(
            stated & column.good & (column.values == 0), lambda _: f"{name} is 0; {remedy}"
        )
        return column

    def _sides(self, name: str) -> Values:
        """Read a column that names one of the two players, as a, b or by name."""
        distinct, codes = self.table.texts(name)
        folded = {player.casefold(): code for player, code in reversed(self.numbers.items())}
        cleaned = [" ".join(_plain(text).split()) for text in distinct]
        exact = [self.numbers.get(text, -1) for text in cleaned]
        sides = [_SIDES.get(_letters(text), 0) for text in distinct]
        loose = [folded.get(text.casefold(), -1) for text in cleaned]
        a, b = self.values["player_a"], self.values["player_b"]

        def side(named: list[int]) -> NDArray[np.int8]:
            code = np.array(named, dtype=np.int64)[codes]
            return np.where(code == a, 1, np.where(code == b, 2, 0)).astype(np.int8)

        # A player may be called A or B: a name as written means the player before the letter does.
        letter = np.array(sides, dtype=np.int8)[codes]
        values = side(exact)
        for weaker in (letter, side(loose)):
            values = np.where(values > 0, values, weaker)
        stated = np.array([bool(text) for text in distinct], dtype=bool)[codes]
        # Whether a name fits cannot be told where a player's own name could not be read.
        unknown = stated & (values == 0) & self.good
        self._refuse(
            unknown,
            lambda row: (
                f"{name} {quoted(distinct[codes[row]])} is neither of the two players; "
                "write a, b or a name of this row, or leave it empty"
            ),
        )
        return Values(values, np.ones(len(self.table), dtype=bool))

    def _refuse(self, bad: NDArray[np.bool_], message: Any) -> None:
        self.table.problems.add_rows(self.table.lines, np.flatnonzero(bad), message)
        self.good &= ~bad


def _plain(text: str) -> str:
    return unicodedata.normalize("NFC", text)


def _letters(text: str) -> str:
    return "".join(letter for letter in text.casefold() if letter.isalnum())


def _racks(text: str) -> str:
    return "".join(text.casefold().split())


def _date(text: str) -> np.datetime64 | None:
    match = _DATE.fullmatch(text)
    try:
        return np.datetime64(date(*map(int, match.groups()[:3]))) if match else None
    except ValueError:
        return None


def _warnings(groups: tuple[tuple[str, ...], ...], source: str) -> list[str]:
    told = [
        f"{source}: {', '.join(map(quoted, group[:-1]))} and {quoted(group[-1])} may be one "
        "player; if so, write one name throughout"
        for group in groups[:WARNED]
    ]
    more = len(groups) - WARNED
    return [*told, f"{source}: and {more:,} more groups of similar names"] if more > 0 else told
