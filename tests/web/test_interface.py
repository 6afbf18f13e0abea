"""The interface: what it answers is what it describes, and what it refuses says how to ask."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from evenbreak.web.site import Site
from web.asked import Browser, Room
from web.test_who_may import NEW


@pytest.fixture
def browser(tmp_path: Path) -> Iterator[Browser]:
    with closing(Room(Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"})))) as room:
        yield Browser(room)


@pytest.fixture
def begun(browser: Browser) -> Browser:
    director = Browser(browser.room, director=True)
    assert director.send("/new", **NEW).status == 303
    return browser


def test_before_a_tournament_there_is_none(browser: Browser) -> None:
    got = browser.tells("GET", "/api/v1/tonight", accept_language="de")
    assert got.status == 404
    assert got.headers["content-type"] == "application/problem+json"
    assert got.json["title"] == "Not Found"
    assert got.json["detail"] == "Es läuft noch kein Turnier."


def test_nothing_new_is_not_sent_again(begun: Browser) -> None:
    got = begun.tells("GET", "/api/v1/tonight")
    assert len(got.json["players"]) == 8
    tag = got.headers["etag"]
    again = begun.tells("GET", "/api/v1/tonight", if_none_match=f'"x", {tag}')
    assert (again.status, again.body, again.headers["etag"]) == (304, b"", tag)
    late = Browser(begun.room, director=True)
    assert late.send("/desk/late", player="Zoe", rating=500).status == 303
    changed = begun.tells("GET", "/api/v1/tonight", if_none_match=tag)
    assert len(changed.json["players"]) == 9


@pytest.mark.parametrize(
    ("method", "path", "status", "parameter", "words"),
    [
        ("GET", "/api/v1/tonigt", 404, None, "no such"),
        ("GET", "/api/v2/tonight", 404, None, "no such"),
        ("POST", "/api/v1/tonight", 405, None, "can't do that"),
        ("GET", "/api/v1/tonight?evnt=2", 400, "evnt", "known here: event"),
        ("GET", "/api/v1/tonight?event=0", 400, "event", "from 1 to 99"),
        ("GET", "/api/v1/tonight?event=1&event=2", 400, "event", "2 times"),
        ("GET", "/api/v1/tonight?event=7", 404, None, ""),
    ],
)
def test_what_is_wrong_is_refused_in_json(
    begun: Browser, method: str, path: str, status: int, parameter: str | None, words: str
) -> None:
    got = begun.tells(method, path)
    assert (got.status, got.headers["content-type"]) == (status, "application/problem+json")
    assert (got.json["status"], got.json.get("parameter")) == (status, parameter)
    assert words in got.json["detail"]
    allowed = set(got.headers.get("allow", "").split(", "))
    assert status != 405 or allowed == {"GET", "HEAD", "OPTIONS"}


def test_the_description_names_what_is_there(browser: Browser) -> None:
    told = browser.tells("GET", "/api/v1/openapi.json").json
    assert told["openapi"] == "3.1.0"
    assert told["paths"]["/api/v1/tonight"]["get"]["operationId"] == "get_tonight"
