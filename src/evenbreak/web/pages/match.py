"""A match by its own QR code: both players tap games, and propose the result.

A side belongs to the first phone that claims it, until the director sets it free. What both sides
propose counts by itself only if they came from different addresses: a second tab of one phone is a
session of its own, but it comes from where the phone is.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeAlias

from scipy.special import betainc
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.files.store.desk import (
    CLAIMED,
    ENTERED,
    PROPOSED,
    RELEASED,
    Entry,
    Sides,
    enter,
    phone_entries,
    sides_between,
)
from evenbreak.files.store.tournament import add_events, read_tournament
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event, Result
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.evening_view import MatchView, match_view, player_views
from evenbreak.web.forms import form_of
from evenbreak.web.guard import MovedOnError, RefusalError
from evenbreak.web.page import done, page, reason, site_of
from evenbreak.web.sessions import (
    DIRECTORS_PAGE,
    address_of,
    author_words,
    check_director,
    is_director,
    phone_of,
    phones_of,
)
from evenbreak.words import say

_SEEN, _MOST_SEEN = "seen", 4

Check: TypeAlias = Callable[[Evening], None]
"""Refuses a form by the state that there is when it is entered."""


async def match(request: Request) -> Response:
    """Show a match to its players."""
    return await _shown(request, *await _match(request))


async def _shown(
    request: Request, name: str, state: Evening, why: RefusalError | None = None
) -> Response:
    """Return the page of a match as it is now, and why a tap was refused."""
    shown: dict[str, Any] = {"name": name, "token": request.path_params["token"]}
    shown["why"] = reason(request, why) if why else ""
    shown["status"] = why.status if why else 200
    if name not in state.standing.to_play:
        result = state.counted.get(name)
        sides = await asyncio.to_thread(_sides, request, name, result.players) if result else None
        mine = sides.of(phone_of(request)) if sides else ""
        known = await site_of(request).night.outlook()
        views = player_views(state, known)
        whose = [mine] if mine else list(result.players) if result else []
        shown |= {"one": None, "result": result}
        shown["nexts_known"] = known is not None and known.of is state
        shown["nexts"] = [view for who in whose for view in views if view.name == who]
        return page(request, "match.html", live=True, **shown)
    one = match_view(state, name)
    seats = [state.order.index(player) for player in one.players]
    skill = state.ratings[seats[0]] - state.ratings[seats[1]]
    p_game = float(state.scale.win_probability(skill))
    sides = await asyncio.to_thread(_sides, request, name, one.players)
    me = sides.of(phone_of(request))
    shown |= {
        "one": one,
        "odds": _odds(one, p_game),
        "me": me,
        "of_others": _is_of_others(request, shown["token"], one.players, bool(me)),
        "sides": sides,
        "seen": _live_words(state, name),
        "may_score": _may_score(request, sides),
    }
    return page(request, "match.html", live=True, **shown)


def _is_of_others(request: Request, token: str, pair: tuple[str, str], mine: bool) -> bool:
    """Return whether others played the match when this phone opened it for the first time.

    Whom it has seen is kept in its session, until its holder says who of the new pair they are.
    """
    kept = request.session.get(_SEEN)
    seen = kept if isinstance(kept, dict) else {}
    before = seen.get(token)
    if before and set(before) != set(pair) and not mine:
        return True
    if before != list(pair):
        last = [one for one in seen.items() if one[0] != token][1 - _MOST_SEEN :]
        request.session[_SEEN] = {**dict(last), token: list(pair)}
    return False


def _odds(one: MatchView, p_game: float) -> tuple[float, float, float]:
    """Return the first player's chance now, if they win the next game, and if they lose it."""
    a, b = one.score or (0, 0)
    left = one.needs[0] - a, one.needs[1] - b

    def win(m: int, n: int) -> float:
        return 1.0 if m <= 0 else 0.0 if n <= 0 else float(betainc(m, n, p_game))

    return win(*left), win(left[0] - 1, left[1]), win(left[0], left[1] - 1)


async def be(request: Request) -> Response:
    """Keep which of the two players holds this phone."""
    name, state = await _match(request)
    form = await form_of(request)
    _count_tap(request, name)
    pair = _players(state, name)
    me = pair[form.whole("me", 0, 1)]
    await asyncio.to_thread(_claim, request, name, pair, me, lambda _: None)
    return done(request, f"/m/{request.path_params['token']}")


async def release(request: Request) -> Response:
    """Set a player's side free, for another phone to claim it."""
    name, state = await _match(request)
    form = await form_of(request)
    check_director(request)
    site, pair = site_of(request), _players(state, name)
    player = pair[form.whole("me", 0, 1)]

    def decide(sides: Sides) -> Entry | None:
        claimed = player in sides.claims or player in sides.proposed
        return Entry(site.clock(), name, RELEASED, player) if claimed else None

    await asyncio.to_thread(enter, site.path, name, pair, decide)
    said = say("{name}'s side is free. The next phone that claims it gets it.", name=player)
    return done(request, f"/m/{request.path_params['token']}", said)


async def tap(request: Request) -> Response:
    """Take the score of a match in play; a full score is proposed as the result.

    A form counts from the score that its page showed: where somebody has scored since, it is
    refused, so that a phone that was out of reach takes no game away.
    """
    name, state = await _match(request)
    form = await form_of(request)
    site, to = site_of(request), f"/m/{request.path_params['token']}"
    _count_tap(request, name)
    pair = form.text("player_a"), form.text("player_b")
    _check_pair(state, name, pair)
    needs = state.needed(name, pair)
    score = form.whole("a", 0, needs[0]), form.whole("b", 0, needs[1])
    seen = form.text("seen")

    def check(now: Evening) -> None:
        _check_tap(request, now, name, pair, seen)

    def work() -> str:
        me = _sides(request, name, pair).of(phone_of(request))
        if form.text("me") and not me:
            me = pair[form.whole("me", 0, 1)]
            _claim(request, name, pair, me, check)
        if score[0] == needs[0] or score[1] == needs[1]:
            return _propose(request, name, pair, score, check)

        def decide(now: Evening) -> list[Event]:
            check(now)
            as_it_is = "{}:{}".format(*score) == seen
            return [] if as_it_is else [Event(site.clock(), moves.score(now, name, score))]

        key = form.key(request.url.path)
        add_events(site.path, decide, by=phones_of([me or name]), form=key)
        return ""

    try:
        said = await asyncio.to_thread(work)
    except MovedOnError as error:
        return await _shown(request, *await _match(request), error)
    return done(request, to, *filter(None, [said]))


def _check_tap(request: Request, now: Evening, name: str, pair: tuple[str, str], seen: str) -> None:
    """Refuse a form that was made before the score that there is now, or that may not score.

    It is asked while nobody else can enter anything.
    """
    _check_pair(now, name, pair)
    if not _may_score(request, _sides(request, name, pair)):
        raise RefusalError(
            "Both players of {match} keep the score on their own phones.", status=403, match=name
        )
    if seen != (there := _live_words(now, name)):
        raise MovedOnError(
            "The score of {match} is {score} now. Check it, then tap again if a game is missing.",
            status=409,
            match=name,
            score=there,
        )


def _check_pair(state: Evening, name: str, pair: tuple[str, str]) -> None:
    """Refuse a form of a match that is over, or that others play now."""
    if name not in state.standing.to_play:
        raise RefusalError("{match} is not being played now.", status=409, match=name)
    if state.pair(name) != pair:
        raise RefusalError(
            "Other players are in {match} now. Open the page again.", status=409, match=name
        )


def _may_score(request: Request, sides: Sides) -> bool:
    """Return whether a phone may score: where both sides have one, only those and the director."""
    full = len(sides.claims) == 2
    return not full or bool(sides.of(phone_of(request))) or is_director(request)


def _live_words(state: Evening, name: str) -> str:
    """Return the score of a match in play, such as 3:0."""
    a, b = match_view(state, name).score or (0, 0)
    return f"{a}:{b}"


def _players(state: Evening, name: str) -> tuple[str, str]:
    """Return who plays a match; refuse a page that was opened before somebody left it."""
    if name not in state.standing.to_play and name not in state.counted:
        raise RefusalError("{match} is not being played now.", status=409, match=name)
    return state.pair(name)


def _count_tap(request: Request, name: str) -> None:
    taps = site_of(request).taps
    if taps.full(name):
        raise RefusalError("Too many taps. Wait a moment.", status=429)
    taps.count(name)


def _claim(request: Request, name: str, pair: tuple[str, str], player: str, check: Check) -> None:
    """Keep that this phone is a player's, unless another one is."""
    site, phone = site_of(request), phone_of(request)

    def decide(sides: Sides) -> Entry | None:
        check(read_tournament(site.path))
        holder = sides.claims.get(player)
        if holder is None:
            at = site.clock()
            return Entry(at, name, CLAIMED, player, phone=phone, address=address_of(request))
        if holder.phone != phone:
            raise RefusalError(
                "Another phone has {name}'s side of this match. If that isn't you, ask the "
                "director to release it.",
                status=409,
                name=player,
            )
        return None

    enter(site.path, name, pair, decide)


def _propose(
    request: Request, name: str, pair: tuple[str, str], score: tuple[int, int], check: Check
) -> str:
    """Keep a proposed result, and enter it if the opponent proposed the same from elsewhere."""
    site = site_of(request)
    phone, address = phone_of(request), address_of(request)
    moves.result(site.night.state(), name, score)  # refuses what cannot be a result
    games = dict(zip(pair, score, strict=True))

    def decide(sides: Sides) -> Entry | None:
        check(read_tournament(site.path))
        me = sides.of(phone)
        if not me:
            return None
        entry = Entry(site.clock(), name, PROPOSED, me, games, phone, address)
        last = sides.proposed.get(me)
        return None if last and replace(last, at=entry.at) == entry else entry

    sides = enter(site.path, name, pair, decide)
    me = sides.of(phone)
    if not me:
        return say("Say whose phone this is first, then enter the last game again.")
    if _entered(site.night.state(), name, games):  # the other phone was faster
        return say("Both of you agree. The result of {match} is in.", match=name)
    if len(sides.proposed) < len(pair):
        return say(
            "Sent. It counts once {other} or the director confirms it.", other=pair[pair[0] == me]
        )
    if not sides.agree:
        return say("Your opponent entered a different result. Please go to the director together.")
    if not sides.apart:
        return say(
            "Both results agree, but they came from one phone or one network address. "
            "Please ask the director to confirm."
        )

    def settle(now: Evening) -> list[Event]:
        if _entered(now, name, games):
            return []
        found: Result = moves.result(now, name, score)
        return [Event(site.clock(), found)]

    add_events(site.path, settle, by=phones_of(pair))
    enter(site.path, name, pair, lambda _: Entry(site.clock(), name, ENTERED))
    return say("Both of you agree. The result of {match} is in.", match=name)


def _sides(request: Request, name: str, pair: tuple[str, str]) -> Sides:
    return sides_between(phone_entries(site_of(request).path, name), pair)


def _entered(state: Evening, name: str, games: dict[str, int]) -> bool:
    """Return whether a match has this result."""
    there = state.counted.get(name)
    return there is not None and not there.forfeit and there.games == games


async def _match(request: Request) -> tuple[str, Evening]:
    site = site_of(request)
    if not site.night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    state = await asyncio.to_thread(site.night.state)
    if not state.drawn:
        raise RefusalError("The draw has not been made yet.", status=404)
    name = site.match_of(request.path_params["token"], list(state.bracket.by_name))
    if name is None:
        raise RefusalError("This link isn't for one of tonight's matches.", status=404)
    return name, state


def phone_words(entry: Entry) -> str:
    """Return what a phone did, for the history."""
    match, name = entry.match, entry.player
    if entry.kind == CLAIMED:
        return say("{match}: claimed {name}'s side", match=match, name=name)
    if entry.kind == RELEASED:
        return say("{match}: released {name}'s side", match=match, name=name)
    score = ", ".join(f"{name} {games}" for name, games in entry.score.items())
    return say("{match}: {name} sent {score}", match=match, name=name, score=score)


def phone_label(entry: Entry) -> str:
    """Return which phone did it, for the history; the director has none."""
    if not entry.phone:
        return author_words(DIRECTORS_PAGE)
    label = f"{entry.phone[:4]} {entry.address}".strip()
    return say("phone {label}", label=label)


ROUTES = [
    Route("/m/{token}", match, methods=["GET"]),
    Route("/m/{token}/me", be, methods=["POST"]),
    Route("/m/{token}/release", release, methods=["POST"]),
    Route("/m/{token}/score", match, methods=["GET"]),  # the page of a tap that was refused
    Route("/m/{token}/score", tap, methods=["POST"]),
]
