"""What the wall and the public page show for a night: tables, who is next, who will win."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime, timedelta
from typing import NamedTuple

from evenbreak.answers.tournament.bracket_view import Panel, bracket_panels
from evenbreak.answers.tournament.moves import event_name
from evenbreak.answers.tournament.time import time_of_day
from evenbreak.tournaments.evening.calling import ready_matches
from evenbreak.tournaments.evening.events import Result
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.money.payouts import with_prizes
from evenbreak.web.desk_view import progress
from evenbreak.web.evening_view import (
    EveningView,
    Favorite,
    MatchView,
    favorites_of,
    progress_of,
    view_of,
)
from evenbreak.web.night import Known, match_chances
from evenbreak.words import Sentence, say, tally

_TURN = 15  # seconds that each picture of the wall is shown
_JUST_CALLED = timedelta(seconds=25)


class TableView(NamedTuple):
    """A table and the match on it, or to be called to it.

    The state is playing, hill, called, two (the players disagree, and no score is shown) or ready.
    `chance` is the first player's; `tag` is the event, if there are several.
    """

    name: str
    state: str
    match: MatchView
    number: Sentence | str
    score: tuple[int, int] | None
    chance: float | None
    tag: Sentence | str = ""


class NextView(NamedTuple):
    """A match that is waiting for a table, and about when it starts; '' if that isn't known.

    If there are several events, `tag` names the match's event.
    """

    match: MatchView
    number: int
    starts: str
    tag: Sentence | str = ""


class Placed(NamedTuple):
    """A place, who has it, and the prize; 0 if there is none."""

    place: str
    name: str
    money: float


@dataclass(frozen=True)
class WallView:
    """A night as everyone sees it.

    `favorites` start with the likeliest winner; `places` are those decided; `chances` are the first
    player's, by match. `parts` are the separate events, if this is a whole night with several.
    """

    name: Sentence | str
    view: EveningView
    tables: Sequence[TableView]
    next: Sequence[NextView]
    favorites: Sequence[Favorite]
    places: Sequence[Placed]
    played: int
    matches: int
    prizes: Sequence[float]
    clock: str
    chances: Mapping[str, float]
    parts: Sequence[WallView] = ()

    @property
    def players(self) -> int:
        """How many are playing tonight."""
        return len({name for one in self.parts or [self] for name in one.state.entrants})

    @property
    def tag(self) -> Sentence | str:
        """Its event's name, if there are several; else ''."""
        return event_name(self.state) if self.state.beside else ""

    @property
    def state(self) -> Evening:
        """The state of the evening."""
        return self.view.state

    @property
    def panels(self) -> tuple[Panel, ...]:
        """The parts of the bracket, marking matches whose players disagree."""
        two = {one.match.name: "two" for one in self.tables if one.state == "two"}
        return bracket_panels(self.state, self.chances, two)

    @property
    def final(self) -> Sentence | str:
        """How the champion won the last match."""
        results = [one.what for one in self.state.events if isinstance(one.what, Result)]
        counted = [one for one in results if one in self.state.counted.values()]
        if not self.places or not counted or counted[-1].winner != self.places[0].name:
            return ""
        last = counted[-1]
        loser = next(name for name in last.players if name != last.winner)
        score = tally((last.games[last.winner], last.games[loser]))
        return say("Final {score} against {player}", score=score, player=loser)

    @property
    def marks(self) -> str:
        """What a rendered page depends on besides the state: calls, disputes, prizes."""
        return (
            " ".join(f"{one.name} {one.state}" for one in self.tables)
            + f"{self.prizes} {self.places}"
        )


def whole_night(views: Sequence[WallView]) -> WallView:
    """Return all the night's events as one: its tables, who is next, when it ends.

    A free table has the match of the first event that would take it.
    """
    going = [one for one in views if one.state.drawn and not one.view.over]
    if len(views) < 2 or not going:
        return views[0]
    every = [table for one in views for table in one.tables]
    tables = {
        one.match.table: one for one in sorted(every, key=lambda one: one.state != "ready")[::-1]
    }
    return replace(
        going[0],
        name=say("Tonight"),
        tables=[one for _, one in sorted(tables.items(), key=lambda one: one[0] or 0)],
        next=sorted((n for one in views for n in one.next), key=lambda n: (not n.starts, n.starts)),
        played=sum(one.played for one in views),
        matches=sum(one.matches for one in views),
        prizes=(),
        parts=tuple(views),
    )


def wall_view(
    state: Evening,
    known: Known | None,
    *,
    name: str,
    now: str,
    prizes: Sequence[float] = (),
    unit: float = 0.0,
    disputed: Collection[str] = (),
) -> WallView:
    """Return a night as everyone sees it; `known` may be for an earlier state.

    `unit` is what shared prizes are rounded down to; in `disputed` matches, the players have sent
    different scores.
    """
    view = view_of(state, known)
    fresh = known if known and known.of is state else None
    chances = match_chances(state, known)
    tables = [
        _table(state, one, now, chances.get(one.name), one.name in disputed)
        for one in (*view.playing, *view.calls)
    ]
    starts = {name: at[1] for name, at in fresh.starts.items()} if fresh else {}
    begun = fresh.start if fresh else 0
    ready = ready_matches(state, known.order if known else ())  # as on the desk
    place = {name: k for k, name in enumerate(ready)}
    waiting = sorted(
        view.waiting,
        key=lambda one: (place.get(one.name, len(place)), starts.get(one.name, math.inf)),
    )
    later = [
        NextView(
            one,
            state.number_of(one.name),
            time_of_day(begun + starts[one.name]) if one.name in starts else "",
            event_name(state) if state.beside else "",
        )
        for one in waiting
    ]
    return WallView(
        event_name(state) if state.beside else state.plan.name or name,
        view,
        sorted(tables, key=lambda one: one.match.table or 0),
        later,
        favorites_of(known),
        [Placed(*one) for one in with_prizes(view.places, prizes, unit)],
        *progress(state),
        prizes,
        now[11:16],
        chances,
    )


def _table(
    state: Evening, one: MatchView, now: str, chance: float | None, disputed: bool
) -> TableView:
    name = state.plan.table_name(one.table or 1)
    kind, score = "ready", one.score
    if disputed:
        kind, score, chance = "two", None, None
    elif one.since:
        if state.plan.form == "chips":
            return TableView(name, "playing", one, state.match_words(one.name), None, None)
        kind = progress_of(state, one.name, now)
        score = one.score or ((0, 0) if kind == "playing" else None)
    tag = event_name(state) if state.beside else ""
    return TableView(name, kind, one, state.match_words(one.name), score, chance, tag)


def pictures_of(view: WallView, *, told: int) -> list[str]:
    """Return the wall's rotation: tables, bracket, story (`told` steps), end, check-in."""
    if not view.state.drawn:
        return ["check-in"]
    bracket = [] if view.state.plan.form == "chips" else ["bracket"]
    story = ["story"] if told > 2 and not view.view.chips else []
    if view.view.over:
        return ["end", "end", *bracket]
    return ["tables", *bracket, "tables", *story]


def turn_at(now: str) -> tuple[int, int]:
    """Return the current item in the rotation, and how many seconds it has left.

    >>> turn_at("2025-03-01T00:00:31")
    (2, 14)
    """
    at = datetime.fromisoformat(now)
    seconds = (at.hour * 60 + at.minute) * 60 + at.second
    return seconds // _TURN, _TURN - seconds % _TURN


def just_called(state: Evening, now: str) -> bool:
    """Return whether a match has just been called."""
    if not state.drawn or state.plan.form == "chips":
        return False
    at = datetime.fromisoformat(now)
    calls = [datetime.fromisoformat(one.at) for one in state.on_tables.values()]
    return any(timedelta(0) <= at - one < _JUST_CALLED for one in calls)
