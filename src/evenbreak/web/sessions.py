"""Who is asking: signed session cookies, the director's PIN, tokens against forged forms.

Also who entered something: how that is stored with the entry and shown on a page.
"""

from __future__ import annotations

import hmac
import secrets
import time
from collections import deque
from collections.abc import Callable, Sequence

from starlette.requests import Request

from evenbreak.evenings.log import PROGRAM
from evenbreak.tournaments.evening.events import BY_ITSELF
from evenbreak.web.guard import RefusalError
from evenbreak.words import listed, say

DIRECTOR, CAPTAIN = "director", "captain"
_CSRF, _PHONE = "form", "phone"
_SECONDS = 60.0
_MOST_ADDRESSES = 1000

DIRECTORS_PAGE = "director's page"
_PHONES, _CAPTAIN, _TABLET = "phones: ", "captain of ", "phone of table "
_BETWEEN = " and "


class Tries:
    """How often something was tried from each address in the last minute.

    >>> tries = Tries(2, clock=iter([0.0, 0.5, 1.0, 2.0, 61.5]).__next__)
    >>> tries.count("10.0.0.7"), tries.count("10.0.0.7")
    (None, None)
    >>> tries.full("10.0.0.7"), tries.full("10.0.0.8"), tries.full("10.0.0.7")
    (True, False, False)
    """

    def __init__(self, most: int, *, clock: Callable[[], float] = time.monotonic) -> None:
        self.most = most
        self.clock = clock
        self.times: dict[str, deque[float]] = {}

    def count(self, address: str) -> None:
        """Count another try."""
        if len(self.times) > _MOST_ADDRESSES:
            self.times.clear()
        self.times.setdefault(address, deque(maxlen=self.most)).append(self.clock())

    def full(self, address: str) -> bool:
        """Return whether no more tries are allowed now."""
        now = self.clock()
        seen = self.times.get(address, deque())
        return len(seen) == self.most and now - seen[0] <= _SECONDS


class Ticket:
    """A ticket that logs one browser in as the director without the PIN, once, within a minute.

    >>> ticket = Ticket(clock=iter([0.0, 30.0, 31.0]).__next__)
    >>> drawn = ticket.draw()
    >>> ticket.is_good(drawn), ticket.is_good("guessed"), ticket.take(drawn), ticket.take(drawn)
    (True, False, True, False)
    """

    def __init__(self, *, clock: Callable[[], float] = time.monotonic) -> None:
        self.clock = clock
        self.drawn, self.until = "", 0.0

    def draw(self) -> str:
        """Return a new ticket; earlier ones become invalid."""
        self.drawn, self.until = secrets.token_urlsafe(24), self.clock() + _SECONDS
        return self.drawn

    def is_good(self, text: str) -> bool:
        """Return whether a string is the ticket, unused and not expired."""
        same = hmac.compare_digest(text.encode(), self.drawn.encode())
        return bool(self.drawn) and same and self.clock() <= self.until

    def take(self, text: str) -> bool:
        """Return the same, and use up the ticket."""
        good = self.is_good(text)
        if good:
            self.drawn = ""
        return good


def form_token(request: Request) -> str:
    """Return the token in each of this session's forms."""
    token: str = request.session.setdefault(_CSRF, secrets.token_urlsafe(16))
    return token


def phone_of(request: Request) -> str:
    """Return the key that identifies this session in its entries."""
    name: str = request.session.setdefault(_PHONE, secrets.token_urlsafe(6))
    return name


def check_form(request: Request, token: str) -> None:
    """Reject a form that wasn't given to this session."""
    known = request.session.get(_CSRF)
    if not known or not hmac.compare_digest(known.encode(), token.encode()):
        raise RefusalError(
            "This form is from an earlier visit. Open the page again and repeat what you did.",
            status=403,
        )


def let_in(request: Request, role: str, mark: str) -> None:
    """Store that a PIN was entered in this session, starting a new visit."""
    request.session[role] = f"{mark} {secrets.token_urlsafe(9)}"


def let_out(request: Request, role: str) -> None:
    """End a visit: copies of its cookie become invalid."""
    held = request.session.pop(role, None)
    if isinstance(held, str):
        request.app.state.site.end_visit(held.rpartition(" ")[2])


def _is_in(request: Request, role: str, mark: str) -> bool:
    """Return whether a PIN was entered in this session, and its visit isn't over."""
    held = request.session.get(role)
    if not isinstance(held, str):
        return False
    own, _, visit = held.rpartition(" ")
    ended: bool = request.app.state.site.has_ended(visit)
    return hmac.compare_digest(own.encode(), mark.encode()) and not ended


def is_director(request: Request) -> bool:
    """Return whether the director's PIN was entered in this session."""
    return _is_in(request, DIRECTOR, request.app.state.site.director_mark)


def check_director(request: Request) -> None:
    """Reject anyone who hasn't entered the director's PIN."""
    if not is_director(request):
        raise RefusalError("Only the director can do that. Enter the PIN first.", status=403)


def captain_of(request: Request, night: int) -> int | None:
    """Return the team whose captain's PIN was entered in this session; None if neither was.

    `night` is the number of the event that started the team night.
    """
    site = request.app.state.site
    return next(
        (team for team in (0, 1) if _is_in(request, CAPTAIN, site.captain_mark(night, team))), None
    )


def check_tries(request: Request) -> None:
    """Reject another PIN if too many wrong ones have come in.

    The computer itself isn't held up by others' wrong PINs: the person sitting there may be the
    director.
    """
    site = request.app.state.site
    if site.tries.full(address_of(request)) or (site.all_tries.full("") and not is_here(request)):
        raise RefusalError("Too many wrong PINs. Wait a minute.", status=429)


def wrong_pin(request: Request) -> RefusalError:
    """Count a wrong PIN, and return why it is rejected."""
    site = request.app.state.site
    site.tries.count(address_of(request))
    site.all_tries.count("")
    return RefusalError("Wrong PIN.", status=403)


def address_of(request: Request) -> str:
    """Return the address a request comes from."""
    return request.client.host if request.client else ""


def is_here(request: Request) -> bool:
    """Return whether a request comes from this computer itself."""
    return address_of(request) in {"127.0.0.1", "::1"}


def phones_of(players: Sequence[str]) -> str:
    """Return the phones that made an entry, as stored."""
    return ("phone: " if len(players) == 1 else _PHONES) + _BETWEEN.join(players)


def tablet_of(table: str) -> str:
    """Return a table's tablet, as stored: it counts as the players' too."""
    return _TABLET + table


def captain_of_team(team: str) -> str:
    """Return a team's captain, as stored."""
    return _CAPTAIN + team


def author_words(kept: str) -> str:
    """Return who entered something.

    >>> author_words("phone: Tom and Jerry"), author_words("captain of the Shark")
    ('phone: Tom and Jerry', 'captain of the Shark')
    >>> author_words("phones: Tom and Jerry and Bo")
    'phones: Tom and Jerry and Bo'
    """
    if not kept:
        return say("a terminal")
    if kept.startswith(BY_ITSELF):
        return say("by itself")
    if kept == DIRECTORS_PAGE:
        return say("director's page")
    if kept.startswith(_TABLET):
        return say("tablet for table {table}", table=kept.removeprefix(_TABLET))
    if kept.startswith("phone: "):
        return say("phone: {player}", player=kept.removeprefix("phone: "))
    if kept.startswith(_PHONES):
        both = kept.removeprefix(_PHONES)
        names = both.split(_BETWEEN)
        # Where a name itself has an "and" in it, nobody can say where the other one starts.
        return say("phones: {players}", players=listed(names) if len(names) == 2 else both)
    if kept.startswith(PROGRAM):
        return say("program: {name}", name=kept.removeprefix(PROGRAM))
    if kept.startswith(_CAPTAIN):
        return say("captain of {team}", team=kept.removeprefix(_CAPTAIN))
    if kept.startswith("phone "):
        return say("phone {label}", label=kept.removeprefix("phone "))
    return kept
