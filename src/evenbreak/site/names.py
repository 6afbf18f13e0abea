"""A site's name for each player, and the file of their page.

A site is for everyone, so each player may be named in full, by initials or not at all. Names are
replaced before anything is made from the results; no page is ever made from private names.
"""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from evenbreak.errors import DataError
from evenbreak.files.league.values import NAMES, Shown
from evenbreak.files.tables.names import KnownNames, clean_name, same_name
from evenbreak.files.tables.problems import quoted
from evenbreak.ratings.results import Results

_LONGEST = 48  # letters of a file's name
_RESERVED = {"con", "prn", "aux", "nul", *(f"{d}{n}" for d in ("com", "lpt") for n in range(10))}
"""Names that Windows takes for a device, whatever the extension."""


@dataclass(frozen=True)
class PublicNames:
    """A site's names for players: public names by private name.

    `means` has names by other spellings (see `same_name`); `stranger` is how to name a player who
    isn't on any of the league's lists, such as a guest at a tournament.

    >>> names = PublicNames.of(["Ann Lee", "Bo Diaz", "Al Lum"], by_player={"Bo Diaz": "hidden"})
    >>> names["Ann Lee"], names["bo  diaz"]
    ('Ann Lee', 'Player 2')
    """

    names: Mapping[str, str]
    ways: Mapping[str, Shown]
    means: Mapping[str, str]
    stranger: Shown = "full"

    @classmethod
    def of(
        cls,
        players: Iterable[str],
        usual: Shown = "full",
        by_player: Mapping[str, Shown] | None = None,
        *,
        aliases: Mapping[str, str] | None = None,
        where: str = "",
    ) -> PublicNames:
        """Return players' public names, in an order that new players don't change.

        Names that differ only in case or spacing belong to one player; `where` is the location of
        `by_player`, for errors. Raises DataError if one of its names is unknown, because a typo
        would reveal a name that should be hidden.
        """
        others = {same_name(name): meant for name, meant in (aliases or {}).items()}
        means: dict[str, str] = {}
        for name in players:
            means.setdefault(same_name(others.get(same_name(name), name)), name)
        order = [*means.values()]
        for name, meant in others.items():
            means.setdefault(name, means.get(same_name(meant), meant))
        known, chosen, problems = KnownNames(order), {}, []
        for name, way in (by_player or {}).items():
            place = known.place(means.get(same_name(clean_name(name)), clean_name(name)))
            if place is None:
                problems.append(
                    f"{where or 'names'}: {quoted(name)} isn't a player in this "
                    f"league{known.hint(clean_name(name))}. Write the name as it is in the results."
                )
            else:
                chosen[order[place]] = way
        if problems:
            raise DataError(problems)
        ways = {name: chosen.get(name, usual) for name in order}
        names: dict[str, str] = {}
        taken = {name.casefold() for name, way in ways.items() if way == "full"}
        for number, (name, way) in enumerate(ways.items(), 1):
            names[name] = name if way == "full" else _unlike(_short(name, way, number), taken)
        strictest = max((usual, *chosen.values()), key=[*NAMES.of].index)
        return cls(names, ways, means, strictest)

    def __getitem__(self, name: str) -> str:
        """Return a player's public name; a stranger is named by the strictest rule."""
        meant = name if name in self.names else self.means.get(same_name(clean_name(name)), "")
        if meant in self.names:
            return self.names[meant]
        return name if self.stranger == "full" else _short(name, self.stranger, 0)

    @property
    def private(self) -> bool:
        """Whether anyone isn't named in full."""
        return any(way != "full" for way in self.ways.values())

    @property
    def hidden(self) -> set[str]:
        """The public names of players who aren't named at all: they have no page."""
        return {self.names[name] for name, way in self.ways.items() if way == "hidden"}

    def results(self, results: Results) -> Results:
        """Return results with everyone's public name, and no other text."""
        public = tuple(self[name] for name in results.players)
        return replace(results, players=public, event=None)


def by_appearance(results: Results) -> list[str]:
    """Return the results' players in the order of their first match.

    >>> by_appearance(Results.from_names(["Zoe", "Ann"], ["Bo", "Zoe"], [7, 7], [5, 4]))
    ['Zoe', 'Bo', 'Ann']
    """
    rows = np.arange(len(results))
    if results.date is not None:
        rows = rows[np.argsort(results.date, kind="stable")]
    seats = np.stack([results.player_a[rows], results.player_b[rows]], axis=1).ravel().tolist()
    return [results.players[k] for k in dict.fromkeys([*seats, *range(len(results.players))])]


def _short(name: str, way: Shown, number: int) -> str:
    if way == "hidden":
        return f"Player {number}" if number else "A guest"
    words = [word for part in name.split() if (word := re.sub(r"^\W+", "", part))]
    ends = words[:1] + words[1:][-1:]
    return " ".join(f"{word[0].upper()}." for word in ends) or "N. N."


def _unlike(name: str, taken: set[str]) -> str:
    """Return an unused name, and mark it as used."""
    tried, number = name, 1
    while tried.casefold() in taken:
        number += 1
        tried = f"{name} ({number})"
    taken.add(tried.casefold())
    return tried


def file_names(players: Iterable[str]) -> dict[str, str]:
    """Return a file name, without extension, for each public name; each is safe and distinct.

    A player keeps it as long as the players before them stay the same.

    >>> file_names(["Nguyễn Văn An", "../etc", "Ann/Lee", "ann lee", "李小龙", "Con"]).values()
    dict_values(['nguyen-van-an', 'etc', 'ann-lee', 'ann-lee-e49591', 'p-535320', 'con-3b6f52'])
    """
    found: dict[str, str] = {}
    for player in players:
        plain = _plain(player)
        if not plain or plain in _RESERVED or plain in found.values():
            digest = hashlib.sha256(player.encode()).hexdigest()[:6]
            plain = f"{plain or 'p'}-{digest}"
        found[player] = _unlike(plain, set(found.values())).replace(" (", "-").rstrip(")")
    return found


def _plain(name: str) -> str:
    return "-".join(_words(name))[:_LONGEST].strip("-")


def _words(name: str) -> Iterator[str]:
    letters = name.translate(_LETTERS)
    ascii_only = unicodedata.normalize("NFKD", letters).encode("ascii", "ignore").decode()
    yield from re.findall(r"[a-z0-9]+", ascii_only.lower())


_LETTERS = str.maketrans("øØłŁđĐ", "oOlLdD")
"""Letters that can't be decomposed."""
