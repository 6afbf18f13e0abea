"""The players: ratings, chances, when each plays next; and what the places are paid."""

from __future__ import annotations

import asyncio
import re
from dataclasses import replace

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament_prizes import tournament_prizes_answer
from evenbreak.tournaments.money.payouts import PAYOUTS, Payouts, payout_table
from evenbreak.web.forms import Form
from evenbreak.web.page import answer_shown, page, site_of
from evenbreak.web.player_view import player_views
from evenbreak.web.refusals import RefusalError

MOST_MONEY = 1_000_000
_SHARES = re.compile(r"[0-9]+([.,][0-9]+)?(/[0-9]+([.,][0-9]+)?)*", re.ASCII)


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
    payout = form.text("payout", longest=60) or usual
    shown = ""
    if pot := fee * len(state.entrants) + added:
        known = await night.outlook()
        odds = known.odds if known and known.of is state else None
        answer = tournament_prizes_answer(state, _table(payout), float(pot), odds)
        shown = answer_shown(request, answer)
    asked = {"fee": fee, "added": added, "payout": payout}
    return page(request, "prizes.html", asked=asked, payouts=list(PAYOUTS), answer=shown)


def _table(payout: str) -> Payouts:
    """Return a table by its name, or what each place is paid in percent, such as 50/30/20."""
    if payout.lower() in PAYOUTS:
        return payout_table(payout.lower())
    if not _SHARES.fullmatch(payout):
        raise RefusalError("refused_payout", value=payout)
    shares = [float(part) / 100.0 for part in payout.replace(",", ".").split("/")]
    if not 0.0 < sum(shares) <= 1.0 + 1e-9:
        raise RefusalError("refused_payout", value=payout)
    return replace(payout_table(shares), name=payout)


ROUTES = [Route("/players", players), Route("/prizes", prizes)]
