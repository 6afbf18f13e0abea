"""Entries by other programs: an address for each move, based on the table of moves.

A request is entered like a form on the desk, and its author is the program. Its Idempotency-Key is
stored with the entry: if the same request comes again, it is answered, but nothing is entered
twice.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import MISSING, dataclass
from functools import partial
from typing import Annotated, Any

from msgspec import Meta

from evenbreak.answers.tournament.move_table import MOVES
from evenbreak.fields.kinds import Flag, Kind
from evenbreak.fields.question import Declared, Field, declared
from evenbreak.files.store.log import TakenBeforeError, entries_of, forms_with
from evenbreak.files.store.tokens import DIRECTOR, MOVES_OF_SCORES, SCORES
from evenbreak.files.store.tournament import read_events
from evenbreak.questions.common import SCORE
from evenbreak.questions.moves import COMMANDS
from evenbreak.tournaments.evening.fold import Evening, evening
from evenbreak.tournaments.evening.known import known_match
from evenbreak.tournaments.evening.undoing import losses
from evenbreak.web.api import shapes
from evenbreak.web.api.problem import Lost, ProblemError, face_of, in_full
from evenbreak.web.api.resource import EVENT, Call, Resource
from evenbreak.web.api.seen import match_of, night_asked, seen_of
from evenbreak.web.api.tokens import check_still, token_of
from evenbreak.web.entering import Entered, SureError, asked_of, enter
from evenbreak.web.night import Night, score_of
from evenbreak.web.pages.moves import OF_COMMANDS
from evenbreak.words import joined, say, tally


class _Agreed(Kind):
    """Yes, or the name of the question answered with yes."""

    metavar = ""

    def load(self, value: Any) -> bool | str:
        """Return the value that JSON stands for."""
        return value if isinstance(value, str) else Flag().load(value)

    def schema(self) -> dict[str, Any]:
        """Return the JSON schema for such a value."""
        return {"type": ["boolean", "string"]}


_SURE = Declared(
    "sure",
    Field(
        _Agreed(),
        "Enter it even if a match in play leaves its table or a result no longer counts. The "
        "value of 'sure' from the refusal agrees to exactly what the refusal listed; true "
        "agrees to anything.",
    ),
    False,
)
_SEEN = Declared(
    "seen",
    Field(SCORE, "The score as you last saw it; if it has changed since, the request is refused."),
    None,
)
_OWN = ("sure", "seen")
_ENTRY = "The entry's number, from `entries` in an answer, from the stream or from the history."
_TAPS = ("score", "result")
_KEY = re.compile(r"[!-~]{1,200}")


@dataclass(frozen=True)
class Written:
    """What was entered."""

    event: shapes.EventNumber
    said: Annotated[list[str], Meta(description="What the request changed, in words.")]
    entries: Annotated[list[int], Meta(description="The numbers of the new entries.")]
    matches: Annotated[list[shapes.Match], Meta(description="The matches that changed.")]
    taken_before: Annotated[
        bool,
        Meta(
            description="Whether the same request had come before, so that nothing was "
            "entered this time."
        ),
    ]


async def _entered(name: str, call: Call) -> Written:
    """Enter a program's request."""
    night, move, request = night_asked(call), MOVES[name], call.request
    if not night.exists:
        raise ProblemError("No tournament is running yet.", status=404)
    values = {key: value for key, value in call.values.items() if key not in (*_OWN, "event")}
    asked = asked_of(move.question, values)
    key, whole = _key(name, call)
    sure = call.values["sure"]

    def check(state: Evening) -> None:
        match = getattr(asked, "match", None)
        check_still(request, state, match)
        if key and (earlier := forms_with(night.path, key)):
            _refuse_other(earlier, whole)
        if (seen := call.values.get("seen")) is not None:
            _check_seen(state, match, seen)

    try:
        done = await enter(
            call.site,
            night,
            move,
            [asked],
            by=token_of(request).author,
            key=whole,
            sure=bool(sure),
            named=sure if isinstance(sure, str) else "",
            check=check,
        )
    except SureError as error:
        raise _sure(error.would) from None
    except TakenBeforeError:
        said = say("You entered that before. Nothing was entered twice.")
        numbers = entries_of(night.path, whole or "")
        events = read_events(night.path, night.event)[: numbers[-1]] if numbers else []
        then = evening(events[: numbers[0] - 1]) if numbers else None
        matches = await _matches(call, night, then, evening(events)) if then else []
        return Written(night.event, [said], numbers, matches, True)
    numbers = list(range(len(done.before.log) + 1, len(done.after.log) + 1))
    matches = await _matches(call, night, done.before, done.after)
    words = [in_full(one, face_of(request)) for one in done.said()]
    return Written(night.event, words, numbers, matches, False)


def _key(name: str, call: Call) -> tuple[str, str | None]:
    """Return a key for a request and its program, and one that includes its content."""
    given = call.request.headers.get("idempotency-key")
    if given is None:
        return "", None
    if not _KEY.fullmatch(given):
        raise ProblemError(
            "{field} must be 1 to 200 letters, digits or signs.",
            parameter="Idempotency-Key",
            field="Idempotency-Key",
        )
    sent = json.dumps([name, call.values], sort_keys=True, default=str)
    key = f"program {_hashed(token_of(call.request).name, given)} "
    return key, key + _hashed(sent)


def _hashed(*texts: str) -> str:
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:32]


def _refuse_other(earlier: set[str], whole: str | None) -> None:
    if whole not in earlier:
        raise ProblemError(
            "This Idempotency-Key was already used for a different request. Use a new key for "
            "each request.",
            status=422,
            parameter="Idempotency-Key",
        )


def _check_seen(state: Evening, match: str | None, seen: tuple[int, int]) -> None:
    """Reject a request made for an earlier score."""
    name = known_match(state, match or "")
    now = score_of(state, name) or (0, 0)
    if name in state.standing.to_play and now != seen:
        raise ProblemError(
            "The score of {match} is {score} now.",
            status=409,
            parameter="seen",
            more={"score": now},
            match=state.match_words(name),
            score=tally(now),
        )


def _sure(would: Entered) -> ProblemError:
    """Return a request for confirmation, with what would be lost."""
    state = would.before
    lost = [
        Lost(
            str(state.number_of(one.match) or one.match),
            one.players,
            None if one.table is None else state.plan.table_name(one.table),
            one.score if one.result is None or one.result.forfeit else one.result.score,
            one.result is not None,
        )
        for one in losses(state, would.after)
    ]
    more = {"how": {"sure": would.name}, "lost": lost}
    return ProblemError(joined(would.would, " "), status=409, more=more)


async def _matches(call: Call, night: Night, before: Evening, after: Evening) -> list[shapes.Match]:
    """Return the matches that changed, as everyone sees them."""
    if not after.drawn or not after.log[len(before.log) :]:
        return []
    then = before if before.drawn else None

    def stands(state: Evening | None, name: str) -> object:
        if state is None:
            return None
        of = (state.counted, state.on_tables, state.live, state.waiting_for, state.standing.seats)
        return tuple(one.get(name) for one in of)

    changed = {name for name in after.bracket.by_name if stands(then, name) != stands(after, name)}
    seen = await seen_of(call, night)
    found = [match_of(seen, part, box) for part in seen.panels for box in part.boxes
             if box.match in changed]  # fmt: skip
    return sorted(found, key=lambda one: int(one.number))


def _resources() -> Iterator[Resource]:
    for name, move in MOVES.items():
        fields = [
            # What was entered last may be another program's: the entry must be named.
            Declared("entry", Field(one.kind, _ENTRY), MISSING) if one.name == "entry" else one
            for one in declared(move.question)
            if one.name not in (*OF_COMMANDS, "event")
        ]
        more: Sequence[Declared] = [_SEEN, _SURE] if name in _TAPS else [_SURE]
        yield Resource(
            f"/tonight/{name}",
            COMMANDS[name][1],
            partial(_entered, name),
            Written,
            "POST",
            (*fields, *more, EVENT),
            SCORES if name in MOVES_OF_SCORES else DIRECTOR,
        )


RESOURCES = list(_resources())
"""An address for each move in the table."""
