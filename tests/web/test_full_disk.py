"""Where nothing can be written, the page is read all the same; and no guest learns of a folder."""

import errno
import os
import re
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

from evenbreak.errors import DataError
from evenbreak.files.store.tournament import read_events
from evenbreak.web import night
from evenbreak.web.site import Site
from web.conftest import Hall
from web.phones import Phone, free_port
from web.test_kills import begun

READ = ("/", "/players", "/bracket", "/screen", "/prizes", "/league", "/fair", "/bracket.pdf")
DESK = ("/desk", "/desk/history", "/desk/codes", "/desk/time")
NAME = "where-nobody-looks"


class Stuck(NamedTuple):
    """A server that can write to no file, and the PIN that it printed."""

    site: Site
    pin: str


@pytest.fixture(scope="module")
def stuck(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Stuck]:
    if os.name == "nt":
        pytest.skip("this system does not limit the size of files")
    path, port = tmp_path_factory.mktemp(NAME) / "tonight.db", free_port()
    begun(path, 8)
    words = f"ulimit -f 0; exec {sys.executable} -m evenbreak serve {path} --port {port}"
    server = subprocess.Popen(["sh", "-c", words], stderr=subprocess.PIPE, text=True)
    try:
        said = ""
        while "Ctrl+C" not in said:
            assert server.stderr is not None
            line = server.stderr.readline()
            assert line, said
            said += line
        assert "couldn't be backed up" in said
        site = Site(path, address=f"http://127.0.0.1:{port}")
        until = time.monotonic() + 20
        while True:
            try:
                Phone(site).open("/evenbreak.css")
                break
            except OSError:
                assert time.monotonic() < until
                time.sleep(0.02)
        found = re.search(r"PIN: (\d{6})", said)
        assert found
        yield Stuck(site, found[1])
    finally:
        server.kill()
        server.communicate()


@pytest.mark.slow
def test_what_cannot_be_written_to_is_read(stuck: Stuck) -> None:
    guest, director = Phone(stuck.site), Phone(stuck.site)
    assert director.send("/pin", pin=stuck.pin).status == 200
    for phone, pages in ((guest, READ), (director, (*READ, *DESK))):
        for page in pages:
            shown = phone.open(page)
            assert shown.status == 200, page
            assert NAME not in shown.text


def test_an_entry_that_cannot_be_written_is_refused_and_reading_goes_on(stuck: Stuck) -> None:
    director = Phone(stuck.site)
    assert director.send("/pin", pin=stuck.pin).status == 200
    before = read_events(stuck.site.path)
    for to, fields in (
        ("/desk/call", {"match": "W1.1", "table": 1}),
        ("/desk/save", {}),
        ("/desk/pin", {}),
        ("/prizes", {"fee": 5, "payout": "50/50"}),
        ("/league", {"results": "a,b\n1,2\n", "scale": "fargo"}),
    ):
        shown = director.send(to, **fields)
        assert shown.status in (400, 503), to
        assert NAME not in shown.text
        assert director.open("/desk").status == 200
    assert read_events(stuck.site.path) == before
    assert director.send("/leave").status == 200
    assert director.open("/desk").status == 403


@pytest.mark.slow
def test_no_refusal_names_the_folder(hall: Hall, monkeypatch: pytest.MonkeyPatch) -> None:
    path = hall.site.path

    def fails(*_: object) -> None:
        raise DataError([f"{path}: wrong", f"{path.absolute().parent}/other.csv:3: wrong too"])

    monkeypatch.setattr(night, "read_night", fails)
    os.utime(path)
    for page in READ:
        assert str(path.parent) not in hall.guest.open(page).text, page


@pytest.mark.slow
def test_no_problem_of_the_league_names_the_folder(hall: Hall) -> None:
    path: Path = hall.site.path
    path.with_name(f"{path.stem}.league.csv").write_text("neither,nor\n1,2\n", encoding="utf-8")
    for _ in range(200):
        shown = hall.guest.open("/league")
        assert str(path.parent) not in shown.text
        if "onight.league.csv" in shown.text:
            return
        time.sleep(0.02)
    raise AssertionError(shown.words)


@pytest.mark.slow
def test_a_disk_that_fails_while_a_form_is_taken_is_said_without_its_place(
    hall: Hall, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), f"/srv/{NAME}/x")

    monkeypatch.setattr(tempfile, "TemporaryDirectory", full)
    shown = hall.director.send("/new", entrants="Ann,500\nBo,400", format="double")
    assert shown.status == 503
    assert "the disk may be full" in shown.words
    assert NAME not in shown.text


@pytest.mark.slow
@pytest.mark.parametrize("junk", [b"", b"junk" * 9000, b"SQLite format 3\0" + b"\xff" * 9000])
def test_a_file_that_is_damaged_while_it_is_shown_is_said(hall: Hall, junk: bytes) -> None:
    other = hall.site.path.with_name("other")
    other.write_bytes(junk)
    other.replace(hall.site.path)
    for phone in (hall.guest, hall.director):
        for page in (*READ, *DESK):
            shown = phone.open(page)
            assert shown.status < 500, (page, shown.words)
            assert str(hall.site.path.parent) not in shown.text
