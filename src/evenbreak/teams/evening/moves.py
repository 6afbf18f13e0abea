"""What the captains and the director may do: each checks one thing, and returns its events.

What has been entered already gives no event, so that a second tap changes nothing.
"""

from __future__ import annotations

from evenbreak.errors import InputError
from evenbreak.teams.evening.choices import check_line_up, choices
from evenbreak.teams.evening.events import (
    Begun,
    HandedIn,
    Pick,
    Proposed,
    PutUp,
    Result,
    Score,
    What,
)
from evenbreak.teams.evening.fold import SetLine, TeamEvening
from evenbreak.teams.evening.plan import NightPlan
from evenbreak.teams.night import WINNER
from evenbreak.teams.set_laws import brought
from evenbreak.words import listed, say, say_count


def begin(state: TeamEvening | None, plan: NightPlan) -> list[What]:
    """Begin a night; `check_plan` has found nothing wrong with it."""
    if state is not None and state.plan == plan and isinstance(state.last.what, Begun):
        return []
    return [Begun(plan)]


def put_up(state: TeamEvening, team: int, number: int, pick: Pick) -> list[What]:
    """Put somebody up in a set.

    Raises
    ------
    InputError
        if it is not this team's turn, or the pick is not allowed.
    """
    if state.sealed:
        raise InputError("line-ups are sealed tonight; hand in the whole line-up")
    line = _line(state, number)
    there = line.picks[team]
    if sorted(there) == sorted(pick):
        return []
    if there and state.open(number):
        raise InputError(
            "{players} has already been put up in set {n}; only the director can take that back",
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
            "a team puts up {players} in set {n}",
            players=say_count("{n} player", "{n} players", size),
            n=number,
        )
    raise InputError("{players} can't be put up in set {n}", players=listed(pick), n=number)


def _check_turn(state: TeamEvening, team: int, number: int, *, replaces: bool) -> None:
    """Refuse a pick that is not due."""
    line = state.to_name
    if line is None or line.number != number:
        due = say("set {n} is next", n=line.number) if line else say("all sets have their players")
        raise InputError("nobody can be put up in set {n} now: {due}", n=number, due=due)
    if team in state.due or replaces:
        return
    if not state.due:
        if state.meeting.order[number - 1] == WINNER:
            raise InputError(
                "the winner of set {last} names first in set {n}; enter its result first",
                last=number - 1,
                n=number,
            )
        raise InputError(
            "the loser of set {last} names first in set {n}; enter its result first",
            last=number - 1,
            n=number,
        )
    raise InputError("{team} names first in set {n}", team=state.teams[1 - team], n=number)


def hand_in(state: TeamEvening, team: int, picks: tuple[Pick, ...]) -> list[What]:
    """Hand in a whole line-up; it may be changed until the other one is in too.

    Raises
    ------
    InputError
        if line-ups are not sealed, both are in, or it does not fill the sets within the caps.
    """
    if not state.sealed:
        raise InputError("line-ups are not sealed tonight; put up one player after another")
    if tuple(line.picks[team] for line in state.sets) == picks:
        return []
    if state.to_name is None:
        raise InputError("both line-ups are in; only the director can take that back")
    if len(picks) != len(state.sets) or not all(len(pick) == 1 for pick in picks):
        raise InputError("a line-up has {n} players, one for each set", n=len(state.sets))
    check_line_up(state, team, picks)
    return [HandedIn(team, picks)]


def propose(state: TeamEvening, team: int, number: int, score: Score) -> list[What]:
    """Say for one team how a set ended.

    Raises
    ------
    InputError
        if that cannot be, or another result counts already.
    """
    line = _checked(state, number, score)
    if line.score == score or (line.score is None and line.said[team] == score):
        return []
    if line.score is not None:
        raise InputError(
            "{a}:{b} counts in set {n}; the director can correct it",
            a=line.score[0],
            b=line.score[1],
            n=number,
        )
    return [Proposed(team, number, score)]


def result(state: TeamEvening, number: int, score: Score) -> list[What]:
    """Enter how a set ended, or correct it.

    Raises
    ------
    InputError
        if it cannot have ended so.
    """
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
            "there is no set {n}; the sets are 1 to {sets}", n=number, sets=len(state.sets)
        )
    return state.sets[number - 1]
