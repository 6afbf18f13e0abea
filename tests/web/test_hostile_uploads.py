"""Files that come in by the page: each is taken, or its form comes back with the reason."""

import random
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from evenbreak.web.site import Site
from files.test_mutated_files import first, tampered
from tries import tries
from web.asked import Browser, Room
from web.test_who_may import NEW, TEAMS

PART = "--edge\r\nContent-Disposition: form-data"
UPLOADS = tries("uploads", 15)
WHERE = {
    "/new": ("file", {**NEW, "entrants": ""}, first("demo_entrants.csv", 9)),
    "/league": ("file", {"scale": "fargo", "race": "5"}, first("demo_league.csv", 12)),
    "/team/new": ("file_a", {**TEAMS, "players_a": ""}, "player,rating\nAnn,600\nBo,580\nCy,570\n"),
}


@pytest.fixture
def room(tmp_path: Path) -> Iterator[Room]:
    found = Room(Site(tmp_path / "tonight.db", hosts=frozenset({"localhost"})))
    yield found
    found.close()


def sent(browser: Browser, path: str, name: str, content: bytes, fields: dict[str, object]):
    """Send a form with a file."""
    body = b""
    for key, value in {**browser.hidden(), **fields}.items():
        body += (
            f'--edge\r\nContent-Disposition: form-data; name="{key}"\r\n\r\n{value}\r\n'.encode()
        )
    head = f'{PART}; name="{name}"; filename="../x"\r\n\r\n'
    body += head.encode() + content + b"\r\n--edge--\r\n"
    return browser.ask("POST", path, body=body, kind="multipart/form-data; boundary=edge")


def test_an_upload_is_taken_or_refused_in_words(room: Room, tmp_path: Path) -> None:
    director, taken = Browser(room, director=True), 0
    for seed in range(UPLOADS):
        luck, path = random.Random(seed), list(WHERE)[seed % len(WHERE)]
        name, fields, good = WHERE[path]
        got = sent(director, path, name, tampered(good, luck), fields)
        said = (seed, path, got.status, got.words[-400:])
        assert got.status in (303, 400, 409, 413), said
        taken += got.status == 303
        assert str(tmp_path) not in got.text, said
        assert tempfile.gettempdir() not in got.text, said
        if got.status == 303:
            assert director.open(got.to).status == 200, said
    assert taken
