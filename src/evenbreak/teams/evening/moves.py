"""Actions of the captains and the director: each is checked, and returns its events.

Repeating an entry gives no events, so a second tap changes nothing.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from evenbreak.errors import InputError
from evenbreak.teams.evening.events import (
    Begun,
    HandedIn,
    NightPlan,
    Pick,
    Proposed,
    PutUp,
    Result,
    Score,
    What,
)
from evenbreak.teams.evening.fold import SetLine, TeamEvening
from evenbreak.teams.night import WINNER
from evenbreak.teams.set_laws import brought
from evenbreak.teams.squad import LineUps, Squad, line_ups
from evenbreak.words import listed, say, say_count

_line_ups = lru_cache(maxsize=8)(line_ups)


def begin(state: TeamEvening | None, plan: NightPlan) -> list[What]:
    """Start a night; `check_plan` has found nothing wrong with it."""
    if state is not None and state.plan == plan and isinstance(state.last.what, Begun):
        return []
    return [Begun(plan)]


def put_up(state: TeamEvening, team: int, number: int, pick: Pick) -> list[What]:
    """Put up a player in a set; InputError if it isn't this team's turn, or isn't allowed."""
    if state.sealed:
        raise InputError("lineups are sealed tonight; hand in the whole lineup")
    line = _line(state, number)
    there = line.picks[team]
    if sorted(there) == sorted(pick):
        return []
    if there and state.open(number):
        raise InputError(
            "the team has already put up {players} in set {n}; only the director can take that "
            "back",
            players=listed(there),
            n=number,
        )
    _check_turn(state, team, number, replaces=bool(there))
    wanted = sorted(pick)
    for allowed in choices(state, team).picks:
        if sorted(allowed) == wanted:
            return [PutUp(team, number, allowed)]
    size = state.meeting.sizes[number - 1]
    if len(pick) != size:
        raise InputError(
            "each team puts up {players} in set {n}",
            players=say_count("{n} player", "{n} players", size),
            n=number,
        )
    raise InputError("{players} can't be put up in set {n}", players=listed(pick), n=number)


def _check_turn(state: TeamEvening, team: int, number: int, *, replaces: bool) -> None:
    """Raise an error for a pick that is not due."""
    line = state.to_name
    if line is None or line.number != number:
        due = say("set {n} is next", n=line.number) if line else say("every set has its players")
        raise InputError("no one can be put up in set {n} now: {due}", n=number, due=due)
    if team in state.due or replaces:
        return
    if not state.due:
        if state.meeting.order[number - 1] == WINNER:
            raise InputError(
                "the winner of set {last} puts up first in set {n}. Enter its result first.",
                last=number - 1,
                n=number,
            )
        raise InputError(
            "the loser of set {last} puts up first in set {n}. Enter its result first.",
            last=number - 1,
            n=number,
        )
    raise InputError("{team} puts up first in set {n}", team=state.teams[1 - team], n=number)


def hand_in(state: TeamEvening, team: int, picks: tuple[Pick, ...]) -> list[What]:
    """Hand in a whole lineup, which may be changed until the other one is in too.

    Raises InputError if lineups aren't sealed, both are in, or it breaks the caps.
    """
    if not state.sealed:
        raise InputError("lineups aren't sealed tonight. Put up one player after another.")
    if tuple(line.picks[team] for line in state.sets) == picks:
        return []
    if state.to_name is None:
        raise InputError("both lineups are in; only the director can take that back")
    if len(picks) != len(state.sets) or not all(len(pick) == 1 for pick in picks):
        raise InputError("a lineup has {n} players, one for each set", n=len(state.sets))
    check_line_up(state, team, picks)
    return [HandedIn(team, picks)]


def propose(state: TeamEvening, team: int, number: int, score: Score) -> list[What]:
    """Enter one team's result for a set; InputError if impossible or another one already counts."""
    line = _checked(state, number, score)
    if line.score == score or (line.score is None and line.said[team] == score):
        return []
    if line.score is not None:
        raise InputError(
            "set {n} already has the result {a}-{b}; only the director can correct it",
            a=line.score[0],
            b=line.score[1],
            n=number,
        )
    return [Proposed(team, number, score)]


def result(state: TeamEvening, number: int, score: Score) -> list[What]:
    """Enter a set's result, or correct it; InputError if it is impossible."""
    line = _checked(state, number, score)
    return [] if line.score == score else [Result(number, score)]


def _checked(state: TeamEvening, number: int, score: Score) -> SetLine:
    line = _line(state, number)
    if not line.named:
        raise InputError("set {n} has no players yet", n=number)
    brought(state.needs(line), score, state.meeting.count)
    return line


def _line(state: TeamEvening, number: int) -> SetLine:
    if not 1 <= number <= len(state.sets):
        raise InputError(
            "there's no set {n}; the sets are 1 to {sets}", n=number, sets=len(state.sets)
        )
    return state.sets[number - 1]


class CapNow(NamedTuple):
    """How much of a cap is used: `total` is the sum over all players put up, answered or not."""

    name: str
    total: float
    most: float


class Choices(NamedTuple):
    """Who can be put up for the next set without players.

    `used_up` are players who have played as often as they may; `barred` are players who could still
    play, but whom the caps or the remaining sets rule out now.
    """

    picks: tuple[Pick, ...]
    used_up: tuple[str, ...]
    barred: tuple[str, ...]
    caps: tuple[CapNow, ...]


def choices(state: TeamEvening, team: int) -> Choices:
    """Return who can be put up for the next set without players, for team 0 (A) or 1 (B)."""
    squad = state.meeting.squads[team]
    found = _of(squad, state.meeting.sizes)
    counts = _counts(squad, state.used(team))
    line = state.to_name
    picks: tuple[Pick, ...] = ()
    if line is not None:
        k = line.number - 1
        after = found.after[k][found.used[k].index(counts)]
        picks = tuple(
            tuple(squad.names[player] for player in pick)
            for pick, state_after in zip(found.picks[k], after, strict=True)
            if state_after >= 0
        )
    played = [name for name, many in zip(squad.names, counts, strict=True) if many >= squad.times]
    able = {name for pick in picks for name in pick}
    barred = [name for name in squad.names if line and name not in able and name not in played]
    so_far = _counts(squad, state.put_up(team))
    caps = tuple(CapNow(cap.name, cap.total(so_far), cap.most) for cap in squad.caps)
    return Choices(picks, tuple(played), tuple(barred), caps)


def check_line_up(state: TeamEvening, team: int, picks: Sequence[Pick]) -> None:
    """Raise InputError if a whole lineup does not fill its sets within the caps."""
    squad = state.meeting.squads[team]
    named = [name for pick in picks for name in pick]
    for name in named:
        squad.place(name)
    counts = _counts(squad, named)
    often = [name for name, many in zip(squad.names, counts, strict=True) if many > squad.times]
    if often:
        raise InputError(
            "{player} is named more often than they are allowed to play", player=often[0]
        )
    for cap in squad.caps:
        if cap.total(counts) > cap.most:
            raise InputError(
                "{cap} is {total:g}; the limit is {most:g}",
                cap=cap.name,
                total=cap.total(counts),
                most=cap.most,
            )


def _of(squad: Squad, sizes: tuple[int, ...]) -> LineUps:
    found: LineUps = _line_ups(squad, sizes)
    return found


def _counts(squad: Squad, used: Sequence[str]) -> tuple[int, ...]:
    many = Counter(used)
    return tuple(many[name] for name in squad.names)
