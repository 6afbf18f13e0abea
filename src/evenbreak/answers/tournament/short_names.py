"""Names shortened to fit, never cut off, and never the same for two players."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable
from functools import lru_cache

_NICKNAME = re.compile(r"\s*[\"“„'‘(][^\"”“'’)]*[\"”“'’)]\s*")
_WIDTHS = (("ijl.,;:'|!I()[]’“”\" ", 0.36), ("frt-/", 0.43), ("mwMW@%", 0.98))
_CAPITAL, _SMALL, _DIGIT, _IDEOGRAPH, _BOLD = 0.71, 0.61, 0.64, 1.05, 1.12


@lru_cache(maxsize=4096)
def rough_width(text: str, bold: bool = False) -> float:
    """Return a string's maximum width in a page's font, in units of the font size.

    Pages use the reader's own font, so this assumes a wide one.

    >>> 2.5 < rough_width("Ann Lee") < rough_width("Ann Lee", bold=True) < 5.0
    True
    """
    wide = sum(_letter(one) for one in text)
    return wide * _BOLD if bold else wide


@lru_cache(maxsize=1024)
def _letter(letter: str) -> float:
    plain = unicodedata.normalize("NFD", letter)[0]
    for letters, width in _WIDTHS:
        if plain in letters:
            return width
    if unicodedata.east_asian_width(letter) in "WF":
        return _IDEOGRAPH
    if plain.isdigit():
        return _DIGIT
    return _CAPITAL if plain.isupper() else _SMALL


def short_names(names: Iterable[str], fits: Callable[[str], bool]) -> dict[str, str]:
    """Return what to write for each name: its longest form that fits, or else the shortest.

    The forms are the full name; "R. Dubois-Lachapelle"; "R. Dubois-L.". A form that another player
    could share gets more letters of the first name; a one-word name has no shorter form.
    """
    distinct = list(dict.fromkeys(names))
    if all(map(fits, distinct)):
        return {name: name for name in distinct}
    levels = [_told_apart(distinct, shorten) for shorten in (_initial, _both)]
    written = {}
    for name in distinct:
        forms = [name, *(level[name] for level in levels)]
        written[name] = next(filter(fits, forms), min(forms, key=len))
    return written


def first_name(name: str, everybody: Iterable[str]) -> str:
    """Return a player's first name; the full name if the first is shared or may not be one.

    >>> names = ["Frank Russo", "Big Tony", "Li Wei"]
    >>> [first_name(name, names) for name in names]
    ['Frank', 'Big Tony', 'Li Wei']
    """
    first = name.split()[0]
    others = (one.split()[0].casefold() for one in everybody if one != name)
    return name if len(first) < 4 or first.casefold() in others else first


def _told_apart(names: list[str], shorten: Callable[[str, int], str]) -> dict[str, str]:
    """Return a short form of each name that no one else has as a name or short form."""
    found = {name: shorten(name, 1) for name in names}
    for letters in range(2, 13):
        taken = Counter(found.values())
        taken.update(name for name in names if found[name] != name)
        again = [name for name, form in found.items() if taken[form] > 1 and form != name]
        if not again:
            return found
        found |= {name: shorten(name, letters) for name in again}
    taken = Counter(found.values())
    return {name: form if taken[form] == 1 else name for name, form in found.items()}


def _initial(name: str, letters: int) -> str:
    """Return the first name's initial, or more of its letters, and the last name."""
    first, _, rest = _NICKNAME.sub(" ", name).strip().partition(" ")
    parts = [part for part in first.split("-") if part]
    if not rest or not all(part[0].isalpha() for part in parts):
        return name
    short = "-".join(part if len(part) <= letters else f"{part[:letters]}." for part in parts)
    return f"{short} {rest}"


def _both(name: str, letters: int) -> str:
    """Return the same with the last name shortened too, keeping its first word or part."""
    first, _, rest = _initial(name, letters).partition(" ")
    if not rest:
        return name
    *before, last = rest.split(" ")
    stem, *more = last.split("-")
    short = [f"{part[0]}." for part in more if part]
    middle = [word if word.islower() else f"{word[0]}." for word in before if word]
    return " ".join([first, *middle, "-".join([stem, *short])])
