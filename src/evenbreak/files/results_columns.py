"""The columns of a results file: what each may be called, and what its cells may say."""

from __future__ import annotations

import unicodedata
from collections import defaultdict
from collections.abc import Mapping
from functools import partial
from itertools import count
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.cells import Values, dates, read_cells, whole_numbers
from evenbreak.files.csv_writer import FORMULA_STARTS
from evenbreak.files.problems import quoted
from evenbreak.files.text_table import Table
from evenbreak.ratings.consistency import find_problems
from evenbreak.ratings.results import FORMATS, Results

NAMES = ("player_a", "player_b")

REQUIRED = {
    "player_a": ("player 1", "player a name", "home", "home player", "a"),
    "player_b": ("player 2", "player b name", "away", "away player", "b"),
    "score_a": ("score 1", "games a", "games 1", "home score", "frames a", "racks won a"),
    "score_b": ("score 2", "games b", "games 2", "away score", "frames b", "racks won b"),
}
"""The columns that a results file must have, with their other names."""

OPTIONAL = {
    "date": ("day", "match date", "played", "played on"),
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

INSTEAD = dict.fromkeys(("score_a", "score_b"), (("race_a", "race_b", "winner"), ("racks",)))
"""What may be there in place of a score: who won which race, or who won each rack."""

_SIDES = {"a": 1, "playera": 1, "1": 1, "player1": 1, "b": 2, "playerb": 2, "2": 2, "player2": 2}
_FORFEIT = {
    **dict.fromkeys(("yes", "y", "true", "t", "1", "x", "forfeit", "walkover", "wo"), True),
    **dict.fromkeys(("no", "n", "false", "f", "0"), False),
}


DEFUSED = tuple(f"'{start}" for start in FORMULA_STARTS)
"""How a name begins that was kept from being a formula."""


class ResultsColumns:
    """The columns of a table on their way to becoming `Results`.

    Reading them notes each cell that has no meaning in the table's problems.

    Parameters
    ----------
    table
        what `evenbreak.files.text_table` made of the file.
    means
        from a name that is written to the one that is meant.
    """

    def __init__(self, table: Table, means: Mapping[str, str] | None = None) -> None:
        self.table = table
        self.means = means or {}
        self.numbers: defaultdict[str, int] = defaultdict(count().__next__)
        self.values: dict[str, NDArray[Any]] = {}
        self.good = np.ones(len(table), dtype=bool)

        for name in NAMES:
            self._keep(name, self._names(name))
        self.named = self.good.copy()
        if "date" in self.table:
            self._keep("date", dates(self.table, "date"))
        if "forfeit" in self.table:
            self._keep("forfeit", self._words("forfeit", _FORFEIT, "yes or no", False))
        for name in ("score_a", "score_b"):
            self._keep(name, whole_numbers(self.table, name, at_least=0, may_be_empty=True))
        for name in ("race_a", "race_b"):
            if name in self.table:
                remedy = "write 1, 2, 3, ..., or leave both races empty"
                self._keep(
                    name,
                    whole_numbers(self.table, name, at_least=1, remedy=remedy, may_be_empty=True),
                )
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
        self._settle_empty_scores()

    def checked(self) -> Results:
        """Return the rows that could be read, their contradictions noted as problems."""
        players = sorted(self.numbers)
        rank = np.zeros(len(players), dtype=np.int64)
        for place, name in enumerate(players):
            rank[self.numbers[name]] = place
        rows = np.flatnonzero(self.good)
        columns = {name: values[rows] for name, values in self.values.items()}
        columns |= {name: rank[columns[name]] for name in NAMES}
        results = Results(tuple(players), **columns)
        self._note(results, rows)
        # Where only the names could be read, they can still be one and the same.
        rows = np.flatnonzero(self.named & ~self.good)
        a, b = (rank[self.values[name][rows]] for name in NAMES)
        self._note(Results(tuple(players), a, b, 0 * a, 0 * b), rows)
        return results

    def _note(self, results: Results, rows: NDArray[np.int64]) -> None:
        for problem in find_problems(results):
            row = rows[problem.row]
            alias = self._by_aliases(row) if problem.column == "player_b" else ""
            self.table.problems.add(int(self.table.lines[row]), problem.message + alias)

    def _by_aliases(self, row: int) -> str:
        """Return the two names of a player against himself, if aliases made them one."""
        texts = map(self.table.texts, NAMES)
        a, b = (clean_name(distinct[codes[row]]) for distinct, codes in texts)
        return "" if a == b else f" ({quoted(a)} and {quoted(b)} are one player by the aliases)"

    def merged_names(self) -> list[str]:
        """Return a warning for each name that was also written with other blanks."""
        written = {
            text for column in NAMES for text in map(_plain, self.table.texts(column).distinct)
        }
        return [
            f"{self.table.source}: {quoted(text)} is read as {quoted(clean_name(text))}"
            for text in sorted(written)
            if clean_name(text) not in ("", text) and clean_name(text) in written
        ]

    def aliases_met(self) -> list[str]:
        """Return the names in the file that mean another one, sorted."""
        written = {text for column in NAMES for text in self.table.texts(column).distinct}
        return sorted({clean_name(text) for text in written} & self.means.keys())

    def _meant(self, text: str) -> str:
        """Return the name of the player whom a cell means."""
        clean = clean_name(text)
        return self.means.get(clean, clean)

    def _keep(self, name: str, column: Values) -> None:
        self.values[name] = column.values
        self.good &= column.good

    def _names(self, name: str) -> Values:
        def meaning(text: str) -> int | None:
            clean = clean_name(text)
            controls = any(unicodedata.category(letter) == "Cc" for letter in clean)
            return None if controls else self.numbers[self._meant(text)]

        return read_cells(
            self.table,
            name,
            meaning,
            wanted="a name that can be printed",
            remedy="write the player's name",
            dtype=np.int64,
            empty=0,
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

    def _settle_empty_scores(self) -> None:
        """Take empty scores from the racks, or as unknown where race and winner are stated."""
        given_away = self.values.get("forfeit", np.zeros(len(self.table), dtype=bool))
        empty = {name: self._is_empty(name) & ~given_away for name in ("score_a", "score_b")}
        both = empty["score_a"] & empty["score_b"]
        by_rack = both & ~self._is_empty("racks")
        racks = self.table.texts("racks")
        for name, letter in (("score_a", "a"), ("score_b", "b")):
            count = np.array([_racks(text).count(letter) for text in racks.distinct])
            self.values[name] = np.where(by_rack, count[racks.codes], self.values[name])
        unscored = both & ~by_rack
        for name in ("race_a", "race_b", "winner"):
            unscored &= self.values.get(name, np.zeros(len(self.table))) > 0
        if unscored.any():
            self.values["unscored"] = unscored
        unreadable = np.zeros(len(self.table), dtype=bool)  # has been told, and may be all there is
        for name in ("race_a", "race_b", "winner"):
            if name in self.values:
                unreadable |= ~self._is_empty(name) & (self.values[name] == 0)
        if not any(name in self.table for name in empty):
            if not _missing(self.table, "score_a"):
                self._refuse(both & ~by_rack & ~unscored & ~unreadable, _nothing_known)
            return
        for name, cells in empty.items():
            if not _missing(self.table, name):  # else the missing column has been told
                told = cells & ~by_rack & ~unscored & ~(both & unreadable)
                self._refuse(told, partial(_empty_score, name))

    def _is_empty(self, name: str) -> NDArray[np.bool_]:
        distinct, codes = self.table.texts(name)
        return np.array([not text for text in distinct], dtype=bool)[codes]

    def _sides(self, name: str) -> Values:
        """Read a column that names one of the two players, as a, b or by name."""
        distinct, codes = self.table.texts(name)
        folded = {
            alias.casefold(): self.numbers.get(self._meant(alias), -1) for alias in self.means
        }
        folded |= {player.casefold(): code for player, code in reversed(self.numbers.items())}
        exact = [self.numbers.get(self._meant(text), -1) for text in distinct]
        sides = [_SIDES.get(_letters(text), 0) for text in distinct]
        loose = [folded.get(clean_name(text).casefold(), -1) for text in distinct]
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
        unknown = stated & (values == 0) & self.named
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


def lacks_columns(table: Table) -> bool:
    """Return whether a column is missing without which nothing can be made of a table."""
    return any(_missing(table, name) for name in REQUIRED)


def _missing(table: Table, name: str) -> bool:
    others_do = any(all(other in table for other in group) for group in INSTEAD.get(name, ()))
    return name not in table and not others_do


def _empty_score(name: str, _: int) -> str:
    return (
        f"{name} is empty; write the games won, or race_a, race_b and winner if no more is known, "
        "or mark a forfeit, or leave out a match that was not played"
    )


def _nothing_known(_: int) -> str:
    return (
        "it is not said who won; write race_a, race_b and winner, or racks, or mark a forfeit, or "
        "leave out a match that was not played"
    )


def clean_name(text: str) -> str:
    r"""Return a name without blanks around and double blanks inside, in Unicode's form NFC.

    The apostrophe that `evenbreak.files.csv_writer` puts before what a spreadsheet would run
    as a formula is no part of the name.

    >>> clean_name(" Zoe\u0308  Kestleman "), clean_name("'=cmd()")
    ('Zoë Kestleman', '=cmd()')
    """
    clean = " ".join(_plain(text).split())
    return clean[1:] if clean.startswith(DEFUSED) else clean


def _plain(text: str) -> str:
    return unicodedata.normalize("NFC", text)


def _letters(text: str) -> str:
    return "".join(letter for letter in text.casefold() if letter.isalnum())


def _racks(text: str) -> str:
    return "".join(text.casefold().split())
