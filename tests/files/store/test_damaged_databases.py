"""A damaged or hostile database gives a right answer or one clear line, and never a traceback."""

import asyncio
import base64
import json
import random
import re
import shutil
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from itsdangerous import TimestampSigner

from earlier_files import NIGHT, TOURNAMENTS
from evenbreak.cli.program import program
from evenbreak.errors import EvenbreakError
from evenbreak.web.app import cookie_name, make_app
from evenbreak.web.site import Site
from files.mutants import mutate
from tournament_nights import SAVED
from tries import tries

MUTANTS = tries("damaged databases", 5)

COMMANDS = (
    ("show",),
    ("next",),
    ("odds", "--json"),
    ("time",),
    ("prizes", "--fee", "20"),
    ("export",),
    ("export", "--events"),
    ("result", "W2.1", "5:3"),
    ("undo",),
    ("drop", "Bo"),
)
PAGES = ("/", "/bracket", "/players", "/screen", "/desk", "/new", "/team", "/prizes", "/pin")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(MUTANTS))
def test_a_damaged_database_is_answered_in_words(seed: int, tmp_path: Path) -> None:
    luck = random.Random(seed)
    good = luck.choice([*TOURNAMENTS, "tournament", NIGHT]) + ".db"
    path = tmp_path / "tonight.db"
    shutil.copy(SAVED / "v0_2_0" / good, path)
    how = f"seed {seed}, {good}, {mutate(path, luck)}"
    kept = {one: one.read_bytes() for one in tmp_path.iterdir()}
    for words in luck.sample(COMMANDS, 2):
        ran = CliRunner().invoke(program, ["tournament", *words, "--file", str(path)])
        code, said = ran.exit_code, ran.stderr.strip().splitlines()
        assert isinstance(ran.exception, SystemExit | None), f"{how}, {words}: {ran.exception!r}"
        assert (code == 0) == (ran.exception is None or code == 0)
        if code:
            errors = [line for line in said if line.startswith("Error: ")]
            assert len(errors) == 1, f"{how}, {words}: {said}"
            assert not re.search(r"Error\(|object at|<class|/tmp", errors[0]), f"{how}: {said}"
        for one, body in kept.items():
            one.write_bytes(body)
    for page, status, text in pages(path):
        assert status < 500, f"{how}, {page}: {status} {text[-300:]}"
        assert str(tmp_path) not in text


@pytest.mark.slow
def test_the_pages_are_those_of_the_director(tmp_path: Path) -> None:
    good = shutil.copy(SAVED / "v0_2_0" / "tournament.db", tmp_path)
    assert [status for _, status, _ in pages(Path(good))] == [200] * len(PAGES)


def pages(path: Path) -> list[tuple[str, int, str]]:
    """Return what the director is answered on each page."""

    async def shown() -> list[tuple[str, int, str]]:
        app, session = make_app(site), session_of(site)
        return [(page, *await get(app, page, session)) for page in PAGES]

    try:
        site = Site(path)
        return asyncio.run(shown())
    except EvenbreakError:  # serve says so, and does not start
        return []


def session_of(site: Site) -> bytes:
    data = base64.b64encode(json.dumps({"director": f"{site.director_mark} visit"}).encode())
    signed = TimestampSigner(site.cookie_key).sign(data)
    return f"{cookie_name(site)}={signed.decode()}".encode()


async def get(app: Any, path: str, cookie: bytes) -> tuple[int, str]:
    """Ask an application for a page, without a server."""
    got: list[Any] = []

    async def receive() -> dict[str, Any]:
        await asyncio.sleep(0)
        return {"type": "http.request", "body": b"", "more_body": False}

    async def send(message: Any) -> None:
        got.append(message)

    scope = {
        "type": "http",
        "method": "GET",
        "path": path,
        "raw_path": path.encode(),
        "query_string": b"",
        "headers": [(b"host", b"localhost"), (b"cookie", cookie)],
        "client": ("127.0.0.1", 1),
        "server": ("localhost", 80),
        "scheme": "http",
        "http_version": "1.1",
        "root_path": "",
    }
    try:
        await app(scope, receive, send)
    except Exception as error:  # the middleware raises again what it has answered with 500
        return 500, repr(error)
    body = b"".join(one.get("body", b"") for one in got[1:])
    return got[0]["status"], body.decode()
