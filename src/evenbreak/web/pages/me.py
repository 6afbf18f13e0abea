"""My night: the one page that a player needs all evening, on a phone that is theirs.

A phone claims a player once: from the list of names, or by the player's code, which takes the claim
over from another phone. What both players of a match propose counts by itself only if it came from
different addresses: a second tab of one phone is a session of its own, but it comes from where the
phone is.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.files.store.desk import (
    CLAIMED,
    COMING,
    NO_TABLET,
    OBJECTED,
    PROPOSED,
    RELEASED,
    TABLET,
    WITHDRAWN,
    Entry,
    Phones,
    enter,
)
from evenbreak.tournaments.evening.fold import ELIMINATIONS, Evening
from evenbreak.web import taps
from evenbreak.web.codes import code_in
from evenbreak.web.forms import form_of
from evenbreak.web.guard import MovedOnError, RefusalError
from evenbreak.web.my_night import (
    after,
    chances,
    first_name,
    match_of,
    place_of,
    sides_of,
    step_of,
    way_of,
    why_words,
)
from evenbreak.web.page import done, page, reason, site_of
from evenbreak.web.sessions import (
    DIRECTORS_PAGE,
    address_of,
    author_words,
    check_director,
    phone_of,
    phones_of,
)
from evenbreak.words import say


async def me(request: Request) -> Response:
    """Show a player their night, or ask whose phone this is."""
    return await _shown(request)


async def _shown(request: Request, why: RefusalError | None = None) -> Response:
    """Return a player's page as it is now, and why a tap was refused."""
    night = site_of(request).night
    if not night.exists:
        return page(request, "begin.html")
    known = await night.outlook()
    state = await asyncio.to_thread(night.state)
    phones = await asyncio.to_thread(night.phones)
    name = phones.of(phone_of(request))
    status = why.status if why else 200
    words = reason(request, why) if why else ""
    if name not in state.entrants:
        return page(request, "who.html", state=state, phones=phones, why=words, status=status)
    mine = match_of(state, name, known)
    step = step_of(state, name, mine, phones)
    ready = mine is not None and mine.pair is not None and mine.name in state.standing.to_play
    if step in ("waits", "up") and ready and (why or request.query_params.get("play")):
        step = "playing"
    played = state.counted.values() if state.drawn else ()
    shown: dict[str, Any] = {
        "me": name,
        "mine": mine,
        "step": step,
        "why": words,
        "now": site_of(request).clock()[11:16],
        "code": site_of(request).player_code(name),
        "older": known is None or known.of is not state,
        "way": way_of(state, name, mine),
        "won": sum(one.winner == name for one in played),
        "lost": sum(one.loser == name for one in played),
        "eliminates": state.plan.form in ELIMINATIONS,
        "dropped": name in state.dropped,
        "finished": place_of(state, name, known, night.prizes()),
        "state": state,
    }
    if mine and mine.pair:
        shown["sides"] = sides_of(mine, phones)
        shown["odds"] = chances(state, mine)
        shown["race_why"] = why_words(state, mine)
        shown["other"] = first_name(str(mine.other), name)
        shown["minutes"] = phones.answer(name, mine.name, mine.since)
    if mine:
        shown["onward"] = [(word, after(state, mine, word, known)) for word in ("winner", "loser")]
    return page(request, "me.html", live=True, status=status, **shown)


async def claim(request: Request) -> Response:
    """Keep that this phone is a player's, unless another one is."""
    form = await form_of(request)
    state, name = await _state(request), form.text("name")
    if name not in state.entrants:
        raise RefusalError("{name} isn't playing tonight.", status=404, name=name)
    await asyncio.to_thread(_claim, request, state, name, False)
    return done(request, "/me")


async def claim_by_code(request: Request) -> Response:
    """Keep that this phone is the player's who has this code, whichever was before."""
    state = await _state(request)
    if request.method == "HEAD":
        return Response()
    typed = request.path_params.get("code")
    code = code_in((await form_of(request)).text("code") if typed is None else typed)
    site, address = site_of(request), address_of(request)
    if site.codes.full(address) or site.all_codes.full(""):
        raise RefusalError("Too many wrong codes. Wait a minute.", status=429)
    players = {one: name for name, one in site.player_codes().items()}
    if code not in players:
        site.codes.count(address)
        site.all_codes.count("")
        raise RefusalError("Nobody has this code tonight. Check it on your score card.", status=404)
    await asyncio.to_thread(_claim, request, state, players[code], True)
    return done(request, "/me")


def _claim(request: Request, state: Evening, name: str, by_code: bool) -> None:
    site, phone = site_of(request), phone_of(request)

    def decide(phones: Phones) -> Entry | None:
        holder = phones.claims.get(name)
        if holder and holder.phone == phone:
            return None
        if holder and not by_code:
            raise RefusalError(
                "Another phone is {name}'s already. If that's you, type the code from your score "
                "card; if it isn't, ask the director to release it.",
                status=409,
                name=name,
            )
        return Entry(site.clock(), "", CLAIMED, name, phone=phone, address=address_of(request))

    _count(request, f"claims {address_of(request)}")
    enter(site.path, state, decide)


async def leave(request: Request) -> Response:
    """Give a phone up, for another player to have it."""
    await form_of(request)
    state = await _state(request)
    site, phone = site_of(request), phone_of(request)

    def decide(phones: Phones) -> Entry | None:
        name, address = phones.of(phone), address_of(request)
        return Entry(site.clock(), "", RELEASED, name, {}, phone, address) if name else None

    await asyncio.to_thread(enter, site.path, state, decide)
    return done(request, "/me")


async def release(request: Request) -> Response:
    """Take a player's phone from whoever has it."""
    form = await form_of(request)
    check_director(request)
    state, site, name = await _state(request), site_of(request), form.text("player")

    def decide(phones: Phones) -> Entry | None:
        return Entry(site.clock(), "", RELEASED, name) if name in phones.claims else None

    await asyncio.to_thread(enter, site.path, state, decide)
    words = say("{name} has no phone now. The next one that claims the name gets it.", name=name)
    return done(request, "/desk/codes", words)


async def tap(request: Request) -> Response:
    """Take the score of the player's match; a full score is proposed as the result."""
    form = await form_of(request)
    try:
        state = await _state(request)
        one = taps.tap_in(request, form, state)

        def work() -> str:
            name = _mine(request, one.pair)
            if one.ends(state):
                return taps.propose(request, one, name)
            taps.score(request, one, phones_of([name]), lambda _: _still(request, name))
            return ""

        said = await asyncio.to_thread(work)
    except MovedOnError as error:
        return await _shown(request, error)
    return done(request, "/me" if one.ends(state) else "/me?play=1", *filter(None, [said]))


def _mine(request: Request, pair: tuple[str, str]) -> str:
    """Return which of two players this phone is; refuse everybody else."""
    name = site_of(request).night.phones().of(phone_of(request))
    if name not in pair:
        raise RefusalError("Only the players of a match keep its score.", status=403)
    return name


def _still(request: Request, name: str) -> None:
    if site_of(request).night.phones().of(phone_of(request)) != name:
        raise RefusalError("Only the players of a match keep its score.", status=403)


async def withdraw(request: Request) -> Response:
    """Take back what a player proposed."""
    return await _noted(request, WITHDRAWN)


async def coming(request: Request) -> Response:
    """Keep that a player who has been called is on the way, or needs some minutes."""
    minutes = (await form_of(request)).whole("minutes", 0, 30, default=0)
    return await _noted(request, COMING, {"minutes": minutes} if minutes else {})


async def _noted(request: Request, kind: str, what: dict[str, int] | None = None) -> Response:
    form = await form_of(request)
    state, site, match = await _state(request), site_of(request), form.text("match")
    if match not in state.standing.to_play:
        raise MovedOnError("Your match has moved on. Open your page again.", status=409)
    name = await asyncio.to_thread(_mine, request, state.pair(match))
    phone, address = phone_of(request), address_of(request)

    def decide(phones: Phones) -> Entry | None:
        if kind == WITHDRAWN and name not in phones.sides(match, state.pair(match)).proposed:
            return None
        return Entry(site.clock(), match, kind, name, what or {}, phone, address)

    _count(request, match)
    await asyncio.to_thread(enter, site.path, state, decide)
    return done(request, "/me?play=1" if kind == WITHDRAWN else "/me")


def _count(request: Request, what: str) -> None:
    tries = site_of(request).taps
    if tries.full(what):
        raise RefusalError("Too many taps. Wait a moment.", status=429)
    tries.count(what)


async def _state(request: Request) -> Evening:
    night = site_of(request).night
    if not night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    return await asyncio.to_thread(night.state)


_DID: dict[str, Callable[..., str]] = {
    CLAIMED: lambda name, **_: say("this phone is {name}'s", name=name),
    RELEASED: lambda name, **_: say("{name} has no phone now", name=name),
    COMING: lambda name, match, **_: say(
        "{match}: {name} answered the call", match=match, name=name
    ),
    WITHDRAWN: lambda name, match, **_: say(
        "{match}: {name} took back what they sent", match=match, name=name
    ),
    PROPOSED: lambda name, match, score: say(
        "{match}: {name} sent {score}", match=match, name=name, score=score
    ),
    OBJECTED: lambda match, score, **_: say(
        "{match}: the table says that {score} is wrong", match=match, score=score
    ),
    TABLET: lambda name, **_: say("this is the tablet of table {table}", table=name),
    NO_TABLET: lambda name, **_: say("this is no longer the tablet of table {table}", table=name),
}


def phone_words(entry: Entry, state: Evening) -> str:
    """Return what a phone did, for the history."""
    match = state.match_words(entry.match) if state.drawn else entry.match
    score = ", ".join(f"{name} {games}" for name, games in entry.score.items())
    return _DID[entry.kind](name=entry.player, match=match, score=score)


def phone_label(entry: Entry) -> str:
    """Return which phone did it, for the history; the director has none."""
    if not entry.phone:
        return author_words(DIRECTORS_PAGE)
    label = f"{entry.phone[:4]} {entry.address}".strip()
    return say("phone {label}", label=label)


ROUTES = [
    Route("/me", me, methods=["GET"]),
    Route("/c/{code}", claim_by_code, methods=["GET"]),
    Route("/me/code", claim_by_code, methods=["POST"]),
    Route("/me/score", me, methods=["GET"]),  # the page of a tap that was refused
    Route("/me/score", tap, methods=["POST"]),
    *(
        Route(f"/me/{one.__name__}", one, methods=["POST"])
        for one in (claim, leave, withdraw, coming)
    ),
    Route("/desk/release", release, methods=["POST"]),
]
