"""Titles for a match's two sides: which is which, and titles that appear twice, once per side."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cache
from typing import NamedTuple

from evenbreak.files.tables.titles import PLAYERS, SIDES, key_of, keys_of, marks

_PART = re.compile(r"[^\W\d_]+|\d+")

_REPEATED = re.compile(r"(.+?)[._]1")
"""How programs write a title that already exists: SL, SL.1."""


def order_of(one: str, other: str) -> int:
    """Return 1 if two similar titles name the first side and the second, -1 if reversed, else 0.

    >>> order_of("Tore H", "Tore G"), order_of("Gastpunkte", "Heimpunkte"), order_of("A", "S B")
    (1, -1, 0)
    """
    return _side(*_unlike(one, other))


def _unlike(one: str, other: str) -> tuple[str, str]:
    """Return keys for where two similar titles differ; nothing if they aren't similar."""
    parts = [*map(key_of, _PART.findall(one))], [*map(key_of, _PART.findall(other))]
    if len(parts[0]) == len(parts[1]):
        unlike = [(a, b) for a, b in zip(*parts, strict=True) if a != b]
        if len(unlike) == 1:
            return _ends(*unlike[0])
    left = [[part for part in own if part not in theirs] for own, theirs in (parts, parts[::-1])]
    return ("".join(left[0]), "".join(left[1])) if all(map(len, left)) else ("", "")


def _side(one: str, other: str) -> int:
    return ((one, other) in marks()) - ((other, one) in marks())


def _ends(one: str, other: str) -> tuple[str, str]:
    """Return the differing parts of two words that share one word before or after.

    >>> _ends("heimpunkte", "gastpunkte"), _ends("heim", "gast")
    (('heim', 'gast'), ('heim', 'gast'))
    """
    for first, second in sorted(marks(), key=lambda pair: -len(pair[0])):
        for a, b in ((first, second), (second, first)):
            if len(min(a, b, key=len)) < 3:
                continue
            if one.startswith(a) and other.startswith(b) and one[len(a) :] == other[len(b) :]:
                return a, b
            if one.endswith(a) and other.endswith(b) and one[: -len(a)] == other[: -len(b)]:
                return a, b
    return one, other


def told_apart(titles: Sequence[str]) -> list[str]:
    """Return titles with the side added to those that appear twice, once per side.

    A title belongs to the side of the player or team it follows; if the first comes before either,
    each belongs to the side that comes next.

    >>> told_apart(["Home Player", "SL", "Wins", "Away Player", "SL", "Wins", "Innings"])
    ['Home Player', 'Home SL', 'Home Wins', 'Away Player', 'Away SL', 'Away Wins', 'Innings']
    >>> told_apart(["Race", "Player 1", "Race", "Player 2"]), told_apart(["Player", "SL"] * 2)
    (['Race 1', 'Player 1', 'Race 2', 'Player 2'], ['Player A', 'SL A', 'Player B', 'SL B'])
    """
    plain = [_first_writing(title, titles[:k]) for k, title in enumerate(titles)]
    keys = [*map(key_of, plain)]
    places = defaultdict(list)
    for place, key in enumerate(keys):
        places[key].append(place)
    twice = [both for key, both in places.items() if key and len(both) == 2]
    if not twice:
        return [*titles]
    marked = {place: mark for place, key in enumerate(keys) if (mark := _mark(key)) is not None}
    if not marked:
        names = next((both for both in twice if keys[both[0]] in PLAYERS), ())
        marked = {place: _Mark(side, "AB"[side]) for side, place in enumerate(names)}
    for both in twice:
        for place, mark in zip(both, _marks_of(both, marked), strict=False):
            plain[place] = mark.on(plain[place])
    return [
        title if plain[place] == _first_writing(title, titles[:place]) else plain[place]
        for place, title in enumerate(titles)
    ]


class _Mark(NamedTuple):
    """What names a side in a title."""

    side: int
    word: str
    first: bool = False

    def on(self, title: str) -> str:
        title = title.strip()
        return f"{self.word} {title}" if self.first else f"{title} {self.word}"


def _first_writing(title: str, before: Sequence[str]) -> str:
    """Return a title without the number that a program added to tell it from an earlier one."""
    again = _REPEATED.fullmatch(title.strip())
    return again[1] if again and again[1] in map(str.strip, before) else title


def _marks_of(both: Sequence[int], marked: Mapping[int, _Mark]) -> Sequence[_Mark]:
    """Return the marks for two columns with the same title; none if the order is ambiguous."""
    if not {*both}.isdisjoint(marked):
        return [marked[place] for place in both] if {*both} <= marked.keys() else ()
    before = [max((p for p in marked if p < place), default=None) for place in both]
    after = [min((p for p in marked if p > place), default=None) for place in both]
    for ends in (before, after):
        marks_there = [marked[place] for place in ends if place is not None]
        if len({mark.side for mark in marks_there}) == 2:
            return marks_there
    sides = [*{mark.side: mark for _, mark in sorted(marked.items())}.values()]
    side_by_side = both[1] == both[0] + 1 and max(marked, default=both[1]) < both[0]
    return sides if side_by_side and len(sides) == 2 else ()


@cache
def _mark(key: str) -> _Mark | None:
    """Return the part of a player or team title that names the side, by its key.

    >>> _mark("homeplayer"), _mark("player2").on("Race"), _mark("home sl")
    (_Mark(side=0, word='Home', first=True), 'Race 2', None)
    """
    for side in (0, 1):
        if any(key in keys_of(f"{what}_{'ab'[side]}") for what in ("player", "team")):
            words = [word for of in SIDES.values() for word in of[side].split(", ")]
            for word in sorted(words, key=len, reverse=True):
                if key.startswith(key_of(word)) or key.endswith(key_of(word)):
                    return _Mark(side, word[0].upper() + word[1:], key.startswith(key_of(word)))
            return _Mark(side, key[-1].upper()) if key[-1] in "ab12" else None
    return None
