"""The interface: what it answers is what it describes, and what it refuses says how to ask."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from contextlib import closing
from datetime import datetime
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import request_response

from evenbreak.files.demo import write_demo_evening
from evenbreak.files.store.tokens import SCORES, create_token
from evenbreak.web.api import description
from evenbreak.web.night import Night
from evenbreak.web.site import Site
from places import ROOT
from web.asked import Browser, Room
from web.test_interface_shapes import known
from web.test_who_may import NEW

CURL = re.compile(
    r"""^\$ curl -s (?:-H "Authorization: Bearer \$TOKEN".* \\\n +--json '(.*)' )?"""
    r"""\"?http://127.0.0.1:8000(\S+?)"?\n((?:[^$`].*\n)+)""",
    re.MULTILINE,
)
HERE = Path(__file__).parent


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
        ("POST", "/api/v1/tonight", 405, None, "POST can't be used"),
        ("GET", "/api/v1/tonight?evnt=2", 400, "evnt", "address, which has: event"),
        ("GET", "/api/v1/tonight?event=0", 400, "event", "from 1 to 99"),
        ("GET", "/api/v1/tonight?event=1&event=2", 400, "event", "2 times"),
        ("GET", "/api/v1/tonight?event=7", 404, "event", "no event 7"),
        ("GET", "/api/v1/tonight/race?a=Ann", 400, "b", "'b' is missing"),
        ("GET", "/api/v1/tonight/race?a=Ann&b=Zoe", 404, "b", "isn't in this tournament"),
        ("GET", "/api/v1/tonight/race?a=Ann&b=ann", 400, "b", "themselves"),
        ("GET", "/api/v1/tonight/tables?event=1", 400, "event", "isn't a parameter"),
        ("GET", "/api/v1", 404, None, "no such"),
        ("GET", "/api", 404, None, "no such"),
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


def test_heads_and_options_say_what_a_get_would(begun: Browser) -> None:
    got, head = (begun.tells(method, "/api/v1/tonight/bracket") for method in ("GET", "HEAD"))
    assert (head.status, head.headers["etag"]) == (200, got.headers["etag"])
    options = begun.tells("OPTIONS", "/api/v1/tonight/bracket")
    assert (options.status, options.headers["allow"]) == (204, "GET, HEAD, OPTIONS")
    assert options.body == b""


def test_a_request_without_a_body_needs_no_type(browser: Browser) -> None:
    assert "Missing" in browser.ask("POST", "/api/v1/odds", kind="").json["detail"]
    assert browser.ask("POST", "/api/v1/odds", {"a": 1}).status == 415


def test_what_fails_unforeseen_is_said_in_json(
    browser: Browser, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def fails(_: Request) -> Response:
        raise ArithmeticError

    route = next(one for one in browser.room.app.routes if one.path == "/api/v1/tonight")  # type: ignore[attr-defined]
    monkeypatch.setattr(route, "app", request_response(fails))
    browser.expected = (ArithmeticError,)
    got = browser.tells("GET", "/api/v1/tonight")
    assert (got.status, got.headers["content-type"]) == (500, "application/problem+json")
    assert got.json["detail"] == "That failed; nothing was changed."


def test_the_guard_too_answers_programs_in_json(begun: Browser) -> None:
    got = begun.tells("GET", "/api/v1/tonight", host="evil.example")
    assert (got.status, got.json["title"]) == (421, "Misdirected Request")
    assert got.headers["content-type"] == "application/problem+json"


def test_a_program_gets_and_needs_no_cookie(begun: Browser) -> None:
    assert "set-cookie" not in begun.tells("GET", "/api/v1/tonight").headers


@pytest.mark.slow
def test_the_description_keeps_to_openapi() -> None:
    told = description()
    schema = json.loads((HERE / "openapi-3.1.schema.json").read_text(encoding="utf-8"))
    assert [one.message for one in Draft202012Validator(schema).iter_errors(told)] == []
    for one in told["components"]["schemas"].values():
        Draft202012Validator.check_schema(one)
        for says in one["properties"].values():  # what is given as an example is one
            says = {**says, "components": told["components"]}
            for example in says.get("examples", ()):
                Draft202012Validator(says).validate(example)
    assert {one.split("/")[-1] for one in refs(told)} <= {*told["components"]["schemas"]}
    for path, methods in told["paths"].items():  # each parameter says what it is
        for one in methods.values():
            body = one.get("requestBody", {"content": {"application/json": {"schema": {}}}})
            fields = body["content"]["application/json"]["schema"].get("properties", {})
            says = {**fields, **{named["name"]: named for named in one.get("parameters", ())}}
            assert [(path, name) for name, field in says.items() if not field["description"]] == []
    operations = [one for methods in told["paths"].values() for one in methods.values()]
    ids = [one["operationId"] for one in operations]
    assert len({*ids}) == len(ids)
    tags = {one["name"] for one in told["tags"]}
    assert all({*one["tags"]} <= tags and one["summary"].endswith(".") for one in operations)


def refs(told: Any) -> Iterator[str]:
    if isinstance(told, dict):
        yield from (told["$ref"],) if isinstance(told.get("$ref"), str) else ()
        told = list(told.values())
    for one in told if isinstance(told, list) else ():
        yield from refs(one)


@pytest.mark.parametrize("address", ["tables", "matches", "bracket"])
def test_a_score_comes_with_its_chance(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, address: str
) -> None:
    """Nobody has to ask again once the odds of the whole night are worked out."""

    async def nothing(_: Night) -> None:
        return None

    monkeypatch.setattr(Night, "outlook", nothing)
    path = tmp_path / "tonight.db"
    write_demo_evening(path, datetime(2026, 3, 1, 20, 0))
    with closing(Room(Site(path, hosts=frozenset({"localhost"})))) as room:
        text = Browser(room).open(f"/api/v1/tonight/{address}").text
    played = re.findall(r'"players":\[[^]]*\],"state":"(?:called|playing)"', text)
    assert len(played) >= 3
    assert not any('"chance":null' in one for one in played)


def test_generators_of_clients_read_the_answers() -> None:
    """Some know no `items: false`, and a client would stop at a word that is added later."""
    text = json.dumps(description()["components"]["schemas"])
    assert "prefixItems" not in text
    assert '"items": false' not in text
    assert '"enum"' not in text


def test_each_route_is_described_and_the_reverse(browser: Browser) -> None:
    routed = {
        (path, method.lower())
        for one in browser.room.app.routes
        if (path := one.path).startswith("/api")  # type: ignore[attr-defined]
        for method in one.methods - {"HEAD", "OPTIONS"}  # type: ignore[attr-defined]
    }
    told = browser.tells("GET", "/api/v1/openapi.json").json
    assert routed == {(path, how) for path, methods in told["paths"].items() for how in methods}


@pytest.mark.slow
def test_the_examples_of_the_page_run(tmp_path: Path) -> None:
    """Each `curl` on the page about the interface is answered as it says, of the demo's evening."""
    text = (ROOT / "docs" / "reference" / "interface.md").read_text(encoding="utf-8")
    now = datetime(2026, 3, 1, 21, 0)
    write_demo_evening(tmp_path / "evening.db", now)
    site = Site(tmp_path / "evening.db", hosts=frozenset({"localhost"}), clock=now.isoformat)
    with closing(Room(site)) as room:
        browser = Browser(room)
        known(browser)
        token = create_token(site.path, "board", SCORES, now.isoformat())
        asked = CURL.findall(text)
        for body, address, shown in asked:
            head = {"authorization": f"Bearer {token}"} if body else {}
            sent = json.loads(body) if body else None
            got = browser.tells("POST" if body else "GET", address, sent, **head)
            wanted = re.escape(shown.replace("\n", "")).replace(r"\.\.\.", ".*?")
            assert re.fullmatch(wanted, got.text), (address, got.text)
    assert len(asked) == text.count("$ curl ") >= 5
