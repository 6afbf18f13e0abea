"""Browsers that ask a page's application without a server between: soon answered, and all alike."""

from __future__ import annotations

import asyncio
import base64
import json
import re
import urllib.parse
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import unescape
from html.parser import HTMLParser
from typing import Any, NamedTuple

from itsdangerous import TimestampSigner
from starlette.applications import Starlette

from evenbreak.web.app import cookie_name, make_app
from evenbreak.web.site import Site
from web.phones import answer_of, carried, seen_at


class Got(NamedTuple):
    """What a browser was answered."""

    status: int
    body: bytes
    to: str
    headers: Mapping[str, str] = {}

    @property
    def json(self) -> Any:
        return json.loads(self.body)

    @property
    def text(self) -> str:
        return self.body.decode("utf-8", "replace")

    @property
    def words(self) -> str:
        """The text without tags."""
        inner = re.sub(r"<(script|style).*?</\1>", " ", self.text, flags=re.DOTALL)
        return " ".join(unescape(re.sub(r"<[^>]+>", " ", inner)).split())


class Room:
    """An application with the loop that it runs in, and what it complains of."""

    def __init__(self, site: Site) -> None:
        self.site = site
        self.app: Starlette = make_app(site)
        self.app.state.watch.close()  # a stream says one thing and ends
        self.loop = asyncio.new_event_loop()

    def close(self) -> None:
        self.loop.close()


class Browser:
    """A browser with cookies and an address of its own."""

    def __init__(self, room: Room, *, address: str = "127.0.0.9", director: bool = False) -> None:
        self.room, self.address = room, address
        self.cookies: dict[str, str] = {}
        self.kept = ""
        self.fixed = False  # whether it keeps its cookies whatever the page sets
        self.expected: tuple[type[Exception], ...] = ()  # what the application may fail with
        if director:
            assert self.send("/pin", pin=room.site.pin).status == 303

    def token(self) -> str:
        """Return the token of this browser's forms."""
        if not self.kept:
            self.kept = re.findall(r'name="csrf" value="([^"]+)"', self.open("/pin").text)[0]
        return self.kept

    def open(self, path: str, **asked: str) -> Got:
        if asked:
            path = f"{path}?{urllib.parse.urlencode(asked)}"
        return self.ask("GET", path)

    def send(self, path: str, **fields: object) -> Got:
        """Send a form of this browser."""
        seen = seen_at(self.room.site, path, fields)
        return self.ask("POST", path, {**self.hidden(), **seen, **fields})

    def claims(self, name: str) -> Got:
        """Say that this is a player's phone."""
        return self.send("/me/claim", name=name)

    def taps(self, match: str, a: int, b: int, **more: object) -> Got:
        """Tap the score of a match on the player's own page."""
        return self.send("/me/score", match=match, a=a, b=b, **more)

    def tells(self, method: str, path: str, body: object = None, **head: str) -> Got:
        """Ask as another program does: in JSON, without cookies."""
        sent = b"" if body is None else json.dumps(body).encode()
        cookies, self.cookies = self.cookies, {}
        try:
            return self.ask(method, path, body=sent, kind="application/json", **head)
        finally:
            self.cookies = cookies

    def hidden(self) -> dict[str, str]:
        """Return what every form of a page that is opened now carries unseen."""
        return carried(self.room.site, self.token())

    def told(self, path: str, **fields: object) -> Got:
        """Send a form, and open the page that it leads to."""
        got = self.send(path, **fields)
        return self.open(got.to) if got.status == 303 else got

    def ask(
        self,
        method: str,
        path: str,
        fields: Mapping[str, object] | Sequence[tuple[str, object]] | None = None,
        *,
        host: str = "localhost",
        body: bytes = b"",
        kind: str = "application/x-www-form-urlencoded",
        **more: str,
    ) -> Got:
        """Ask whatever is to be asked; `more` are further headers, `if_none_match` for one."""
        body = body or urllib.parse.urlencode(fields or {}, doseq=True).encode()
        cookie = "; ".join(f"{name}={value}" for name, value in self.cookies.items())
        head = {"host": host, "cookie": cookie, "content-type": kind}
        head["content-length"] = str(len(body))
        head |= {name.replace("_", "-"): value for name, value in more.items()}
        return self.room.loop.run_until_complete(self._asked(method, path, head, body))

    async def asking(self, method: str, path: str, fields: Mapping[str, object]) -> Got:
        """Ask beside others of the same loop."""
        body = urllib.parse.urlencode(fields, doseq=True).encode()
        cookie = "; ".join(f"{name}={value}" for name, value in self.cookies.items())
        head = {"host": "localhost", "cookie": cookie, "content-length": str(len(body))}
        head["content-type"] = "application/x-www-form-urlencoded"
        return await self._asked(method, path, head, body)

    async def _asked(self, method: str, path: str, head: dict[str, str], body: bytes) -> Got:
        status, headers, sent = await answer_of(
            self.room.app, method, path, head, body, address=self.address, expected=self.expected
        )
        for name, value in headers:
            if name == "set-cookie" and not self.fixed:
                key, _, held = value.partition(";")[0].partition("=")
                self.cookies[key] = held
        to = urllib.parse.urlsplit(dict(headers).get("location", ""))
        return Got(status, sent, to._replace(scheme="", netloc="").geturl(), dict(headers))


def session(site: Site, held: Mapping[str, object], key: str = "") -> dict[str, str]:
    """Return the cookie of a session that holds this, signed with a key (that of the site)."""
    data = base64.b64encode(json.dumps(dict(held)).encode())
    signed = TimestampSigner(key or site.cookie_key).sign(data)
    return {cookie_name(site): signed.decode()}


def copy_of(browser: Browser, *, address: str = "127.0.0.8") -> Browser:
    """Return another browser with the same cookies."""
    same = Browser(browser.room, address=address)
    same.kept = browser.token()
    same.cookies = dict(browser.cookies)
    return same


@dataclass
class Form:
    """A form that is posted, as a page shows it.

    Parameters
    ----------
    action
        where it goes to.
    fields
        what it sends if nothing is done, in its order.
    typed, choices
        the fields that are typed in, and the values among which others are chosen.
    words
        what stands in it.
    """

    action: str
    fields: list[tuple[str, str]] = field(default_factory=list)
    typed: list[str] = field(default_factory=list)
    choices: dict[str, list[str]] = field(default_factory=dict)
    words: str = ""

    def filled(self, **more: str) -> list[tuple[str, str]]:
        """Return its fields with others, or with other values."""
        return [*((name, value) for name, value in self.fields if name not in more), *more.items()]


class _Reader(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.forms: list[Form] = []
        self.inside = False
        self.select = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        at = {name: value or "" for name, value in attrs}
        if tag == "form":
            self.inside = at.get("method") == "post"
            if self.inside:
                self.forms.append(Form(at["action"]))
        if not self.inside:
            return
        form, name = self.forms[-1], at.get("name", "")
        form.words += f" {at.get('aria-label', '')} "
        if tag == "input" and at.get("type") == "hidden":
            form.fields.append((name, at["value"]))
        elif tag == "input" and at.get("type") in ("radio", "checkbox"):
            form.choices.setdefault(name, []).append(at["value"])
        elif tag == "input" and name:
            form.typed.append(name)
            form.fields.append((name, at.get("value", "")))
        elif tag == "button" and name and "disabled" not in at:
            form.choices.setdefault(name, []).append(at["value"])
        elif tag == "select":
            self.select = name
            form.choices[name] = []
        elif tag == "option" and self.select and "value" in at:
            form.choices[self.select].append(at["value"])

    def handle_data(self, data: str) -> None:
        if not self.inside:
            return
        form = self.forms[-1]
        form.words += data
        if self.select and self.lasttag == "option" and data.strip():
            form.choices[self.select].append(data.strip())

    def handle_endtag(self, tag: str) -> None:
        self.inside = self.inside and tag != "form"
        if tag == "select":
            self.select = ""


def forms_in(text: str) -> list[Form]:
    """Return the forms of a page that are posted."""
    return _Reader(text).forms


def forms_of(got: Got) -> list[Form]:
    """Return the same of what a browser was answered."""
    return forms_in(got.text)
