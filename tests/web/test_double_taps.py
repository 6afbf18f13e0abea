"""Double taps: each form is taken once, in whatever order and number it comes in."""

from __future__ import annotations

import re
import threading
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from evenbreak.files.store.team_night import read_team_events
from evenbreak.files.store.tournament import read_events, read_tournament
from evenbreak.web.app import OF_THE_SESSION, make_app
from evenbreak.web.site import Site
from places import SRC
from web.conftest import Hall, begun
from web.phones import Phone, Shown, answering

NAMES = ["Ann", "Ann Smith", "Bo", "Cy", "Di", "Ed"]
TEAMS = {
    "team_a": "Racks", "players_a": "Ann,600\nBo,580", "team_b": "Cues",
    "players_b": "Wim,610\nYo,560", "scale": "fargo", "races": "even", "race": 5,
    "order": "alternate", "count": "sets",
}  # fmt: skip


class Forms(HTMLParser):
    """The forms of a page that are posted: where they go to, and their fields as they stand."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[tuple[str, dict[str, str]]] = []
        self._open = False
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        at = dict(attrs)
        if tag == "form":
            self._open = at.get("method") == "post"
            if self._open:
                self.found.append((at["action"] or "", {}))
        elif self._open and tag in ("input", "button") and at.get("name"):
            self.found[-1][1][at["name"] or ""] = at.get("value") or ""

    def handle_endtag(self, tag: str) -> None:
        self._open = self._open and tag != "form"


@pytest.fixture
def six(tmp_path: Path) -> Iterator[Hall]:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        begun(director, NAMES, format="double", tables=2, seeding="listed")
        yield Hall(site, director, Phone(site))


def pages_of(hall: Hall, phone: Phone) -> Iterator[Shown]:
    """Yield all pages that have forms; a sure page comes of a question."""
    phone.claims(hall.state.pair(next(iter(hall.state.standing.to_play)))[0])
    paths = ("/desk", "/new", "/pin", "/prizes?fee=10", "/league", "/team", "/team/new")
    for path in (*paths, "/me?play=1", "/"):
        yield phone.open(path)
    yield phone.send("/desk/drop", player="Bo")


@pytest.mark.slow
def test_every_form_of_every_page_carries_a_number(six: Hall) -> None:
    six.director.send("/desk/call", match=six.state.standing.to_play[0], table=1)
    six.director.send("/team/new", **TEAMS)
    first = six.state.standing.to_play[1]
    six.director.send("/desk/result", match=first, a=3, b=0)
    seen = set()
    for shown in pages_of(six, six.director):
        assert 'method="post"' in shown.text, shown.url
        for action, fields in Forms(shown.text).found:
            assert fields["once"], (shown.url, action)
            assert fields["begun"] == six.site.night.begun_at, (shown.url, action)
            seen.add(action)
    assert {"/desk/drop", "/new", "/prizes", "/league", "/me/score"} <= seen


def test_no_template_makes_a_form_of_its_own() -> None:
    for path in (SRC / "web" / "templates").glob("*.html"):
        for form in re.findall(
            r'<form method="post".*?</form>', path.read_text("utf-8"), re.DOTALL
        ):
            numbered = re.search(r"\{\{ (hidden\(|marks\(|sent_by\(|of_mine\()", form)
            assert numbered or path.name in ("sure.html", "correct.html"), (path.name, form[:80])


def test_the_routes_that_are_taken_twice_are_those_of_the_session(tmp_path: Path) -> None:
    app = make_app(Site(tmp_path / "tonight.db"))
    posts = {one.path: one for one in app.routes if "POST" in (getattr(one, "methods", 0) or ())}
    posts = {path: one for path, one in posts.items() if not path.startswith("/api/")}
    for path, route in posts.items():
        own = path in OF_THE_SESSION or path.startswith("/team/")
        assert (route.endpoint.__module__ == "evenbreak.web.app") != own, path
    assert len(posts) >= 20


FORMS: list[tuple[str, dict[str, Any], int]] = [
    ("/desk/late", {"player": "Late Larry", "rating": "500"}, 1),
    ("/desk/call", {"match": "W1.4", "table": 1}, 1),
    ("/desk/result", {"match": "W1.4", "a": 3, "b": 1}, 2),
    ("/desk/correct", {"match": "W1.4", "a": 1, "b": 3, "sure": "yes"}, 1),
    ("/desk/change", {"tables": 3}, 1),
    ("/desk/undo", {}, 1),
    ("/desk/forfeit", {"player": "Cy", "sure": "yes"}, 1),
    ("/desk/drop", {"player": "Ann", "sure": "yes"}, 1),
    ("/desk/save", {}, 0),
    ("/desk/pin", {}, 0),
    ("/prizes", {"fee": 10, "added": 0, "payout": "60/40"}, 0),
    ("/league/tonight", {}, 0),
]


def fields_of(hall: Hall, path: str, given: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of a form as the desk holds it, with those that are filled in."""
    held = [f for action, f in Forms(hall.director.open("/desk").text).found if action == path]
    return (held[0] if held and not given else hall.director.hidden()) | given


def twice(hall: Hall, path: str, fields: dict[str, Any], *, together: bool) -> list[Shown]:
    """Send a form twice, as one phone does."""
    if not together:
        return [hall.director.send_raw(path, fields) for _ in range(2)]
    found: list[Shown] = []
    at = threading.Barrier(2)

    def send() -> None:
        phone = Phone(hall.site)
        for cookie in hall.director.jar:
            phone.jar.set_cookie(cookie)
        at.wait()
        found.append(phone.send_raw(path, fields))

    threads = [threading.Thread(target=send) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return found


@pytest.mark.slow
@pytest.mark.parametrize("together", [False, True])
def test_a_form_that_comes_in_twice_is_taken_once(six: Hall, together: bool) -> None:
    folder = six.site.path.parent
    for number, (path, given, more) in enumerate(FORMS):
        before, pin = read_events(six.site.path), six.site.pin
        copies = len(list(folder.glob("*.backup.db")))
        fields = fields_of(six, path, given) | {"once": f"n{number}"}
        shown = twice(six, path, fields, together=together)
        assert [one.status for one in shown] == [200, 200], (path, [one.words for one in shown])
        assert len(read_events(six.site.path)) == len(before) + more, path
        assert len(list(folder.glob("*.backup.db"))) - copies == (path == "/desk/save"), path
        if path == "/desk/pin":
            assert six.site.pin != pin
            assert all(f"PIN is now {six.site.pin}" in one.words for one in shown)
            six.director.send("/pin", pin=six.site.pin)
        else:
            said = [re.findall(r'role="status">(.*?)</div>', one.text, re.DOTALL) for one in shown]
            assert said[0] == said[1], path


@pytest.mark.slow
def test_a_form_is_known_again_after_a_restart(six: Hall) -> None:
    sent = {**six.director.hidden(), "player": "Ann", "sure": "yes"}
    assert six.director.send_raw("/desk/drop", sent).status == 200
    entered = read_events(six.site.path)
    with answering(six.site.path) as site:
        six.director.site = site
        shown = six.director.send_raw("/desk/drop", sent)
    assert "nothing was entered twice" in shown.words.lower()
    assert read_events(six.site.path) == entered


def test_a_form_without_its_number_is_refused(six: Hall) -> None:
    before = read_events(six.site.path)
    for path, given, _ in [*FORMS, ("/team/new", TEAMS, 0)]:
        shown = six.director.send(path, **given, once="")
        assert (shown.status, "an earlier visit" in shown.words) == (400, True), path
    assert (read_events(six.site.path), read_team_events(six.site.path)) == (before, [])


def test_a_page_of_an_earlier_tournament_changes_nothing_in_the_next(six: Hall) -> None:
    six.director.send("/desk/result", match="W1.3", a=3, b=0)
    pages = [(shown.url, Forms(shown.text).found) for shown in pages_of(six, six.director)]
    stale = [(action, fields) for _, found in pages for action, fields in found]
    six.site.clock = lambda: "2031-01-01T20:00:00"
    held = dict(Forms(six.director.open("/new").text).found[0][1])
    begun(six.director, NAMES, in_place_of=held["in_place_of"], format="double", tables=2)
    before, secret = read_events(six.site.path), six.site.pin
    assert before[0].at == "2031-01-01T20:00:00"
    seen = set()
    for action, fields in stale:
        if action in OF_THE_SESSION or action.endswith("/me") or action.startswith("/team/"):
            continue
        shown = six.director.send_raw(action, fields)
        assert shown.status == 409, (action, shown.words)
        assert "Another tournament was started in the meantime" in shown.words
        seen.add(action)
    assert {"/desk/call", "/desk/undo", "/desk/drop", "/new", "/me/score"} <= seen
    assert (read_events(six.site.path), six.site.pin) == (before, secret)


@pytest.mark.slow
def test_an_evening_begun_twice_is_begun_once(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        team = {**TEAMS, "once": "t"}
        for _ in range(2):
            assert director.send("/team/new", **team).status == 200
        assert len(read_team_events(site.path)) == 1
        plan = {"entrants": "Ann,1\nBo,2", "format": "single", "races": "even", "race": 3}
        more = {"tables": 2, "discipline": "9-ball", "seeding": "listed", "scale": "npl"}
        for _ in range(2):
            assert director.send("/new", **plan, **more, begun="", once="e").status == 200
            director.send("/desk/draw", once="d")
        assert [type(one.what).__name__ for one in read_events(site.path)] == ["Opened", "Drawn"]


@pytest.mark.slow
def test_a_name_from_a_form_is_nobody_elses_that_begins_like_it(six: Hall) -> None:
    for what in ("drop", "forfeit"):
        before = len(six.state.events)
        shown = six.director.send(f"/desk/{what}", player="Ann S", sure="yes")
        assert (shown.status, len(six.state.events)) == (400, before)
    with answering(six.site.path.with_name("other.db")) as site:
        director = Phone(site, director=True)
        begun(director, NAMES[:3])
        director.send("/desk/undo", entry=2, sure="yes")
        for name in ("Ann", "Ann"):
            director.send("/desk/drop", player=name, sure="yes")
        assert list(read_tournament(site.path).entrants) == ["Ann Smith", "Bo"]
