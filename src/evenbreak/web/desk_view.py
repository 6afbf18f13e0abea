"""What the director sees: tables, disputes, calls, the last entry, a match with its actions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from functools import lru_cache
from typing import Any, NamedTuple

from evenbreak.answers.tournament.bracket_view import source_words
from evenbreak.answers.tournament.moves import (
    called_words,
    event_name,
    event_words,
    forfeited,
    happened,
    reopened,
    shout,
)
from evenbreak.answers.tournament.short_names import first_name
from evenbreak.answers.tournament.story import clock_words
from evenbreak.answers.tournament.tournament import place_words
from evenbreak.files.store.desk import Sides
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.beside import with_entry
from evenbreak.tournaments.evening.calling import night_queue
from evenbreak.tournaments.evening.events import (
    BY_ITSELF,
    Called,
    CalledBack,
    Dropped,
    Event,
    Result,
    Waits,
)
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.undoing import losses, undoable
from evenbreak.web.evening_view import progress_of
from evenbreak.web.night import score_of, win_chance
from evenbreak.web.sessions import author_words
from evenbreak.words import Sentence, joined, listed, say, say_count, tally


class Side(NamedTuple):
    """A player in a match; `short` is the first name if no one else tonight has it.

    `behind`: they need more games than the other, or have lost.
    """

    name: str
    short: str
    won: int
    needs: int
    behind: bool
    winner: bool = False


@dataclass(frozen=True)
class DeskMatch:
    """A match as the director sees it.

    `part` is the side of the bracket, or the round; `places` says in words where unknown players
    come from. The state is waits, ready, called, playing, hill, sent, two, done or forfeit;
    `minutes` are counted from the call. `sent` has both players' games, by the player whose phone
    sent them; `agreed`: both sent the same score, maybe from one phone. `tag` is its event, '' if
    there is only one.
    """

    name: str
    number: int
    part: Sentence | str
    sides: tuple[Side, ...]
    places: tuple[Sentence | str, ...]
    state: str
    table: int | None = None
    minutes: int = 0
    sent: Mapping[str, tuple[int, int]] | None = None
    agreed: bool = False
    event: int = 1
    tag: Sentence | str = ""

    @property
    def key(self) -> str:
        """Its key on a page, unique among the night's matches."""
        return self.name if self.event == 1 else f"{self.event}-{self.name}"

    @property
    def one_rack(self) -> bool:
        """Whether one game decides it."""
        return bool(self.sides) and all(side.needs == 1 for side in self.sides)

    @property
    def scored(self) -> bool:
        """Whether any of its games has been entered."""
        return any(side.won for side in self.sides)


def desk_match(
    state: Evening, name: str, now: str, sides: Mapping[str, Sides] | None = None
) -> DeskMatch:
    """Return a match as the director sees it; `sides` is what phones have sent, by match."""
    match = state.bracket.match(name)
    seats = state.standing.seats[name]
    of: dict[str, Any] = {"event": state.event, "tag": event_name(state) if state.beside else ""}
    number, part = state.number_of(name), part_words(state, name)
    places = tuple(
        state.order[seat] if seat is not None and seat >= 0 else _from(state, slot)
        for slot, seat in zip(match.slots, seats, strict=True)
    )
    if any(seat is None or seat == NOBODY for seat in seats):
        return DeskMatch(name, number, part, (), places, "waits", **of)
    pair, result = state.pair(name), state.counted.get(name)
    needs = state.needed(name, pair)
    won = score_of(state, name) or (0, 0)
    if result is not None:
        won = result.games[pair[0]], result.games[pair[1]]
    its = (sides or {}).get(name)
    sent = None
    if its is not None and result is None:
        sent = its.scores
    agreed = bool(its and its.agree)
    on, minutes = state.on_tables.get(name), 0
    if on is not None:
        passed = datetime.fromisoformat(now) - datetime.fromisoformat(on.at)
        minutes = max(0, int(passed.total_seconds() // 60))
    if result is not None:
        what = "forfeit" if result.forfeit else "done"
    elif sent:
        what = "two" if len(sent) == 2 and not agreed else "sent"
    else:
        what = "ready" if on is None else progress_of(state, name, now)
    found = tuple(
        Side(
            one,
            first_name(one, state.entrants),
            won[k],
            needs[k],
            any(won) and needs[k] - won[k] > needs[1 - k] - won[1 - k]
            if result is None
            else result.winner != one,
            result is not None and result.winner == one,
        )
        for k, one in enumerate(pair)
    )
    table = on.call.table if on else None
    both: dict[str, Any] = {"table": table, "minutes": minutes, "sent": sent, "agreed": agreed}
    return DeskMatch(name, number, part, found, places, what, **both, **of)


def _from(state: Evening, slot: int | Source) -> Sentence | str:
    """Return where an unknown player will come from, such as 'winner of 22'."""
    if not isinstance(slot, Source):
        return say("to be drawn")
    return source_words(slot, state.match_numbers)


FINALS = ("final", "second final")
_SIDES = {
    "winners": say("winners' side"),
    "losers": say("losers' side"),
    "final": say("final"),
    "second final": say("second final"),
    "third place": say("third place"),
    "consolation": say("consolation"),
}


def part_words(state: Evening, name: str) -> Sentence | str:
    """Return a match's position in the bracket."""
    match = state.bracket.match(name)
    return _SIDES.get(match.side, say("round {n}", n=match.round))


def progress(state: Evening) -> tuple[int, int]:
    """Return how many matches are over, and how many there are."""
    if not state.drawn:
        return 0, 0
    seats = state.standing.seats
    left = [
        name
        for name in state.match_numbers
        if not (name in seats and NOBODY in seats[name])
        and not (name not in state.counted and name in state.standing.winners)
    ]
    spare = [
        name
        for name in left
        if name in state.bracket.by_name
        and state.bracket.match(name).side == "second final"
        and None in seats[name]
    ]
    over = sum(1 for name in left if name in state.counted)
    return over, len(left) - len(spare)


class LastAct(NamedTuple):
    """The last entry, which stays on the desk until it is read.

    `lines` are its effects; `undo` is '' if something depends on it; `match` is 0 if it isn't about
    a match; `over`: it is a result. `by` is the phones or the tablet, '' for the director; `absent`
    players forfeited the match and haven't gone home.
    """

    event: int
    number: int
    at: str
    title: Sentence | str
    lines: Sequence[Sentence | str]
    undo: Sentence | str
    match: int = 0
    over: bool = False
    by: Sentence | str = ""
    absent: str = ""


def last_act(state: Evening, read: int) -> LastAct | None:
    """Return the last entry, if the director hasn't read it yet."""
    entries = list(zip(state.numbers, state.events, strict=True))
    told = (one for one in entries[:0:-1] if not one[1].by.startswith(BY_ITSELF))
    last = next((one for one in told if _is_act(one[1]) or one[1].by_directors), None)
    if last is None or not _is_act(last[1]) or entries[-1][0] <= read:
        return None
    number, event = last
    title, lines = _told(state, number)
    match = getattr(event.what, "match", "")
    undo = undo_words(state, event) if number in undoable(state) else ""
    return LastAct(
        state.event,
        number,
        event.at,
        title,
        lines,
        undo,
        state.number_of(match) if match else 0,
        isinstance(event.what, Result),
        "" if event.by_directors else author_words(event.by),
        _absent(state, event),
    )


def _absent(state: Evening, event: Event) -> str:
    if (
        not isinstance(what := event.what, Result)
        or not what.forfeit
        or what.loser in state.dropped
    ):
        return ""
    seat = state.order.index(what.loser)
    to_come = (seats for name, seats in state.standing.seats.items() if name not in state.counted)
    return what.loser if any(seat in seats for seats in to_come) else ""


def shouts(
    states: Mapping[int, Evening], read: Mapping[int, int], last: LastAct | None
) -> list[Sentence]:
    """Return what to announce, by table: matches called by the last action and not started."""
    found = []
    for n, state in states.items():
        its = zip(state.numbers, state.events, strict=True)
        entries = {getattr(one.what, "match", ""): (number, one) for number, one in its}
        for name, on in state.on_tables.items() if state.drawn else ():
            number, event = entries.get(name, (0, None))
            if name in state.live or event is None or number <= read.get(n, 0):
                continue
            if not last or _came_with(n, number, event, last, states[last.event]):
                found.append((on.call.table, shout(state, name)))
    return [words for _, words in sorted(found, key=lambda one: one[0])]


def _came_with(n: int, number: int, event: Event, last: LastAct, acted: Evening) -> bool:
    """Return whether an entry belongs to the last action, or came with it or after it."""
    events = dict(zip(acted.numbers, acted.events, strict=True))
    first = _first_with(acted, last.number)
    if n == last.event:
        return number >= first
    return event.at > last.at or event.by in {
        with_entry(last.event, k) for k in events if k >= first
    }


def _first_with(state: Evening, number: int) -> int:
    """Return an action's first entry: each table called with one tap is a separate entry."""
    events = dict(zip(state.numbers, state.events, strict=True))
    act = events[number]
    while (one := events.get(number - 1)) and (one.at, one.by) == (act.at, act.by):
        number -= 1
    return number


def _is_act(event: Event) -> bool:
    """Return whether an entry stays on the desk until it is read: entries about matches do."""
    if event.by_phones:
        return isinstance(event.what, Result)
    return isinstance(event.what, Result | Called | CalledBack | Waits | Dropped)


@lru_cache(maxsize=4)
def _told(state: Evening, number: int) -> tuple[Sentence | str, tuple[Sentence | str, ...]]:
    """Return what an entry was, and its effects."""
    k = state.numbers.index(number)
    event = state.events[k]
    before, after = evening(state.events[:k]), evening(state.events[: k + 1])
    title = event_words(event.what, state)
    together = state.events[state.numbers.index(_first_with(state, number)) : k + 1]
    if isinstance(event.what, Called) and len(together) > 1:
        calls = sum(isinstance(one.what, Called) for one in together)
        title = say_count("{n} match called", "{n} matches called", calls)
    if isinstance(event.what, Result) and not event.what.stands:
        result = event.what
        said = happened(before, after, event)
        full = after.plan.form in ("chips", "swiss")
        if full or after.bracket.match(result.match).side in FINALS:
            return (said[0] if said else title), tuple(said[1:])
        again = reopened(before, after, result.match)
        return after.result_words(result), (joined(next_words(after, result.match)), *again)
    if isinstance(event.what, CalledBack | Waits) and (said := called_words(before, after)):
        return said[0], tuple(said[1:])
    if isinstance(event.what, Dropped):
        said = forfeited(before, after)
        return (said[0] if said else title), tuple(said[1:])
    return title, tuple(reopened(before, after))


def undo_words(state: Evening, event: Event) -> Sentence:
    """Return what is taken back, as shown on its button."""
    what = event.what
    if isinstance(what, Result) and not what.forfeit:
        won, lost = what.games[what.winner], what.games[what.loser]
        names = {
            "a": first_name(what.winner, state.entrants),
            "b": first_name(what.loser, state.entrants),
        }
        return say(
            "Undo: {a} {score} {b} ({match})",
            **names,
            score=tally((won, lost)),
            match=state.match_words(what.match),
        )
    return say("Undo: {what}", what=event_words(what, state))


class Late(NamedTuple):
    """A match allowed to wait, and who is missing."""

    match: DeskMatch
    absent: tuple[str, ...]
    until: str
    reason: str
    missing: tuple[str, ...]


def waiting(state: Evening, now: str) -> tuple[list[Late], list[Late]]:
    """Return the matches past their waiting time, and those still allowed to wait."""
    over: list[Late] = []
    still: list[Late] = []
    for name, waits in state.waiting_for.items():
        one = Late(
            desk_match(state, name, now),
            waits.absent or waits.players,
            clock_words(waits.until) if waits.until else "",
            waits.reason,
            waits.absent,
        )
        (over if waits.until and waits.until <= now else still).append(one)
    return over, still


def chance(state: Evening, one: DeskMatch, means: Mapping[str, float]) -> float:
    """Return the chances of a match's first player from the current score on."""
    both, needs, won = zip(*((side.name, side.needs, side.won) for side in one.sides), strict=True)
    return win_chance(state, both, needs, won, means)


def next_words(state: Evening, name: str) -> list[Sentence]:
    """Return where a match's winner and loser go."""
    found = []
    played = state.bracket.match(name)
    to = {
        slot.outcome: other.name
        for other in state.bracket.matches
        for slot in other.slots
        if isinstance(slot, Source) and slot.match == name
    }
    for outcome, words, place in (
        ("winner", say("Winner"), played.winner_place),
        ("loser", say("Loser"), played.loser_place),
    ):
        if outcome in to:
            found.append(
                say("{who} goes to {match}.", who=words, match=state.match_words(to[outcome]))
            )
        elif place:
            found.append(say("{who} finishes {place}.", who=words, place=place_words(place)))
    return found


def waits_words(state: Evening, one: DeskMatch) -> Sentence | str:
    """Return which matches decide who plays in a match."""
    seats, slots = state.standing.seats[one.name], state.bracket.match(one.name).slots
    numbers = [
        str(state.number_of(slot.match))
        for slot, seat in zip(slots, seats, strict=True)
        if seat is None and isinstance(slot, Source) and state.number_of(slot.match)
    ]
    return say("waiting for {matches}", matches=listed(numbers)) if numbers else ""


def soon(
    states: Mapping[int, Evening], now: str, order: Sequence[tuple[int, str]], most: int = 6
) -> list[DeskMatch]:
    """Return the upcoming matches: first those ready, then those waiting for another match."""
    ready = night_queue(states, order)
    open_ones = [
        (n, name)
        for n, state in states.items()
        for name in sorted(state.bracket.by_name, key=state.number_of)
        if name not in state.counted
        and name not in state.on_tables
        and (n, name) not in ready
        and name not in state.waiting_for
        and any(seat is not None and seat >= 0 for seat in state.standing.seats[name])
        and NOBODY not in state.standing.seats[name]
    ]
    more = open_ones[: max(0, most - len(ready))]
    return [desk_match(states[n], name, now) for n, name in [*ready, *more]]


class Lost(NamedTuple):
    """A match played on a result that is being corrected, with its score."""

    number: int
    table: int | None
    players: tuple[str, str]
    score: str
    over: bool


class Corrected(NamedTuple):
    """A result being corrected: who won before and who wins now, each with the score."""

    number: int
    was: tuple[str, str]
    now: tuple[str, str]
    lost: Sequence[Lost]


def corrected(before: Evening, after: Evening, match: str) -> Corrected:
    """Return what to ask when a result is corrected that later matches were played on."""

    def scored(state: Evening) -> tuple[str, str]:
        result = state.counted[match]
        won, gone = result.games[result.winner], result.games[result.loser]
        return result.winner, "" if result.forfeit else tally((won, gone))

    lost = []
    for one in losses(before, after):
        games = one.result.games if one.result else {}
        score = [games[name] for name in one.players] if games else one.score or (0, 0)
        number, over = before.number_of(one.match), one.result is not None
        lost.append(Lost(number, one.table, one.players, tally(score), over))
    return Corrected(before.number_of(match), scored(before), scored(after), lost)
