"""The names of players in a file: cleaned, and matched with the players they mean."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.cells import Values, letters, read_cells
from evenbreak.files.csv_writer import FORMULA_STARTS
from evenbreak.files.problems import quoted
from evenbreak.files.text_table import TextTable

_SIDES = {"a": 1, "playera": 1, "1": 1, "player1": 1, "b": 2, "playerb": 2, "2": 2, "player2": 2}

DEFUSED = tuple(f"'{start}" for start in FORMULA_STARTS)
"""The beginnings of names that were kept from being formulas."""


def clean_name(text: str) -> str:
    r"""Return a name without blanks around and double blanks inside, in Unicode's form NFC.

    The apostrophe that `evenbreak.files.csv_writer` puts before what a spreadsheet would run
    as a formula is removed too.

    >>> clean_name(" Zoe\u0308  Kestleman "), clean_name("'=cmd()")
    ('Zoë Kestleman', '=cmd()')
    """
    clean = " ".join(unicodedata.normalize("NFC", text).split())
    return clean[1:] if clean.startswith(DEFUSED) else clean


class PlayerNames:
    """The players whose names stand in some columns of a table.

    Parameters
    ----------
    table, columns
        where the names stand.
    means
        from a name as written to the name that is meant.

    Attributes
    ----------
    players
        the names that are meant, sorted.
    places
        for each text that names a player their place in `players`.
    """

    def __init__(self, table: TextTable, columns: Sequence[str], means: Mapping[str, str]) -> None:
        self._written = {text for column in columns for text in table.columns[column].distinct}
        self._means = means
        meant = {text: self._meant(text) for text in self._written}
        self.players = tuple(sorted({name for name in meant.values() if _is_name(name)}))
        self._place = {name: place for place, name in enumerate(self.players)}
        self.places = {text: self._place[name] for text, name in meant.items() if _is_name(name)}

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column of names, as places in `players`."""
        return read_cells(
            table,
            name,
            self.places.get,
            wanted="a name that can be printed",
            remedy="write the player's name",
            dtype=np.int64,
            empty=0,
        )

    def read_side(self, table: TextTable, name: str, a: Values, b: Values) -> Values:
        """Read a column that names one of the two players, as a, b or by name: 1 or 2.

        A player may be called A or B: a name as written means the player before the letter
        does. Upper and lower case of names may differ.
        """
        distinct, codes = table.columns[name]
        sides = np.array([_SIDES.get(letters(text), 0) for text in distinct], dtype=np.int8)
        values = np.zeros(len(table.lines), dtype=np.int8)
        for found in (
            _side(self._exact(distinct)[codes], a, b),
            sides[codes],
            _side(self._loose(distinct)[codes], a, b),
        ):
            values = np.where(values > 0, values, found)
        stated = np.array([bool(text) for text in distinct], dtype=bool)[codes]
        # Where a player's own name could not be read, it is not known whether this one fits.
        wrong = stated & (values == 0) & a.good & b.good
        for row in np.flatnonzero(wrong):
            table.problems.add(
                int(table.lines[row]),
                f"{name} {quoted(distinct[codes[row]])} is neither of the two players; "
                "write a, b or one of the two names, or leave it empty",
            )
        return Values(values, ~wrong, stated)

    def _exact(self, texts: Sequence[str]) -> NDArray[np.int64]:
        return np.array([self._place.get(self._meant(text), -1) for text in texts], dtype=np.int64)

    def _loose(self, texts: Sequence[str]) -> NDArray[np.int64]:
        folded = {
            alias.casefold(): self._place.get(name, -1) for alias, name in self._means.items()
        }
        folded |= {player.casefold(): k for player, k in reversed(self._place.items())}
        places = [folded.get(clean_name(text).casefold(), -1) for text in texts]
        return np.array(places, dtype=np.int64)

    def merged(self) -> dict[str, str]:
        """Return the names that differ in blanks from another one, each with that one."""
        written = {unicodedata.normalize("NFC", text) for text in self._written}
        clean = {text: clean_name(text) for text in sorted(written)}
        return {
            text: name for text, name in clean.items() if name not in ("", text) and name in written
        }

    def renamed(self) -> dict[str, str]:
        """Return the names that mean another one, each with that one."""
        clean = {clean_name(text) for text in self._written}
        return {name: self._means[name] for name in sorted(clean & self._means.keys())}

    def _meant(self, text: str) -> str:
        clean = clean_name(text)
        return self._means.get(clean, clean)


def _side(places: NDArray[np.int64], a: Values, b: Values) -> NDArray[np.int8]:
    return np.where(places == a.values, 1, np.where(places == b.values, 2, 0)).astype(np.int8)


def _is_name(name: str) -> bool:
    return name != "" and not any(unicodedata.category(letter) == "Cc" for letter in name)
