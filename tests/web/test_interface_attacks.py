"""Attacks on every operation of the interface's own description: each is refused with a problem.

A new address is attacked as soon as it is described. Nothing that is refused changes the file, and
no answer has a secret in it.
"""

from __future__ import annotations

import asyncio
import itertools
import json
import random
import tempfile
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from evenbreak.files.store.tokens import MOVES_OF_A_TABLE, create_token, revoke_token
from evenbreak.web import guard
from evenbreak.web.api import description
from evenbreak.web.api.problem import Problem
from evenbreak.web.site import Site
from tries import tries
from web.asked import Browser, Got, Room
from web.test_who_may import NEW, held

ATTACKS = tries("any values in any operation", 1)
AT = "2025-03-01T19:00:00"
ELSEWHERE = "https://league.example"
_ADDRESSES = (f"10.{a}.{b}.{c}" for a, b, c in itertools.product(range(1, 255), repeat=3))


class Operation(NamedTuple):
    """An operation as the description has it."""

    method: str
    path: str
    scope: str
    fields: dict[str, Any]
    required: list[str]
    parameters: list[str]


def operations() -> list[Operation]:
    found = []
    for path, methods in description()["paths"].items():
        for method, one in methods.items():
            security = one.get("security") or [{"token": [""]}]
            body = one.get("requestBody", {}).get("content", {}).get("application/json", {})
            schema = body.get("schema", {})
            asked = [p["name"] for p in one.get("parameters", []) if p["in"] == "query"]
            ((scope,),) = security[0].values()
            found.append(Operation(method.upper(), path, scope, schema.get("properties", {}),
                                   schema.get("required", []), asked))  # fmt: skip
    return found


EVERY = operations()
WRITES = [one for one in EVERY if one.scope]


class Attacked:
    """A tournament under way, tokens of every kind, and whoever asks from a new address."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / "tonight.db"
        named = frozenset({ELSEWHERE})
        site = Site(self.path, hosts=frozenset({"localhost"}), origins=named)
        site.entries.most = site.taps.most = 10**6
        self.room = Room(site)
        self.director = Browser(self.room, director=True)
        for where, fields in (("/new", NEW), ("/desk/draw", {})):
            assert self.director.send(where, **fields).status == 303
        assert self.director.send("/desk/call", match="W1.1", table=2).status == 303
        self.tokens = {
            name: create_token(self.path, name, scope, AT)
            for name, scope in {
                "scores": "scores", "director": "director", "here": "table:2",
                "elsewhere": "table:1", "gone": "director",
            }.items()
        }  # fmt: skip
        revoke_token(self.path, "gone")
        other = folder / "other" / "tonight.db"
        other.parent.mkdir()
        with closing(Room(Site(other, hosts=frozenset({"localhost"})))) as room:
            assert Browser(room, director=True).send("/new", **NEW).status == 303
        self.tokens["of another night"] = create_token(other, "x", "director", AT)
        self.secrets = [site.pin, site.cookie_key, site.director_mark, str(folder), *site.tokens]
        self.secrets += self.tokens.values()

    def asks(self, one: Operation, body: object = None, **more: Any) -> Got:
        """Ask from an address of its own."""
        browser = more.pop("browser", None) or Browser(self.room, address=next(_ADDRESSES))
        raw = body if isinstance(body, bytes) else json.dumps({} if body is None else body).encode()
        more = {"kind": "application/json"} | more
        path = one.path + more.pop("query", "")
        got = browser.ask(more.pop("method", one.method), path, body=raw, **more)
        assert "set-cookie" not in got.headers
        for secret in self.secrets:
            assert secret not in got.text, (one, secret)
        return got

    def refused(self, one: Operation, body: object = None, **more: Any) -> int:
        """Ask what must be refused, with a problem."""
        got = self.asks(one, body, **more)
        self.is_problem(got, (one.method, one.path, more))
        return got.status

    def is_problem(self, got: Got, said: object) -> None:
        assert 400 <= got.status < 500, (said, got.status, got.text)
        assert got.headers["content-type"] == "application/problem+json", (said, got.text)
        assert got.json["status"] == got.status
        assert len(got.json["detail"]) > 10, said
        assert got.json.keys() <= Problem.__dataclass_fields__.keys()

    def bearer(self, name: str) -> str:
        return f"Bearer {self.tokens[name]}"


@pytest.fixture(scope="module")
def begun() -> Iterator[Attacked]:
    with tempfile.TemporaryDirectory() as folder:
        found = Attacked(Path(folder))
        with closing(found.room):
            yield found


@pytest.fixture
def attacked(begun: Attacked) -> Iterator[Attacked]:
    """All rows of the file are the same after a test as before."""
    before = held(begun.path)
    yield begun
    assert held(begun.path) == before


def test_the_description_has_what_is_attacked() -> None:
    assert {one.method for one in EVERY} == {"GET", "POST"}
    assert len(WRITES) >= 23
    assert {one.scope for one in EVERY} == {"", "scores", "director"}


def test_nobody_enters_anything_without_a_token_that_is_for_it(attacked: Attacked) -> None:
    token = attacked.tokens["director"]
    for one in WRITES:
        refused = attacked.refused
        move = one.path.rpartition("/")[2]
        for head in (
            {}, {"browser": attacked.director}, {"authorization": token},
            {"authorization": f"Basic {token}"}, {"authorization": "Bearer"},
            {"authorization": "Bearer " + token[:-1]}, {"authorization": f"Bearer {token} x"},
            {"authorization": attacked.bearer("gone")},
            {"authorization": attacked.bearer("of another night")},
            {"query": f"?access_token={token}&token={token}&authorization=Bearer+{token}"},
            {"cookie": f"token={token}; authorization=Bearer {token}"},
            {"x_authorization": f"Bearer {token}"},
        ):  # fmt: skip
            assert refused(one, **head) == 401, (one, head)
        if one.scope == "director":
            assert refused(one, authorization=attacked.bearer("scores")) == 403, one
        body = {"match": "1", "score": [1, 0]}
        if move not in MOVES_OF_A_TABLE:
            assert refused(one, authorization=attacked.bearer("here")) == 403, one
        assert refused(one, body, authorization=attacked.bearer("elsewhere")) == 403, one


def test_wrong_tokens_are_counted_by_address(attacked: Attacked) -> None:
    one, browser = WRITES[0], Browser(attacked.room, address="10.0.0.1")
    wrong = {"authorization": "Bearer evenbreak-x", "browser": browser}
    assert [attacked.refused(one, **wrong) for _ in range(7)] == [401] * 5 + [429] * 2
    assert attacked.refused(one, authorization="Bearer evenbreak-x") == 401
    right = {"authorization": attacked.bearer("scores"), "browser": browser}
    assert attacked.refused(one, **right) == (403 if one.scope == "director" else 400)


@pytest.mark.slow
def test_only_pages_of_this_computer_and_those_named_may_write(attacked: Attacked) -> None:
    for one in EVERY:
        assert attacked.refused(one, host="evil.example") == 421
        for origin in ("https://evil.example", "null", "*", "http://localhost.evil.example",
                       f"{ELSEWHERE}:8443", ELSEWHERE.upper(), f"{ELSEWHERE}/",
                       "https://localhost", f"{ELSEWHERE}, http://localhost"):  # fmt: skip
            head = {"authorization": attacked.bearer("director"), "origin": origin}
            preflight = {"method": "OPTIONS", "access_control_request_method": "POST"}
            assert attacked.refused(one, **head, **preflight) == 403
            if one.method == "POST":
                assert attacked.refused(one, **head) == 403
            else:
                got = attacked.asks(one, **head)
                assert not [name for name in got.headers if name.startswith("access-control")]
        got = attacked.asks(one, method="OPTIONS", origin=ELSEWHERE,
                            access_control_request_method=one.method)  # fmt: skip
        assert (got.status, got.headers["access-control-allow-origin"]) == (204, ELSEWHERE)
        assert "access-control-allow-credentials" not in got.headers
        shown = attacked.asks(one, b"x", origin=ELSEWHERE)
        assert shown.headers["access-control-allow-origin"] == ELSEWHERE
        assert "Origin" in shown.headers["vary"]


@pytest.mark.slow
def test_no_other_method_and_no_override_changes_anything(attacked: Attacked) -> None:
    may = {"authorization": attacked.bearer("director")}
    for one in EVERY:
        others = {"GET", "POST"} - {op.method for op in EVERY if op.path == one.path}
        for method in ("PUT", "PATCH", "DELETE", "TRACE", "get", "X", *others):
            assert attacked.refused(one, method=method, **may) == 405, (one, method)
        if one.method == "GET":
            for name in ("x_http_method_override", "x_method_override", "x_http_method"):
                attacked.asks(one, {"match": "1", "score": [1, 0]}, **{name: "POST"}, **may)
            attacked.asks(one, {"_method": "POST"}, query="?_method=POST&method=POST")


WRONG = [
    b"", b"{", b"[]", b'"x"', b"nul", b"{}x", b"\xff\xfe{\x00}\x00", b"\xef\xbb\xbf{}",
    b'{"match": "\xff"}', b'{"match": "\\ud800"}', b'{"\\udfff": 1}',
    b'{"match": "1", "match": "2"}', b'{"match": NaN}', b'{"match": -Infinity}',
    b'{"games": 1e999}', b'{"games": 1' + b"0" * 5000 + b"}",
    b'{"match": ' + b"[" * 30000 + b"]" * 30000 + b"}",
    b'{"a":' * 9000 + b"1" + b"}" * 9000, b'{"match": ' + b"[" * 50 + b"]" * 50 + b"}",
    b'{"__proto__": {"sure": true}}', b'{"file": "/etc/passwd"}', b'{"at": "20:00"}',
    b'{"yes": true}', b'{"by": "x", "key": "y", "event": 1}',
]  # fmt: skip
TOO_LARGE = [b'{"match": "' + b"x" * 65536 + b'"}', b" " * (guard.MOST_BYTES + 1)]


@pytest.mark.slow
def test_a_body_that_is_not_what_is_asked_for_is_refused(attacked: Attacked) -> None:
    may = {"authorization": attacked.bearer("director")}
    for one in (op for op in EVERY if op.method == "POST"):
        for body in WRONG if one.required else WRONG[1:]:  # where nothing need be sent
            assert attacked.refused(one, body, **may) == 400, (one, body[:40])
        for body in TOO_LARGE:
            assert attacked.refused(one, body, **may) == 413, one
        for kind in ("text/plain", "application/x-www-form-urlencoded", "multipart/form-data; x",
                     "application/xml", "x", ""):  # fmt: skip
            assert attacked.refused(one, {"match": "1"}, kind=kind, **may) == 415
        for key in ("x" * 201, "\x7f", "a b") if one.scope else ():
            whole = dict.fromkeys(one.required, "1")
            assert attacked.refused(one, whole, idempotency_key=key, **may) == 400, one


@pytest.mark.slow
def test_a_body_that_never_comes_is_given_up(
    attacked: Attacked, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guard, "PATIENCE", 0.01)

    async def asked(one: Operation) -> list[Any]:
        sent: list[Any] = []

        async def receive() -> dict[str, Any]:
            if sent or receive.begun:  # type: ignore[attr-defined]
                await asyncio.sleep(10)
            receive.begun = True  # type: ignore[attr-defined]
            return {"type": "http.request", "body": b'{"match": ', "more_body": True}

        async def send(message: Any) -> None:
            sent.append(message)

        receive.begun = False  # type: ignore[attr-defined]
        head = {"host": "localhost", "content-type": "application/json",
                "authorization": attacked.bearer("director")}  # fmt: skip
        scope = {
            "type": "http", "method": one.method, "path": one.path, "raw_path": one.path.encode(),
            "query_string": b"", "client": (next(_ADDRESSES), 1), "server": ("localhost", 80),
            "headers": [(name.encode(), value.encode()) for name, value in head.items()],
            "scheme": "http", "http_version": "1.1", "root_path": "",
        }  # fmt: skip
        await attacked.room.app(scope, receive, send)
        return sent

    for one in (op for op in EVERY if op.method == "POST"):
        got = attacked.room.loop.run_until_complete(asked(one))
        assert got[0]["status"] == 408, one
        assert json.loads(got[1]["body"])["status"] == 408


VALUES: list[Any] = [
    None, True, False, 0, -1, 1, 2, 1e6, -1e300, 0.5, 10**39, "", " ", "1", "W1.1", "Ann", "ann",
    "' OR 1=1; DROP TABLE entry; --", "<script>alert(1)</script>", "=HYPERLINK(\"x\")", "\x00",
    "a\x00b", "\u202eevil", "\U0001f3b1", "é" * 100, "x" * 201, "x" * 60000, "../../etc/passwd",
    "{player}", "{0.__class__}", "%s%n", "3:1", "99999:1", "-1:0", "19:99", "nan", "1e999", [], [1],
    [1, 0], [0, 0], [3, 0], [1, 2, 3], [-1, 0], [10**30, 0], [0.5, 1], ["1", "0"], [[1, 0]], {},
    {"a": 1}, [None], ["Ann", "Bo"], ["\x00"], [True, False],
]  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(ATTACKS))
def test_whatever_is_in_a_field_is_taken_or_refused(seed: int, tmp_path: Path) -> None:
    luck, found = random.Random(seed), Attacked(tmp_path)
    whole: dict[str, Any] = {
        "match": "1", "score": [1, 0], "player": "Ann", "name": "Bo", "to": "Zoe", "one": "1",
        "other": "2",
    }  # fmt: skip
    with closing(found.room):
        for _ in range(120):
            one = luck.choice(WRITES if luck.random() < 0.8 else EVERY)
            fields = [*one.fields, *one.parameters]
            body = {name: whole.get(name, "1") for name in one.required}
            for name in luck.sample(fields, min(len(fields), luck.randint(1, 2))):
                body[name] = luck.choice(VALUES)
            query = ""
            for name in one.parameters:
                value = body.pop(name, None)
                if value is not None:
                    query = f"?{name}={random_text(value)}"
            before = held(found.path)
            head = {"authorization": found.bearer("director"), "query": query}
            got = found.asks(one, body, **head)
            said = (seed, one.method, one.path, body, query, got.status, got.text[-300:])
            assert got.status < 500, said
            if got.status >= 400:
                found.is_problem(got, said)
            if got.status >= 400 or one.method == "GET" or not one.scope:
                assert held(found.path) == before, said
        for page in ("/", "/bracket", "/players", "/desk", "/desk/history", "/screen"):
            shown = found.director.open(page)
            assert shown.status == 200, (seed, page)
            assert "<script>alert" not in shown.text
            assert "\x00" not in shown.text


def random_text(value: object) -> str:
    """Return a value as an address has it."""
    from urllib.parse import quote

    return quote(value if isinstance(value, str) else json.dumps(value))
