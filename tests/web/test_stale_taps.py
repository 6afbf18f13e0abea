"""Phones that were out of reach: a tap counts from the score that its page showed."""

import random
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from evenbreak.files.tournament_store import read_tournament
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


@pytest.mark.parametrize("seed", range(EVENINGS))
def test_the_score_is_the_games_that_were_acknowledged(table: Table, seed: int) -> None:
    luck = random.Random(seed)
    browsers = [*table.players, table.director]
    opened = {browser: table.forms(browser) for browser in browsers}
    refused = 0
    for number in range(40):
        browser = luck.choice(browsers)
        if luck.random() < 0.5:
            opened[browser] = table.forms(browser)
        form = luck.choice(opened[browser]) | {"once": f"tap {number}"}
        before = table.score
        got = browser.ask("POST", f"{table.at}/score", form)
        asked = int(form["a"]), int(form["b"])
        seen = tuple(map(int, form["seen"].split(":")))
        if got.status == 303:  # one game from what it showed; another may have seen the same one
            assert table.score == asked
            assert before in (seen, asked)
            assert sum(abs(x - y) for x, y in zip(asked, seen, strict=True)) <= 1
        else:
            assert got.status == 409
            assert "by now" in got.words
            assert (table.score, seen == before) == (before, False)
            refused += 1
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
    assert "has entered" not in table.director.open("/desk").words
