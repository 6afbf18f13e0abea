"""What a move enters and triggers, and what needs confirming: one way in for every client.

Both the pages' forms and other programs' requests come through here.
"""

from __future__ import annotations

import asyncio
import hashlib
import secrets
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from evenbreak.answers.tournament.move_table import MOVES, name_in
from evenbreak.answers.tournament.moves import lost_words
from evenbreak.evenings.move import AlreadyError, Move
from evenbreak.fields.kinds import Text
from evenbreak.fields.question import declared
from evenbreak.files.store.tournament import Night as Evenings
from evenbreak.files.store.tournament import add_events
from evenbreak.questions.moves import PLAYER
from evenbreak.tournaments.evening.events import Dropped, Event, What
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.undoing import losses, matches_of
from evenbreak.web.forms import LONGEST
from evenbreak.web.guard import RefusalError
from evenbreak.web.night import Night
from evenbreak.web.site import Site
from evenbreak.words import Parameter

_NAMES = (PLAYER, Text("NAME"))
_LONGEST_NAME = 80


def asked_of(question: type, values: Mapping[str, Any]) -> Any:
    """Return a question with these values.

    Raises RefusalError if a string is too long, and InputError for a name that can't be printed, or
    values that the question rejects.
    """
    found = dict(values)
    for one in declared(question):
        value = found.get(one.name)
        is_name = one.kind in _NAMES
        most = _LONGEST_NAME if is_name else LONGEST
        for text in value if isinstance(value, tuple) else (value,):
            if isinstance(text, str) and len(text) > most:
                raise RefusalError(
                    "{field} must not be longer than {longest} characters.",
                    field=Parameter(one.name),
                    longest=most,
                )
        if is_name and value:
            names = isinstance(value, tuple)
            found[one.name] = tuple(map(name_in, value)) if names else name_in(value)
        if one.name == "seed" and value is None:  # so that it draws and says the same
            found["seed"] = secrets.randbelow(2**32)
    return question(**found)


@dataclass(frozen=True)
class Entered:
    """An entry, made or proposed, with the states before and after it.

    A form with several matches has several questions; `already` is what to say about those already
    done.
    """

    move: Move[Evening, What]
    asked: Sequence[Any]
    before: Evening
    after: Evening
    already: Sequence[str] = ()

    def said(self, *, brief: bool = False) -> list[str]:
        """Return the move's message, and anything that may be wrong; if brief, only the latter."""
        if self.already:
            return [*self.already]
        both = self.before, self.after
        words = [] if brief else [line for one in self.asked for line in self.move.said(*both, one)]
        words += [line for one in self.asked for line in self.move.doubts(*both, one)]
        return list(dict.fromkeys(words))

    @property
    def would(self) -> list[str]:
        """What it would do and remove, in words."""
        words = self.move.would(self.before, self.after) if self.move.would else ()
        return [*words, *self.lost] or self.said()

    @property
    def lost(self) -> list[str]:
        """What it removes, in words."""
        return [*lost_words(self.before, self.after)]

    @property
    def name(self) -> str:
        """The key of a question about it: the matches that it is about, and the matches in play."""
        lost = sorted((one.match, *sorted(one.players)) for one in losses(self.before, self.after))
        text = repr(lost or sorted(matches_of(self.before, self.after)))
        return hashlib.sha256(text.encode()).hexdigest()[:16]


class SureError(Exception):
    """Whether the entry removes something, or needs confirming in any case."""

    def __init__(self, would: Entered) -> None:
        self.would = would


async def enter(
    site: Site,
    night: Night,
    move: Move[Evening, What],
    asked: Sequence[Any],
    *,
    by: str,
    key: str | None,
    sure: bool = False,
    named: str = "",
    everywhere: bool = False,
    check: Callable[[Evening], None] | None = None,
) -> Entered:
    """Enter what was requested, with the calls that a result makes automatically.

    `by` is the author as stored; a form or request is accepted once, by its `key`. `sure`: the loss
    has been confirmed, if the question answered was `named` ('': any); if something else would be
    lost by now, it must be confirmed again. `everywhere`: a player who goes home does so in all
    events. `check` gets the state before; if it raises an error, nothing is entered. Raises
    SureError if confirmation is needed, and TakenBeforeError if the form was accepted before.
    """
    at, already = site.clock(), list[str]()

    def decide(state: Evening) -> list[Event]:
        if check:
            check(state)
        events: list[Event] = []
        for one in asked:
            now = state.then(*events) if events else state
            try:
                events += [Event(at, what) for what in move.decide(now, one, at)]
            except AlreadyError as error:  # the same tap again
                already.append(error.sentence)
        return events

    def ask(before: Evening, after: Evening) -> None:
        would = Entered(move, asked, before, after, already)
        if (move.would or would.lost) and not (sure and named in ("", would.name)):
            raise SureError(would)

    def home(before: Evenings, _: Evenings) -> Sequence[tuple[int, What]]:
        player = asked[0].player
        return [(n, Dropped(player)) for n in other_events(before[night.event], player)]

    more = site.next_calls if move is MOVES["result"] else home if everywhere else None
    before, after = await asyncio.to_thread(
        add_events, night.path, decide, event=night.event, by=by, form=key, check=ask, more=more
    )
    return Entered(move, asked, before, after, already)


def other_events(state: Evening, player: str) -> list[int]:
    """Return the night's other events that a player who is going home is in."""
    events = [one for one in state.beside if player in one.entrants]
    return [one.event for one in events if player not in one.dropped]
