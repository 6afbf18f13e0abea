"""What is refused: forged, replayed, oversized and foreign requests; each says why in one line."""

import http.client
import random
import socket
from contextlib import ExitStack
from html import unescape
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from starlette.requests import Request

from evenbreak.files.store.tournament import new_tournament
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.web import guard, server
from evenbreak.web.app import cookie_name, make_app
from evenbreak.web.guard import RefusalError
from evenbreak.web.sessions import check_tries
from evenbreak.web.site import Site
from files.tables.test_hostile_workbooks import Make, cut, huge_row, repeated_columns, wide_cell
from web.conftest import Hall, begun
from web.phones import Phone, answering, running

CHANGES = ["draw", "call", "result", "forfeit", "drop", "undo", "save", "late", "pin"]


def raw(hall: Hall, method: str, path: str, body: bytes = b"", **headers: str) -> tuple[int, str]:
    """Send a request as it stands."""
    place = urlsplit(hall.site.address)
    line = http.client.HTTPConnection(place.hostname or "", place.port, timeout=10)
    line.putrequest(method, path, skip_host="Host" in headers)
    for name, value in headers.items():
        line.putheader(name.replace("_", "-"), value)
    try:
        line.endheaders(body or None)
        got = line.getresponse()
        return got.status, got.read().decode("utf-8", "replace")
    finally:
        line.close()


@pytest.mark.parametrize("what", CHANGES)
def test_only_the_director_changes_anything(standing_hall: Hall, what: str) -> None:
    before = len(standing_hall.state.events)
    shown = standing_hall.guest.send(f"/desk/{what}", match="W1.1", a=3, b=0, seen=2)
    assert shown.status == 403
    assert "Only the director" in shown.words
    assert len(standing_hall.state.events) == before


@pytest.mark.parametrize("page", ["/desk", "/desk/history", "/desk/codes", "/new"])
def test_only_the_director_sees_the_desk(standing_hall: Hall, page: str) -> None:
    assert standing_hall.guest.open(page).status == 403
    assert standing_hall.director.open(page).status == 200


@pytest.mark.parametrize("token", ["", "x", "é" * 9])
def test_a_form_from_elsewhere_is_refused(standing_hall: Hall, token: str) -> None:
    shown = standing_hall.director.send_raw("/desk/undo", {"csrf": token, "seen": 2})
    assert shown.status == 403
    assert "an earlier visit" in shown.words


def test_the_token_of_another_session_is_refused(standing_hall: Hall) -> None:
    stolen = standing_hall.guest.token()
    assert standing_hall.director.send_raw("/desk/undo", {"csrf": stolen}).status == 403


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8000", "127.0.0.1.evil.example"])
def test_a_foreign_host_is_refused(served_hall: Hall, host: str) -> None:
    assert raw(served_hall, "GET", "/", Host=host)[0] == 421


def test_a_wrong_pin_is_refused_and_soon_every_pin(hall: Hall) -> None:
    phone = Phone(hall.site)
    codes = [phone.send("/pin", pin=f"wrong{k}").status for k in range(6)]
    assert codes == [403, 403, 403, 403, 403, 429]
    assert phone.send("/pin", pin=hall.site.pin).status == 429


def test_a_new_pin_shuts_out_who_entered_the_old_one(hall: Hall) -> None:
    other, old = Phone(hall.site, director=True), hall.site.pin
    same = Phone(hall.site)  # the same phone, whose second tap goes out before the first's answer
    same.kept = hall.director.token()
    for cookie in hall.director.jar:
        same.jar.set_cookie(cookie)
    shown = hall.director.send("/desk/pin", once="n")
    new = hall.site.pin
    assert f"PIN is now {new}" in same.send("/desk/pin", once="n").words
    assert hall.site.pin == new
    assert other.send("/desk/pin").status == 403
    assert new != old
    assert f"PIN is now {new}" in shown.words
    assert hall.director.open("/desk").status == 200
    assert other.open("/desk").status == 403
    assert other.send("/pin", pin=old).status == 403
    assert other.send("/pin", pin=new).status == 200
    assert Site(hall.site.path).pin == new


def test_secrets_are_kept_in_a_file_that_a_command_begins(tmp_path: Path) -> None:
    with answering(tmp_path / "tonight.db") as site:
        director = Phone(site, director=True)
        plan, entrants = Plan("single", 3), (Entrant("Ann", 80.0), Entrant("Bo", 70.0))
        new_tournament(site.path, [Event("2025-03-01T19:30:00", Opened(plan, entrants))])
        assert director.open("/desk").status == 200
        assert Site(site.path).pin == site.pin


def test_the_director_gets_in_at_the_computer_while_others_guess(hall: Hall) -> None:
    for _ in range(30):
        hall.site.all_tries.count("")
    assert Phone(hall.site).send("/pin", pin=hall.site.pin).status == 200
    elsewhere = Request({"type": "http", "client": ("10.0.0.7", 5000), "app": make_app(hall.site)})
    with pytest.raises(RefusalError):
        check_tries(elsewhere)


@pytest.mark.slow
def test_two_pages_on_one_computer_keep_their_sessions_apart(tmp_path: Path) -> None:
    with answering(tmp_path / "one.db") as one, answering(tmp_path / "other.db") as other:
        phone = Phone(one, director=True)
        phone.site, phone.kept = other, ""
        phone.open("/")
        phone.site = one
        assert "Sign out as director" in phone.open("/").words


def test_the_language_is_chosen_where_the_reader_is(standing_hall: Hall) -> None:
    asked = {"a": "600", "b": "500", "race": "9"}
    phone = Phone(standing_hall.site)
    back = unescape(phone.open("/fair", **asked).text.split('name="back" value="')[1].split('"')[0])
    assert "9-" in phone.send("/language", language="de", back=back).words
    refused = phone.send("/desk/undo").text
    back = refused.split('name="back" value="')[1].split('"')[0]
    assert phone.send("/language", language="en", back=back).status == 200


def test_nothing_of_the_evening_is_kept_by_a_browser(standing_hall: Hall) -> None:
    for path in ("/", "/desk/codes", "/bracket.pdf", "/missing"):
        assert standing_hall.director.open(path).headers["cache-control"] == "no-store"


def test_a_forged_cookie_makes_no_director(standing_hall: Hall) -> None:
    phone = Phone(standing_hall.site)
    forged = f"{cookie_name(phone.site)}=eyJkaXJlY3RvciI6ICJ4In0=.aaaa.bbbb"
    phone.opener.addheaders.append(("Cookie", forged))
    assert phone.open("/desk").status == 403


@pytest.mark.parametrize("length", ["0007100", "101", "²", "٧", "-1", "1e2", "7.5"])
def test_a_guest_cannot_ask_for_a_race_without_end(standing_hall: Hall, length: str) -> None:
    shown = standing_hall.guest.open("/fair", a="600", b="500", race=length)
    assert shown.status == 400
    assert "from 1 to 100" in shown.words


def test_too_large_a_body_is_refused(served_hall: Hall) -> None:
    size = str(guard.MOST_BYTES + 1)
    status, text = raw(served_hall, "POST", "/pin", Content_Length=size)
    assert (status, "Send less" in text) == (413, True)
    body = b"".join(b"10000\r\n" + b"x" * 65536 + b"\r\n" for _ in range(40)) + b"0\r\n\r\n"
    kind = "application/x-www-form-urlencoded"
    try:
        status, _ = raw(
            served_hall, "POST", "/pin", body, Transfer_Encoding="chunked", Content_Type=kind
        )
    except (BrokenPipeError, ConnectionResetError):
        return  # refused before everything was sent
    assert status in (400, 413)


@pytest.mark.slow_after(1)
@pytest.mark.parametrize("make", [huge_row, wide_cell, repeated_columns, cut])
def test_a_hostile_workbook_ends_no_server(hall: Hall, make: Make) -> None:
    content = make(random.Random(5))
    shown = hall.director.send_files("/new", {"file": content}, entrants="", format="double")
    assert shown.status == 400
    assert len(shown.text) < len(hall.director.open("/new").text) + 2000
    assert str(hall.site.path.parent) not in shown.words
    assert hall.guest.open("/").status == 200


def test_a_slow_body_is_cut_off(served_hall: Hall, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guard, "PATIENCE", 0.2)
    place = urlsplit(served_hall.site.address)
    with socket.create_connection((place.hostname, place.port), timeout=5) as line:
        head = f"POST /pin HTTP/1.1\r\nHost: {place.netloc}\r\nContent-Length: 50\r\n"
        line.sendall(f"{head}Content-Type: application/x-www-form-urlencoded\r\n\r\nc".encode())
        assert b" 408 " in line.recv(200)


@pytest.mark.slow
def test_connections_that_ask_for_nothing_are_ended(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "_IDLE", 2)
    with running(tmp_path / "tonight.db") as site:
        place = urlsplit(site.address)
        asked = f"GET /events HTTP/1.1\r\nHost: {place.netloc}\r\n".encode()
        with ExitStack() as ends:
            nothing, half, whole = (
                ends.enter_context(socket.create_connection((place.hostname, place.port), 5))
                for _ in range(3)
            )
            half.sendall(asked)
            whole.sendall(asked + b"\r\n")
            stream = ends.enter_context(whole.makefile("rb"))
            assert stream.readline().startswith(b"HTTP/1.1 200")
            assert (nothing.recv(9), half.recv(9)) == (b"", b"")
            assert any(line == b"data: 0\n" for line in stream)  # a stream goes on
            begun(Phone(site, director=True), ["Ann", "Bo"])
            assert any(line.startswith(b"data: ") for line in stream)


@pytest.mark.parametrize(
    "path", ["/../etc/passwd", "/c/..%2f..%2fetc", "/c/x", "/evenbreak.css/..", "/%00", "/desk/x"]
)
def test_paths_lead_nowhere(served_hall: Hall, path: str) -> None:
    status, text = raw(served_hall, "GET", path)
    assert status in (403, 404, 405)
    assert "root:" not in text


SCRIPT = "<script>alert(1)</script>"
NASTY = [SCRIPT, "Robert'); DROP TABLE event;--", "../../x", "=cmd|' /C calc'!A0", "עברית \u202e x"]


@pytest.mark.slow
def test_names_are_text_everywhere(hall: Hall) -> None:
    for name in NASTY:
        shown = hall.director.send(
            "/desk/drop", player=f"Player {16 - NASTY.index(name)}", sure="yes"
        )
        assert shown.status == 200
    hall.director.send("/desk/undo", entry=hall.state.numbers[-1])
    for page in ("/", "/desk", "/bracket", "/screen", "/desk/history"):
        assert hall.director.open(page).status == 200
    other = hall.site.path.with_name("other.db")
    with answering(other) as site:
        director = Phone(site, director=True)
        begun(director, [*NASTY, "Ann"], seeding="listed")
        for page in ("/", "/desk", "/bracket", "/screen", "/desk/codes", "/desk/history"):
            shown = director.open(page)
            assert shown.status == 200
            assert SCRIPT not in shown.text
            assert "style-src 'self'" in shown.headers["content-security-policy"]
        assert director.open("/bracket.pdf").status == 200
        assert director.open("/fair", a=SCRIPT, b="Ann").status == 200


@pytest.mark.slow
def test_the_same_tap_twice_enters_once(hall: Hall) -> None:
    for _ in range(2):
        assert hall.director.send("/desk/call", match="W1.1", table=1).status == 200
    for _ in range(2):
        assert hall.director.send("/desk/result", match="W1.1", a=3, b=1).status == 200
    kinds = [type(one.what).__name__ for one in hall.state.events]
    assert kinds == ["Opened", "Drawn", "Called", "Result", "Called"]


def test_undo_is_refused_once_something_else_came_in(hall: Hall) -> None:
    seen = len(hall.state.events)
    hall.director.send("/desk/call", match="W1.1", table=1)
    shown = hall.director.send("/desk/undo", entry=seen)
    assert shown.status == 400
    assert len(hall.state.events) == seen + 1


@pytest.mark.parametrize(
    ("path", "fields", "why"),
    [
        ("/desk/result", {"match": "W1.1", "a": "x", "b": 0}, "whole number"),
        ("/desk/result", {"match": "W1.1", "a": 9, "b": 0}, "can't be the final"),
        ("/desk/result", {"match": "W9.9", "a": 3, "b": 0}, "There's no match"),
        ("/desk/call", {"match": "W2.1", "table": 1}, "isn't ready"),
        ("/desk/late", {"player": " "}, "is blank"),
        ("/desk/late", {"player": "Zoë", "rating": "high"}, "isn't a rating"),
        ("/desk/late", {"player": "x" * 100}, "longer than"),
        ("/desk/drop", {"player": "Nobody"}, "isn't in this tournament"),
    ],
)
def test_a_wrong_entry_is_refused_in_one_line(
    standing_hall: Hall, path: str, fields: dict, why: str
) -> None:
    shown = standing_hall.director.send(path, **fields)
    assert 400 <= shown.status < 500
    assert why in shown.words
