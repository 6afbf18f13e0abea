"""The rules that every handicap system must follow, tried on a small league."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from evenbreak.arrays import Floats
from evenbreak.handicaps.charts.level_chart import LevelChart
from evenbreak.handicaps.systems.history import Entries, History, Matches
from evenbreak.handicaps.systems.system import System, checked_races, checked_ratings, updated
from evenbreak.plugins import broken_of
from evenbreak.ratings.scale import SCALES

_PLAYERS, _REPLICAS, _NIGHTS = 8, 3, 5


def broken_laws(system: System, *, seed: int = 1) -> list[str]:
    """Return the rules that a system breaks, in sentences; empty if it breaks none.

    These rules are checked: ratings are finite and races are whole games; a pair's races are the
    same seen from either side; a night doesn't change its input; stored sums, the order of players,
    and replicas side by side change nothing; a winner never falls, if the system says so; and the
    system can be sent to other processes.

    Parameters
    ----------
    seed
        seed for the league's random draws.

    >>> from evenbreak.handicaps import system_of
    >>> broken_laws(system_of("npl"))
    []
    """
    return broken_of(partial(law, system, np.random.default_rng(seed)) for law in _LAWS)


def entries_for(system: System, rng: np.random.Generator, replicas: int = _REPLICAS) -> Entries:
    """Return a small league's entries for a system, with newcomers among them."""
    shape = _PLAYERS, replicas
    scale = system.scale or SCALES["fargo"]
    ratings = scale.center + scale.points_per_doubling * rng.normal(0.0, 0.7, shape)
    levels = system.chart.levels if isinstance(system.chart, LevelChart) else (2, 3, 4, 5, 6)
    matches = rng.integers(-1, 25, shape)
    return Entries.of(
        np.rint(np.maximum(ratings, 1.0)),
        rng.choice(np.array(levels, dtype=float), shape),
        matches,
        np.where(matches < 0, -1, 7 * matches),
    )


def played_nights(
    system: System, rng: np.random.Generator, *, keep: bool = True, entries: Entries | None = None
) -> Iterator[tuple[History, Floats]]:
    """Yield the history of each night in a small league, and what the system publishes after it."""
    entries = entries_for(system, rng) if entries is None else entries
    shape = entries.rating.shape
    initial = checked_ratings(system, system.initial(entries), shape, "initial")
    ratings, columns, kept = initial, [[] for _ in range(11)], {}  # type: ignore[var-annotated]
    for night in range(1, _NIGHTS + 1):
        for pair in rng.permutation(len(initial)).reshape(-1, 2)[:3]:
            for column, values in zip(
                columns, _match(system, night, pair, ratings, rng), strict=True
            ):
                column.append(values)
        arrays = [np.array(column) for column in columns]
        for array in (*arrays, ratings, initial):
            array.flags.writeable = False
        history = History(
            entries, initial, ratings, night, Matches(*arrays), kept=kept if keep else {}
        )
        ratings = updated(system, history)
        yield history, ratings


def _match(
    system: System, night: int, pair: Any, ratings: Floats, rng: np.random.Generator
) -> tuple[Any, ...]:
    replicas = ratings.shape[1]
    a, b = np.where(rng.random(replicas) < 0.1, -1, pair[:, None])
    of_a, of_b = (ratings[np.maximum(who, 0), np.arange(replicas)] for who in (a, b))
    race_a, race_b = checked_races(system, of_a, of_b)
    won = rng.random(replicas) < 0.5
    score_a = np.where(won, race_a, rng.integers(0, race_a))
    score_b = np.where(won, rng.integers(0, race_b), race_b)
    innings = [3 * (score_a + score_b) + rng.integers(0, 9, replicas) for _ in range(2)]
    return (night, a, b, score_a, score_b, race_a, race_b, of_a, of_b, *innings)


# Each law yields what is wrong.


def _it_is_a_system(system: System, rng: np.random.Generator) -> Iterator[str]:  # noqa: ARG001
    if pickle.loads(pickle.dumps(system)).name != system.name:  # noqa: S301
        yield f"the system {system.name} changes when sent to another process"


def _races_are_turned_round(system: System, rng: np.random.Generator) -> Iterator[str]:
    ratings = np.concatenate([now for _, now in played_nights(system, rng)]).ravel()
    a, b = ratings, rng.permutation(ratings)
    m, n = checked_races(system, a, b)
    turned_n, turned_m = checked_races(system, b, a)
    if (m != turned_m).any() or (n != turned_n).any():
        place = int(np.flatnonzero((m != turned_m) | (n != turned_n))[0])
        yield (
            f"in the system {system.name}, the race is {m[place]}:{n[place]} for {a[place]:g} and "
            f"{b[place]:g}, but {turned_n[place]}:{turned_m[place]} for {b[place]:g} and "
            f"{a[place]:g}. It must be the same race either way."
        )


def _same(system: System, one: Floats, other: Floats, what: str) -> Iterator[str]:
    if not np.allclose(one, other, rtol=0.0, atol=1e-6):
        off = float(np.abs(one - other).max())
        yield f"in the system {system.name}, update differs by {off:.3g} {what}"


def _nothing_kept_changes_nothing(system: System, rng: np.random.Generator) -> Iterator[str]:
    for history, ratings in played_nights(system, rng):
        anew = updated(system, replace(history, kept={}))
        yield from _same(system, ratings, anew, "if nothing is kept from earlier nights")


def _order_of_players(system: System, rng: np.random.Generator) -> Iterator[str]:
    order = rng.permutation(_PLAYERS)
    place = np.append(np.argsort(order), -1)  # of each player in the new order; nobody stays so
    for history, ratings in played_nights(system, rng):
        matches = history.matches
        other = History(
            Entries(*(values[order] for values in vars(history.entries).values())),
            history.initial[order],
            history.ratings[order],
            history.night,
            replace(matches, a=place[matches.a], b=place[matches.b]),
        )
        yield from _same(
            system,
            ratings[order],
            updated(system, other),
            "if the players are in a different order",
        )


def _replicas_apart(system: System, rng: np.random.Generator) -> Iterator[str]:
    for history, ratings in played_nights(system, rng):
        alone = updated(system, replace(history.one(1), kept={}))
        yield from _same(system, ratings[:, 1], alone, "if a league is simulated alone")


def _winners_never_fall(system: System, rng: np.random.Generator) -> Iterator[str]:
    if not system.winner_never_falls:
        return
    for history, ratings in played_nights(system, rng):
        lost = np.zeros(ratings.shape, dtype=bool)
        night = history.tonight
        for row in range(len(night)):
            loser = np.where(night.won_a[row], night.b[row], night.a[row])
            there = np.flatnonzero(night.played[row])
            lost[loser[there], there] = True
        fell = (ratings < history.ratings - 1e-9) & ~lost
        if fell.any():
            yield (
                f"in the system {system.name}, someone's rating fell on a night when they "
                "didn't lose a match"
            )


_LAWS: tuple[Callable[[System, np.random.Generator], Iterator[str]], ...] = (
    _it_is_a_system,
    _races_are_turned_round,
    _nothing_kept_changes_nothing,
    _order_of_players,
    _replicas_apart,
    _winners_never_fall,
)
