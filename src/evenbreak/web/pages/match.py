"""A match by its own QR code: both players tap games, and propose the result."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

from scipy.special import betainc
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.files.tournament_desk import Proposal, forget_proposals, proposals, propose
from evenbreak.files.tournament_store import add_events
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Event, Result, Scored
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.evening_view import MatchView, match_view
from evenbreak.web.forms import form_of
from evenbreak.web.page import done, language, page, site_of
from evenbreak.web.player_view import player_views
from evenbreak.web.refusals import RefusalError
from evenbreak.web.sessions import phone_of
from evenbreak.web.words import say

_ME = "me"


async def match(request: Request) -> Response:
    """Show a match to its players."""
    name, state = await _match(request)
    shown: dict[str, Any] = {"name": name, "token": request.path_params["token"]}
    if name not in state.standing.to_play:
        result, mine = state.counted.get(name), _me(request, name)
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
    found = await asyncio.to_thread(_proposed, site_of(request).path, name, one.players)
    mine = _me(request, name)
    shown |= {
        "one": one,
        "odds": _odds(one, p_game),
        "me": mine,
        "proposed": found,
    }
    return page(request, "match.html", live=True, **shown)


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
    pair = state.pair(name)
    request.session[_ME] = {name: pair[form.whole("me", 0, 1)]}
    return done(request, f"/m/{request.path_params['token']}")


async def tap(request: Request) -> Response:
    """Take the score of a match in play; a full score is proposed as the result."""
    name, state = await _match(request)
    form = await form_of(request)
    site, to = site_of(request), f"/m/{request.path_params['token']}"
    if site.taps.full(name):
        raise RefusalError("refused_taps", status=429)
    site.taps.count(name)
    if name not in state.standing.to_play:
        raise RefusalError("refused_over", status=409, match=name)
    pair, needs = state.pair(name), state.needed(name, state.pair(name))
    if (form.text("player_a"), form.text("player_b")) != pair:
        raise RefusalError("refused_other_players", status=409, match=name)
    score = form.whole("a", 0, needs[0]), form.whole("b", 0, needs[1])
    if form.text("me") and not _me(request, name):
        request.session[_ME] = {name: pair[form.whole("me", 0, 1)]}
    if score[0] == needs[0] or score[1] == needs[1]:
        said = await asyncio.to_thread(_propose, request, name, pair, score, _me(request, name))
        return done(request, to, said)
    at, by = site.clock(), f"phone: {_me(request, name) or name}"

    def decide(now: Evening) -> list[Event]:
        found: Scored = moves.score(now, name, score)
        live = now.live.get(name)
        return [] if live and live.what == found else [Event(at, found)]

    key = form.key(request.url.path)
    await asyncio.to_thread(add_events, site.path, decide, by=by, form=key)
    return done(request, to)


def _propose(
    request: Request, name: str, pair: tuple[str, str], score: tuple[int, int], me: str
) -> str:
    """Keep a proposed result, and enter it if the opponent proposed the same."""
    site, code = site_of(request), language(request)
    if not me:
        return say(code, "refused_who")
    state = site.night.state()
    moves.result(state, name, score)  # refuses what cannot be a result
    games = dict(zip(pair, score, strict=True))
    phone = phone_of(request)
    propose(site.path, Proposal(name, me, games, phone, site.clock()))
    others = [p for p in _proposed(site.path, name, pair) if p.player != me and p.phone != phone]
    if _entered(site.night.state(), name, games):  # the other phone was faster
        return say(code, "result_entered", match=name)
    if not others:
        return say(code, "proposed_wait", other=pair[pair[0] == me])
    if any(dict(p.score) != games for p in others):
        return say(code, "proposed_differ")

    def decide(now: Evening) -> list[Event]:
        if _entered(now, name, games):
            return []
        found: Result = moves.result(now, name, score)
        return [Event(site.clock(), found)]

    add_events(site.path, decide, by=f"phones: {' and '.join(pair)}")
    forget_proposals(site.path, name)
    return say(code, "result_entered", match=name)


def _proposed(path: Path, name: str, pair: tuple[str, str]) -> list[Proposal]:
    """Return what was proposed for a match by the two who play it now."""
    return [p for p in proposals(path) if p.match == name and set(p.score) == set(pair)]


def _entered(state: Evening, name: str, games: dict[str, int]) -> bool:
    """Return whether a match has this result."""
    there = state.counted.get(name)
    return there is not None and not there.forfeit and there.games == games


async def _match(request: Request) -> tuple[str, Evening]:
    site = site_of(request)
    if not site.night.exists:
        raise RefusalError("refused_no_tournament", status=404)
    state = await asyncio.to_thread(site.night.state)
    if not state.drawn:
        raise RefusalError("refused_no_draw", status=404)
    name = site.match_of(request.path_params["token"], list(state.bracket.by_name))
    if name is None:
        raise RefusalError("refused_token", status=404)
    return name, state


def _me(request: Request, name: str) -> str:
    kept = request.session.get(_ME)
    return str(kept.get(name, "")) if isinstance(kept, dict) else ""


ROUTES = [
    Route("/m/{token}", match, methods=["GET"]),
    Route("/m/{token}/me", be, methods=["POST"]),
    Route("/m/{token}/score", tap, methods=["POST"]),
]
