"""The players: ratings, chances, when each plays next; and what the places are paid."""

from __future__ import annotations

import asyncio
import re

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament.prizes import tournament_prizes_answer
from evenbreak.errors import InputError
from evenbreak.files.store.desk import kept_prizes
from evenbreak.tournaments.money.payouts import PAYOUTS, PrizeMoney
from evenbreak.web.evening_view import player_views
from evenbreak.web.forms import Form, form_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import answer_shown, done, page, reason, site_of
from evenbreak.web.sessions import check_director
from evenbreak.words import Parameter, say

_MONEY = re.compile(r"[0-9]{1,7}(\.[0-9]{1,2})?", re.ASCII)


async def players(request: Request) -> Response:
    """Show the players, the highest rating first."""
    night = site_of(request).night
    if not night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    known = await night.outlook()
    state = night.state()
    return page(request, "players.html", live=True, players=player_views(state, known))


async def prizes(request: Request) -> Response:
    """Show what each place is paid, and what each player may expect."""
    site = site_of(request)
    if not site.night.exists:
        raise RefusalError("No tournament is running yet.", status=404)
    kept = await asyncio.to_thread(kept_prizes, site.path) or PrizeMoney()
    asked = _asked(Form(request.query_params)) if "fee" in request.query_params else kept
    state = await asyncio.to_thread(site.night.state)
    entrants, shown, why = len(state.entrants), "", ""
    if pot := asked.pot(entrants):
        known = await site.night.outlook()
        odds = known.odds if known and known.of is state else None
        try:
            answer = tournament_prizes_answer(state, asked.payouts(entrants), pot, odds)
            shown = answer_shown(request, answer)
        except InputError as error:  # a table that does not pay so many; another can be asked for
            why = reason(request, error)
    return page(
        request,
        "prizes.html",
        asked=asked,
        usual=asked.payouts(entrants).name,
        payouts=list(PAYOUTS),
        answer=shown,
        why=why,
        kept=asked == kept,
    )


async def keep(request: Request) -> Response:
    """Keep the prizes with the tournament."""
    form, site = await form_of(request), site_of(request)
    check_director(request)
    money = _asked(form)
    money.amounts(len((await asyncio.to_thread(site.night.state)).entrants))
    await asyncio.to_thread(site.night.keep_prizes, money)
    return done(
        request,
        "/prizes",
        say("The prizes are saved, and shown on tonight's page and on the screen."),
    )


def _asked(form: Form) -> PrizeMoney:
    fee, added = (_money(form, name) for name in ("fee", "added"))
    payout = form.text("payout", longest=60)
    try:
        return PrizeMoney(fee, added, payout=payout.lower().replace(",", "."))
    except InputError:
        raise RefusalError(
            "{value!r}: choose a table from the list, or write the percentage for each "
            "place, such as 50/30/20, adding up to 100 at most.",
            value=payout,
        ) from None


def _money(form: Form, name: str) -> float:
    text = form.text(name).replace(",", ".")
    if text and not _MONEY.fullmatch(text):
        raise RefusalError(
            "{field} must be an amount of money below 10 million, such as 20 or 12.50; you "
            "entered {value!r}.",
            field=Parameter(name),
            value=text,
        )
    return float(text or 0)


ROUTES = [
    Route("/players", players),
    Route("/prizes", prizes, methods=["GET"]),
    Route("/prizes", keep, methods=["POST"]),
]
