"""Whatever stands in a request's head, or however it is cut, is answered and never fails."""

import random
import socket
import time
from collections.abc import Iterator
from contextlib import suppress
from urllib.parse import urlsplit

import pytest

from evenbreak.web import guard
from tries import tries
from web.conftest import Hall
from web.phones import Phone

TRIES = tries("heads of requests", 100)

PATHS = [
    *("/", "/players", "/bracket", "/screen", "/fair", "/prizes", "/league", "/team", "/pin"),
    *("/evenbreak.css", "/desk", "/desk/history", "/desk/codes", "/new", "/c/x", "/nothing"),
    *("/bracket.pdf", "/results.csv", "/%zz", "/\xff", "//x", "/?a=%ff&a=\x7f", "*", "/events/x"),
]
FORMS = [
    "/pin",
    "/leave",
    "/language",
    "/desk/undo",
    "/desk/result",
    "/new",
    "/league",
    "/team/new",
]
ODD = [
    *(
        "",
        " ",
        "http://[",
        "http://[::1",
        "//[x]",
        "http://]:x/",
        "\xff\xfe",
        "a" * 3000,
        "%",
        "%00",
    ),
    *(
        "-1",
        "1e9",
        "9" * 40,
        "0x10",
        "\u00b2".encode().decode("latin-1"),
        ";",
        ";;=",
        ",,,",
        "=",
        '"',
    ),
    *("http://127.0.0.1:99999/", "http://127.0.0.1:x/", "http://\x80/", "javascript:alert(1)"),
]
CHARSETS = [
    "undefined",
    "utf-7",
    "idna",
    "punycode",
    "base64",
    "rot13",
    "x" * 300,
    '"',
    "\xff",
    "mbcs",
]
EDGES = ["", "x", '"', '"x', "x" * 300, "\xff", " ", "-" * 70, "x; x", "x\ty"]
KINDS = [
    *("multipart/form-data; boundary=x; charset={charset}", "multipart/form-data; boundary={edge}"),
    *("multipart/form-data", "application/x-www-form-urlencoded; charset={charset}"),
    *(
        "multipart/form-data; charset={charset}; boundary={edge}",
        "text/plain",
        "{odd}",
        "/",
        "a/b;c",
    ),
]
BODIES = [
    b"",
    b"csrf=x",
    b"csrf=%ff&a=%zz",
    b"--x\r\nContent-Disposition: form-data; name=csrf\r\n\r\n\xff\r\n--x--\r\n",
    b'--x\r\nContent-Disposition: form-data; name="a"; filename="\xff"\r\n\r\n1\r\n--x--\r\n',
    b"--x\r\nContent-Disposition: form-data\r\n\r\n1\r\n--x--\r\n",
    b"--x\r\nContent-Disposition: form-data; name*=utf-7''a\r\n\r\n1\r\n--x--\r\n",
    b"--x\r\nContent-Type: \xff\r\n\r\n1\r\n--x--",
    b"--x\r\n: \r\n\r\n--x\r\n",
    b"--x",
    b"\0" * 100,
]


def head_of(luck: random.Random, hall: Hall, cookie: str) -> tuple[list[tuple[str, str]], bytes]:
    """Return a head with a few unusual lines, and a body that may go with it."""
    place = urlsplit(hall.site.address).netloc
    odd = luck.choice(ODD)
    kind = luck.choice(KINDS).format(
        charset=luck.choice(CHARSETS), edge=luck.choice(EDGES), odd=odd
    )
    body = luck.choice(BODIES)
    lines = {
        "Host": place,
        "Cookie": luck.choice([cookie, cookie[:-1], f"{cookie}; {cookie}", odd, f"{odd}={odd}"]),
        "Content-Type": kind,
        "Content-Length": str(len(body)),
    }
    unusual = {
        "Host": luck.choice([odd, f"{odd}:{odd}", f"{place}{odd}", "[::1]:", "127.0.0.1:", "[::1"]),
        "Referer": luck.choice([odd, f"http://{place}{odd}", f"http://{place}//{odd}"]),
        "Accept-Language": luck.choice([odd, f"de;q={odd}", "de," * 200, f"{odd}-{odd}"]),
        "Range": luck.choice(["bytes=0-", "bytes=5-1", f"bytes={odd}", "bytes=" + "0-1," * 300]),
        "If-Modified-Since": odd,
        "If-None-Match": odd,
        "Content-Length": luck.choice([odd, "5, 5", "+3", str(len(body) - 1), "4000000"]),
        "Transfer-Encoding": luck.choice(["chunked", "gzip", "chunked, chunked", odd]),
        "Content-Encoding": "gzip",
        "Expect": luck.choice(["100-continue", odd]),
        "Upgrade": luck.choice(["websocket", "h2c", odd]),
        "Connection": luck.choice(["upgrade", "close", odd]),
        "X-Forwarded-For": odd,
        "Origin": odd,
    }
    for name in luck.sample(list(unusual), luck.randrange(1, 4)):
        lines[name] = unusual[name]
    return list(lines.items()), body


def answer(hall: Hall, request: bytes) -> bytes:
    """Return the first line of the answer; b"" if the connection was closed without one."""
    place = urlsplit(hall.site.address)
    with socket.create_connection((place.hostname, place.port), timeout=8) as line:
        line.sendall(request)
        try:
            return line.makefile("rb").readline()
        except ConnectionResetError:
            return b""


@pytest.fixture
def cookie(served_hall: Hall) -> Iterator[str]:
    """The cookie of a director."""
    director = Phone(served_hall.site, director=True)
    (kept,) = director.jar
    yield f"{kept.name}={kept.value}"
    assert director.open("/desk").status == 200  # the page goes on


@pytest.mark.slow
def test_no_head_makes_the_page_fail(
    served_hall: Hall, cookie: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guard, "PATIENCE", 0.2)
    for seed in range(TRIES):
        luck = random.Random(seed)
        lines, body = head_of(luck, served_hall, cookie)
        method = luck.choice(["GET", "POST", "POST", "HEAD", "PUT", "OPTIONS", "get"])
        path = luck.choice(FORMS if method == "POST" else PATHS)
        head = "".join(f"{name}: {value}\r\n" for name, value in lines)
        request = f"{method} {path} HTTP/1.1\r\n{head}\r\n".encode("latin-1", "replace") + body
        found = answer(served_hall, request)
        assert not found.startswith(b"HTTP/1.1 5"), (seed, request)


@pytest.mark.slow_after(2)
@pytest.mark.parametrize("charset", [*CHARSETS, "latin-1", "utf-8"])
def test_no_charset_of_a_form_makes_the_page_fail(served_hall: Hall, charset: str) -> None:
    place = urlsplit(served_hall.site.address).netloc
    for kind in (KINDS[0], KINDS[3]):
        for body in BODIES:
            head = (
                f"POST /pin HTTP/1.1\r\nHost: {place}\r\nContent-Length: {len(body)}\r\n"
                f"Content-Type: {kind.format(charset=charset)}\r\n\r\n"
            )
            found = answer(served_hall, head.encode("latin-1") + body)
            assert found.startswith(b"HTTP/1.1 4"), (kind, body)


@pytest.mark.parametrize("pieces", [1, 20])
@pytest.mark.parametrize("where", ["one line", "many lines", "address"])
def test_a_head_that_is_too_large_is_refused(served_hall: Hall, where: str, pieces: int) -> None:
    place, large = urlsplit(served_hall.site.address), "x" * 40_000
    head = {
        "one line": f"GET / HTTP/1.1\r\nCookie: a={large}\r\n",
        "many lines": "GET / HTTP/1.1\r\n" + f"X-A: {'x' * 90}\r\n" * 400,
        "address": f"GET /?a={large} HTTP/1.1\r\n",
    }[where]
    request = f"{head}Host: {place.netloc}\r\n\r\n".encode()
    step = -(-len(request) // pieces)
    with socket.create_connection((place.hostname, place.port), timeout=8) as line:
        for start in range(0, len(request), step):
            with suppress(OSError):  # refused before everything was sent
                line.sendall(request[start : start + step])
                time.sleep(0.001 * (pieces > 1))
        with suppress(ConnectionResetError):
            assert line.recv(13) in (b"HTTP/1.1 431 ", b"HTTP/1.1 400 ")
    assert served_hall.guest.open("/").status == 200
