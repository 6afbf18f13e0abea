"""The stream of changes: nothing lost, nothing twice, nothing that is not for everybody."""

from __future__ import annotations

import asyncio
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
from evenbreak.files.store.evening_file import changing, copied
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
from evenbreak.web.watch import Watch
from tiers import examples
from web.asked import Browser, Room
from web.test_watch import AT, begun, scored

SAVED = Path(__file__).parents[1] / "files" / "saved"
CHANGES = "/api/v1/tonight/changes"


class Got(NamedTuple):
    """A message of the stream."""

    mark: str
    event: str
    data: dict[str, Any]

    @property
    def id(self) -> int:
        return int(self.mark.partition("-")[0])


def followed(site: Site, after: str = "", header: str = "") -> list[Got]:
    """Return what a server sends to one who follows it for a moment."""
    with closing(Room(site)) as room:
        browser = Browser(room)
        asked = f"{CHANGES}?after={after}" if after else CHANGES
        given = {"last_event_id": header} if header else {}
        text = browser.tells("GET", asked, **given).text
    found = []
    for block in text.split("\n\n"):
        fields = dict(line.split(": ", 1) for line in block.splitlines() if line[0] != ":")
        if "data" in fields:
            data = msgspec.json.decode(fields["data"])
            assert data["id"] == fields["id"]
            found.append(Got(fields["id"], fields["event"], data))
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
        last, read = "0", list[int]()

        def whole() -> list[int]:
            with closing(sqlite3.connect(path)) as base:
                asked = "SELECT rowid FROM entry WHERE strand IN ('1', 'phones') ORDER BY rowid"
                return [number for (number,) in base.execute(asked)]

        def follow(many: int) -> None:
            nonlocal last, read
            for got in followed(Site(path), header=last)[:many]:
                last = got.mark
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
    first, second = (row.mark for row in rows_from(path, 0, 9))
    for unknown in ("99", "2", "-1", "x", "1" * 40, "2-00000000", f"1{second[1:]}"):
        assert followed(Site(path), header=unknown) == [Got(second, "reset", {"id": second})]
    assert followed(Site(path), after=second) == []
    assert [got.id for got in followed(Site(path), after=first, header="0")] == [1, 2]


def test_another_file_is_told_from_the_one_before_even_if_it_is_a_copy_of_it(
    tmp_path: Path,
) -> None:
    """Tonight's after yesterday's, and the copy with which the night goes on."""
    path, other = tmp_path / "tonight.db", tmp_path / "tomorrow.db"
    begun(path)
    scored(path, 1)
    copy = copied(path, "kept")
    shared = [row.mark for row in rows_from(path, 0, 9)]
    scored(path, 2)
    scored(copy, 3)
    later = "2025-03-02T19:30:00"
    begun(other, later)
    scored(other, 1, later)
    scored(other, 2, later)
    (*_, last) = rows_from(path, 0, 9)
    pages = {one: told_to_pages(Site(one)) for one in (path, copy, other)}
    assert len({*pages.values()}) == 3
    for one in (copy, other):
        assert [got.event for got in followed(Site(one), header=last.mark)] == ["reset"]
    for mark in shared:
        assert [got.event for got in followed(Site(other), header=mark)] == ["reset"]
    assert [got.id for got in followed(Site(copy), header=shared[-1])] == [4]


def told_to_pages(site: Site) -> str:
    with closing(Room(site)) as room:
        return Browser(room).open("/events").text


def test_a_file_that_is_replaced_while_it_is_followed_tells_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, other = tmp_path / "tonight.db", tmp_path / "other.db"
    begun(path)
    begun(other, "2025-03-02T19:30:00")
    monkeypatch.setattr(watch_module, "_LOOK", 0.01)
    watch = Watch(path, 9)

    async def follow() -> tuple[str, bytes]:
        async with watch.following("127.0.0.1"):
            seen = watch.last
            for ending in ("-wal", "-shm"):
                path.with_name(path.name + ending).unlink(missing_ok=True)
            other.replace(path)
            await asyncio.wait_for(watch.after(seen), 5.0)
            return seen, stream.since(watch, {}, seen)

    seen, sent = asyncio.run(follow())
    assert watch.last != seen
    assert watch.last.startswith("2-")
    assert b"event: reset" in sent


def test_matches_and_tables_are_named_as_people_do(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    add_events(path, lambda state: [Event(AT, moves.call(state, "F", 1))])
    scored(path, 3)
    _, second, *rest = (row.mark for row in rows_from(path, 0, 9))
    called, score = (got.data for got in followed(Site(path), after=second))
    assert [called.pop("id"), score.pop("id")] == rest
    both = {"match": "F", "number": "1", "players": ["Ann", "Bo"]}
    assert called == {"at": AT, "kind": "called", "event": 1, "entry": 3, "table": "1"} | both
    assert score == {"at": AT, "kind": "scored", "event": 1, "entry": 4, "score": [3, 0]} | both


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
    got = followed(Site(path), after="0")
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
