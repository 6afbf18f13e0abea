"""A season from its files, night by night, and what was found against whom."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from evenbreak.answers.night_results import moves_of_files
from evenbreak.errors import DataError, InputError
from evenbreak.files.results import ResultsFile
from evenbreak.files.roster import RosterFile
from evenbreak.handicaps.charts.chart import Chart
from evenbreak.handicaps.systems.rating_changes import Moves
from evenbreak.handicaps.systems.system import System
from evenbreak.league.nights import Night, played_nights
from evenbreak.league.watch import Watched
from evenbreak.ratings.results import Results
from evenbreak.ratings.roster import Roster


class WatchRow(NamedTuple):
    """A player's line: matches, what they weigh, and when the alarm was raised.

    Parameters
    ----------
    player, matches, won
        who played how many matches and won how many.
    e_value, largest_e
        the evidence after the last match, and its largest value after any.
    p_value
        the smallest alpha at which he would have been flagged.
    e_any, e_established
        the evidence after the last match against the honest of each kind.
    flagged
        whether the alarm was raised.
    alarm_match, alarm_date
        after which of his matches, from 1 on, and when; None without an alarm or a date.
    league_wide
        whether it would have been raised at alpha shared out among all players.
    """

    player: str
    matches: int
    won: int
    e_value: float
    largest_e: float
    p_value: float
    e_any: float
    e_established: float
    flagged: bool
    alarm_match: int | None
    alarm_date: str | None
    league_wide: bool


def nights_of_files(
    system: System, first: RosterFile, season: ResultsFile, *, chart: Chart | None = None
) -> list[Night]:
    """Return a season night by night, the ratings moved by each.

    Parameters
    ----------
    system
        the league's system.
    first
        the list before the first night.
    season
        the results.
    chart
        by which races were given where the results state none.

    Raises
    ------
    DataError
        with all that keeps the results from moving ratings, each in its line.
    """
    told: dict[str, None] = {}

    def of_night(list_: Roster, rows: NDArray[np.int64]) -> Moves:
        # Who is not on the list is told as often as nights were played: once is enough.
        kept = rows
        while True:
            night = replace(season, results=season.results.select(kept), lines=season.lines[kept])
            try:
                return moves_of_files(system, replace(first, roster=list_), night, chart=chart)
            except DataError as error:
                told.update(dict.fromkeys(error.problems))
                kept = kept[:0]

    nights = played_nights(system, first.roster, season.results, chart=chart, apply=of_night)
    if told:
        raise DataError(_once(told))
    return nights


def _once(problems: Sequence[str] | dict[str, None]) -> list[str]:
    """Return the problems without those that only their line tells from an earlier one."""
    said: dict[str, str] = {}
    for problem in problems:
        said.setdefault(problem.split(": ", 1)[-1], problem)
    return list(said.values())


def events_marked(results: Results, events: Sequence[str]) -> NDArray[np.bool_]:
    """Return which matches belong to events that do not count for much.

    Raises
    ------
    InputError
        if the results have no such event.
    """
    column = results.event
    known = sorted({str(event) for event in (() if column is None else column) if event})
    for event in events:
        if event not in known:
            names = ", ".join(known[:10]) or "none: the file has no column event"
            raise InputError(f"event {event!r} is not in the results; give one of them ({names})")
    return np.isin(np.asarray(column, dtype=str), list(events))


def watch_rows(watched: Sequence[Watched], results: Results) -> list[WatchRow]:
    """Return a line for each player, the largest evidence first.

    Parameters
    ----------
    watched
        what `watch` returned for these results.
    results
        the season.
    """
    rows = []
    for one in watched:
        alarm = one.alarm
        rows.append(
            WatchRow(
                one.player,
                len(one.rows),
                int(one.won.sum()),
                one.e_value,
                one.largest_e,
                one.p_value,
                _e(one.any[-1]),
                _e(one.established[-1]),
                alarm is not None,
                None if alarm is None else alarm + 1,
                None if alarm is None else _date(results, int(one.rows[alarm])),
                one.largest_e >= len(watched) / one.alpha,
            )
        )
    return sorted(rows, key=lambda row: (-row.largest_e, row.player))


def match_rows(one: Watched, nights: Sequence[Night]) -> list[tuple[Any, ...]]:
    """Return a line for each match of a player: what it was, and what it did to the evidence.

    Returns
    -------
    list of (row in the results, opponent, rating, opponent's rating, games won, games lost,
    games he needed, games the opponent needed, won, e after it, factor of e)
    """
    found, place = [], 0
    for night in nights:
        players, rating = night.moves.before.players, night.moves.before.rating
        for match in night.moves.matches:
            sides = (match.winner, match.loser)
            if one.player not in (players[sides[0]], players[sides[1]]):
                continue
            won = players[match.winner] == one.player
            me, other = sides if won else sides[::-1]
            games, race = (
                (None, None) if pair is None else (pair if won else pair[::-1])
                for pair in (match.games, match.race)
            )
            before = float(one.log_e[place - 1]) if place else 0.0
            after = float(one.log_e[place])
            found.append(
                (
                    int(night.rows[match.row]),
                    players[other],
                    float(rating[me]),
                    float(rating[other]),
                    *games,
                    *race,
                    won,
                    _e(after),
                    _e(after - before),
                )
            )
            place += 1
    return found


def _e(log_e: float) -> float:
    return math.exp(min(float(log_e), 700.0))


def _date(results: Results, row: int) -> str | None:
    if results.date is None or np.isnat(results.date[row]):
        return None
    return str(results.date[row])
