"""A team night under way: what is needed, who can still play, what has happened."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.kit.wording import count_of, listed, percent
from evenbreak.answers.team.lineup import names_words, race_words
from evenbreak.teams.evening.choices import choices
from evenbreak.teams.evening.events import (
    Begun,
    Event,
    HandedIn,
    Proposed,
    PutUp,
    Result,
    Undone,
    What,
)
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.evening.plan import NightPlan
from evenbreak.teams.night import WINNER

_DECIDED = 1e-9


def night_words(state: TeamEvening) -> str:
    """Return what is played tonight."""
    counted = "" if state.plan.count == "sets" else f", all {state.plan.count} count"
    return f"{count_of(state.plan.sets, 'set')}, {race_words(state.meeting.race)}{counted}"


def decided(state: TeamEvening, chances: tuple[float, float] | None) -> bool:
    """Return whether a night is over, or no set to come can change who wins it."""
    return state.over or (chances is not None and min(chances) < _DECIDED)


def needed_words(state: TeamEvening, chances: tuple[float, float] | None) -> str:
    """Return how the night stands: who has won it, or what is still needed.

    Parameters
    ----------
    state
        the state of the night.
    chances
        of both teams; None: not known.
    """
    (first, second), (a, b) = state.teams, state.score
    if state.over and a == b:
        return "The night ends in a tie."
    if decided(state, chances):
        won = a > b if state.over or chances is None else chances[0] > 0.5
        return f"{(second, first)[won]} has won the night."
    left = sum(line.score is None for line in state.sets)
    if state.plan.count != "sets":
        if a == b:
            return f"The score is level with {count_of(left, 'set')} to finish."
        ahead = count_of(abs(a - b), state.plan.count.removesuffix("s"))
        return f"{state.teams[a < b]} leads by {ahead} with {count_of(left, 'set')} to finish."
    needed = [state.plan.sets // 2 + 1 - won for won in (a, b)]
    return (
        f"To win the night {first} needs {needed[0]} of the {count_of(left, 'set')} to finish, "
        f"and {second} needs {needed[1]}."
    )


def chance_words(state: TeamEvening, chances: tuple[float, float]) -> str:
    """Return how often each team wins the night from here."""
    first, second = state.teams
    counted = state.plan.count == "sets" and state.plan.sets % 2
    tied = "" if counted else " A tie counts as half a win."
    return (
        f"{first} wins the night {percent(chances[0])} of the time, and {second} wins it "
        f"{percent(chances[1])}.{tied}"
    )


def cap_words(state: TeamEvening, team: int) -> list[str]:
    """Return how far a team's caps are used up, and who can still be put up."""
    found = choices(state, team)
    lines = [
        f"{cap.name.capitalize()} so far: {cap.total:g} of {cap.most:g}." for cap in found.caps
    ]
    line = state.to_name
    if line is None or not found.caps:
        return lines
    if state.sealed:
        return []
    if line.picks[team] and not state.unseen(line.number):  # nothing to choose before the answer
        return lines
    if not found.barred:
        return [*lines, "Everybody who has not played can still be put up."]
    return [
        *lines,
        f"{listed(found.barred)} cannot be put up in set {line.number}: the sets after it could "
        "no longer be filled within the limit.",
    ]


def waiting_words(state: TeamEvening) -> str:
    """Return what the next pick waits for; '' if it waits for nothing."""
    line = state.to_name
    if line is None or state.due:
        return ""
    who = "winner" if state.meeting.order[line.number - 1] == WINNER else "loser"
    return (
        f"The {who} of set {line.number - 1} names first in set {line.number}, so enter its result "
        "first."
    )


def history_words(events: Sequence[Event], state: TeamEvening) -> list[str]:
    """Return what happened, a line each, without the picks that are still unseen.

    Parameters
    ----------
    events
        all of them.
    state
        the state after them.
    """
    lines: list[str] = []
    plan, seen = state.plan, _open(state)
    kept: list[What] = []  # an undo may bring an earlier night back
    for number, event in enumerate(events, 1):
        kept = kept[:-1] if isinstance(event.what, Undone) else [*kept, event.what]
        plan = next((what.plan for what in reversed(kept) if isinstance(what, Begun)), plan)
        shown = seen if number >= state.began else set(range(1, plan.sets + 1))
        lines.append(event_words(event, plan, shown))
    return lines


def last_words(state: TeamEvening) -> str:
    """Return what happened last, without a pick that is still unseen."""
    return event_words(state.last, state.plan, _open(state))


def _open(state: TeamEvening) -> set[int]:
    return {line.number for line in state.sets if state.open(line.number)}


def event_words(event: Event, plan: NightPlan, shown: set[int]) -> str:
    """Return what happened; of picks only those in the sets `shown`.

    >>> from evenbreak.teams.evening.plan import TeamSheet
    >>> us, them = (TeamSheet(name, (), (), (), ()) for name in ("Racks", "Cues"))
    >>> plan = NightPlan((us, them), 2, race=5)
    >>> one = Event("2025-03-01T19:30:00", PutUp(0, 1, ("Ann",)))
    >>> event_words(one, plan, {1}), event_words(one, plan, set())
    ('Racks put up Ann in set 1', 'Racks put up somebody in set 1')
    """
    names = [team.name for team in plan.teams]
    match event.what:
        case Begun():
            return f"{names[0]} against {names[1]} begun"
        case PutUp(team, number, pick):
            who = names_words(pick) if number in shown else "somebody"
            return f"{names[team]} put up {who} in set {number}"
        case HandedIn(team, picks):
            who = f": {', '.join(map(names_words, picks))}" if shown else ""
            return f"{names[team]} handed in the line-up{who}"
        case Proposed(team, number, score):
            return f"{names[team]} says {score[0]}:{score[1]} in set {number}"
        case Result(number, score):
            return f"result of set {number}: {score[0]}:{score[1]}"
        case Undone():
            return "the last entry undone"
