"""What one running page knows: its file, its secrets, its words."""

from __future__ import annotations

import asyncio
import hashlib
import hmac
import itertools
import secrets
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from starlette.requests import Request

from evenbreak.errors import DataError
from evenbreak.files.league.league_file import LeagueFile
from evenbreak.files.store.desk import change_secrets, kept_secrets, new_pin
from evenbreak.files.store.evening_file import is_there
from evenbreak.files.store.tokens import Token, kept_tokens
from evenbreak.files.store.tournament import event_numbers
from evenbreak.tournaments.evening.calling import calls_after
from evenbreak.tournaments.evening.events import What
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.beside import Beside, Made
from evenbreak.web.codes import codes_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.league import League
from evenbreak.web.night import Night, mark_of, now
from evenbreak.web.room import Room
from evenbreak.web.sessions import Ticket, Tries
from evenbreak.web.team_night import TeamNights

_ENDED, _CALLS, _BY_HAND = "ended", "calls", "by hand"
_PHONES, _PORT = "phones", "port"
_MOST_KINDS = 8  # kinds of pages and answers besides, each for whoever reads it


@dataclass(eq=False)
class Site:
    """One running page.

    The file at `path` need not exist yet. `hosts` are this computer's names and addresses in
    requests, before a `Room` adds names for phones to `asked_as`; `address` is for phones, in QR
    codes. `rules`, the league's file, fills in forms. `origins` are pages elsewhere that may use
    the API from a browser. The counters cover the last minute: wrong PINs by address and overall,
    wrong player codes in the same way, taps by match, wrong tokens by address, entries by program,
    questions by address.
    """

    path: Path
    hosts: frozenset[str] = frozenset({"127.0.0.1", "localhost", "::1"})
    address: str = "http://127.0.0.1:8000"
    rules: LeagueFile | None = None
    color: str | None = None
    clock: Callable[[], str] = now
    origins: frozenset[str] = frozenset()
    tries: Tries = field(default_factory=lambda: Tries(5))
    all_tries: Tries = field(default_factory=lambda: Tries(30))
    codes: Tries = field(default_factory=lambda: Tries(10))
    all_codes: Tries = field(default_factory=lambda: Tries(60))
    taps: Tries = field(default_factory=lambda: Tries(240))
    wrong_tokens: Tries = field(default_factory=lambda: Tries(5))
    entries: Tries = field(default_factory=lambda: Tries(240))
    questions: Tries = field(default_factory=lambda: Tries(60))

    def __post_init__(self) -> None:
        self.asked_as = set(self.hosts)
        self.ticket = Ticket()
        self.room: Room | None = None
        self.night = Night(self.path, clock=lambda: self.clock())
        self._nights = {1: self.night}
        self._numbers: tuple[tuple[int, int, int] | None, list[int]] = None, [1]
        self.teams = TeamNights(self.path, self.night.beside)
        self.league = League(self.path)
        self.made = Made()
        self.asked = Beside()  # what questions of other programs are worked out by
        self._rendered: list[tuple[Sequence[object], dict[tuple[object, ...], Any]]] = []
        self._first = {
            "pin": new_pin(),
            **{name: _mark() for name in ("cookie", "director", "match")},
            **dict.fromkeys((_CALLS, _PHONES, _PORT), ""),
        }
        self.since_start: list[str] = []  # what the director has to know of it
        self._secrets = dict(self._first)
        self._read_at: tuple[int, int, int] | None = None
        self._tokens: tuple[tuple[int, int, int], dict[str, Token]] = (0, 0, 0), {}
        self._codes: tuple[list[Evening], dict[str, str]] | None = None

    @property
    def nights(self) -> list[Night]:
        """The night's events, which share its tables; an empty one if none has started."""
        mark = mark_of(self.path)
        if mark != self._numbers[0]:
            with suppress(DataError):  # of a file that cannot be read, the pages say why
                self._numbers = mark, event_numbers(self.path)
        for number in self._numbers[1]:
            if number not in self._nights:
                night = Night(self.path, number, clock=lambda: self.clock())
                night.beside = self.night.beside
                self._nights[number] = night
        return [self._nights[number] for number in self._numbers[1]]

    @property
    def begun(self) -> list[Night]:
        """The night's events; none if none has started."""
        return [night for night in self.nights if night.exists]

    @property
    def names(self) -> set[str]:
        """The names of everyone playing tonight or in the league; no sentence is expected there."""
        sheet = self.league.sheet
        tonight = {name for night in self._nights.values() for name in night.names}
        return {*tonight, *self.teams.names, *(sheet.ratings.players if sheet else ())}

    def rendered_of(self, what: Sequence[object]) -> dict[tuple[object, ...], Any]:
        """Return the pages rendered for these: the same objects, or equal strings."""
        for of, pages in self._rendered:
            if len(of) == len(what) and all(
                a is b or (isinstance(a, str) and a == b) for a, b in zip(of, what, strict=True)
            ):
                return pages
        self._rendered = [(what, {}), *self._rendered[:_MOST_KINDS]]
        return self._rendered[0][1]

    @property
    def for_phones(self) -> bool:
        """Whether phones can open the page at its address."""
        return not self.address.startswith("http://127.0.0.1:")

    def found_at(self, address: str) -> None:
        """Set the address where phones find the page from now on."""
        self.address = address
        self._rendered.clear()

    def keep_secrets(self) -> None:
        """Store the secrets in the file, if it exists, so that phones keep working after a restart.

        They are read again whenever the file has changed: another server on it may have generated a
        new PIN.
        """
        if not is_there(self.path):
            return
        mark = mark_of(self.path)
        if mark != self._read_at:
            with suppress(DataError):  # of a file that cannot be read, the pages say why
                self._secrets, self._read_at = kept_secrets(self.path, self._first), mark

    def _secret(self, name: str) -> str:
        self.keep_secrets()  # the file may have been begun by a command
        return self._secrets[name]

    def end_visit(self, visit: str) -> None:
        """Store that a visit has ended, for every server on the file."""
        found = {f"{_ENDED} {visit}": ""}
        self._first |= found
        if is_there(self.path):
            with suppress(DataError):  # of a file that can only be read, this server knows it
                change_secrets(self.path, found)

    def has_ended(self, visit: str) -> bool:
        """Return whether the visitor who entered a PIN at that time has left since then."""
        self.keep_secrets()
        return f"{_ENDED} {visit}" in self._first | self._secrets

    @property
    def tokens(self) -> dict[str, Token]:
        """Other programs' tokens by hash, as currently in the file."""
        mark = mark_of(self.path)
        if mark != self._tokens[0]:
            self._tokens = mark, kept_tokens(self.path) if is_there(self.path) else {}
        return self._tokens[1]

    def change_pin(self) -> None:
        """Generate a new director's PIN; anyone who entered the earlier one is logged out."""
        self._keep({"pin": new_pin(), "director": _mark()})

    def _keep(self, found: Mapping[str, str]) -> None:
        """Store a new value, in the file as soon as it exists."""
        if is_there(self.path):
            change_secrets(self.path, found)
        self._first |= found
        self._secrets |= found

    @property
    def phones_in(self) -> bool:
        """Whether the director has let phones in, and hasn't locked them out since."""
        return bool(self._secret(_PHONES))

    def let_phones(self, come_in: bool) -> None:
        """Store whether phones are let in, including after the next start."""
        self._keep({_PHONES: "in" if come_in else ""})

    @property
    def last_port(self) -> int:
        """The port where the night was last found; 0 if none yet."""
        kept = self._secret(_PORT)
        return int(kept) if kept.isascii() and kept.isdigit() and len(kept) < 6 else 0

    def found_at_port(self, port: int) -> None:
        """Store the night's port, so that the next start uses the same one."""
        self.found_at(f"http://127.0.0.1:{port}")
        if port != self.last_port:
            with suppress(DataError):  # of a file that can only be read
                self._keep({_PORT: str(port)})

    @property
    def calls_itself(self) -> bool:
        """Whether a result automatically calls the next match to the freed table."""
        return self._secret(_CALLS) != _BY_HAND

    def let_call(self, itself: bool) -> None:
        """Store whether a result calls the next match."""
        self._keep({_CALLS: "" if itself else _BY_HAND})

    @property
    def queue(self) -> Sequence[tuple[int, str]]:
        """All events' matches in the order that ends the night soonest, as calculated."""
        known = [night.known for night in self.nights if night.known and night.known.queue]
        return max(known, key=lambda one: one.at).queue if known else ()

    def next_calls(
        self, before: Mapping[int, Evening], after: Mapping[int, Evening]
    ) -> Sequence[tuple[int, What]]:
        """Return the calls that a result makes automatically, unless calls are made by hand."""
        return calls_after(before, after, self.queue) if self.calls_itself else []

    @property
    def pin(self) -> str:
        """The director's PIN."""
        return self._secret("pin")

    def is_pin(self, text: str) -> bool:
        """Return whether this is the director's PIN."""
        return hmac.compare_digest(text.encode(), self.pin.encode())

    @property
    def cookie_key(self) -> str:
        """The key that signs sessions."""
        return self._secret("cookie")

    @property
    def director_mark(self) -> str:
        """The value stored in a director's session."""
        return self._secret("director")

    def captain_pin(self, night: int, team: int) -> str:
        """Return a captain's PIN: a new one each night, different from the other PINs."""
        others = {self.pin} | ({self.captain_pin(night, 0)} if team else set())
        drawn = (
            f"{int(self.captain_mark(night, team, again), 16) % 10**6:06d}"
            for again in itertools.count(1)
        )
        return next(pin for pin in drawn if pin not in others)

    def captain_lot(self, night: int, team: int, number: int) -> str:
        """Return the key for a captain's random draws, if drawing is best; a set keeps its lot."""
        return self._token(f"lot {night} {team} {number}")

    def captain_mark(self, night: int, team: int, again: int = 0) -> str:
        """Return the value stored in a captain's session; with `again`, their PIN's seed."""
        return self._token(f"captain {night} {team} {again}")

    def player_codes(self) -> dict[str, str]:
        """Return each player's code for the night; `/c/CODE` claims their phone.

        A player in two events has one code, from the first.
        """
        states = [night.state() for night in self.begun]
        if self._codes is None or list(map(id, self._codes[0])) != list(map(id, states)):
            found: dict[str, str] = {}
            for state in states:
                found = codes_of(state, self._secret("match"), found)
            self._codes = states, found
        return self._codes[1]

    def player_code(self, name: str) -> str:
        """Return a player's short code; '' if they aren't playing tonight."""
        return self.player_codes().get(name, "")

    def _token(self, what: str) -> str:
        return _token(self._secret("match"), what)


def names_event(request: Request) -> bool:
    """Return whether a request names one of the night's events."""
    return bool(_event_text(request))


def event_of(request: Request) -> int:
    """Return the event number in a request's form or address; 1 if none."""
    text = _event_text(request)
    return int(text) if text.isascii() and text.isdigit() and len(text) < 3 else 1


def _event_text(request: Request) -> str:
    form = getattr(request.state, "form", None)
    # Refusals ask it too, so that it refuses nothing.
    field = form.fields.get("event") if form else ""
    return str(field or request.query_params.get("event", ""))


def of_event(path: str, event: int) -> str:
    """Return the address of a page for one of the night's events.

    >>> of_event("/desk?match=3#sheet", 2), of_event("/players", 1)
    ('/desk?match=3&event=2#sheet', '/players')
    """
    if event < 2 or "event=" in path:
        return path
    page, mark, place = path.partition("#")
    return f"{page}{'&' if '?' in page else '?'}event={event}{mark}{place}"


def night_of(request: Request) -> Night:
    """Return a request's event, by form or address, else the first (RefusalError if none)."""
    nights: list[Night] = request.app.state.site.nights
    number = event_of(request)
    for night in nights:
        if night.event == number:
            return night
    raise RefusalError("There is no such page.", status=404)


def begun(night: Night) -> Night:
    """Return one of the night's events; raise an error if it hasn't started."""
    if not night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    return night


async def drawn_state(request: Request) -> Evening:
    """Return the state of a request's event; raise an error if there is no draw."""
    state = await asyncio.to_thread(begun(night_of(request)).state)
    if not state.drawn:
        raise RefusalError("The draw hasn't been made yet.", status=404)
    return state


def begun_nights(request: Request) -> list[Night]:
    """Return the night's events; raise an error if none has started."""
    site: Site = request.app.state.site
    return site.begun or [begun(site.night)]


def _token(key: str, what: str) -> str:
    return hmac.new(key.encode(), what.encode(), hashlib.sha256).hexdigest()[:20]


def _mark() -> str:
    return secrets.token_urlsafe(24)
