"""The table of races cut into blocks of columns, and each player's races by themselves."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import pandas as pd

from evenbreak.answers.league.sheet import NO_RACE
from evenbreak.sheets.rating_bars import PlayerLine

Races = Mapping[tuple[str, str], str]
"""The race of each two players, from the side of the first."""

_ROOM, _FIGURE, _EDGE = 144.0, 1.5, 2.2
"""Millimetres: for the columns of a printed table, for a figure in it, and around a race."""


class Block(NamedTuple):
    """Columns of the table of races, and each player's races in them; None against oneself."""

    across: Sequence[PlayerLine]
    rows: Sequence[tuple[PlayerLine, Sequence[str | None]]]


class RaceCard(NamedTuple):
    """One player's opponents, each with the race and the player's chance of winning it."""

    player: PlayerLine
    races: Sequence[tuple[PlayerLine, str, str]]


def race_blocks(lines: Sequence[PlayerLine], races: Races, most: int | None = None) -> list[Block]:
    """Return the table of races in blocks of columns, all of nearly one size.

    `most` is how many columns fit; None: as many as fit on a printed web page.
    """
    if most is None:
        widest = max(map(len, races.values()), default=3)
        most = int(_ROOM / (_FIGURE * (widest - 0.5) + _EDGE))  # a colon is half a figure wide
    return [
        Block(
            across,
            [
                (line, [_race(races, line, other) if line != other else None for other in across])
                for line in lines
            ],
        )
        for across in parts_of(lines, most)
    ]


def parts_of(lines: Sequence[PlayerLine], most: int) -> list[Sequence[PlayerLine]]:
    """Return a list cut into parts as equal as can be, of so many lines at most."""
    size = math.ceil(len(lines) / math.ceil(len(lines) / most))
    return [lines[first : first + size] for first in range(0, len(lines), size)]


def _race(races: Races, player: PlayerLine, other: PlayerLine) -> str:
    return races.get((player.name, other.name), NO_RACE)


def race_cards(lines: Sequence[PlayerLine], races: Races, paired: pd.DataFrame) -> list[RaceCard]:
    """Return each player's races, for a page that is too narrow for the table of them."""
    chances: dict[tuple[str, str], str] = {}
    rows: Any = paired.dropna(subset=["race_a"]).itertuples(index=False)
    for pair in rows:
        chances[pair.player_a, pair.player_b] = f"{pair.p_win_a:.2f}"
        chances[pair.player_b, pair.player_a] = f"{1.0 - pair.p_win_a:.2f}"
    return [
        RaceCard(
            line,
            [
                (other, _race(races, line, other), chances.get((line.name, other.name), ""))
                for other in lines
                if other != line
            ],
        )
        for line in lines
    ]
