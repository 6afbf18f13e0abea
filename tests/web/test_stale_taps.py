"""Phones that were out of reach: a tap counts from the score that its page showed."""

import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from starlette.requests import Request

from evenbreak.files.store.desk import RELEASED, Act, enter, phone_entries
from evenbreak.files.store.tournament import add_events, read_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web import taps
from evenbreak.web.forms import Form
from evenbreak.web.site import Site
from tries import tries
from web.asked import Browser, Room

NEW = {
    "entrants": "player,rating\nAnn,600\nBo,590", "format": "single", "races": "even", "race": 50,
    "tables": 1, "discipline": "9-ball", "seeding": "listed", "scale": "fargo",
}  # fmt: skip
EVENINGS = tries("taps of stale phones", 4)


class Table:
    """A long match with the phones of its players, and the tablet of its table."""

    def __init__(self, path: Path) -> None:
        self.room = Room(Site(path, hosts=frozenset({"localhost"})))
        self.director = Browser(self.room, director=True)
        assert self.director.send("/new", **NEW).status == 303
        assert self.director.send("/desk/draw").status == 303
        assert self.director.send("/desk/call", match="F", table=1).status == 303
        self.tablet = Browser(self.room, director=True)
        assert self.tablet.send("/table/1/tablet", give="yes").status == 303
        self.players = [Browser(self.room, address=f"10.0.0.{k}") for k in (1, 2)]
        for name, player in zip(("Ann", "Bo"), self.players, strict=True):
            assert player.claims(name).status == 303

    def at(self, browser: Browser) -> str:
        return "/table/1/score" if browser is self.tablet else "/me/score"

    def forms(self, browser: Browser) -> list[dict[str, str]]:
        """Return the forms of a phone's page: each adds a game or takes one back."""
        page = "/table/1?play=F" if browser is self.tablet else "/me?play=1"
        text = browser.open(page).text
        forms = re.findall(r'<form[^>]* action="[^"]*/score".*?</form>', text, re.DOTALL)
        return [dict(re.findall(r'name="([^"]+)" value="([^"]*)"', form)) for form in forms]

    @property
    def score(self) -> tuple[int, int]:
        live = read_tournament(self.room.site.path).live.get("F")
        return live.what.score if live else (0, 0)


@pytest.fixture
def table(tmp_path: Path) -> Iterator[Table]:
    found = Table(tmp_path / "tonight.db")
    yield found
    found.room.close()


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(EVENINGS))
def test_the_score_is_the_games_that_were_acknowledged(table: Table, seed: int) -> None:
    luck = random.Random(seed)
    browsers = [*table.players, table.tablet]
    opened = {browser: table.forms(browser) for browser in browsers}
    refused, games = 0, (0, 0)
    for number in range(40):
        browser = luck.choice(browsers)
        if luck.random() < 0.5:
            opened[browser] = table.forms(browser)
        form = luck.choice(opened[browser]) | {"once": f"tap {number}"}
        before = table.score
        got = browser.ask("POST", table.at(browser), form)
        asked = int(form["a"]), int(form["b"])
        seen = tuple(map(int, form["seen"].split(":")))
        if got.status == 303:  # one game more or less than it showed
            added = asked[0] - seen[0], asked[1] - seen[1]
            assert sum(map(abs, added)) <= 1
            games = games[0] + added[0], games[1] + added[1]
        else:
            assert got.status == 409
            assert "Check it, then tap" in got.words
            assert "Tap for a game" in got.words  # the page as it is now
            assert (table.score, seen == before) == (before, False)
            refused += 1
        assert table.score == games
    assert refused


def test_who_looks_on_scores_nothing(table: Table) -> None:
    guest = Browser(table.room, address="10.0.0.9")
    form = table.forms(table.players[0])[0]
    for path in ("/me/score", "/table/1/score"):
        assert guest.ask("POST", path, form | {"csrf": guest.token()}).status == 403
    assert table.score == (0, 0)
    other = table.players[1]
    assert other.ask("POST", "/me/score", form | {"csrf": other.token()}).status == 303
    assert table.score == (1, 0)


def test_a_result_counts_from_the_score_that_its_page_showed(table: Table) -> None:
    one, other = table.players
    before = len(phone_entries(table.room.site.path))
    other.taps("F", 0, 1)
    assert one.taps("F", 50, 0, seen="0:0").status == 409
    assert len(phone_entries(table.room.site.path)) == before
    assert "Tap for a game" in one.open("/me/score").words  # where a browser looks again


@pytest.mark.slow
@pytest.mark.parametrize("field", ["seen", "phone"])
def test_what_happens_while_a_tap_comes_in_counts(
    table: Table, field: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between reading a tap and entering it, somebody scores, or the phone is released."""
    player, path = table.players[0], table.room.site.path
    form = table.forms(player)[0]
    read = taps.tap_in

    def late(request: Request, sent: Form, state: Evening) -> taps.Tap:
        found = read(request, sent, state)
        if field == "seen":
            scored = moves.score(state, "F", (0, 1))
            add_events(path, lambda _: [Event("2025-03-01T20:00:00", scored)])
        else:
            enter(path, state, lambda _: Act(RELEASED, "Ann"), at="2025-03-01T20:00:00")
        return found

    monkeypatch.setattr(taps, "tap_in", late)
    got = player.ask("POST", "/me/score", form)
    assert got.status == (409 if field == "seen" else 403)
    assert table.score == ((0, 1) if field == "seen" else (0, 0))
