"""Who may do what: every route and every role, declared once, and each pair tried."""

from __future__ import annotations

import asyncio
import base64
import json
import re
import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from evenbreak.web.app import cookie_name
from evenbreak.web.site import Site
from web.asked import Browser, Got, Room, copy_of, session
from web.phones import seen_at

EVERYBODY = "everybody"
PLAYERS_OF_IT = "player, opponent"
CAPTAINS = "captain A, captain B, director"
DIRECTOR = "director"
NOBODY = ""

MAY = {
    **dict.fromkeys(
        [
            *("GET /", "GET /players", "GET /bracket", "GET /bracket.pdf", "GET /cards.pdf"),
            *("GET /prizes", "GET /league", "GET /results.csv", "GET /league/player"),
            *("GET /league/ratings.csv", "GET /league/matchups.csv", "GET /league/sheet.pdf"),
            *(
                "GET /league/sheet.html",
                "GET /league/sheet.xlsx",
                "GET /screen",
                "GET /fair",
            ),
            *("GET /pin", "GET /evenbreak.css", "GET /events", "GET /team"),
            *("GET /overlay.css", "GET /overlay/{table}", "GET /overlay/bracket"),
            *("GET /me", "GET /me/score", "GET /c/{code}", "POST /me/claim", "POST /me/code"),
            *("GET /table/{table}", "GET /table/{table}/score", "POST /language"),
            *("GET /play", "POST /play", "GET /share", "GET /share.html"),
            *("GET /share.png", "GET /share.csv"),
        ],
        EVERYBODY,
    ),
    **dict.fromkeys(["POST /me/score", "POST /me/coming", "POST /me/withdraw"], PLAYERS_OF_IT),
    **dict.fromkeys(["POST /table/{table}/score", "POST /table/{table}/wrong"], "tablet"),
    **dict.fromkeys(["POST /team/put", "POST /team/hand", "POST /team/result"], CAPTAINS),
    **dict.fromkeys(
        [
            *(
                "GET /desk",
                "GET /desk/more",
                "POST /desk/read",
                "POST /desk/calling",
                "GET /desk/time",
                "GET /desk/history",
                "GET /desk/codes",
                "GET /new",
            ),
            *("GET /desk/programs", "POST /desk/programs/create", "POST /desk/programs/revoke"),
            *("GET /desk/check-in", "GET /next", "GET /desk/phones", "POST /desk/phones"),
            *("GET /team/new", "GET /team/history", "POST /desk/draw", "POST /desk/call"),
            *(
                "POST /desk/result",
                "POST /desk/correct",
                "POST /desk/redo",
                "POST /desk/second-chance",
                "POST /desk/swap-tables",
                "POST /desk/wait",
                "POST /desk/rename",
                "POST /desk/substitute",
                "POST /desk/swap",
                "POST /desk/check-in",
                "POST /desk/accept",
                "POST /desk/decline",
                "POST /desk/score",
                "POST /desk/forfeit",
                "POST /desk/drop",
                "POST /desk/edit",
            ),
            *("POST /desk/change", "POST /desk/tiebreak", "POST /desk/undo", "POST /desk/stand"),
            *("POST /desk/uncall", "POST /desk/late", "POST /desk/save", "POST /prizes"),
            *(
                "POST /league",
                "POST /league/tonight",
                "POST /desk/release",
                "POST /table/{table}/tablet",
            ),
            *(
                "POST /team/undo",
                "POST /team/new",
                "POST /desk/pin",
                "POST /new",
                "POST /desk/delete",
            ),
        ],
        DIRECTOR,
    ),
    **dict.fromkeys(["POST /pin", "POST /team/pin"], NOBODY),  # without the PIN
    **dict.fromkeys(["POST /team/leave", "POST /leave", "POST /me/leave"], EVERYBODY),
}
"""Who passes at each route; all others are refused, and change nothing."""

PLAYERS = "player,rating\nAnn,640\nBo,620\nCy,600\nDi,580\nEd,560\nFay,540\nGus,520\nHal,500"
NEW = {
    "entrants": PLAYERS, "format": "double", "races": "even", "race": 3, "losers_race": 3,
    "tables": 2, "discipline": "9-ball", "seeding": "listed", "scale": "fargo",
}  # fmt: skip
TEAMS = {
    "team_a": "Racks", "players_a": "Ann,600\nBo,580\nCy,570", "team_b": "Cues",
    "players_b": "Wim,610\nYo,560\nUli,555", "scale": "fargo", "races": "even", "race": 5,
    "order": "sealed", "count": "sets",
}  # fmt: skip
HEADER = "player_a,player_b,score_a,score_b"
RESULTS = f"{HEADER}\nAnn,Bo,5,3\nBo,Cy,5,2\nCy,Ann,5,4\n"
REFUSED = {403, 404, 421, 429}


class Rooms:
    """A tournament, a team night and a league on one page, and somebody in each role."""

    def __init__(self, path: Path) -> None:
        self.room = Room(Site(path, hosts=frozenset({"localhost"})))
        site = self.site = self.room.site
        first = self.director = Browser(self.room, director=True)
        assert first.send("/new", **NEW).status == 303
        assert first.send("/desk/draw").status == 303
        assert first.send("/team/new", **TEAMS).status == 303, first.send("/team/new", **TEAMS)
        self.night = site.night
        assert first.send("/desk/result", match="W1.4", a=3, b=1).status == 303
        assert first.send("/league", results=RESULTS, scale="fargo", race=5).status == 303
        for _ in range(600):
            if site.league.sheet is not None:
                break
            self.room.loop.run_until_complete(asyncio.sleep(0.02))
            first.open("/league")
        assert site.league.sheet is not None, site.league.problem
        self.pair = site.night.state().pair("W1.1")
        who = {name: Browser(self.room, address=f"10.0.0.{k}") for k, name in enumerate(
            ["guest", "player", "opponent", "captain A", "captain B"], 1
        )}  # fmt: skip
        (began,) = re.findall(r'name="night" value="(\d+)"', first.open("/team").text)[:1]
        self.began = int(began)
        for side, name in enumerate(("captain A", "captain B")):
            pin = site.captain_pin(self.began, side)
            assert who[name].send("/team/pin", pin=pin).status == 303
        for side, name in enumerate(("player", "opponent")):
            assert who[name].claims(self.pair[side]).status == 303
        assert first.send("/desk/call", match="W1.1", table=2).status == 303
        who["tablet"] = Browser(self.room, address="10.0.0.9", director=True)
        assert who["tablet"].send("/table/2/tablet", give="yes").status == 303
        old = Browser(self.room, director=True)
        assert first.told("/desk/pin").status == 200
        leaves = Browser(self.room, director=True)
        left = copy_of(leaves)
        assert leaves.send("/leave").status == 303
        forged = Browser(self.room)
        token = forged.token()
        held = {"director": f"{site.director_mark} x", "form": token}
        forged.cookies = session(site, held, "another key")
        forged.fixed = True
        guessed = Browser(self.room)
        guessed.cookies = session(site, {"form": guessed.token(), "director": "x y"})
        wrong = copy_of(first)
        wrong.kept = who["guest"].token()
        self.who = who | {
            "who entered an old PIN": old, "who has left": left, "a forged session": forged,
            "a guessed mark": guessed, "a wrong token": wrong, "another host": copy_of(first),
            "director": first,
        }  # fmt: skip

    def fields(self, route: str, role: str) -> dict[str, Any]:
        """Return what would be taken of a director, or of a captain."""
        state = self.night.state()
        tap = {"match": "W1.1", "a": 1, "b": 0}
        tap |= seen_at(self.site, "/me/score", tap)
        by: dict[str, Any] = {"night": self.began, "number": 1, "by": "director", "team": 0}
        if role in ("captain A", "captain B"):
            by["by"] = "AB".index(role[-1])
        return {
            "/desk/call": {"match": "W1.2", "table": 1},
            "/desk/uncall": {"match": "W1.2"},
            "/desk/result": {"match": "W1.3", "a": 3, "b": 1},
            "/desk/correct": {"match": "W1.3", "a": 1, "b": 3, "sure": "yes"},
            "/desk/score": {"match": "W1.2", "a": 1, "b": 0},
            "/desk/forfeit": {"player": "Hal", "sure": "yes"},
            "/desk/drop": {"player": "Gus", "sure": "yes"},
            "/desk/edit": {"player": "Ann", "name": "Annie", "rating": 640},
            "/desk/change": {"tables": 3},
            "/desk/undo": {"entry": state.numbers[-1] if state.numbers else 2},
            "/desk/redo": {},
            "/desk/second-chance": {},
            "/desk/swap-tables": {"one": "W1.1", "other": "W1.2"},
            "/desk/wait": {"match": "W1.2", "reason": "late"},
            "/desk/rename": {"player": "Ann", "to": "Annie"},
            "/desk/substitute": {"player": "Gus", "to": "Zoe"},
            "/desk/swap": {"one": "Gus", "other": "Hal"},
            "/desk/check-in": {"player": "Ann"},
            "/desk/accept": {"name": "Zoe"},
            "/desk/decline": {"name": "Zoe"},
            "/desk/stand": {"match": "W1.3"},
            "/desk/programs/create": {"name": "board", "may": "scores"},
            "/desk/programs/revoke": {"name": "board"},
            "/desk/late": {"player": "Late Larry", "rating": 500},
            "/play": {"name": "Eve"},
            "/prizes": {"fee": 10, "added": 0, "payout": "60/40"},
            "/league": {"results": RESULTS, "scale": "fargo", "race": 5},
            "/new": NEW,
            "/team/new": TEAMS,
            "/pin": {"pin": "000000"},
            "/team/pin": {"pin": "000000"},
            "/language": {"language": "en", "back": "/"},
            "/me/claim": {"name": self.named(role)},
            "/me/code": {"code": self.site.player_code(self.named(role))},
            "/me/coming": {"match": "W1.1"},
            "/me/withdraw": {"match": "W1.1"},
            "/me/score": tap,
            "/table/{table}/score": tap,
            "/table/{table}/wrong": {"match": "W1.4"},
            "/table/{table}/tablet": {"give": "no"},
            "/desk/release": {"player": "Gus"},
            "/team/put": by | {"pick": "0"},
            "/team/hand": by | {f"pick{k}": str(k - 1) for k in range(1, 4)},
            "/team/result": by | {"a": 5, "b": 3},
            "/team/undo": {"seen": 1},
        }.get(route, {})  # fmt: skip

    def named(self, role: str) -> str:
        """Return whose phone somebody says that they have."""
        return dict(zip(("player", "opponent"), self.pair, strict=True)).get(role, "Gus")

    def path(self, route: str, role: str) -> str:
        """Return an address of a route."""
        code = self.site.player_code(self.named(role))
        return route.replace("{code}", code).replace("{table}", "2")

    def tries(self, method: str, route: str, role: str) -> Got:
        path = self.path(route, role)
        host = "evil.example" if role == "another host" else "localhost"
        browser = self.who[role]
        if route == "/league/player":
            path += "?name=Ann"
        if method == "GET":
            return browser.ask("GET", path, host=host)
        return browser.ask(method, path, {**browser.hidden(), **self.fields(route, role)},
                           host=host)  # fmt: skip


@pytest.fixture(scope="module")
def rooms(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Rooms]:
    found = Rooms(tmp_path_factory.mktemp("rooms") / "tonight.db")
    yield found
    found.room.close()


def held(path: Path) -> list[object]:
    """Return all that a file holds, and the names of those beside it."""
    with closing(sqlite3.connect(path)) as base:
        beside = sorted(one.name for one in path.parent.rglob("*") if "-" not in one.suffix)
        return [*base.iterdump(), *beside]


def passes(asked: str, role: str, who: str) -> bool:
    """Return whether a role is among those who may."""
    if role == "a wrong token":  # a director's, without which nobody sends a form
        return asked.startswith("GET ") and passes(asked, "director", who)
    if role == "another host" or (role == "a forged session" and asked.startswith("POST ")):
        return False
    return who == EVERYBODY or role in who.split(", ")


def routes(room: Room) -> dict[str, set[str]]:
    """Return the methods of each page; what programs may ask is tried by its own description."""
    found: dict[str, set[str]] = {}
    for one in room.app.routes:
        if one.path.startswith("/api/"):  # type: ignore[attr-defined]
            continue
        found.setdefault(one.path, set()).update(one.methods - {"HEAD"})  # type: ignore[attr-defined]
    return found


def test_every_route_is_declared(rooms: Rooms) -> None:
    asked = {f"{m} {path}" for path, methods in routes(rooms.room).items() for m in methods}
    assert asked == set(MAY)


@pytest.mark.slow_after(3)
@pytest.mark.parametrize("method", ["PUT", "PATCH", "DELETE", "OPTIONS", "TRACE", "get", "X"])
def test_no_other_method_is_answered(rooms: Rooms, method: str) -> None:
    before = held(rooms.site.path)
    for route in routes(rooms.room):
        for role in ("guest", "director"):
            assert rooms.tries(method, route, role).status in (403, 404, 405), (route, role)
    assert held(rooms.site.path) == before


@pytest.mark.slow_after(3)
def test_no_page_changes_anything_when_it_is_opened(rooms: Rooms) -> None:
    before, opened = held(rooms.site.path), 0
    for asked in MAY:
        method, route = asked.split()
        for role in ("guest", "player", "tablet", "director") if method == "GET" else ():
            whose = "opponent" if role == "player" else role  # scans somebody else's code
            path = rooms.path(route, whose)
            assert rooms.who[role].open(path).status < 500
            assert held(rooms.site.path) == before, (asked, role)
            opened += 1
    assert opened > 100


def test_a_form_in_an_address_changes_nothing(rooms: Rooms) -> None:
    """A picture or a link on another page asks with the director's cookie."""
    director, before = rooms.who["director"], held(rooms.site.path)
    for asked in MAY:
        method, route = asked.split()
        if method == "POST":
            fields = {key: str(value) for key, value in rooms.fields(route, "director").items()}
            path = rooms.path(route, "director")
            director.open(path, csrf=director.token(), **fields)
            director.ask("HEAD", f"{path}?csrf={director.token()}&match=W1.1&a=3&b=1")
    assert held(rooms.site.path) == before


def browser_phone(rooms: Rooms, browser: Browser) -> str:
    """Return what the session of a browser is known by."""
    data = browser.cookies.get(cookie_name(rooms.site), "").split(".")[0]
    return str(json.loads(base64.b64decode(data + "==") or "{}").get("phone", ""))


PAGES = ("/", "/players", "/bracket", "/screen", "/team", "/pin", "/prizes", "/league", "/fair")


def test_no_page_tells_a_secret_to_who_may_not_know_it(rooms: Rooms) -> None:
    site = rooms.site
    pins = [site.captain_pin(rooms.began, side) for side in (0, 1)]
    for role, browser in rooms.who.items():
        if role in ("director", "another host", "a wrong token"):
            continue
        for page in (*PAGES, "/desk", "/desk/codes", "/team/history", "/me", "/table/2"):
            text = browser.open(page).text
            for secret in (site.pin, *pins, site.cookie_key, site.director_mark):
                assert secret not in text, (role, page)
            mine = rooms.night.phones().of(browser_phone(rooms, browser))
            for name, code in site.player_codes().items():
                assert code not in text or (name, page) == (mine, "/me"), (role, page)


def test_what_a_captain_hands_in_unseen_shows_nowhere_else(rooms: Rooms) -> None:
    shown = []
    for order in ((0, 1, 2), (2, 1, 0), (1, 2, 0)):
        picks = {f"pick{k}": str(place) for k, place in enumerate(order, 1)}
        given = {"night": rooms.began, "by": 0, "number": 1, **picks}
        assert rooms.who["captain A"].send("/team/hand", **given).status == 303
        rooms.who["captain A"].open("/team")
        pages = {
            (role, page): rooms.who[role].open(page).text
            for role in ("guest", "player", "captain B", "director")
            for page in ("/team", "/team/history")
        }
        # The number of entries may show, and when they came in.
        own = r'name="(once|csrf|seen)" value="[^"]*"|\s*<li data-key.*?</li>|data-older'
        shown.append({at: re.sub(own, "", text, flags=re.DOTALL) for at, text in pages.items()})
    assert shown[1:] == shown[:-1]


@pytest.mark.slow
def test_each_role_passes_where_it_is_declared_and_nowhere_else(rooms: Rooms) -> None:
    # The last one: in the end everybody has left.
    tried = 0
    for asked, who in MAY.items():
        method, route = asked.split()
        for role in sorted(rooms.who, key=lambda role: passes(asked, role, who)):
            may = passes(asked, role, who)
            before = None if may else held(rooms.site.path)
            got = rooms.tries(method, route, role)
            tried += 1
            said = (asked, role, got.status, got.words[-200:])
            assert got.status < 500, said
            assert (got.status not in REFUSED) == may, said
            if not may:
                assert held(rooms.site.path) == before, said
    assert tried >= 200
