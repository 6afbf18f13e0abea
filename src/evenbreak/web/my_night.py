"""A player's night as shown on their own page: what comes next, why, and the path so far."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from evenbreak.answers.tournament.bracket_view import round_names, source_words
from evenbreak.answers.tournament.time import time_of_day
from evenbreak.answers.tournament.tournament import short_place
from evenbreak.files.store.desk import Phones, Sides
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.standing import NOBODY
from evenbreak.tournaments.evening.events import Scored, race_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.listed import decided_places
from evenbreak.tournaments.money.payouts import shared_prize
from evenbreak.web.evening_view import is_hill, provisional_in
from evenbreak.web.night import Known, score_of, win_chance
from evenbreak.words import Sentence, say, say_count, tally

_MOST_STEPS = 12
_TENTH = 1.2816  # standard deviations to the 10th and the 90th of 100

_FINALS = "final", "second final", "third place"


class Step(NamedTuple):
    """A match on a player's path: 'done' (won), 'forfeit' (lost) or 'playing' (next).

    `score` has the player's own games first, or is the starting time.
    """

    kind: str
    other: Sentence | str
    score: Sentence | str


class After(NamedTuple):
    """Where a player goes from a match, when ('': not known), and the opponent or their origin."""

    where: Sentence | str
    at: str
    other: Sentence | str


@dataclass(frozen=True)
class MyMatch:
    """A player's current or next match.

    `seat` is 0 if the player is the first of the two. `pair` is None while the opponent is unknown;
    `needs` and `score` have the first player's games first. `table` is None until the call.
    `starts` is early, middle and late; `middle` is where the middle is between the other two, in
    percent. `last` is whose game can be taken back, 0 or 1; both if it isn't known who won the last
    game.
    """

    name: str
    number: Sentence | str
    round: Sentence | str
    seat: int
    pair: tuple[str, str] | None
    other: Sentence | str
    needs: tuple[int, int] = (0, 0)
    score: tuple[int, int] = (0, 0)
    table: int | None = None
    since: str = ""
    called: int | None = None
    starts: tuple[str, ...] | None = None
    middle: float = 50.0
    last: tuple[int, ...] = ()

    @property
    def hill(self) -> bool:
        """Whether both players need one more game of several."""
        return is_hill(self.needs, self.score)

    @property
    def seen(self) -> str:
        """The score shown on the page, used to check that a tap is up to date."""
        return "{}:{}".format(*self.score)


def match_of(state: Evening, name: str, known: Known | None) -> MyMatch | None:
    """Return a player's current or next match; None if there is nothing to show yet."""
    if not state.drawn or name not in state.order:
        return None
    seat = state.order.index(name)
    ready = [one for one in state.standing.to_play if name in state.pair(one)]
    calls = {match: table for table, match in known.calls} if known and known.of is state else {}
    ready.sort(key=lambda one: (one not in state.on_tables, one not in calls))
    waits = [
        one.name
        for one in state.bracket.matches
        if one.name not in state.standing.winners
        and seat in (seats := state.standing.seats[one.name])
        and NOBODY not in seats
    ]
    found = next(iter([*ready, *waits]), None)
    return None if found is None else shown_match(state, found, name, known)


def shown_match(state: Evening, match: str, name: str, known: Known | None) -> MyMatch:
    """Return a match as one of its players sees it."""
    seats = state.standing.seats[match]
    mine = seats.index(state.order.index(name))
    slot = state.bracket.match(match).slots[1 - mine]
    starts, middle = _times(known, match)
    words: Sentence | str = (
        source_words(slot, state.match_numbers) if isinstance(slot, Source) else ""
    )
    found = MyMatch(
        match,
        state.match_words(match),
        round_names(state).get(match, ""),
        mine,
        None,
        words,
        starts=starts,
        middle=middle,
    )
    if None in seats:
        return found
    return replace(found, **_under_way(state, match, mine, known))


def match_at(state: Evening, match: str) -> MyMatch:
    """Return a playable match as seen from its table."""
    return shown_match(state, match, state.pair(match)[0], None)


def _under_way(state: Evening, match: str, mine: int, known: Known | None) -> dict[str, Any]:
    """Return what can be shown for a match whose players are known."""
    pair = state.pair(match)
    on = state.on_tables.get(match)
    calls = {one: table for table, one in known.calls} if known and known.of is state else {}
    return {
        "pair": pair,
        "other": pair[1 - mine],
        "needs": state.needed(match, pair),
        "score": score_of(state, match) or (0, 0),
        "table": on.call.table if on else None,
        "since": on.at if on else "",
        "called": calls.get(match),
        "last": _last_games(state, match, pair),
    }


def _last_games(state: Evening, match: str, pair: tuple[str, str]) -> tuple[int, ...]:
    """Return who won the last game in a match in play; both if that isn't known."""
    scores: list[dict[str, int]] = []
    for event in state.events:
        what = event.what
        if isinstance(what, Scored) and what.match == match and set(what.players) == set(pair):
            scores.append(dict(zip(what.players, what.score, strict=True)))
    now, before = ([dict.fromkeys(pair, 0)] * 2 + scores)[:-3:-1]
    added = [now[name] - before[name] for name in pair]
    won = tuple(k for k, name in enumerate(pair) if now[name])
    return (added.index(1),) if sorted(added) == [0, 1] else won


def step_of(state: Evening, me: str, mine: MyMatch | None, phones: Phones) -> str:
    """Return the current view of a player's page."""
    if mine is None:
        return "before" if not state.drawn else "rests"
    if mine.pair is None or mine.name not in state.standing.to_play:
        return "waits"
    sides = phones.sides(mine.name, mine.pair)
    if len(sides.proposed) == 2 and not sides.agree:
        return "two"
    if me in sides.proposed:
        return "alone" if sides.agree else "sent"
    if any(mine.score) or sides.proposed or (mine.table and _goes(state, me, mine, phones)):
        return "playing"
    return "up" if mine.table else "waits"


def _goes(state: Evening, me: str, mine: MyMatch, phones: Phones) -> bool:
    """Return whether a called player is on the way or already at the table."""
    return state.plan.form == "chips" or phones.answer(me, mine.name, mine.since) == 0


def chances(
    state: Evening, mine: MyMatch, means: Mapping[str, float]
) -> tuple[float, float, tuple[float, float] | None]:
    """Return the player's chances in the match now, and after losing a game.

    Also return the range it is in eight times out of ten, if either rating is based on few games.
    """
    pair = mine.pair or ("", "")
    me, other = pair[mine.seat], pair[1 - mine.seat]
    needs, won = ((both[mine.seat], both[1 - mine.seat]) for both in (mine.needs, mine.score))
    one, two = state.entrants[me], state.entrants[other]

    def win(off: float, score: tuple[int, int]) -> float:
        if score[1] >= needs[1]:
            return 0.0
        return win_chance(state, (me, other), needs, score, means, off=off)

    band = None
    if {me, other} & set(provisional_in(state)):
        off = _TENTH * float(np.hypot(one.standard_error, two.standard_error))
        band = win(-off, won), win(off, won)
    return win(0.0, won), win(0.0, (won[0], won[1] + 1)), band


def why_words(state: Evening, mine: MyMatch) -> Sentence | str:
    """Return the reason for a match's race, such as '498 against 622: 2 games' start'."""
    if state.plan.form == "chips" or mine.pair is None:
        return ""
    ours, theirs = mine.pair[mine.seat], mine.pair[1 - mine.seat]
    ratings = [f"{round(state.entrants[name].rating, 1):g}" for name in (ours, theirs)]
    start = abs(mine.needs[0] - mine.needs[1])
    if not start:
        return say("{mine} against {theirs}: even race", mine=ratings[0], theirs=ratings[1])
    return say_count(
        "{mine} against {theirs}: a head start of one game",
        "{mine} against {theirs}: a head start of {n} games",
        start,
        mine=ratings[0],
        theirs=ratings[1],
    )


def way_of(state: Evening, me: str, mine: MyMatch | None) -> list[Step]:
    """Return the matches that a player has played, in that order, and the next one."""
    if not state.drawn:
        return []
    at = {name: played[-1].at for name, played in state.records.items()}
    steps = []
    for result in sorted(state.counted.values(), key=lambda one: at.get(one.match, "")):
        if me not in result.players:
            continue
        other = next(one for one in result.players if one != me)
        score: Sentence | str = tally((result.games[me], result.games[other]))
        if result.forfeit:
            score = say("forfeit")
        elif needs := state.uneven_race(result):
            race = race_words(needs if result.players[0] == me else needs[::-1])
            score = say("{score} ({race})", score=score, race=race)
        steps.append(Step("done" if result.winner == me else "forfeit", other, score))
    if mine is not None:
        steps.append(Step("playing", mine.other, mine.starts[1] if mine.starts else ""))
    return steps[-_MOST_STEPS:]


def after(state: Evening, mine: MyMatch, outcome: str, known: Known | None) -> After | None:
    """Return where a player goes after winning or losing a match; None if nowhere or unknown."""
    match, via = mine.name, mine.seat + 1
    if state.plan.form == "swiss":  # the next round is not drawn yet
        return None
    while True:
        onward = [
            (one, k)
            for one in state.whole.matches
            for k, slot in enumerate(one.slots)
            if isinstance(slot, Source)
            and (slot.match, slot.outcome) == (match, outcome)
            and slot.via in (None, via)
        ]
        if not onward:
            return None
        there, k = onward[0]
        seat = state.standing.seats.get(there.name, (None, None))[1 - k]
        if seat != NOBODY:
            break
        match, outcome, via = there.name, "winner", k + 1
    slot = there.slots[1 - k]
    other: Sentence | str = ""
    if seat is not None:
        other = state.order[seat]
    elif isinstance(slot, Source) and slot.match != mine.name:
        other = _from_words(state, slot)
    final = round_names(state).get(there.name, "") if there.side in _FINALS else ""
    where = final or state.match_words(there.name)
    times, _ = _times(known, there.name)
    return After(where, times[1] if times else "", other)


def place_of(
    state: Evening, me: str, prizes: list[float], unit: float = 0.0
) -> tuple[str, float | None]:
    """Return where a player finished, and their share of the prizes; '' until that is known."""
    place = decided_places(state).get(me) if state.drawn else None
    if place is None:
        return "", None
    paid = shared_prize(prizes, place.first, place.last, unit)
    return short_place(place), None if place.event else paid


def _from_words(state: Evening, slot: Source) -> Sentence | str:
    """Return where a player comes from, such as 'loser of match 17'."""
    if slot.outcome == "winner":
        return say("winner of {match}", match=state.match_words(slot.match))
    if slot.outcome == "loser":
        return say("loser of {match}", match=state.match_words(slot.match))
    return source_words(slot, state.match_numbers)


def sides_of(mine: MyMatch, phones: Phones) -> Sides | None:
    """Return what both players in a match propose; None if they aren't known yet."""
    return phones.sides(mine.name, mine.pair) if mine.pair else None


def _times(known: Known | None, match: str) -> tuple[tuple[str, ...] | None, float]:
    """Return when a match starts: early, middle and late; and the middle in percent."""
    if known is None or match not in known.starts:
        return None, 50.0
    early, middle, late = known.starts[match]
    at = tuple(time_of_day(known.start + one) for one in (early, middle, late))
    return at, 100.0 * (middle - early) / (late - early) if late > early else 50.0
