"""A team night in progress: what is needed, who can still play, what has happened."""

from __future__ import annotations

from collections.abc import Sequence

from evenbreak.answers.kit.wording import percent
from evenbreak.answers.team.lineup import TIE, names_words, race_words
from evenbreak.teams.evening.events import (
    Begun,
    Event,
    HandedIn,
    NightPlan,
    Proposed,
    PutUp,
    Result,
    Undone,
    What,
)
from evenbreak.teams.evening.fold import TeamEvening
from evenbreak.teams.evening.moves import choices
from evenbreak.teams.night import WINNER
from evenbreak.words import Sentence, joined, listed, say, say_count, tally

_DECIDED = 1e-9


def night_words(state: TeamEvening) -> str:
    """Return what is played tonight."""
    played = [say_count("{n} set", "{n} sets", state.plan.sets), race_words(state.meeting.race)]
    if state.plan.count == "games":
        played.append(say("all games count"))
    elif state.plan.count == "points":
        played.append(say("all points count"))
    return joined(played, ", ")


def decided(state: TeamEvening, chances: tuple[float, float] | None) -> bool:
    """Return whether a night is over, or no upcoming set can change who wins it."""
    return state.over or (chances is not None and min(chances) < _DECIDED)


def needed_words(state: TeamEvening, chances: tuple[float, float] | None) -> str:
    """Return the night's state: who has won it, or what is still needed."""
    (first, second), (a, b) = state.teams, state.score
    if state.over and a == b:
        return say("The night ends in a tie.")
    if decided(state, chances):
        won = a > b if state.over or chances is None else chances[0] > 0.5
        return say("{team} has won the night.", team=(second, first)[won])
    left = sum(line.score is None for line in state.sets)
    if state.plan.count != "sets":
        if a == b:
            return say("The score is tied with {sets} left.", sets=_sets_words(left))
        ahead = say_count("{n} game", "{n} games", abs(a - b))
        if state.plan.count == "points":
            ahead = say_count("{n} point", "{n} points", abs(a - b))
        return say(
            "{team} leads by {lead} with {sets} left.",
            team=state.teams[a < b],
            lead=ahead,
            sets=_sets_words(left),
        )
    needed = [state.plan.sets // 2 + 1 - won for won in (a, b)]
    return say(
        "To win the night, {first} needs {n} of the {sets} left, and {second} needs {m}.",
        first=first,
        n=needed[0],
        sets=_sets_words(left),
        second=second,
        m=needed[1],
    )


def _sets_words(n: int) -> Sentence:
    return say_count("{n} set", "{n} sets", n)


def chance_words(state: TeamEvening, chances: tuple[float, float]) -> str:
    """Return each team's chance of winning the night from here."""
    first, second = state.teams
    counted = state.plan.count == "sets" and state.plan.sets % 2
    text = say(
        "{first} wins the night {p} of the time, and {second} wins {q} of the time.",
        first=first,
        p=percent(chances[0]),
        second=second,
        q=percent(chances[1]),
    )
    return text if counted else joined([text, TIE])


def cap_words(state: TeamEvening, team: int) -> list[str]:
    """Return how much of a team's caps is used up, and who can still be put up."""
    found = choices(state, team)
    lines: list[str] = [
        say(
            "So far, {cap} is {total:g}; the limit is {most:g}.",
            cap=cap.name,
            total=cap.total,
            most=cap.most,
        )
        for cap in found.caps
    ]
    line = state.to_name
    if line is None or not found.caps:
        return lines
    if state.sealed:
        return []
    if line.picks[team] and not state.unseen(line.number):  # nothing to choose before the answer
        return lines
    if not found.barred:
        return [*lines, say("Every player who has not played can still be put up.")]
    return [
        *lines,
        say(
            "{players} can't be put up in set {n}: the sets after it could no longer be filled "
            "within the limit.",
            players=listed(found.barred),
            n=line.number,
        ),
    ]


def waiting_words(state: TeamEvening) -> str:
    """Return what the next pick is waiting for; '' if nothing."""
    line = state.to_name
    if line is None or state.due:
        return ""
    sets = {"last": line.number - 1, "n": line.number}
    if state.meeting.order[line.number - 1] == WINNER:
        return say(
            "The winner of set {last} puts up first in set {n}, so enter its result first.", **sets
        )
    return say(
        "The loser of set {last} puts up first in set {n}, so enter its result first.", **sets
    )


def history_words(events: Sequence[Event], state: TeamEvening) -> list[str]:
    """Return what happened, one line each, without picks that are still unseen."""
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
    """Return what happened last, leaving out a pick that is still unseen."""
    return event_words(state.last, state.plan, _open(state))


def _open(state: TeamEvening) -> set[int]:
    return {line.number for line in state.sets if state.open(line.number)}


def event_words(event: Event, plan: NightPlan, shown: set[int]) -> str:
    """Return what happened; picks are included only for the sets in `shown`.

    >>> from evenbreak.teams.evening.events import TeamSheet
    >>> us, them = (TeamSheet(name, (), (), (), ()) for name in ("Racks", "Cues"))
    >>> plan = NightPlan((us, them), 2, race=5)
    >>> one = Event("2025-03-01T19:30:00", PutUp(0, 1, ("Ann",)))
    >>> event_words(one, plan, {1}), event_words(one, plan, set())
    ('Racks put up Ann in set 1', 'Racks put up a player in set 1')
    """
    names = [team.name for team in plan.teams]
    match event.what:
        case Begun():
            return say("night started: {a} against {b}", a=names[0], b=names[1])
        case PutUp(team, number, pick):
            if number not in shown:
                return say("{team} put up a player in set {n}", team=names[team], n=number)
            return say(
                "{team} put up {players} in set {n}",
                team=names[team],
                players=names_words(pick),
                n=number,
            )
        case HandedIn(team, picks):
            if not shown:
                return say("{team} handed in their lineup", team=names[team])
            line_up = joined(map(names_words, picks), ", ")
            return say(
                "{team} handed in their lineup: {players}", team=names[team], players=line_up
            )
        case Proposed(team, number, score):
            return say(
                "{team} reports {score} in set {n}",
                team=names[team],
                score=tally(score),
                n=number,
            )
        case Result(number, score):
            return say("result in set {n}: {score}", n=number, score=tally(score))
        case Undone():
            return say("last entry undone")
