"""Questions by HTTP: answered as the command answers, within bounds, and without files or code."""

from __future__ import annotations

import asyncio
import json
import shlex
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any
from unittest.mock import patch

import click
import pytest

from evenbreak.answers.asked import ASKED, question_of
from evenbreak.cli.kit.asked import Typed
from evenbreak.cli.program import program
from evenbreak.fields.kinds import Number, TwoWhole, Whole
from evenbreak.fields.question import declared
from evenbreak.web.api import ask
from evenbreak.web.site import Site
from places import ROOT
from test_faces import ASKED as GOLDEN
from test_faces import SLOW, command_of
from test_faces import ask as by_command
from web.asked import Browser, Got, Room

QUESTIONS = {one.path[1:].replace("/", " "): one for one in ask.RESOURCES}
ODDS = {"ratings": [612, 521], "scale": "fargo", "race": [7, 5]}
LONG = {"ahead": [1000, 1000], "form": 2.0, "p1": 0.99, "p2": 0.6, "breaks": "winner"}


@pytest.fixture
def browser(tmp_path: Path) -> Iterator[Browser]:
    with closing(Room(Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"})))) as room:
        yield Browser(room)


def in_json(question: type, typed: dict[str, Any]) -> dict[str, Any]:
    """Return what is typed as JSON has it."""

    def one(kind: Any, text: Any) -> Any:
        if isinstance(kind, Whole | Number):
            return kind.read(text)
        return list(kind.read(text)) if isinstance(kind, TwoWhole) else text

    return {
        said.name: [one(said.kind, text) for text in typed[said.name]]
        if said.field.many
        else one(said.kind, typed[said.name])
        for said in declared(question)
        if said.name in typed
    }


def body_of(line: str) -> dict[str, Any]:
    """Return the question of a command line as the body of a request."""
    name, group, words = command_of_line(line), program, shlex.split(line)
    for word in name.split():
        group = group.get_command(click.Context(group), word)  # type: ignore[assignment]
    rest = words[len(name.split()) :]
    with patch.object(Typed, "convert", lambda *given: given[1]):
        ctx = group.make_context(name, rest)
    typed = {key: value for key, value in ctx.params.items() if value not in (None, (), False)}
    question = question_of(name)
    return in_json(question, question.split(typed))


def command_of_line(line: str) -> str:
    return next(command_of(name) for name, asked in GOLDEN.items() if asked == line)


def asked_by_http() -> Iterator[Any]:
    """Yield the golden questions that the interface answers."""
    for name, line in GOLDEN.items():
        command = command_of(name)
        if command in QUESTIONS:
            known = {one.name for one in QUESTIONS[command].asks}
            if set(body_of(line)) <= known and "data/" not in line:
                yield pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW))


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("name", list(asked_by_http()))
def test_the_answer_is_what_the_command_prints(browser: Browser, name: str) -> None:
    with patch.object(ask, "MOST_SECONDS", 60.0):  # of a computer that others work on too
        path = f"/api/v1{QUESTIONS[command_of(name)].path}"
        got = browser.tells("POST", path, body_of(GOLDEN[name]))
    assert (got.status, got.headers["content-type"]) == (200, "application/json")
    assert got.text == by_command(GOLDEN[name], "--json")


def test_every_question_without_files_is_answered() -> None:
    """Those left out need a file, and no other field lets one in."""
    assert set(ASKED) - set(QUESTIONS) == {"chips odds", "practice"}
    for one in QUESTIONS.values():
        assert not {"plot", "out", "league", "from_file", "results", "jobs", "dask"} & {
            asked.name for asked in one.asks
        }


STRANGE = ("/etc/passwd", "../x.csv", "data/house_chart.csv", "-", "sneaky_code:Sneaky", "a" * 9000)
_TOUCHED: list[str] = []
_WATCHING = [False]


def _touched(event: str, given: tuple[Any, ...]) -> None:
    if _WATCHING[0] and event in ("open", "import", "os.listdir", "socket.connect", "exec.file"):
        _TOUCHED.extend(f"{event} {one}" for one in given if str(one).startswith(STRANGE[:5]))
        _TOUCHED.extend(f"{event} {one}" for one in given if "sneaky" in str(one))


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("command", QUESTIONS)
def test_no_file_and_no_code_can_be_named(
    browser: Browser, command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not _TOUCHED and not getattr(sys, "_watched", False):
        sys._watched = True  # type: ignore[attr-defined]
        sys.addaudithook(_touched)
    (tmp_path / "sneaky_code.py").write_text("raise SystemExit('it ran')", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    one = QUESTIONS[command]
    browser.room.site.questions.most = 10_000
    _WATCHING[0] = True
    try:
        for asked in one.asks:
            for word in STRANGE:
                value: Any = [word, word] if asked.field.many else word
                got = browser.tells("POST", f"/api/v1{one.path}", {asked.name: value})
                assert got.status == 400, (asked.name, word, got.text)
                assert got.headers["content-type"] == "application/problem+json"
    finally:
        _WATCHING[0] = False
    assert _TOUCHED == []


@pytest.mark.parametrize(
    ("body", "parameter", "words"),
    [
        ({"p": 0.6}, None, "match: give race M:N, ahead M:N or chart"),
        ({**ODDS, "from_file": "ratings.csv"}, "from_file", "parameter of this address"),
        ({**ODDS, "race": "7:5"}, "race", "list of two numbers."),
        ({**ODDS, "ratings": [190, 140], "scale": "snooker"}, "scale", "'snooker'"),
        (
            {"ratings": [190, 140], "race": [7, 7]},
            None,
            (
                "which scale they're on: A wins a game against B 76% of the time by NPL ratings, "
                "59% by Fargo ratings, 57% by Elo ratings. Add scale npl, scale fargo"
            ),
        ),
        ({"p": 7, "race": [7, 7]}, "p", "0 to 1"),
        ({"p": "0.6", "race": [7, 7]}, "p", "'p': \"0.6\" is text. Leave out the quotes"),
        ({"p": 0.6, "race": ["7", 7]}, "race", "'race': \"7\" is text. Leave out the quotes"),
        ({"p": [], "race": [7, 7]}, "p", "'p': [] isn't a number"),
        ({"p": 10**400, "race": [7, 7]}, None, "a number that is too large"),
    ],
)
def test_what_is_wrong_is_said(
    browser: Browser, body: dict[str, Any], parameter: str | None, words: str
) -> None:
    got = browser.tells("POST", "/api/v1/odds", body)
    assert (got.status, got.json.get("parameter")) == (400, parameter)
    assert words in got.json["detail"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("path", "body"),
    [
        ("/ladder", {"scale": 1000, "step": 1}),
        ("/ladder", {"system": "elo 16", "day_sd": 5, "matches_a_night": 20}),
        ("/odds", {"p": 0.6, "race": [1000, 1000], "set": [1000, 1000]}),
        ("/odds", {"p": 0.6, "ahead": [1000, 1000], "exact": True, "set_": [10, 10]}),
        ("/compare", {"p": 0.6, "formats": ["1:1" + " of 1:1" * 3000]}),
        ("/chart/design", {"games": [1, 1000], "up_to": 1_000_000}),
    ],
)
def test_giants_are_refused_before_they_are_begun(
    browser: Browser, path: str, body: dict[str, Any]
) -> None:
    begun = time.thread_time()
    got = browser.tells("POST", f"/api/v1{path}", body)
    assert got.status == 400
    assert "seconds" not in got.json["detail"].replace("20 seconds", "")
    assert time.thread_time() - begun < 1.0


def test_numbers_are_numbers(browser: Browser) -> None:
    got = browser.tells("POST", "/api/v1/odds", {**ODDS, "scale": 100.0})
    assert got.json["p_win_a"] == browser.tells("POST", "/api/v1/odds", ODDS).json["p_win_a"]


# What stops it may be raised in a callback of the garbage collector, which Hypothesis has set.
@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_what_takes_long_is_stopped_while_pages_go_on(browser: Browser) -> None:
    done: list[str] = []

    async def asks(method: str, path: str, body: dict[str, Any]) -> int:
        sent = json.dumps(body).encode() if body else b""
        head = {"host": "localhost", "content-type": "application/json"}
        got = await browser._asked(method, path, head, sent)
        done.append(path)
        return got.status

    async def both() -> list[int]:
        long = asyncio.ensure_future(asks("POST", "/api/v1/odds", LONG))
        await asyncio.sleep(0.05)
        return [await asks("GET", "/fair", {}), await long]

    with patch.object(ask, "MOST_SECONDS", 0.5):
        assert browser.room.loop.run_until_complete(both()) == [200, 400]
    assert done == ["/fair", "/api/v1/odds"]
    assert browser.tells("POST", "/api/v1/odds", ODDS).status == 200


def test_many_questions_are_too_many(browser: Browser) -> None:
    browser.room.site.questions.most = 2
    statuses = [browser.tells("POST", "/api/v1/odds", ODDS).status for _ in range(3)]
    assert statuses == [200, 200, 429]


def test_no_address_takes_the_answers_of_the_others(browser: Browser) -> None:
    """Those that are refused while it waits do not count; when all places are taken, all wait."""
    room, gate = browser.room, threading.Event()
    room.site.questions.most = 4

    async def asks(guest: int) -> Got:
        sent = json.dumps(ODDS).encode()
        head = {"host": "localhost", "content-type": "application/json"}
        one = Browser(room, address=f"10.0.0.{guest}")
        return await one._asked("POST", "/api/v1/odds", head, sent)

    async def together(*guests: int) -> list[Got]:
        asked = [asyncio.ensure_future(asks(guest)) for guest in guests]
        refused = len(asked) - ask.MOST_WAITING
        while sum(one.done() for one in asked) < refused:
            await asyncio.sleep(0.001)
        gate.set()
        return await asyncio.gather(*asked)

    with patch.object(ask, "answer_in_json", lambda *_: b"{}" if gate.wait(10) else b""):
        got = room.loop.run_until_complete(together(*[1] * 8, *range(2, 10)))
        assert [one.status for one in got] == [200] * 2 + [503] * 6 + [200] * 6 + [503] * 2
        assert got[2].headers["retry-after"] == "5"
        again = [room.loop.run_until_complete(asks(1)).status for _ in range(3)]
        assert again == [200, 200, 429]


def test_the_example_of_the_docs(browser: Browser) -> None:
    text = (ROOT / "docs" / "reference" / "json.md").read_text("utf-8")
    words = shlex.split(next(line for line in text.splitlines() if line.startswith("curl")))
    path = words[-1].removeprefix("http://localhost:8000")
    got = browser.tells("POST", path, json.loads(words[words.index("--json") + 1]))
    assert got.text == by_command("odds 612 521 --scale fargo --race 7:5", "--json")
