"""Tonight as the API sees it: events, what is known about them, and their matches."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Sequence
from datetime import datetime, timedelta
from functools import lru_cache
from typing import Any, NamedTuple

from evenbreak.answers.tournament.bracket_view import Box, Panel
from evenbreak.answers.tournament.moves import event_name
from evenbreak.answers.tournament.tournament import short_place
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.listed import decided_places
from evenbreak.web.api import shapes
from evenbreak.web.api.problem import ProblemError
from evenbreak.web.api.resource import V1, Call, Kept
from evenbreak.web.evening_view import progress_of
from evenbreak.web.night import Known, Night
from evenbreak.web.pages.wall import view_for
from evenbreak.web.wall_view import WallView
from evenbreak.words import Sentence

_TEAM = f"{V1}/tonight/team"
PLACES = 4
"""How many decimals a chance has."""


class Seen(NamedTuple):
    """An event as everyone sees it; `known` may be for an earlier state (None: nothing yet)."""

    view: WallView
    known: Known | None
    now: str

    @property
    def state(self) -> Evening:
        """Its state."""
        return self.view.state

    @property
    def fresh(self) -> Known | None:
        """What has been calculated for exactly this state."""
        return self.known if self.known and self.known.of is self.state else None

    @property
    def event(self) -> int:
        """Its number."""
        return self.state.event

    @property
    def name(self) -> Sentence | str:
        """Its name."""
        return event_name(self.state) if self.state.beside else self.view.name

    @property
    def stage(self) -> Any:
        """How far along it is."""
        if not self.state.drawn:
            return "registered"
        return "finished" if self.view.view.over else "under_way"

    @property
    def champion(self) -> str:
        """Who has won it; '' until that is decided."""
        first = [name for place, name in self.places if place == "1"]
        return first[0] if len(first) == 1 and self.view.view.over else ""

    @property
    def places(self) -> list[tuple[str, str]]:
        """The places decided, and who has them."""
        decided = decided_places(self.state) if self.state.drawn else {}
        first = sorted(decided.items(), key=lambda one: (one[1].event, one[1]))
        return [(short_place(place), name) for name, place in first]

    @property
    def panels(self) -> tuple[Panel, ...]:
        """The parts of its bracket; none before the draw."""
        return self.view.panels if self.state.drawn else ()


def night_asked(call: Call) -> Night:
    """Return the named event, or else the first."""
    event = call.values.get("event") or 1
    for night in call.site.nights:
        if night.event == event:
            return night
    raise ProblemError("There is no event {n} tonight.", status=404, parameter="event", n=event)


async def seen_of(call: Call, night: Night) -> Seen:
    """Return an event as everyone sees it."""
    now = call.site.clock()
    view, state = await view_for(call.request, night, now)
    known = night.known
    if known and known.of.events[:1] != state.events[:1]:  # of another tournament
        known = None
    return Seen(view, known, now)


def told(make: Callable[[Call, Seen, Sequence[Seen]], Any]) -> Callable[[Call], Awaitable[Kept]]:
    """Return a resource's answer function, given one of an event and all the night's events."""

    async def answer(call: Call) -> Kept:
        if not call.site.night.exists:
            if await call.site.teams.now() is not None:
                raise ProblemError(
                    "Tonight is a team night. It is at {address}.", status=404, address=_TEAM
                )
            raise ProblemError("No tournament is running yet.", status=404)
        asked = night_asked(call)
        nights = [await seen_of(call, night) for night in call.site.nights]
        of = [part for one in nights for part in (one.state, one.known or "", one.view.marks)]
        mine = next(one for one in nights if one.event == asked.event)
        return Kept(("api", *of), lambda: make(call, mine, nights))

    return answer


def match_of(seen: Seen, panel: Panel, box: Box) -> shapes.Match:
    """Return a match in the bracket."""
    state, name = seen.state, box.match
    table, result = state.on_tables.get(name), state.counted.get(name)
    standing: Any = box.state
    if table is not None:
        chips = state.plan.form == "chips"
        standing = "called" if not chips and _walks(seen, name) else "playing"
    to, played = _onward(state).get(name, {}), state.records.get(name, ())
    begins = seen.fresh.starts.get(name) if seen.fresh else None
    needs: tuple[int | None, int | None] = None, None
    if all(line.known for line in box.lines):
        needs = state.needed(name, state.pair(name))
    return shapes.Match(
        str(box.number),
        name,
        state.event,
        panel.title,
        box.title or panel.rounds[box.column].title,
        box.column,
        (_side(box, 0, needs[0]), _side(box, 1, needs[1])),
        standing,
        box.state == "hill",
        box.state == "two",
        box.table,
        table.at if table else None,
        played[-1].at if played and result else None,
        times_of(seen.fresh, begins),
        to.get("winner"),
        to.get("loser"),
    )


def _walks(seen: Seen, name: str) -> bool:
    """Return whether a match's players are still on their way to its table."""
    return progress_of(seen.state, name, seen.now) == "called"


def _side(box: Box, seat: int, needs: int | None) -> shapes.Side:
    line = box.lines[seat]
    games = int(line.score) if line.score.isdecimal() and box.state != "two" else None
    chance = None if line.chance is None else round(line.chance, PLACES)
    name, origin = (line.text, "") if line.known else ("", line.text)
    return shapes.Side(name, origin, needs, games, line.won, chance)


@lru_cache(maxsize=4)
def _onward(state: Evening) -> dict[str, dict[str, str]]:
    """Return the numbers of the matches that a match's winner and loser go to."""
    to: dict[str, dict[str, str]] = {}
    for match in state.bracket.matches:
        for slot in match.slots:
            number = state.number_of(match.name)
            if isinstance(slot, Source) and slot.via is None and number:
                to.setdefault(slot.match, {})[str(slot.outcome)] = str(number)
    return to


def times_of(known: Known | None, at: Sequence[float] | None) -> shapes.Times | None:
    """Return times given in minutes after the start of the evening."""
    if known is None or at is None or not known.day:
        return None
    midnight = datetime.fromisoformat(known.day)
    early, middle, late = (
        (midnight + timedelta(minutes=round(known.start + one))).isoformat() for one in at
    )
    return shapes.Times(early, middle, late)
