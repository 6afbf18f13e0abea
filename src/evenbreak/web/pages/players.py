"""The players: ratings, chances, when each plays next; and what the places are paid."""

from __future__ import annotations

import asyncio

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament_prizes import tournament_prizes_answer
from evenbreak.tournaments.money.payouts import PAYOUTS, payout_table
from evenbreak.web.forms import Form
from evenbreak.web.page import answer_shown, page, site_of
from evenbreak.web.player_view import player_views
from evenbreak.web.refusals import RefusalError

MOST_MONEY = 1_000_000


async def players(request: Request) -> Response:
    """Show the players, the highest rating first."""
    night = site_of(request).night
    if not night.exists:
        raise RefusalError("refused_no_tournament", status=404)
    known = await night.outlook()
    state = await asyncio.to_thread(night.state)
    return page(request, "players.html", live=True, players=player_views(state, known))


async def prizes(request: Request) -> Response:
    """Show what each place is paid, and what each player may expect."""
    night = site_of(request).night
    if not night.exists:
        raise RefusalError("refused_no_tournament", status=404)
    form = Form(request.query_params)
    fee, added = (form.whole(name, 0, MOST_MONEY, default=0) for name in ("fee", "added"))
    state = await asyncio.to_thread(night.state)
    usual = "70/30" if len(state.entrants) < 8 else "40/30/20/10"
    payout = form.one_of("payout", tuple(PAYOUTS)) if form.text("payout") else usual
    shown = ""
    if pot := fee * len(state.entrants) + added:
        known = await night.outlook()
        odds = known.odds if known and known.of is state else None
        answer = tournament_prizes_answer(state, payout_table(payout), float(pot), odds)
        shown = answer_shown(request, answer)
    asked = {"fee": fee, "added": added, "payout": payout}
    return page(request, "prizes.html", asked=asked, payouts=list(PAYOUTS), answer=shown)


ROUTES = [Route("/players", players), Route("/prizes", prizes)]
