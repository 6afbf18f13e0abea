"""Forms that come in several times at once, and again later: each is entered once at most."""

from __future__ import annotations

import asyncio
import random
import re
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from evenbreak.files.store.desk import phone_entries
from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import read_events
from evenbreak.web.app import OF_THE_SESSION, make_app
from evenbreak.web.night import Night
from evenbreak.web.site import Site
from tries import tries
from web.asked import Browser, Got, Room
from web.test_who_may import NEW, TEAMS

REPLAYS = tries("forms that come in again", 3)
ANSWERS = (200, 303, 400, 403, 404, 409)
NOT_HERE = {
    *OF_THE_SESSION,
    *("/team/pin", "/team/leave", "/league", "/league/tonight", "/desk/save", "/desk/calling"),
    *("/desk/second-chance", "/desk/programs/create", "/desk/programs/revoke", "/desk/phones"),
}
"""Routes that add no entry: those of a session, the league's, a copy of the file, a setting, a
token."""


class Hall:
    """A drawn tournament and a team night, with a director, two players and two captains."""

    def __init__(self, path: Path) -> None:
        self.room = Room(Site(path, hosts=frozenset({"localhost"})))
        self.path, site = path, self.room.site
        self.director = Browser(self.room, director=True)
        self.begins()
        assert self.director.send("/team/new", **TEAMS).status == 303
        (began,) = re.findall(r'name="night" value="(\d+)"', self.director.open("/team").text)[:1]
        self.night = int(began)
        self.pair = site.night.state().pair("W1.1")
        self.tablet = Browser(self.room, director=True)
        self.captains = [Browser(self.room, address=f"10.0.1.{k}") for k in (1, 2)]
        for side, browser in enumerate(self.captains):
            pin = site.captain_pin(self.night, side)
            assert browser.send("/team/pin", pin=pin).status == 303
        self.players = [Browser(self.room, address=f"10.0.2.{k}") for k in (1, 2)]
        for side, browser in enumerate(self.players):
            assert browser.claims(self.pair[side]).status == 303

    def begins(self) -> None:
        """Begin a tournament, if there is none."""
        if not self.room.site.night.exists:
            for where, fields in (("/new", NEW), ("/desk/draw", {})):
                assert self.director.send(where, **fields).status == 303

    def entries(self) -> tuple[int, int, int]:
        """Return how many entries there are: of the tournament, the team night, the phones."""
        there = self.room.site.night.exists
        files = (
            read_events(self.path) if there else [],
            read_team_events(self.path),
            phone_entries(self.path),
        )
        return len(files[0]), len(files[1]), len(files[2])

    def forms(self) -> dict[str, tuple[Browser, str, dict[str, Any]]]:
        """Return a form of each route, as it would be taken once."""
        site, director = self.room.site, self.director
        state = site.night.state()
        night: dict[str, Any] = {"night": self.night, "number": 1}
        three = {"match": "W1.3"}
        picks = {f"pick{k}": k - 1 for k in (1, 2, 3)}
        tap = {"match": "W1.1", "player_a": self.pair[0], "player_b": self.pair[1], "seen": "0:0"}
        tablet = self.tablet
        return {
            name: (browser, path, fields)
            for name, browser, path, fields in [
                ("call", director, "/desk/call", {"match": "W1.2", "table": 1}),
                ("back", director, "/desk/uncall", {"match": "W1.2"}),
                ("result", director, "/desk/result", {**three, "a": 3, "b": 1}),
                ("correct", director, "/desk/correct",
                 {**three, "a": 1, "b": 3, "sure": "yes"}),
                ("score", director, "/desk/score", {**three, "a": 1, "b": 1}),
                ("wait", director, "/desk/wait", {"match": "W1.4", "reason": "late"}),
                ("rename", director, "/desk/rename", {"player": "Ann", "to": "Annie"}),
                ("substitute", director, "/desk/substitute",
                 {"player": "Gus", "to": "Zoe", "sure": "yes"}),
                ("swap", director, "/desk/swap", {"one": "Gus", "other": "Hal", "sure": "yes"}),
                ("check in", director, "/desk/check-in", {"player": "Ann"}),
                ("redo", director, "/desk/redo", {}),
                ("swap tables", director, "/desk/swap-tables", {"one": "W1.1", "other": "W1.2"}),
                ("accept", director, "/desk/accept", {"name": "Zoe"}),
                ("decline", director, "/desk/decline", {"name": "Zoe"}),
                ("forfeit", director, "/desk/forfeit", {"player": "Hal", "sure": "yes"}),
                ("drop", director, "/desk/drop", {"player": "Gus", "sure": "yes"}),
                ("change", director, "/desk/change", {"tables": 3}),
                ("undo", director, "/desk/undo", {"entry": state.numbers[-1], "sure": "yes"}),
                ("late", director, "/desk/late", {"player": "Late Larry", "rating": 500}),
                ("entrant", director, "/desk/edit", {"player": "Ann", "name": "Annie"}),
                ("draw", director, "/desk/draw", {}),
                ("tiebreak", director, "/desk/tiebreak", {}),
                ("stand", director, "/desk/stand", {"match": "W1.3"}),
                ("pin", director, "/desk/pin", {}),
                ("prizes", director, "/prizes", {"fee": 10, "added": 0, "payout": "60/40"}),
                ("new", director, "/new", NEW),
                ("delete", director, "/desk/delete", {"sure": "yes"}),
                ("team new", director, "/team/new", {**TEAMS, "team_a": "Others"}),
                ("team undo", director, "/team/undo", {"seen": len(read_team_events(self.path))}),
                ("hand", self.captains[0], "/team/hand", {**night, "by": 0, **picks}),
                ("hand b", self.captains[1], "/team/hand", {**night, "by": 1, **picks}),
                ("put", director, "/team/put", {**night, "by": "director", "team": 0, "pick": 0}),
                ("propose", self.captains[0], "/team/result", {**night, "by": 0, "a": 5, "b": 3}),
                ("set", director, "/team/result", {**night, "by": "director", "a": 5, "b": 3}),
                ("tap", self.players[0], "/me/score", {**tap, "a": 1, "b": 0}),
                ("full", self.players[0], "/me/score", {**tap, "a": 3, "b": 1}),
                ("agree", self.players[1], "/me/score", {**tap, "a": 3, "b": 1}),
                ("take back", self.players[1], "/me/withdraw", {"match": "W1.1"}),
                ("coming", self.players[1], "/me/coming", {"match": "W1.1", "minutes": 5}),
                ("register", self.players[1], "/play", {"name": "Zoe"}),
                ("claim", self.players[0], "/me/claim", {"name": self.pair[0]}),
                ("code", self.players[0], "/me/code", {"code": site.player_code(self.pair[0])}),
                ("leave", self.players[0], "/me/leave", {}),
                ("release", director, "/desk/release", {"player": self.pair[0]}),
                ("tablet", tablet, "/table/1/tablet", {"give": "yes"}),
                ("at a table", tablet, "/table/1/score", {**tap, "a": 1, "b": 0}),
                ("wrong", tablet, "/table/1/wrong", {"match": "W1.3"}),
            ]
        }  # fmt: skip


async def together(browser: Browser, path: str, form: dict[str, Any], times: int) -> list[Got]:
    return await asyncio.gather(*(browser.asking("POST", path, form) for _ in range(times)))


@pytest.fixture
def hall(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Hall]:
    async def not_yet(_: Night) -> None:
        """The odds are worked out beside."""

    monkeypatch.setattr(Night, "outlook", not_yet)
    found = Hall(tmp_path / "tonight.db")
    with closing(found.room):
        yield found


def test_every_route_that_adds_an_entry_is_tried(hall: Hall) -> None:
    posts = {
        one.path
        for one in make_app(hall.room.site).routes
        if "POST" in (getattr(one, "methods", None) or ()) and not one.path.startswith("/api/")
    }
    tried = {re.sub("/table/1", "/table/{table}", path) for _, path, _ in hall.forms().values()}
    assert tried == posts - NOT_HERE


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(REPLAYS))
def test_a_form_is_entered_once_however_often_it_comes_in(hall: Hall, seed: int) -> None:
    luck = random.Random(seed)
    sent: list[tuple[Browser, str, dict[str, Any]]] = []
    for number in range(14):
        hall.begins()
        name, (browser, path, fields) = luck.choice(list(hall.forms().items()))
        form = {**browser.hidden(), **fields, "once": f"{seed} {number}"}
        before = hall.entries()

        times = luck.randint(2, 4)
        got = hall.room.loop.run_until_complete(together(browser, path, form, times))
        said = (seed, name, [one.status for one in got], got[0].words[-200:])
        assert all(one.status in ANSWERS for one in got), said
        added = [now - then for now, then in zip(hall.entries(), before, strict=True)]
        if name == "new":
            assert added[0] <= 0, said
        else:
            assert added[0] <= 1, (said, added)
        assert added[1] <= 1, (said, added)
        assert added[2] <= 2, (said, added)  # both agree: the proposal, and that it is entered
        if any(one.status == 303 for one in got):  # what is refused may come in again
            sent.append((browser, path, form))
        if sent and luck.random() < 0.5:
            old, where, again = luck.choice(sent)
            there = hall.entries()
            shown = old.ask("POST", where, again)
            assert shown.status in ANSWERS, (seed, where, shown.words[-200:])
            assert hall.entries() == there, (seed, name, where, again)
    assert sent, seed
