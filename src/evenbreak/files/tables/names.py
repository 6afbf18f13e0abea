"""Player names: cleaned, matched, and found as people type them."""

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
"""The most characters in a name; if a quotation mark is missing, half a file may be in a cell."""

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
"""Characters not allowed in a name: invisible ones, ones that turn the text around them (as U+202E
does), and invalid code points. Joiners stay; some scripts need them."""


def clean_name(text: str) -> str:
    r"""Return a printable name: in Unicode NFC, without invisible characters or extra spaces.

    The apostrophes that `evenbreak.files.csv_writer` adds to keep a spreadsheet from running a
    formula are also removed.

    >>> clean_name(" Zoe\u0308  Kestleman "), clean_name("'=cmd()"), clean_name("Bo\u202e")
    ('Zoë Kestleman', '=cmd()', 'Bo')
    """
    # Nearly all names are printed as they are written, and a file holds each several times.
    if text.isascii() and text.isprintable() and "'" not in text and text == " ".join(text.split()):
        return text
    return undefused(" ".join(unicodedata.normalize("NFC", _HIDDEN.sub("", text)).split()))


@dataclass(frozen=True, kw_only=True)
class Name(Column):
    """Names of players or teams, cleaned; with `given_first`, Lee, Ann becomes Ann Lee."""

    filled: bool = True
    write: str = say("a name")
    given_first: bool = True  # type: ignore[misc]

    @property
    def wanted(self) -> str:
        """What a cell should contain."""
        return NAME

    def meaning(self, text: str) -> Any:
        """Return the clean name."""
        name = clean_name(text)
        return name if is_name(name) else None

    def fault(self, text: str) -> str:
        """Return what is wrong with a cell that contains no name."""
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
    """Player names as places in a list: `places` has each string's place."""

    places: Mapping[str, int]
    write: str = say("the player's name")
    nothing: int = 0

    dtype: ClassVar[Any] = np.int64

    def meaning(self, text: str) -> int | None:
        """Return the place."""
        return self.places.get(text)


def hidden_letter_warnings(table: TextTable, columns: Sequence[str]) -> list[str]:
    """Return a warning for each name from which invisible characters were removed."""
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
    """Return a key shared by names that differ only in case or spacing, and so are one player's.

    >>> same_name("Ann Lee") == same_name("ann  LEE") == same_name("AnnLee")
    True
    """
    return folded(clean_name(name))


class PlayerNames:
    """The players named in some of a table's columns.

    Names that differ only in case or spacing belong to one player. The spelling in `means` is used,
    or else the most frequent one. `players` are the resolved names, sorted; `places` has each
    string's place among them.
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
        """Return the spelling to use for names that differ only in case or spacing."""
        counts: Counter[str] = Counter()
        for text, count in rows.items():
            counts[self._unaliased(text)] += count
        return usual_spellings(counts, set(self._means.values()))

    def read(self, table: TextTable, name: str) -> Values:
        """Read a column of names, as places in `players`."""
        return PlayerPlace(places=self.places).read(table, name)

    def read_side(self, table: TextTable, name: str, a: Values, b: Values) -> Values:
        """Read a column that names one of the two players, as a, b or by name, as 1 or 2.

        A player may be called A or B: an exact name takes precedence over the letter. Case is
        ignored in names.
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
        """Return the names that differ in case or spacing from the name they are read as."""
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
        """Return the names that mean another name, each with that name."""
        clean = sorted({clean_name(text) for text in self._written})
        return {name: meant for name in clean if (meant := self._alias_of(name))}

    def _alias_of(self, text: str) -> str:
        """Return the name that an alias stands for; '' if the string isn't an alias.

        An exact alias takes precedence over one that differs in case or spacing.
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
    r"""Return whether a clean name can be printed: not empty, not too long, no control characters.

    >>> is_name("Zoë"), is_name("Bo\x07"), is_name("")
    (True, False, False)
    """
    return 0 < len(name) <= LONGEST_NAME and (
        name.isprintable() or not any(unicodedata.category(letter) == "Cc" for letter in name)
    )


MOST_HINTS = 3


class KnownNames:
    """A league's names, and each name's place.

    Case and spacing are ignored unless that would be ambiguous.

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
        """Return a name's place in the list, or None if it is unknown or ambiguous."""
        same = [name] if name in self._exact else self._same.get(same_name(name), [])
        return self._exact[same[0]] if len(same) == 1 else None

    def nearest(self, name: str) -> str | None:
        """Return the name closest to one that wasn't found; None if none is close."""
        return next(iter(self._near(name.casefold())), None)

    def hint(self, name: str) -> str:
        """Return a hint about the names that may have been meant, '' if there are none."""
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
