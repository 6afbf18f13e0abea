"""When a team night's sets start, and when the night ends.

The time model is the same as for tournaments (`evenbreak.tournaments.clock`): the pace of real
events, adjusted to the sets played so far, and sets that start in order as tables become free.
"""

from __future__ import annotations

import heapq
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from itertools import combinations
from typing import NamedTuple

import numpy as np
from scipy.special import ndtri

from evenbreak.answers.tournament.time import minute_of_day, time_of_day
from evenbreak.arrays import Floats
from evenbreak.matches.pace import Pace
from evenbreak.teams.evening.fold import SetLine, TeamEvening
from evenbreak.teams.night import LOSER, WINNER
from evenbreak.tournaments.clock.evenings import lognormal, minutes_left, turnovers
from evenbreak.tournaments.clock.event_pace import QUICKEST, Timed, learned_pace
from evenbreak.tournaments.clock.finish import bands_of
from evenbreak.tournaments.clock.table_schedule import Waiting, schedule
from evenbreak.tournaments.odds.play import stratified_uniforms
from evenbreak.words import Sentence, say

RUNS = 2000


class Band(NamedTuple):
    """A time in minutes from now, reached in 10, 50 and 90 of 100 nights."""

    early: float
    middle: float
    late: float


@dataclass(frozen=True)
class NightClock:
    """A team night's times; `starts` has each set that isn't on a table yet."""

    now: datetime
    starts: Mapping[int, Band]
    end: Band


def night_clock(state: TeamEvening, now: str) -> NightClock:
    """Return when the remaining sets start, and when the night ends.

    A set without players is as long as the remaining players' sets, on average.
    """
    begun = _begun(state)
    rng = np.random.default_rng(0)
    pace = learned_pace(state.plan.discipline, _timed(state, begun))
    evening = lognormal(ndtri(stratified_uniforms(rng, RUNS)), pace.evening_sd)
    left = [line for line in state.sets if line.score is None]
    on_tables = [k for k, line in enumerate(left) if line.number in begun]
    minutes = np.empty((RUNS, len(left)))
    for k, line in enumerate(left):
        started = begun.get(line.number)
        since = None if started is None else max(0.0, _minutes(started, now))
        minutes[:, k] = _minutes_of(_lengths(state, line), pace, evening, since, rng)
    turnover = np.array([turnovers(None, stratified_uniforms(rng, RUNS)) for _ in left]).T
    planned = schedule(
        _waiting(state, left),
        minutes,
        np.ones(minutes.shape, dtype=bool),
        turnover.reshape(minutes.shape),
        np.zeros((RUNS, max(state.plan.tables, len(on_tables)))),
        priority=-np.arange(len(left), dtype=float),
        under_way=on_tables,
    )
    starts = {
        line.number: Band(*bands_of(planned.start[:, k])[0])
        for k, line in enumerate(left)
        if k not in on_tables
    }
    end = bands_of(planned.end.max(axis=1, initial=0.0))[0]
    return NightClock(datetime.fromisoformat(now), starts, Band(*end))


def _begun(state: TeamEvening) -> dict[int, str]:
    """Return when each set started: when its players were known and a table was free."""
    free = [""] * state.plan.tables  # since when each free table is free
    begun = {}
    for line in state.sets:
        if not line.named or not (free or line.score):
            continue
        since = heapq.heappop(free) if free else ""
        begun[line.number] = max(line.named_at, since)
        if line.score and len(free) < state.plan.tables:
            heapq.heappush(free, line.over_at)
    return begun


def _timed(state: TeamEvening, begun: Mapping[int, str]) -> list[Timed]:
    found = []
    for line in state.sets:
        if line.score and line.number in begun:
            one = Timed(sum(line.score), _minutes(begun[line.number], line.over_at))
            if one.minutes >= QUICKEST * one.games:
                found.append(one)
    return found


def _minutes(since: str, until: str) -> float:
    passed = datetime.fromisoformat(until) - datetime.fromisoformat(since)
    return passed.total_seconds() / 60.0


def _lengths(state: TeamEvening, line: SetLine) -> Floats:
    """Return P(a set takes k games), averaged over who may play it."""
    lengths = state.meeting.lengths[line.number - 1]
    mine, others = (_picks(state, line, team) for team in (0, 1))
    return np.asarray(lengths[np.ix_(mine, others)].mean(axis=(0, 1)))


def _picks(state: TeamEvening, line: SetLine, team: int) -> list[int]:
    """Return who may play a set for a team, by their places among its picks."""
    squad, size = state.meeting.squads[team], state.meeting.sizes[line.number - 1]
    every = list(combinations(range(len(squad.names)), size))
    if line.picks[team]:
        return [every.index(tuple(sorted(map(squad.place, line.picks[team]))))]
    played = Counter(map(squad.place, state.put_up(team)))
    gone = {place for place, many in played.items() if many >= squad.times}
    return [k for k, pick in enumerate(every) if not gone & set(pick)] or list(range(len(every)))


def _minutes_of(
    lengths: Floats, pace: Pace, evening: Floats, since: float | None, rng: np.random.Generator
) -> Floats:
    """Return the minutes that a set takes, or has left, in each run."""
    usual = np.asarray(pace.mean_minutes(np.arange(len(lengths))))
    if since is not None:
        return minutes_left(lengths, usual, pace.match_sd, evening, since, rng)[1]
    luck = stratified_uniforms(rng, len(evening))
    games = np.searchsorted(np.cumsum(lengths)[:-1], luck, side="right")
    noise = lognormal(ndtri(stratified_uniforms(rng, len(evening))), pace.match_sd)
    return np.asarray(evening * noise * usual[games])


def _waiting(state: TeamEvening, left: list[SetLine]) -> Waiting:
    """Return which sets must wait for another's result, or for their players."""
    after, shared = (np.zeros((len(left), len(left)), dtype=bool) for _ in range(2))
    for k, line in enumerate(left):
        letter = "" if state.sealed else state.meeting.order[line.number - 1]
        waits = letter in (WINNER, LOSER) and not line.named
        for i, other in enumerate(left[:k]):
            after[i, k] = waits and other.number == line.number - 1
            both = [set(line.picks[team]) & set(other.picks[team]) for team in (0, 1)]
            shared[i, k] = shared[k, i] = any(both)
    return Waiting(tuple(str(line.number) for line in left), after, shared)


def clock_words(state: TeamEvening, clock: NightClock) -> list[Sentence]:
    """Return when the next set starts, and when the night ends; nothing if it is over."""
    if state.over:
        return []
    lines = []
    for number, band in list(clock.starts.items())[:1]:
        if band.late < 1.0:
            lines.append(say("Set {n} can start now.", n=number))
            continue
        lines.append(
            say(
                "Set {n} starts at about {middle} (8 nights in 10: {early} to {late}).",
                n=number,
                **_times(clock.now, band),
            )
        )
    lines.append(
        say(
            "If every set is played, the night ends at about {middle} (8 nights in 10: {early} to "
            "{late}).",
            **_times(clock.now, clock.end),
        )
    )
    return lines


def _times(now: datetime, band: Band) -> dict[str, str]:
    at = zip(Band._fields, band, strict=True)
    return {name: time_of_day(minute_of_day(now) + minutes) for name, minutes in at}
