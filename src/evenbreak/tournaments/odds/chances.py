"""Each match's chances, as tables: P(i beats j) for every two players."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from evenbreak.arrays import Floats
from evenbreak.checks import floats, number_probability
from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.brackets.standing import Standing


@runtime_checkable
class HasWin(Protocol):
    """Anything with a table `win`: win[i, j] = P(i beats j)."""

    @property
    def win(self) -> Floats:
        """The chance of each player against each other player."""
        ...


Win: TypeAlias = ArrayLike | Callable[[str, str], float] | HasWin
"""P(i beats j) for every two players: a table, or a function of two names."""

Wins: TypeAlias = Win | Mapping[str, Win]
"""One for all matches, or a mapping with one per match, by match name."""


@dataclass(frozen=True, eq=False)
class Chances:
    """P(slot 1's player wins) for each match and every two players.

    Tables have one extra row and column for an empty slot, against which everyone wins. A third
    axis, if any, runs over samples.
    """

    tables: Mapping[str, Floats]

    def of(self, match: str) -> Floats:
        """Return a match's table."""
        return self.tables[match]

    def each(self, match: str, first: NDArray[np.integer], second: NDArray[np.integer]) -> Floats:
        """Return the chance of slot 1's player in each sample, given who plays in it.

        The samples are the last axis of `first` and `second`.
        """
        return of_samples(self.of(match), first, second)


def of_samples(table: Floats, first: NDArray[np.integer], second: NDArray[np.integer]) -> Floats:
    """Return entries of a table; if it has a third axis, each sample's entry."""
    if table.ndim == 2:
        found: Floats = table[first, second]
    else:
        found = table[first, second, np.arange(table.shape[2])]
    return found


def chances_of(
    now: Standing,
    win: Wins,
    *,
    live: Mapping[str, float] | None = None,
    walkovers: float | Mapping[str, float] = 0.0,
) -> Chances:
    """Return all undecided matches' tables.

    `win` is P(i beats j) in the bracket's order, shape (n, n), or a function of two names, or a
    mapping of these by match; `live` is P(the player in slot 1 wins) for matches in play.
    `walkovers` is the chance of a walkover, equally likely either way: one number, or by match.
    Raises InputError if a chance isn't a probability, a pair's two chances don't add up to 1, or a
    match is unknown or has no table.
    """
    bracket, count = now.bracket, len(now.bracket.players)
    known: dict[int, Floats] = {}
    tables: dict[str, Floats] = {}
    keep: list[Any] = []  # so that no id is used twice
    for match in now.remaining.matches:
        given = _given(win, match.name)
        if id(given) not in known:
            keep.append(given)
            known[id(given)] = with_nobody(_table(given, bracket))
        tables[match.name] = known[id(given)]
    _walk_over(bracket, tables, walkovers)
    for name, chance in (live or {}).items():
        p = number_probability(chance, f"live chance of {name}")
        seats = now.seats.get(bracket.match(name).name, (None, None))
        if name in now.winners or None in seats:
            raise InputError(
                "{live} has match {name!r}. Give matches whose players are known.", name=name
            )
        one, other = seats
        table = tables[name].copy()
        table[one, other], table[other, one] = p, 1.0 - p
        tables[name] = table
    for name, won in now.winners.items():
        if name in tables:  # of a group that is not settled
            tables[name] = _decided(won, count)
    return Chances(tables)


def _given(win: Wins, name: str) -> Any:
    if not isinstance(win, Mapping):
        return win
    if name not in win:
        raise InputError(
            "{win} has no chances for match {name!r}. Give chances for every match.", name=name
        )
    return win[name]


def _table(given: Any, bracket: Bracket) -> Floats:
    players = bracket.players
    if not isinstance(given, np.ndarray) and isinstance(given, HasWin):  # of many arrays
        given = given.win
    if callable(given):
        given = [[0.5 if i == j else given(i, j) for j in players] for i in players]
    table = floats(given, "win", low=0.0, high=1.0).copy()
    if table.shape[:2] != (len(players), len(players)) or table.ndim > 3:
        raise InputError(
            "win must have a row and a column for each of {n_players} players; its shape "
            "is {table_shape}",
            table_shape=table.shape,
            n_players=len(players),
        )
    off = np.abs(table + table.swapaxes(0, 1) - 1.0)
    off[np.arange(len(players)), np.arange(len(players))] = 0.0
    if off.max() > 1e-9:
        i, j, *_ = np.unravel_index(off.argmax(), off.shape)
        raise InputError(
            "win[{player}, {player_2}] and win[{player_2}, {player}] don't add up to 1. Give "
            "both players' chances in the same match.",
            player=players[i],
            player_2=players[j],
        )
    return table


def with_nobody(table: Floats) -> Floats:
    """Return chances with an added row and column for no one, whom everyone beats."""
    count = len(table)
    padded = np.ones((count + 1, count + 1, *table.shape[2:]))
    padded[:count, :count] = table
    padded[count, :count] = 0.0
    return padded


def _walk_over(
    bracket: Bracket, tables: dict[str, Floats], walkovers: float | Mapping[str, float]
) -> None:
    made: dict[tuple[int, float], Floats] = {}
    if isinstance(walkovers, Mapping):
        for name in walkovers:
            bracket.match(name)
    for name, table in tables.items():
        share = walkovers.get(name, 0.0) if isinstance(walkovers, Mapping) else walkovers
        if share:
            chance = number_probability(share, "walkovers")
            if (id(table), chance) not in made:
                mixed = table.copy()
                mixed[:-1, :-1] = 0.5 * chance + (1.0 - chance) * table[:-1, :-1]
                made[id(table), chance] = mixed
            tables[name] = made[id(table), chance]


def _decided(won: int, count: int) -> Floats:
    table = np.full((count + 1, count + 1), 0.5)
    table[won, :], table[:, won] = 1.0, 0.0
    return table
