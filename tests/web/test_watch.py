"""One look at the file for all who follow it."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from evenbreak.errors import DataError
from evenbreak.files.store.changes import CLEARED, Row, rows_from
from evenbreak.files.store.tournament import add_events, delete_tournament, new_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
from evenbreak.web import watch as watch_module
from evenbreak.web.site import Site
from evenbreak.web.watch import Watch
from web.asked import Browser, Room

AT = "2025-03-01T19:30:00"


def begun(path: Path, at: str = AT) -> None:
    """Draw two players, whose match can be called."""
    opened = Opened(Plan("single", 5), (Entrant("Ann", 80.0), Entrant("Bo", 70.0)))
    new_tournament(path, [Event(at, opened), Event(at, Drawn(("Ann", "Bo"), (0, 1)))])


def scored(path: Path, a: int, at: str = AT) -> None:
    """Enter a score, as a command would."""
    add_events(path, lambda state: [Event(at, moves.score(state, "F", (a, 0)))])


def test_what_is_entered_here_is_seen_at_once_and_what_is_entered_elsewhere_soon(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    room = Room(Site(path))
    director = Browser(room, director=True)
    watch: Watch = room.app.state.watch
    watch.closing = False
    fields = {**director.hidden(), "match": "F", "table": "1", "once": "one"}

    async def follow(enter: bool) -> tuple[str, str]:
        async with watch.following("127.0.0.1"):
            seen = watch.last
            if enter:
                await asyncio.sleep(0.01)  # its own look is over, and the next far away
                got = await director.asking("POST", "/desk/call", fields)
                assert got.status == 303, got.words
            else:
                scored(path, 1)
            await asyncio.wait_for(watch.after(seen), 5.0)
            return seen[:2], watch.last[:2]

    monkeypatch.setattr(watch_module, "_LOOK", 60.0)
    assert room.loop.run_until_complete(follow(True)) == ("2-", "3-")
    monkeypatch.setattr(watch_module, "_LOOK", 0.02)
    assert room.loop.run_until_complete(follow(False)) == ("3-", "4-")
    assert not watch.followers
    room.close()


def test_an_id_is_never_given_again(tmp_path: Path) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    scored(path, 1)
    delete_tournament(path)
    begun(path)
    rows = rows_from(path, 0, 99)
    assert [(row.id, row.strand) for row in rows] == [(5, CLEARED), (6, "1"), (7, "1")]
    delete_tournament(path)
    assert [row.id for row in rows_from(path, 0, 99)] == [8]


def test_a_file_that_cannot_be_read_for_a_moment_is_read_at_the_next_look(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "tonight.db"
    begun(path)
    watch, fails = Watch(path, 9), [True, False]

    def sometimes(*asked: Any) -> list[Row]:
        if fails.pop(0):
            raise DataError("in use")
        return rows_from(*asked)

    async def follow() -> str:
        async with watch.following("127.0.0.1"):
            seen = watch.last
            scored(path, 1)
            monkeypatch.setattr(watch_module, "rows_from", sometimes)
            monkeypatch.setattr(watch_module, "_LOOK", 0.01)
            watch.wake()
            await asyncio.wait_for(watch.after(seen), 5.0)
            return watch.last

    assert asyncio.run(follow()).startswith("3-")
