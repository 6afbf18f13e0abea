"""The stream of entries, for programs that follow the night.

A message's ID identifies its entry (`evenbreak.files.store.changes`): a client that was cut off
continues after the last message it had, from any server on the file, and is told if it is a
different file. Unseen entries stay unseen: for phones and team nights, the stream only says that
something changed, and no addresses or authors are sent.
"""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

import msgspec
from msgspec import Meta
from starlette.responses import Response

from evenbreak.errors import DataError, EvenbreakError
from evenbreak.fields.kinds import Text
from evenbreak.fields.question import Declared, Field
from evenbreak.files.store.changes import Row
from evenbreak.files.store.formats import PHONES, TEAM_NIGHT
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.api.resource import Call, Resource
from evenbreak.web.api.shapes import EventNumber, Number
from evenbreak.web.site import Site
from evenbreak.web.watch import Watch, stream_of

_UNSEEN = {PHONES: "phones", TEAM_NIGHT: "team night"}
_MATCH = ("match", "players")
_SHOWN = {
    "called": (*_MATCH, "table"),
    "called back": _MATCH,
    "scored": (*_MATCH, "score"),
    "result": (*_MATCH, "score", "winner", "forfeit", "corrects"),
    "undone": ("entry",),
    "redone": ("entry",),
}
"""Which details of an entry are sent; for all others, only that it was made."""


@dataclass(frozen=True)
class Change:
    """One of tonight's entries; besides id, at and kind, it has only what its kind has."""

    id: Annotated[
        str,
        Meta(
            description="The entry's position among all entries, plus a checksum of its "
            "content, so that a change of file is noticed. To continue from here, "
            "send it back unchanged."
        ),
    ]
    at: Annotated[str, Meta(description="When the entry was made.")]
    kind: Annotated[
        str,
        Meta(
            description="The type of entry, such as called, scored, result or undone; `phones` "
            "or `team night` if something changed there whose details aren't sent."
        ),
    ]
    event: EventNumber | None = None
    entry: Annotated[int | None, Meta(description="The entry's number in its event.")] = None
    match: Annotated[str | None, Meta(description="The match's name, as in /tonight/matches.")] = (
        None
    )
    number: Number | None = None
    players: Annotated[tuple[str, str] | None, Meta(description="The match's players.")] = None
    score: Annotated[tuple[int, int] | None, Meta(description="Each player's games.")] = None
    winner: Annotated[str | None, Meta(description="The winner, if the entry is a result.")] = None
    forfeit: Annotated[bool | None, Meta(description="Whether the loser forfeited.")] = None
    corrects: Annotated[bool | None, Meta(description="Whether the entry corrects a result.")] = (
        None
    )
    table: Annotated[
        str | None, Meta(description="The house's name for the table, if the entry is a call.")
    ] = None
    of: Annotated[
        int | None, Meta(description="The entry that is undone or redone; if absent, the last one.")
    ] = None


def message(row: Row, state: Evening | None) -> bytes:
    """Return an entry as sent in the stream; b"" for a form that added nothing."""
    if row.strand in _UNSEEN:
        change = Change(row.mark, row.at, _UNSEEN[row.strand])
    elif row.strand.isdigit():
        own = int(row.strand), row.number
        change = Change(row.mark, row.at, row.kind, *own, **_details(row, state))
    else:
        return b""
    data = {name: one for name, one in msgspec.to_builtins(change).items() if one is not None}
    return _message("entry", row.mark, data)


def _details(row: Row, state: Evening | None) -> dict[str, Any]:
    try:
        what = msgspec.json.decode(row.what, type=dict[str, Any])
        found = {name: what[name] for name in _SHOWN.get(row.kind, ()) if what.get(name)}
        if "entry" in found:
            found["of"] = found.pop("entry")
        if "match" in found and state and (number := state.number_of(found["match"])):
            found["number"] = str(number)
        if table := found.pop("table", None):
            found |= {"table": state.plan.table_name(table)} if state else {}
        msgspec.convert({"id": "", "at": "", "kind": "", **found}, Change)
    except (msgspec.MsgspecError, EvenbreakError, TypeError, UnicodeError):
        return {}  # of a damaged entry, the pages say so
    return found


def _message(event: str, mark: str, data: dict[str, Any]) -> bytes:
    return f"id: {mark}\nevent: {event}\ndata: ".encode() + msgspec.json.encode(data) + b"\n\n"


def since(watch: Watch, states: Mapping[str, Evening], last: str) -> bytes:
    """Return what came in after an entry, or the advice to read everything again.

    `last` is the client's name for its last entry.
    """
    new = watch.since(last)
    if new is None:
        return _message("reset", watch.last, {"id": watch.last})
    return b"".join(message(row, states.get(row.strand)) for row in new)


async def _states(site: Site) -> dict[str, Evening]:
    """Return the night's events by strand; none if the file can't be read."""

    def read() -> dict[str, Evening]:
        return {str(one.event): one.state() for one in site.nights if one.exists}

    try:
        return await asyncio.to_thread(read)
    except DataError:
        return {}


async def changes(call: Call) -> Response:
    """Stream entries, from now on or after a given entry."""
    request = call.request
    watch: Watch = request.app.state.watch

    async def told(last: str | None) -> bytes:
        states = await _states(call.site)
        if last is None:
            return f"id: {watch.last}\n\n".encode()
        return since(watch, states, last) or b": alive\n\n"

    after = request.headers.get("last-event-id") or call.values["after"]
    return stream_of(request, told, after)


_AFTER = Declared(
    "after",
    Field(
        Text(),
        "The id of the last entry you have, for programs that can't send Last-Event-ID; 0 for "
        "all entries. Without either, the stream starts with the next entry.",
    ),
    None,
)
RESOURCES = [
    Resource(
        "/tonight/changes",
        "Every entry of the night as it is made, as server-sent events: `entry`, whose data is "
        "described here, and `reset`, which means that entries were missed and you must read "
        "everything again.",
        changes,
        Change,
        asks=(_AFTER,),
        streams=True,
    )
]
"""The API's stream."""
