"""My night: the one page that a player needs all evening, on their own phone.

A phone claims a player once: from the list of names, or with the player's code, which takes the
claim over from another phone. A result proposed by both players counts automatically only if it
came from different addresses: a second tab on one phone has its own session, but the same address.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any, NamedTuple

from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import Route

from evenbreak.answers.tournament.short_names import first_name
from evenbreak.files.store.desk import (
    CLAIMED,
    COMING,
    NO_TABLET,
    OBJECTED,
    PROPOSED,
    RELEASED,
    TABLET,
    WITHDRAWN,
    Act,
    Entry,
    Phones,
)
from evenbreak.tournaments.evening.fold import ELIMINATIONS, Evening
from evenbreak.web import taps
from evenbreak.web.codes import code_in
from evenbreak.web.forms import directors_form, form_of
from evenbreak.web.guard import MovedOnError, RefusalError
from evenbreak.web.my_night import (
    MyMatch,
    after,
    chances,
    match_of,
    place_of,
    sides_of,
    step_of,
    way_of,
    why_words,
)
from evenbreak.web.night import Known, Night
from evenbreak.web.page import done, page, reason, site_of
from evenbreak.web.sessions import (
    DIRECTORS_PAGE,
    address_of,
    author_words,
    phone_of,
    phones_of,
)
from evenbreak.web.site import begun_nights, event_of, names_event, night_of
from evenbreak.words import say


async def me(request: Request) -> Response:
    """Show a player their night, or ask whose phone this is."""
    return await _shown(request)


async def _shown(request: Request, why: RefusalError | None = None) -> Response:
    """Return a player's current page, and why a tap was rejected."""
    site = site_of(request)
    if not site.begun:
        return page(request, "begin.html")
    plays = [one for night in site.nights if (one := await _place_in(request, night))]
    status = why.status if why else 200
    words = reason(request, why) if why else ""
    if not plays:
        who = await asyncio.to_thread(_who_plays, request)
        return page(request, "who.html", who=who, why=words, status=status)
    asked = [one for one in plays if one.night.event == event_of(request)]
    place = asked[0] if asked and (why or names_event(request)) else min(plays, key=_urgent)
    night, state, phones, name, known, mine, step = place
    ready = mine is not None and mine.pair is not None and mine.name in state.standing.to_play
    if step in ("waits", "up") and ready and (why or request.query_params.get("play")):
        step = "playing"
    played = state.counted.values() if state.drawn else ()
    shown: dict[str, Any] = {
        "event": night.event,
        "others": [one for one in plays if one is not place],
        "me": name,
        "mine": mine,
        "step": step,
        "why": words,
        "now": site.clock()[11:16],
        "code": site.player_code(name),
        "older": known is None or known.of is not state,
        "way": way_of(state, name, mine),
        "won": sum(one.winner == name for one in played),
        "lost": sum(one.loser == name for one in played),
        "eliminates": state.plan.form in ELIMINATIONS,
        "dropped": name in state.dropped,
        "finished": place_of(state, name, night.prizes(), night.unit),
        "state": state,
    }
    if mine and mine.pair:
        shown["sides"] = sides_of(mine, phones)
        shown["odds"] = chances(state, mine, night.means)
        shown["race_why"] = why_words(state, mine)
        shown["other"] = first_name(str(mine.other), state.entrants)
        shown["minutes"] = phones.answer(name, mine.name, mine.since)
    if mine:
        shown["onward"] = [(word, after(state, mine, word, known)) for word in ("winner", "loser")]
    return page(request, "me.html", live=True, status=status, **shown)


class Place(NamedTuple):
    """A player's place in one of the night's events: their match and what their page shows."""

    night: Night
    state: Evening
    phones: Phones
    name: str
    known: Known | None
    mine: MyMatch | None
    step: str


async def _place_in(request: Request, night: Night) -> Place | None:
    """Return where the phone's player is in an event; None if they aren't in it."""
    if not night.exists:
        return None
    known = await night.outlook()
    state = await asyncio.to_thread(night.state)
    phones = await asyncio.to_thread(night.phones)
    name = phones.of(phone_of(request))
    if name not in state.entrants:
        return None
    mine = match_of(state, name, known)
    return Place(night, state, phones, name, known, mine, step_of(state, name, mine, phones))


def _urgent(place: Place) -> tuple[bool, bool, bool, bool, str]:
    """Return an event's sort key on a player's page: a match on a table comes first."""
    mine, busy = place.mine, place.step not in ("waits", "before", "rests")
    starts = mine.starts[1] if mine and mine.starts else "~"
    at_table = mine is not None and mine.table is not None
    called = mine is not None and mine.called is not None
    return not (busy or at_table), not called, mine is None, place.step == "rests", starts


def _who_plays(request: Request) -> dict[str, bool]:
    """Return tonight's players in all events, and whether they have a phone."""
    states = [(night.state(), night.phones().claims) for night in site_of(request).begun]
    return {
        name: name in claims
        for state, claims in states
        for name in state.entrants
        if name not in state.dropped
    }


async def claim(request: Request) -> Response:
    """Store that this phone belongs to a player, unless another phone already does."""
    form = await form_of(request)
    await asyncio.to_thread(_claim, request, form.text("name"), form.key(request.url.path))
    return done(request, "/me")


async def shown_by_code(request: Request) -> Response:
    """Ask whether this is the player with a code; if it's already their phone, go on."""
    begun_nights(request)
    if request.method == "HEAD":
        return Response()
    code = code_in(request.path_params["code"])
    name = _with_code(request, code)
    phone = phone_of(request)
    for night in site_of(request).nights:
        phones = await asyncio.to_thread(night.phones)
        if phones.of(phone) == name:
            return RedirectResponse("/me", status_code=303)
    return page(request, "this_is_me.html", name=name, code=code)


async def claim_by_code(request: Request) -> Response:
    """Store that this phone belongs to the player with this code, replacing any earlier phone."""
    form = await form_of(request)
    begun_nights(request)
    name = _with_code(request, code_in(form.text("code")))
    await asyncio.to_thread(_claim, request, name, form.key(request.url.path), by_code=True)
    return done(request, "/me")


def _with_code(request: Request, code: str) -> str:
    """Return the player with a code; reject anyone guessing."""
    site, address = site_of(request), address_of(request)
    if site.codes.full(address) or site.all_codes.full(""):
        raise RefusalError("Too many wrong codes. Wait a minute.", status=429)
    players = {one: name for name, one in site.player_codes().items()}
    if code not in players:
        site.codes.count(address)
        site.all_codes.count("")
        raise RefusalError("No one has this code tonight. Check it on your score card.", status=404)
    return players[code]


def _claim(request: Request, name: str, key: str, *, by_code: bool = False) -> None:
    phone = phone_of(request)

    def decide(phones: Phones) -> Act | None:
        holder = phones.claims.get(name)
        if holder and holder.phone == phone:
            return None
        if holder and not by_code:
            raise RefusalError(
                "{name} is already on another phone. If that's you, type the code from your score "
                "card; if it isn't, ask the director to release it.",
                status=409,
                name=name,
            )
        return Act(CLAIMED, name)

    night = _night_with(request, name)
    _count(request, f"claims {address_of(request)}")
    taps.note(request, night, key, decide)


def _night_with(request: Request, name: str) -> Night:
    """Return the night's first event that a player is in."""
    for night in begun_nights(request):
        if name in night.state().entrants:
            return night
    raise RefusalError("{name} isn't playing tonight.", status=404, name=name)


async def leave(request: Request) -> Response:
    """Give up a phone's player, so it can have another player."""
    key = (await form_of(request)).key(request.url.path)
    night, phone = begun_nights(request)[0], phone_of(request)

    def decide(phones: Phones) -> Act | None:
        name = phones.of(phone)
        return Act(RELEASED, name) if name else None

    await asyncio.to_thread(taps.note, request, night, key, decide)
    return done(request, "/me")


async def release(request: Request) -> Response:
    """Take a player's phone away from whoever has it."""
    form = await directors_form(request)
    name, key = form.text("player"), form.key(request.url.path)

    def decide(phones: Phones) -> Act | None:
        return Act(RELEASED, name) if name in phones.claims else None

    def work() -> None:
        taps.note(request, _night_with(request, name), key, decide, DIRECTORS_PAGE)

    await asyncio.to_thread(work)
    words = say(
        "{name} no longer has a phone. The next phone that claims the name gets it.", name=name
    )
    return done(request, "/desk/codes", words)


async def tap(request: Request) -> Response:
    """Accept the score of the player's match; a final score is proposed as the result."""
    form = await form_of(request)
    try:
        begun_nights(request)
        state = await asyncio.to_thread(night_of(request).state)
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
    return done(request, "/me" if one.ends(state) else _at_play(request), *filter(None, [said]))


def _at_play(request: Request) -> str:
    """Return the page for a match in play, in whichever event it is."""
    event = night_of(request).event
    return "/me?play=1" + (f"&event={event}" if event > 1 else "")


def _mine(request: Request, pair: tuple[str, str]) -> str:
    """Return which of two players this phone belongs to; reject everyone else."""
    name = night_of(request).phones().of(phone_of(request))
    if name not in pair:
        raise RefusalError("Only the players in a match can keep its score.", status=403)
    return name


def _still(request: Request, name: str) -> None:
    if night_of(request).phones().of(phone_of(request)) != name:
        raise RefusalError("Only the players in a match can keep its score.", status=403)


async def withdraw(request: Request) -> Response:
    """Take back a player's proposal."""
    return await _noted(request, WITHDRAWN)


async def coming(request: Request) -> Response:
    """Store that a called player is on the way, or needs some minutes."""
    minutes = (await form_of(request)).whole("minutes", 0, 30, default=0)
    return await _noted(request, COMING, {"minutes": minutes} if minutes else {})


async def _noted(request: Request, kind: str, what: dict[str, int] | None = None) -> Response:
    form = await form_of(request)
    begun_nights(request)
    night, match, key = night_of(request), form.text("match"), form.key(request.url.path)
    state = await asyncio.to_thread(night.state)
    if not state.drawn or match not in state.standing.to_play:
        raise MovedOnError("Your match has moved on. Open your page again.", status=409)
    name = await asyncio.to_thread(_mine, request, state.pair(match))

    def decide(phones: Phones) -> Act | None:
        if kind == WITHDRAWN and name not in phones.sides(match, state.pair(match)).proposed:
            return None
        return Act(kind, name, match, what or {})

    _count(request, match)
    await asyncio.to_thread(taps.note, request, night, key, decide)
    return done(request, _at_play(request) if kind == WITHDRAWN else "/me")


def _count(request: Request, what: str) -> None:
    tries = site_of(request).taps
    if tries.full(what):
        raise RefusalError("Too many taps. Wait a moment.", status=429)
    tries.count(what)


_DID: dict[str, Callable[..., str]] = {
    CLAIMED: lambda name, **_: say("this phone is {name}'s", name=name),
    RELEASED: lambda name, **_: say("{name} no longer has a phone", name=name),
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
    TABLET: lambda name, **_: say("this is the tablet for table {table}", table=name),
    NO_TABLET: lambda name, **_: say("this is no longer the tablet for table {table}", table=name),
}


def phone_words(entry: Entry, state: Evening) -> str:
    """Return what a phone did, for the history."""
    act = entry.what
    match = state.match_words(act.match) if state.drawn else act.match
    score = ", ".join(f"{name} {games}" for name, games in act.score.items())
    return _DID[entry.kind](name=act.player, match=match, score=score)


def phone_label(entry: Entry) -> str:
    """Return which phone did it, for the history; the director has none."""
    if not entry.phone:
        return author_words(DIRECTORS_PAGE)
    label = f"{entry.phone[:4]} {entry.address}".strip()
    return say("phone {label}", label=label)


ROUTES = [
    Route("/me", me, methods=["GET"]),
    Route("/c/{code}", shown_by_code, methods=["GET"]),
    Route("/me/code", claim_by_code, methods=["POST"]),
    Route("/me/score", me, methods=["GET"]),  # the page of a tap that was refused
    Route("/me/score", tap, methods=["POST"]),
    *(
        Route(f"/me/{one.__name__}", one, methods=["POST"])
        for one in (claim, leave, withdraw, coming)
    ),
    Route("/desk/release", release, methods=["POST"]),
]
