"""When a tournament ends, when each match starts, and which match to call next."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import NamedTuple

import numpy as np

from evenbreak.arrays import Floats, own_arrays
from evenbreak.checks import floats, number, whole
from evenbreak.errors import InputError
from evenbreak.matches.pace import Pace, Turnover
from evenbreak.tournaments.brackets.bracket import Bracket
from evenbreak.tournaments.brackets.standing import Results, Standing, standing
from evenbreak.tournaments.clock.evenings import (
    Evenings,
    InPlay,
    play_evenings,
)
from evenbreak.tournaments.clock.event_pace import Timed, learned_pace
from evenbreak.tournaments.clock.table_schedule import (
    Schedule,
    Waiting,
    longest_paths,
    schedule,
    waiting,
)
from evenbreak.tournaments.odds.races import PairOdds

QUANTILES = (0.1, 0.5, 0.9)
_TRIED, _FEWEST_TRIED = 500, 60  # evenings on which each call is tried; fewer of large brackets
_CALLS = 12  # calls that are tried
_CHOSEN = 4  # free tables for which they are tried one after another
_WORK = 7e7  # what trying them may cost: calls x evenings x matches x matches


class Start(NamedTuple):
    """When a match starts, in minutes: it has started by then in 10, 50 and 90 of 100 evenings.

    Parameters
    ----------
    p10, p50, p90
        given that the match is played.
    """

    p10: float
    p50: float
    p90: float
    p_played: float


class Call(NamedTuple):
    """A match that could be called next; NaN if it wasn't tried because there are many.

    Parameters
    ----------
    finish_mean
        the mean end of the evening, if this match is called next.
    later
        how many minutes later that is than with the best call, on average.
    error
        the standard error of `later`.
    """

    match: str
    finish_mean: float
    later: float
    error: float


def bands_of(finishes: Floats) -> tuple[tuple[float, float, float], float]:
    """Return the times by which 10, 50 and 90 of 100 evenings end, and the largest standard error.

    The error treats the evenings as independent. Because their luck is spread evenly (a Latin
    hypercube), this is an upper bound.
    """
    early, middle, late = np.quantile(finishes, QUANTILES).tolist()
    q = np.array(QUANTILES)
    off = np.sqrt(q * (1.0 - q) / len(finishes))
    above, below = (np.quantile(finishes, q + side) for side in (off, -off))
    return (early, middle, late), float((above - below).max() / 2.0)


@own_arrays
@dataclass(frozen=True, eq=False)
class Finish:
    """When a tournament ends; times are minutes since its first start.

    Parameters
    ----------
    finishes
        when each simulated evening ends.
    starts
        when each match starts on each evening, one column per match; NaN where it isn't needed.
    names
        the matches still to be played, as in the columns of `starts`.
    pace
        this evening's pace.
    standing
        the tournament's current state.
    room
        the tables, what is on them, and the evenings played on them.
    """

    finishes: Floats
    starts: Floats
    names: tuple[str, ...]
    pace: Pace
    standing: Standing
    room: Room

    @classmethod
    def planned(cls, room: Room, pace: Pace, where: Standing) -> Finish:
        """Return when it ends if matches with the longest remaining path go first."""
        plan, names = room.planned(), room.evenings.names
        starts = np.where(room.evenings.needed, plan.start, np.nan)
        for match in room.playing:
            starts[:, names.index(match.match)] = match.started
        return cls(room.ends(plan), starts, names, pace, where, room)

    def finish(self, q: float) -> float:
        """Return the time by which the tournament has ended with probability q."""
        return float(np.quantile(self.finishes, number(q, "q", low=0.0, high=1.0)))

    @property
    def bands(self) -> tuple[float, float, float]:
        """The times by which it has ended in 10, 50 and 90 of 100 evenings."""
        return bands_of(self.finishes)[0]

    @property
    def error(self) -> float:
        """The largest standard error of the `bands`; see `bands_of`."""
        return bands_of(self.finishes)[1]

    def start(self, match: str) -> Start:
        """Return when a match starts."""
        if match not in self.names:
            raise InputError(
                "match must be one that hasn't started; you gave {match!r}", match=match
            )
        times = self.starts[:, self.names.index(match)]
        return _start(times[~np.isnan(times)], times.size)

    def next_start(self, player: str) -> Start:
        """Return when a player's next match starts, whichever it is."""
        seat = self.standing.bracket.player(player)
        evenings = self.room.evenings
        mine = evenings.needed & ((evenings.first == seat) | (evenings.second == seat))
        mine[:, [k for k, name in enumerate(self.names) if name in self.room.on_tables]] = False
        times = np.where(mine, self.starts, np.inf).min(axis=1, initial=np.inf)
        return _start(times[np.isfinite(times)], times.size)

    def if_won(self, match: str) -> tuple[float, float]:
        """Return when the evening ends on average, given which slot's player wins a match."""
        evenings = self.room.evenings
        k = self.names.index(match)
        won, played = evenings.first_won[:, k], evenings.needed[:, k]
        means = [
            float(self.finishes[played & side].mean()) if (played & side).any() else np.nan
            for side in (won, ~won)
        ]
        return means[0], means[1]

    def after_calls(self, names: Sequence[str]) -> Finish:
        """Return when it ends and when each match starts if some matches are called now."""
        if not names:
            return self
        room = self.room
        planned = room.planned(names)
        starts = np.where(room.evenings.needed, planned.start, np.nan)
        for match in room.playing:
            starts[:, self.names.index(match.match)] = match.started
        return replace(self, finishes=room.ends(planned), starts=starts)

    def calls(self, tables: int = 1, ready: Sequence[str] | None = None) -> list[Call]:
        """Return the matches that can be called next, soonest finish first.

        All are tried on the same evenings, a subset of the simulated ones, so small differences are
        real. If there are many matches, those with the longest remaining paths are tried; the
        others follow in that order, with NaN for numbers that weren't calculated.

        Parameters
        ----------
        tables
            how many are free: the second match is the best one given that the first is on a table,
            and so on.
        ready
            the matches that can be called; None: the tournament's.
        """
        if ready is None:
            ready = [name for name in self.standing.to_play if name not in self.room.on_tables]
        tried, untried = self._most_urgent(ready)
        chosen: list[Call] = []
        last = min(tables, _CHOSEN, len(tried))
        for k in range(last):
            called = [call.match for call in chosen]
            left = [name for name in tried if name not in called]
            ranked = self._ranked(left, called, last)
            chosen += ranked if k == last - 1 else ranked[:1]
        return chosen + [Call(name, np.nan, np.nan, np.nan) for name in untried]

    def _ranked(self, tried: Sequence[str], called: Sequence[str], times: int) -> list[Call]:
        """Return matches to call after some others, soonest finish first.

        It is called `times` times, so each call gets only a share of the work.
        """
        runs = int(_WORK / (times * len(tried) * len(self.names) ** 2))
        room = self.room.on_the_first(min(_TRIED, max(_FEWEST_TRIED, runs)))
        ends = {name: room.ends(room.planned([*called, name])) for name in tried}
        best = min(ends, key=lambda name: float(ends[name].mean()))
        calls = []
        for name, end in ends.items():
            if np.isinf(end).any():  # it has to wait for its round
                calls.append(Call(name, np.inf, np.inf, 0.0))
                continue
            later = end - ends[best]
            error = float(later.std() / np.sqrt(len(later)))
            calls.append(Call(name, float(end.mean()), float(later.mean()), error))
        return sorted(calls, key=lambda call: call.later)

    def _most_urgent(self, ready: Sequence[str]) -> tuple[list[str], list[str]]:
        """Return the matches to try calling, and the others, most important first."""
        if len(ready) <= _CALLS:
            return list(ready), []
        evenings = self.room.evenings
        minutes = np.where(evenings.needed, evenings.minutes, 0.0).mean(axis=0)
        path = longest_paths(self.room.waits, minutes)
        order = sorted(ready, key=lambda name: -path[self.names.index(name)])
        return order[:_CALLS], order[_CALLS:]


@dataclass(frozen=True, eq=False)
class Room:
    """The tables, what is on them, and the evenings played on them."""

    evenings: Evenings
    waits: Waiting
    tables: Floats
    now: float
    playing: tuple[InPlay, ...]

    def on_the_first(self, runs: int) -> Room:
        """Return the same with only the first few evenings."""
        evenings = self.evenings
        cells = (getattr(evenings, one.name)[:runs] for one in fields(evenings)[1:])
        return replace(self, evenings=Evenings(evenings.names, *cells))

    @property
    def on_tables(self) -> tuple[str, ...]:
        """The matches in progress."""
        return tuple(match.match for match in self.playing)

    def planned(self, first: Sequence[str] = ()) -> Schedule:
        """Return the schedule, with some matches called first."""
        evenings = self.evenings
        runs = len(evenings.minutes)
        return schedule(
            self.waits,
            evenings.minutes,
            evenings.needed,
            evenings.turnover,
            np.tile(self.tables, (runs, 1)),
            now=self.now,
            first=[evenings.names.index(name) for name in first],
            under_way=[evenings.names.index(name) for name in self.on_tables],
        )

    def ends(self, planned: Schedule) -> Floats:
        """Return when each evening ends."""
        return np.asarray(
            np.where(self.evenings.needed, planned.end, self.now).max(axis=1, initial=self.now)
        )


def finish(
    bracket: Bracket,
    laws: Mapping[str, PairOdds],
    *,
    tables: int | Sequence[float],
    pace: Pace | str = "9-ball",
    turnover: Turnover | None = None,
    wait_for_rounds: bool = True,
    results: Results | None = None,
    played: Sequence[Timed] = (),
    playing: Sequence[InPlay] = (),
    now: float = 0.0,
    runs: int = 2000,
    seed: int = 0,
) -> Finish:
    """Return when a tournament ends and when each match starts.

    Whenever a table is free, the match with the longest remaining path starts on it.

    Parameters
    ----------
    laws
        who wins each match and in how many games, as from `pair_odds`.
    tables
        their number, or when each is free, in minutes since the first start. Tables with matches in
        progress are included.
    pace
        a discipline, calibrated to whole events, or a `Pace`.
    turnover
        the time between two matches on a table when both players are free; None: 0 in 62 of 100
        cases, as in real events, and otherwise the usual time.
    wait_for_rounds
        whether a round starts only when the rounds that feed it are over, as on most evenings; a
        discipline's pace is calibrated for that.
    played
        the games and minutes of the matches played so far, which show this evening's pace.
    now
        in minutes since the first start.
    runs, seed
        for the simulated evenings: with the same seed, a changed evening gets the same luck.

    Raises
    ------
    InputError
        if a parameter is invalid.

    >>> from evenbreak.tournaments import double_elimination, pair_odds
    >>> bracket = double_elimination(8)
    >>> laws = pair_odds(bracket, [500] * 8, 5)
    >>> four, two = (finish(bracket, laws, tables=tables).bands for tables in (4, 2))
    >>> four[0] < four[1] < four[2] < two[1]
    True
    """
    where = standing(bracket, results)
    if where.assumed:
        name = next(iter(where.assumed))
        raise InputError(
            "{results} has {name!r}. Give results of matches whose players are known.", name=name
        )
    clock = number(now, "now", low=0.0)
    speed = learned_pace(pace, played)
    evenings = play_evenings(
        where,
        laws,
        speed,
        turnover,
        playing=playing,
        clock=clock,
        runs=whole(runs, "runs", at_least=10),
        seed=seed,
    )
    waits = waiting(bracket, evenings.names, for_rounds=wait_for_rounds)
    room = Room(evenings, waits, tables_free(tables, clock, len(playing)), clock, tuple(playing))
    return Finish.planned(room, speed, where)


def minutes_later(one: Finish, other: Finish) -> tuple[float, float]:
    """Return how many minutes later one evening ends than the other, and its standard error.

    Both must come from the same seed and runs: then they share their luck.

    Raises
    ------
    InputError
        if they were simulated different numbers of times.
    """
    if one.finishes.shape != other.finishes.shape:
        raise InputError(
            "the two finish times come from different numbers of runs. Use the same number of "
            "runs for both."
        )
    later = one.finishes - other.finishes
    return float(later.mean()), float(later.std() / np.sqrt(len(later)))


def _start(times: Floats, runs: int) -> Start:
    if not times.size:
        return Start(np.nan, np.nan, np.nan, 0.0)
    early, middle, late = np.quantile(times, QUANTILES).tolist()
    return Start(early, middle, late, times.size / runs)


def tables_free(tables: int | Sequence[float], clock: float, busy: int) -> Floats:
    """Return when each table becomes free, starting with those of matches in progress."""
    if isinstance(tables, Sequence):
        free = np.sort(floats(tables, "tables", low=0.0))
    else:
        free = np.zeros(whole(tables, "tables", at_least=1))
    if len(free) < max(busy, 1):
        raise InputError(
            "{tables} is {value!r}, but {busy} matches are under way. Give more tables.",
            value=tables,
            busy=busy,
        )
    return np.maximum(free, clock)
