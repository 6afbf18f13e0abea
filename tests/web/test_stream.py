"""The stream of changes: nothing lost, nothing twice, nothing that is not for everybody."""

from __future__ import annotations

import shutil
import sqlite3
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace
from typing import Any, NamedTuple

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from evenbreak.files.store.changes import rows_from
from evenbreak.files.store.desk import (
    CLAIMED,
    PROPOSED,
    Act,
    by_phone,
    enter,
)
from evenbreak.files.store.evening_file import changing
from evenbreak.files.store.tournament import (
    add_events,
    delete_tournament,
    read_tournament,
)
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import CheckedIn, Event, Registered, Undone
from evenbreak.web import watch as watch_module
from evenbreak.web.api import stream
from evenbreak.web.server import server_of
from evenbreak.web.site import Site
from tiers import examples
from web.asked import Browser, Room
from web.test_watch import AT, begun, scored

SAVED = Path(__file__).parents[1] / "files" / "saved"
CHANGES = "/api/v1/tonight/changes"


class Got(NamedTuple):
    """A message of the stream."""

    id: int
    event: str
    data: dict[str, Any]


def followed(site: Site, after: int | None = None, header: str = "") -> list[Got]:
    """Return what a server sends to one who follows it for a moment."""
    with closing(Room(site)) as room:
        browser = Browser(room)
        asked = f"{CHANGES}?after={after}" if after is not None else CHANGES
        given = {"last_event_id": header} if header else {}
        text = browser.tells("GET", asked, **given).text
    found = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if line[0] != ":")
        if "data" in fields:
            data = msgspec.json.decode(fields["data"])
            found.append(Got(int(fields["id"]), fields["event"], data))
    return found


@dataclass(eq=False)
class Line:
    """A connection."""

    cycle: Any
    flow: Any
    transport: Any
    aborted: list[bool]


@pytest.mark.slow
@settings(max_examples=examples(12))
@given(
    st.lists(
        st.one_of(
            st.tuples(st.just("enter"), st.integers(1, 4)),
            st.tuples(st.just("phone"), st.just(1)),
            st.tuples(st.just("follow"), st.integers(0, 6)),
            st.tuples(st.just("anew"), st.just(1)),
        ),
        max_size=12,
    ),
    st.integers(3, 8),
)
def test_whoever_is_cut_off_and_comes_back_loses_nothing_and_gets_nothing_twice(
    acts: list[tuple[str, int]], most: int
) -> None:
    """Or is told to read everything anew. Each time another server answers."""
    with TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
        patch.setattr(watch_module, "MOST", most)
        path = Path(folder) / "tonight.db"
        begun(path)
        last, read = 0, list[int]()

        def whole() -> list[int]:
            with closing(sqlite3.connect(path)) as base:
                asked = "SELECT rowid FROM entry WHERE strand IN ('1', 'phones') ORDER BY rowid"
                return [number for (number,) in base.execute(asked)]

        def follow(many: int) -> None:
            nonlocal last, read
            for got in followed(Site(path), header=str(last))[:many]:
                last = got.id
                read = whole() if got.event == "reset" else [*read, got.id]

        for act, many in [*acts, ("follow", 999)]:
            match act:
                case "enter":
                    for k in range(many):
                        scored(path, k)
                case "phone":
                    state = read_tournament(path)
                    enter(path, state, lambda _: Act(PROPOSED, "Ann", "F", {"Ann": 5}), at=AT)
                case "anew":
                    delete_tournament(path)
                    begun(path)
                case _:
                    follow(many)
        assert read == whole()


def test_an_id_that_is_not_known_begins_now_and_says_so(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    assert followed(Site(path)) == []
    for unknown in ("99", "-1", "x", "1" * 40):
        assert followed(Site(path), header=unknown) == [Got(2, "reset", {"id": 2})]
    assert followed(Site(path), after=2) == []
    assert [got.id for got in followed(Site(path), after=1, header="0")] == [1, 2]


def test_matches_and_tables_are_named_as_people_do(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    add_events(path, lambda state: [Event(AT, moves.call(state, "F", 1))])
    scored(path, 3)
    called, score = (got.data for got in followed(Site(path), after=2))
    both = {"match": "F", "number": "1", "players": ["Ann", "Bo"]}
    assert (
        called == {"id": 3, "at": AT, "kind": "called", "event": 1, "entry": 3, "table": "1"} | both
    )
    assert (
        score
        == {"id": 4, "at": AT, "kind": "scored", "event": 1, "entry": 4, "score": [3, 0]} | both
    )


def test_what_is_private_is_not_sent(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    state = read_tournament(path)
    claim = Act(CLAIMED, "Ann")
    enter(path, state, lambda _: claim, at=AT, by=by_phone("session", "10.0.0.7"))
    private = [
        CheckedIn("Ann", paid=False),
        Registered("Shy Person", 500.0),
        Undone(),
    ]
    add_events(path, lambda _: [Event(AT, what) for what in private], by="phone session 10.0.0.7")
    got = followed(Site(path), after=0)
    kinds = ["opened", "drawn", "phones", "checked in", "registered", "undone"]
    assert [one.data["kind"] for one in got] == kinds
    sent = {name for one in got for name in one.data}
    assert sent == {"id", "at", "kind", "event", "entry"}


def test_the_entries_of_earlier_versions_keep_their_ids(tmp_path: Path) -> None:
    path = Path(shutil.copy(SAVED / "v0_2_0" / "tournament.db", tmp_path))
    before = rows_from(path, 0, 999)
    with changing(path):
        pass
    assert before == rows_from(path, 0, 999) != []


def test_a_follower_who_does_not_read_is_dropped(tmp_path: Path) -> None:
    server: Any = server_of(Site(tmp_path / "tonight.db"), port=0)

    def line(paused: bool, left: list[int]) -> Any:
        """A connection that is being answered, with so many bytes left to read at each look."""
        aborted: list[bool] = []
        transport = SimpleNamespace(
            get_write_buffer_size=lambda: left.pop(0), abort=lambda: aborted.append(True)
        )
        cycle = SimpleNamespace(response_complete=False)
        flow = SimpleNamespace(write_paused=paused)
        return Line(cycle, flow, transport, aborted)

    reads, slowly, never = line(False, []), line(True, [9, 5, 3]), line(True, [9, 9, 9])
    server.server_state.connections = {reads, slowly, never}
    server._end_idle()
    server._end_idle()
    assert [bool(one.aborted) for one in (reads, slowly, never)] == [False, False, True]


def test_the_description_says_what_a_message_holds(tmp_path: Path) -> None:
    with closing(Room(Site(tmp_path / "tonight.db"))) as room:
        told = Browser(room).tells("GET", "/api/v1/openapi.json").json
    asked = told["paths"][CHANGES]["get"]
    (media,) = asked["responses"]["200"]["content"]
    assert media == "text/event-stream"
    assert "after" in {one["name"] for one in asked["parameters"]}
    assert "corrects" in told["components"]["schemas"][stream.Change.__name__]["properties"]
