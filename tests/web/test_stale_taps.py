"""Phones that were out of reach: a tap counts from the score that its page showed."""

import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from starlette.requests import Request

from evenbreak.files.store.desk import CLAIMED, Entry, enter, phone_entries
from evenbreak.files.store.tournament import add_events, read_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.pages import match
from evenbreak.web.site import Site
from tries import tries
from web.asked import Browser, Room

NEW = {
    "entrants": "player,rating\nAnn,600\nBo,590", "format": "single", "races": "even", "race": 50,
    "tables": 1, "discipline": "9-ball", "seeding": "listed", "scale": "fargo",
}  # fmt: skip
EVENINGS = tries("taps of stale phones", 4)


class Table:
    """A long match with the phones of its players, the director and somebody who looks on."""

    def __init__(self, path: Path) -> None:
        self.room = Room(Site(path, hosts=frozenset({"localhost"})))
        self.director = Browser(self.room, director=True)
        assert self.director.send("/new", **NEW).status == 303
        assert self.director.send("/desk/draw").status == 303
        self.at = f"/m/{self.room.site.match_token('F')}"
        self.players = [Browser(self.room, address=f"10.0.0.{k}") for k in (1, 2)]

    def forms(self, browser: Browser) -> list[dict[str, str]]:
        """Return the forms of a phone's page: each adds a game or takes one back."""
        text = browser.open(self.at).text
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
    browsers = [*table.players, table.director]
    opened = {browser: table.forms(browser) for browser in browsers}
    refused, games = 0, (0, 0)
    for number in range(40):
        browser = luck.choice(browsers)
        if luck.random() < 0.5:
            opened[browser] = table.forms(browser)
        form = luck.choice(opened[browser]) | {"once": f"tap {number}"}
        before = table.score
        got = browser.ask("POST", f"{table.at}/score", form)
        asked = int(form["a"]), int(form["b"])
        seen = tuple(map(int, form["seen"].split(":")))
        if got.status == 303:  # one game more or less than it showed
            added = asked[0] - seen[0], asked[1] - seen[1]
            assert sum(map(abs, added)) <= 1
            games = games[0] + added[0], games[1] + added[1]
        else:
            assert got.status == 409
            assert "Check it, then tap" in got.words
            assert "Game for" in got.words  # the page as it is now
            assert (table.score, seen == before) == (before, False)
            refused += 1
        assert table.score == games
    assert refused


def test_who_looks_on_scores_only_until_both_players_have_their_phones(table: Table) -> None:
    guest = Browser(table.room, address="10.0.0.9")
    form = table.forms(guest)[0]
    assert guest.ask("POST", f"{table.at}/score", form).status == 303
    for k, player in enumerate(table.players):
        assert player.send(f"{table.at}/me", me=k).status == 303
    late = table.forms(table.players[0])[0]
    assert table.forms(guest) == []
    assert guest.ask("POST", f"{table.at}/score", late | {"csrf": guest.token()}).status == 403
    assert table.score == (1, 0)
    assert table.players[1].ask(
        "POST", f"{table.at}/score", late | {"csrf": table.players[1].token()}
    ).status == 303  # fmt: skip
    assert table.score == (2, 0)


def test_a_result_counts_from_the_score_that_its_page_showed(table: Table) -> None:
    pair = {"player_a": "Ann", "player_b": "Bo"}
    for k, player in enumerate(table.players):
        player.send(f"{table.at}/me", me=k)
    stale = {**table.players[0].hidden(), **pair, "seen": "0:0", "a": 50, "b": 0}
    table.players[1].send(f"{table.at}/score", a=0, b=1, **pair)
    assert table.players[0].ask("POST", f"{table.at}/score", stale).status == 409
    assert phone_entries(table.room.site.path, "F")[2:] == []


def test_a_refused_result_claims_no_side_and_leads_to_the_page_as_it_is(table: Table) -> None:
    pair = {"player_a": "Ann", "player_b": "Bo"}
    one, other = table.players
    one.send(f"{table.at}/score", a=1, b=0, **pair)
    assert other.send(f"{table.at}/score", a=50, b=0, me=1, seen="0:0", **pair).status == 409
    assert phone_entries(table.room.site.path) == []
    assert "Game for Ann" in other.open(f"{table.at}/score").words  # where a browser looks again


@pytest.mark.parametrize("field", ["seen", "sides"])
def test_what_happens_while_a_tap_comes_in_counts(
    table: Table, field: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between reading a tap and entering it, somebody scores, or the last side is claimed."""
    guest = Browser(table.room, address="10.0.0.9")
    form = table.forms(guest)[0]
    read = match._match

    async def late(request: Request) -> tuple[str, Evening]:
        found = await read(request)
        monkeypatch.setattr(match, "_match", read)
        if field == "seen":
            scored = moves.score(found[1], "F", (0, 1))
            add_events(table.room.site.path, lambda _: [Event("2025-03-01T20:00:00", scored)])
        else:
            for who, player, at in (("Ann", "x", "10.0.0.1"), ("Bo", "y", "10.0.0.2")):
                entry = Entry("2025-03-01T20:00:00", "F", CLAIMED, who, phone=player, address=at)
                enter(table.room.site.path, "F", ("Ann", "Bo"), lambda _, entry=entry: entry)
        return found

    monkeypatch.setattr(match, "_match", late)
    got = guest.ask("POST", f"{table.at}/score", form)
    assert got.status == (409 if field == "seen" else 403)
    assert table.score == ((0, 1) if field == "seen" else (0, 0))
