"""Every page of every kind of evening is said in the reader's language: no sentence is left out.

The language is one in which each of our words is in brackets; what is outside of them was not said
by the catalog. Names here have a single letter, so that nothing is excused.
"""

from __future__ import annotations

import asyncio
import re
from collections.abc import Iterator
from html import unescape
from pathlib import Path
from string import Formatter
from typing import Any

import pytest
from babel.messages.catalog import Catalog
from babel.messages.pofile import read_po, write_po

from evenbreak.files.catalogs import FILE, OWN
from evenbreak.files.store.team_night import read_team_events
from evenbreak.teams.evening.fold import team_evening
from evenbreak.web.site import Site
from web.asked import Browser, Got, Room
from web.phones import is_working

pytestmark = pytest.mark.slow

SPOKEN = "eo"
PLAYERS = "\n".join(f"P{k},{640 - 20 * k}" for k in range(1, 6)) + "\nP6,140"  # wins <0.1%
NEW = {
    "entrants": PLAYERS, "races": "even", "race": 2, "tables": 2, "discipline": "9-ball",
    "seeding": "listed", "scale": "fargo",
}  # fmt: skip
FORMATS: dict[str, dict[str, Any]] = {
    "double": {"losers_race": 1, "fee": 10, "races": "fair", "tables": "1,T&"},
    "single": {"third_place": "on"},
    "groups": {"groups": 2, "qualifiers": 1},
    "chips": {"chips": "hoboken", "race": ""},
    "swiss": {"rounds": 3},
    "consolation": {},
    "king-of-the-hill": {},
    "round-robin": {},
    "pods": {"qualifiers": 2, "pod_size": 4},
}
TEAMS = {
    "team_a": "A1", "players_a": "P1,600\nP2,580\nP3,570", "team_b": "B2",
    "players_b": "V1,610\nV2,560\nV3,555", "scale": "fargo", "races": "fair", "race": 3,
    "count": "sets",
}  # fmt: skip
RESULTS = "date,player_a,player_b,score_a,score_b\n" + "".join(
    f"2025-01-0{day},P{a},P{b},5,{b}\n"
    for day in range(1, 9)
    for a, b in ((1, 2), (2, 3), (3, 1), (3, 4))
)
DIRECTORS = ("/desk", "/new", "/next", "/team/new", "/team/history")
MOST_ASKED = 40
NO_PAGE = re.compile(r"\.(pdf|csv|xlsx|html|png|css)$|^/events$|^/api/")
TWICE = re.compile(r"&amp;(?:[a-z]+|#\d+);")  # escaped once more
OURS = re.compile(r"⟦[^⟦⟧]*⟧")
EXCUSED = re.compile(
    r"⟦phone ⟧\S+|\S+ 10\.0\.0\.\d|https?://\S+|\b\d+(\.\d+){3}\S*|\bevenbreak\b|localhost\S*|Deutsch|English|Esperanto"
    r"|Elo|NPL|APA|Fargo|National|Hoboken|Pharaohs|R6 Hot|Ann Lee"
    r"|\b[\w-]+\.(db|csv|xlsx)\b|\b[0-9A-Z]{4,6}\b|#\S+",
    re.IGNORECASE,
)


def bracketed(template: str) -> str:
    """Return a template whose words are in brackets, and what is filled in is not."""
    text = ""
    for words, name, spec, how in Formatter().parse(template):
        text += re.sub(r"[^\n]*\w[^\n]*", r"⟦\g<0>⟧", words)
        if name is not None:
            text += "{" + name + (f"!{how}" if how else "") + (f":{spec}" if spec else "") + "}"
    return text


def speak(folder: Path) -> None:
    """Write the catalog of that language."""
    with (OWN / "de" / FILE).open("rb") as file:
        ours = read_po(file)
    said = Catalog(locale=SPOKEN)
    for one in ours:
        if one.id:
            texts = (one.id,) if isinstance(one.id, str) else one.id
            known = [bracketed(text) for text in texts]
            said.add(one.id, known[0] if isinstance(one.id, str) else known, context=one.context)
    place = folder / SPOKEN / FILE
    place.parent.mkdir(parents=True)
    with place.open("wb") as file:
        write_po(file, said)


class Reader(Browser):
    """A browser that asks for that language."""

    def ask(self, *asked: Any, **more: Any) -> Got:
        return super().ask(*asked, accept_language=SPOKEN, **more)


def left_english(page: str) -> set[str]:
    """Return what a page says in words that no catalog said."""
    inner = re.sub(r"<(script|style|textarea|code).*?</\1>", " ", page, flags=re.DOTALL)
    spoken = re.findall(r'(?:aria-label|title|alt|placeholder|data-say\w*)="([^"]*)"', inner)
    texts = [unescape(text) for text in (*re.split(r"<[^>]*>", inner), *spoken)]
    bare = (" ".join(OURS.sub(" ", EXCUSED.sub("", text)).split()) for text in texts)
    return {text for text in bare if re.search(r"[^\W\d_]{2,}", text)}


class Evening:
    """Whoever looks at an evening, and what they saw in no language."""

    def __init__(self, path: Path) -> None:
        site = Site(path, hosts=frozenset({"localhost"}), clock=lambda: "2025-03-01T20:40:00")
        self.site, self.room = site, Room(site)
        self.director = Reader(self.room, director=True)
        self.guest, self.player, *self.captains = (
            Reader(self.room, address=f"10.0.0.{k}") for k in range(1, 5)
        )
        self.left: dict[str, set[str]] = {}
        self.seen: set[str] = set()

    def note(self, where: str, got: Got) -> None:
        self.seen.add(where)
        if words := left_english(got.text) | set(TWICE.findall(got.text)):
            self.left.setdefault(where, set()).update(words)

    def send(self, path: str, who: Reader | None = None, **fields: object) -> None:
        """Send a form, and read what it leads to."""
        self.note(path, (who or self.director).told(path, **fields))

    def look(self, *more: str, inside: str = "/") -> None:
        """Open every page as everyone who may, once its figures are there."""
        for _ in range(MOST_ASKED):
            if not is_working(self.director.open("/").text):
                break
            self.room.loop.run_until_complete(asyncio.sleep(0.02))
        for path in self.pages(inside):
            for browser in self.everyone[: 1 if path.startswith(DIRECTORS) else None]:
                self.note(path, browser.open(path))
        for path in more:
            self.note(path.partition("?")[0], self.director.open(path))

    @property
    def everyone(self) -> list[Reader]:
        return [self.director, self.guest, self.player, *self.captains]

    def pages(self, inside: str) -> Iterator[str]:
        for route in self.room.app.routes:
            path = route.path.replace("{table}", "1")  # type: ignore[attr-defined]
            shown = "GET" in route.methods and path.startswith(inside)  # type: ignore[attr-defined]
            if shown and not NO_PAGE.search(path):
                yield path.replace("{code}", self.site.player_code("P1"))


@pytest.fixture
def night(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Evening]:
    speak(tmp_path / "locale")
    monkeypatch.setenv("EVENBREAK_LOCALE", str(tmp_path / "locale"))
    found = Evening(tmp_path / "1.db")
    yield found
    found.room.close()
    assert {where: sorted(words) for where, words in found.left.items()} == {}


@pytest.mark.parametrize("kind", FORMATS)
def test_a_tournament_is_said_whole(night: Evening, kind: str) -> None:
    if kind == "swiss":
        pytest.importorskip("caissify_pairings", reason="pairings of a Swiss need evenbreak[swiss]")
    night.send("/new", **{**NEW, "format": kind, **FORMATS[kind]})
    night.send("/desk/check-in", player="P1")
    for k in range(2, 7):
        night.send("/desk/check-in", player=f"P{k}")
    night.send("/desk/draw")
    night.send("/me/claim", night.player, name="P1")
    for turn in range(40):
        state = night.site.night.state()
        if not state.standing.to_play:
            night.send("/desk/draw")  # of the next round, or of the qualifiers
            if not night.site.night.state().standing.to_play:
                break
            continue
        match = next(iter(state.standing.to_play))
        if turn == 0:
            night.send("/desk/call", match=match, table=1)
            night.send("/desk/score", match=match, a=1, b=1)
            night.look(f"/desk?match={match}", f"/bracket?match={match}")
        if kind == "chips":
            night.send("/desk/result", match=match, winner=state.pair(match)[0])
        else:
            night.send("/desk/result", match=match, a=2, b=1)
    night.look()


def test_the_league_corrections_and_overlays_are_said_whole(night: Evening) -> None:
    night.look("/fair?a=600&b=500")
    night.send("/league", results=RESULTS, scale="fargo", race=5)
    night.look()
    for _ in range(400):
        if night.site.league.sheet is not None:
            break
        night.room.loop.run_until_complete(asyncio.sleep(0.02))
        night.director.open("/league")
    night.send("/new", **{**NEW, "format": "double", "losers_race": 1})
    night.send("/play", night.guest, name="N1", rating=500)
    night.look("/league/player?name=P1", "/fair?a=P1&b=P2&race=5")
    night.send("/desk/accept", name="N1")
    for k in range(1, 7):
        night.send("/desk/check-in", player=f"P{k}", paid="yes")
    night.send("/prizes", fee=10, added=20, payout="60/40")
    night.send("/desk/draw")
    night.send("/desk/late", player="L1", rating=500)
    first, second, third = list(night.site.night.state().standing.to_play)[:3]
    night.send("/desk/wait", match=third, reason="r1", until="20:50")
    night.send("/desk/swap", one="P1", other="P2")
    night.send("/desk/substitute", player="P6", to="S1")
    night.send("/desk/rename", player="P5", to="R1")
    for name, who in zip(night.site.night.state().pair(first), night.captains, strict=True):
        night.send("/me/claim", who, name=name)
    night.send("/desk/call", match=first, table=1)
    night.send("/desk/call", match=first, table=1)  # refused
    night.send("/me/score", night.captains[0], match=first, a=2, b=1)
    night.look()
    night.send("/me/score", night.captains[1], match=first, a=1, b=2)
    night.look()
    night.send("/desk/result", match=first, a=2, b=1)
    night.send("/desk/result", match=first, a=1, b=2)  # refused
    night.send("/desk/result", match=second, a=2, b=0)
    follows = next(iter(night.site.night.state().standing.to_play))
    night.send("/desk/call", match=follows, table=1)
    night.send("/desk/score", match=follows, a=1, b=0)
    night.send("/desk/correct", match=first, a=1, b=2)
    night.send("/desk/correct", match=first, a=1, b=2, sure="yes")
    night.send("/desk/forfeit", player="P3")
    night.send("/desk/drop", player="P3", sure="yes")
    night.send("/desk/change", tables=3, race=3)
    night.look()
    night.send("/desk/second-chance", race=1)
    night.send("/desk/programs/create", name="b1", may="scores")
    night.send("/desk/undo", entry=night.site.night.state().numbers[-1])
    night.send("/desk/redo")
    night.look("/next", "/new?form=x")
    for bad in ({"entrants": ""}, {"race": 0}, {"format": "pods"}, {"entrants": "1. P1 612 x 7"}):
        night.send("/new", **{**NEW, "format": "single", "put_aside": "yes", **bad})


@pytest.mark.parametrize(
    "how",
    [
        {"order": "sealed"},
        {"order": "alternate", "chart": "apa_8ball"},
        {"order": "winner"},
        {"order": "alternate", "pattern": "A=B", "times": "2"},
    ],
    ids=str,
)
def test_a_team_night_is_said_whole(night: Evening, how: dict[str, str]) -> None:
    night.send("/team/new", **{**TEAMS, **how})
    state = team_evening(read_team_events(night.site.path))
    assert state is not None
    for side, captain in enumerate(night.captains):
        pin = night.site.captain_pin(state.began, side)
        night.send("/team/pin", captain, pin=pin)
    night.look()
    by = {"night": state.began, "by": "director"}
    for number in range(1, state.plan.sets + 1):
        for side in (0, 1):
            picks = {f"pick{k}": str(k - 1) for k in range(1, 4)}
            where = "/team/hand" if how["order"] == "sealed" else "/team/put"
            asked = {**by, **picks, "number": number, "team": side, "pick": str(number - 1)}
            night.send(where, **asked)
            if number < 3:
                night.look(inside="/team")
        night.send("/team/result", night.captains[0], **by | {"by": 0}, number=number, a=3, b=1)
        night.look(inside="/team")
        night.send("/team/result", **by, number=number, a=3, b=1)
    night.look(inside="/screen")
    night.send("/team/undo", **by, seen=0)
