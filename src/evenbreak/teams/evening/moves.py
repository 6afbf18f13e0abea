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
from evenbreak.teams.order import WINNER
from evenbreak.teams.set_laws import brought


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
            f"{' and '.join(there)} has been put up in set {number} already; only the director "
            "can take that back"
        )
    _check_turn(state, team, number, replaces=bool(there))
    wanted = sorted(pick)
    for allowed in choices(state, team).picks:
        if sorted(allowed) == wanted:
            return [PutUp(team, number, allowed)]
    size = state.meeting.sizes[number - 1]
    if len(pick) != size:
        raise InputError(
            f"set {number} is played by {'two players' if size == 2 else 'one player'}"
        )
    raise InputError(f"{' and '.join(pick)} cannot be put up in set {number}")


def _check_turn(state: TeamEvening, team: int, number: int, *, replaces: bool) -> None:
    """Refuse a pick that is not due."""
    line = state.to_name
    if line is None or line.number != number:
        due = f"set {line.number} comes next" if line else "all sets have their players"
        raise InputError(f"nobody can be put up in set {number} now: {due}")
    if team in state.due or replaces:
        return
    if not state.due:
        who = "winner" if state.meeting.order[number - 1] == WINNER else "loser"
        raise InputError(
            f"the {who} of set {number - 1} names first in set {number}; enter its result first"
        )
    raise InputError(f"{state.teams[1 - team]} names first in set {number}")


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
        raise InputError(f"a line-up has {len(state.sets)} players, one for each set")
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
            f"{line.score[0]}:{line.score[1]} counts in set {number}; the director can correct it"
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
        raise InputError(f"nobody plays set {number} yet")
    brought(state.needs(line), score, state.meeting.count)
    return line


def _line(state: TeamEvening, number: int) -> SetLine:
    if not 1 <= number <= len(state.sets):
        raise InputError(f"there is no set {number}; there are {len(state.sets)}")
    return state.sets[number - 1]
