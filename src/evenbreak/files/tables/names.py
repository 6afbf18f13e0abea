"""Names of players: cleaned, matched with those they mean, and found as people type them."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from evenbreak.files.csv_writer import undefused
from evenbreak.files.tables.problems import first_ones, quoted, warning
from evenbreak.files.tables.schema import Column
from evenbreak.files.tables.table import TextTable, Values
from evenbreak.ratings.results_frame import folded, letters, usual_spellings
from evenbreak.words import listed, say

_SIDES = {"a": 1, "playera": 1, "1": 1, "player1": 1, "b": 2, "playerb": 2, "2": 2, "player2": 2}

LONGEST_NAME = 200
"""Letters of a name; where a quotation mark is missing, half a file may be in one cell."""

NAME = say("a name of up to {most} printable characters", most=LONGEST_NAME)

MOST_LISTED = 20
"""How many names are listed in warnings about a file."""

_HIDDEN = re.compile(
    "[\u00ad\u061c\u180e\u200b\u200e\u200f\u202a-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb"
    "\U0001d173-\U0001d17a\U000e0000-\U000e007f"
    "\ud800-\udfff\ufdd0-\ufdef"
    + "".join(
        f"{chr(plane + 0xFFFE)}{chr(plane + 0xFFFF)}" for plane in range(0, 0x110000, 0x10000)
    )
    + "]"
)
"""What has no place in a name: letters that cannot be seen or that turn the text around them (as
U+202E does), and code points that are no letters. Joiners stay; some scripts need them."""


def clean_name(text: str) -> str:
    r"""Return a name as it is printed: in Unicode's NFC, without hidden letters or extra blanks.

    The apostrophes by which `evenbreak.files.csv_writer` keeps a spreadsheet from running a formula
    are removed too.

    >>> clean_name(" Zoe\u0308  Kestleman "), clean_name("'=cmd()"), clean_name("Bo\u202e")
    ('Zoë Kestleman', '=cmd()', 'Bo')
    """
    # Nearly all names are printed as they are written, and a file holds each several times.
    if text.isascii() and text.isprintable() and "'" not in text and text == " ".join(text.split()):
        return text
    return undefused(" ".join(unicodedata.normalize("NFC", _HIDDEN.sub("", text)).split()))


@dataclass(frozen=True, kw_only=True)
class Name(Column):
    """Names of players or teams, cleaned; with `given_first` Lee, Ann becomes Ann Lee."""

    filled: bool = True
    write: str = say("a name")
    given_first: bool = True  # type: ignore[misc]

    @property
    def wanted(self) -> str:
        """What a cell should be."""
        return NAME

    def meaning(self, text: str) -> Any:
        """Return the clean name."""
        name = clean_name(text)
        return name if is_name(name) else None

    def fault(self, text: str) -> str:
        """Return what is wrong with a cell that has no name."""
        name = clean_name(text)
        if len(name) <= LONGEST_NAME:
            return super().fault(text)
        return say(
            "{name} has {n:,} characters. Write a name of up to {most}, and look for a missing "
            "quotation mark.",
            name=quoted(name),
            n=len(name),
            most=LONGEST_NAME,
        )


@dataclass(frozen=True, kw_only=True)
class PlayerPlace(Name):
    """Names of players as places in a list: `places` has that of each text."""

    places: Mapping[str, int]
    write: str = say("the player's name")
    nothing: int = 0

    dtype: ClassVar[Any] = np.int64

    def meaning(self, text: str) -> int | None:
        """Return the place."""
        return self.places.get(text)


def hidden_letter_warnings(table: TextTable, columns: Sequence[str]) -> list[str]:
    """Return a warning for each name that has lost letters which cannot be seen."""
    texts = {text: None for column in columns for text in table.columns[column].distinct}
    warnings = [
        warning(
            table.source,
            None,
            "{text} has invisible characters; it's read as {name}",
            text=quoted(text),
            name=quoted(clean_name(text)),
        )
        for text in texts
        if _HIDDEN.search(text)
    ]
    return first_ones(
        warnings,
        MOST_LISTED,
        table.source,
        lambda n: say("and {n:,} more names with invisible characters", n=n),
    )


def same_name(name: str) -> str:
    """Return what names have in common that differ only in case or blanks: one player's.

    >>> same_name("Ann Lee") == same_name("ann  LEE") == same_name("AnnLee")
    True
    """
    return folded(clean_name(name))


class PlayerNames:
    """The players named in some columns of a table.

    Names that differ only in case or blanks are one player's. Of the spellings of a name the one in
    `means` is used, otherwise the most frequent. `players` are the names that are meant, sorted;
    `places` has the place there of each text.
    """

    def __init__(self, table: TextTable, columns: Sequence[str], means: Mapping[str, str]) -> None:
        self._means = means
        self._loosely: dict[str, str] = {}
        for alias, name in means.items():  # one that is ambiguous apart from case is no help
            key = same_name(alias)
            self._loosely[key] = name if self._loosely.get(key, name) == name else ""
        rows: Counter[str] = Counter()
        for column in columns:
            distinct, codes = table.columns[column]
            counts = np.bincount(codes, minlength=len(distinct))
            rows.update(dict(zip(distinct, counts.tolist(), strict=True)))
        self._written = set(rows)
        self._spelling = self._spellings(rows)
        meant = {text: self._meant(text) for text in self._written}
        self.players = tuple(sorted({name for name in meant.values() if is_name(name)}))
        self._place = {name: place for place, name in enumerate(self.players)}
        self.places = {text: self._place[name] for text, name in meant.items() if is_name(name)}

    def _spellings(self, rows: Mapping[str, int]) -> dict[str, str]:
        """Return the spelling to use of all names that differ only in case or blanks."""
        counts: Counter[str] = Counter()
        for text, count in rows.items():
            counts[self._unaliased(text)] += count
        return usual_spellings(counts, set(self._means.values()))

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column of names, as places in `players`."""
        return PlayerPlace(places=self.places).read(table, name)

    def read_side(self, table: TextTable, name: str, a: Values, b: Values) -> Values:
        """Read a column that names one of the two players, as a, b or by name: 1 or 2.

        A player may be called A or B: a name as written means the player before the letter
        does. Upper and lower case of names may differ.
        """
        distinct, codes = table.columns[name]
        sides = np.array([_SIDES.get(letters(text), 0) for text in distinct], dtype=np.int8)
        values = np.zeros(len(table.lines), dtype=np.int8)
        for sides_found in (
            _side(self._exact(distinct)[codes], a, b),
            sides[codes],
            _side(self._loose(distinct)[codes], a, b),
        ):
            values = np.where(values > 0, values, sides_found)
        stated = np.array([bool(text) for text in distinct], dtype=bool)[codes]
        # Where a player's own name could not be read, it is not known whether this one fits.
        wrong = stated & (values == 0) & a.good & b.good
        for row in np.flatnonzero(wrong):
            table.note(
                row,
                "{column} {cell} is neither of the two players. Write a, b or one of the "
                "two names, or leave it empty.",
                column=name,
                cell=quoted(distinct[codes[row]]),
            )
        return Values(values, ~wrong, stated)

    def _exact(self, texts: Sequence[str]) -> NDArray[np.int64]:
        places = [
            self.places.get(text, self._place.get(self._means.get(clean_name(text), ""), -1))
            for text in texts
        ]
        return np.array(places, dtype=np.int64)

    def _loose(self, texts: Sequence[str]) -> NDArray[np.int64]:
        return np.array([self._place.get(self._meant(text), -1) for text in texts], dtype=np.int64)

    def merged(self) -> dict[str, str]:
        """Return the names that differ in case or blanks from the one they are read as."""
        written = {unicodedata.normalize("NFC", text) for text in self._written}
        meant = {
            text: self._spelling[same_name(text)]
            for text in sorted(written)
            if not self._alias_of(text) and same_name(text) in self._spelling
        }
        return {
            text: name
            for text, name in meant.items()
            if name not in ("", text) and (name != clean_name(text) or name in written)
        }

    def renamed(self) -> dict[str, str]:
        """Return the names that mean another one, each with that one."""
        clean = sorted({clean_name(text) for text in self._written})
        return {name: meant for name in clean if (meant := self._alias_of(name))}

    def _alias_of(self, text: str) -> str:
        """Return the name that a text means by the aliases, '' if it is no alias.

        An alias as written comes before one that differs in case or blanks.
        """
        if not self._means:
            return ""
        clean = clean_name(text)
        if clean in self._means:
            return self._means[clean]
        return self._loosely.get(same_name(clean), "")

    def _unaliased(self, text: str) -> str:
        return self._alias_of(text) or clean_name(text)

    def _meant(self, text: str) -> str:
        name = self._unaliased(text)
        return self._spelling.get(same_name(name), name)


def _side(places: NDArray[np.int64], a: Values, b: Values) -> NDArray[np.int8]:
    return np.where(places == a.values, 1, np.where(places == b.values, 2, 0)).astype(np.int8)


def is_name(name: str) -> bool:
    r"""Return whether a clean name can be printed: not empty, nor too long, nor with control signs.

    >>> is_name("Zoë"), is_name("Bo\x07"), is_name("")
    (True, False, False)
    """
    return 0 < len(name) <= LONGEST_NAME and (
        name.isprintable() or not any(unicodedata.category(letter) == "Cc" for letter in name)
    )


MOST_HINTS = 3


class KnownNames:
    """The names of a league, and the place of each.

    Upper and lower case and blanks may differ where that leaves no doubt.

    >>> names = KnownNames(["Ann Lee", "Bo Diaz"])
    >>> names.place("ann  lee"), names.place("Ann")
    (0, None)
    >>> names.hint("Ann")
    " (did you mean 'Ann Lee'?)"
    """

    def __init__(self, names: Iterable[str]) -> None:
        self._exact = {name: place for place, name in enumerate(names)}
        self._folded: defaultdict[str, list[str]] = defaultdict(list)
        for name in self._exact:
            self._folded[name.casefold()].append(name)
        self._same: defaultdict[str, list[str]] = defaultdict(list)
        for name in self._exact:
            self._same[same_name(name)].append(name)
        self._hints: dict[str, str] = {}

    def place(self, name: str) -> int | None:
        """Return where a name stands in the list, or None if it is unknown or ambiguous."""
        same = [name] if name in self._exact else self._same.get(same_name(name), [])
        return self._exact[same[0]] if len(same) == 1 else None

    def nearest(self, name: str) -> str | None:
        """Return the name nearest to one that was not found, None if none is near."""
        return next(iter(self._near(name.casefold())), None)

    def hint(self, name: str) -> str:
        """Return which names may have been meant by one that was not found, '' if none."""
        if name not in self._hints:
            near = list(map(quoted, self._near(name.casefold())))
            hint = say(" (did you mean {names}?)", names=listed(near, "or")) if near else ""
            self._hints[name] = hint
        return self._hints[name]

    def _near(self, wanted: str) -> list[str]:
        if not wanted or wanted in self._folded:
            return self._folded.get(wanted, [])
        close = get_close_matches(wanted, self._folded, n=MOST_HINTS)
        parts = sorted(key for key in self._folded if wanted in key)
        keys = dict.fromkeys([*close, *parts])
        return [self._folded[key][0] for key in keys][:MOST_HINTS]
