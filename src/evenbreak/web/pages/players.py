"""The players, for everyone and for the director; and the prizes."""

from __future__ import annotations

import asyncio
import re
from dataclasses import replace
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament.moves import event_name
from evenbreak.answers.tournament.prizes import tournament_prizes_answer
from evenbreak.errors import InputError
from evenbreak.files.store.prizes import kept_prizes
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.money.payouts import PAYOUTS, PrizeMoney
from evenbreak.web.evening_view import player_views
from evenbreak.web.forms import Form, directors_form
from evenbreak.web.guard import RefusalError
from evenbreak.web.page import answer_shown, done, page, reason, site_of
from evenbreak.web.sessions import is_director
from evenbreak.web.site import begun, night_of, of_event
from evenbreak.words import Parameter, say

_MONEY = re.compile(r"[0-9]{1,7}(\.[0-9]{1,2})?", re.ASCII)

UNITS = (
    ("0", say("the cent")),
    ("1", say("whole dollars or euros")),
    ("5", say("fives")),
    ("10", say("tens")),
)
"""What prizes can be rounded to, with labels."""


async def players(request: Request) -> Response:
    """Show the players, highest rating first; the director also sees what can be changed."""
    night = begun(night_of(request))
    known = await night.outlook()
    state = await asyncio.to_thread(night.state)
    director = is_director(request)
    played = _begun(state)
    phones = await asyncio.to_thread(night.phones) if director else None
    return page(
        request,
        "players.html",
        live=not director,
        state=state,
        players=player_views(state, known),
        begun_to_play=played,
        movable=[name for name in state.order if name not in played] if state.drawn else [],
        codes=site_of(request).player_codes() if director else {},
        claimed=phones.claims if phones else (),
    )


def _begun(state: Evening) -> set[str]:
    """Return who has played or is playing."""
    if not state.drawn:
        return set()
    found = {name for one in state.on_tables.values() for name in one.call.players}
    for name, result in state.counted.items():
        if name in state.records:
            found.update(result.players)
    return found


async def prizes(request: Request) -> Response:
    """Show each place's prize, and each player's expected prize."""
    night = begun(night_of(request))
    kept = await asyncio.to_thread(kept_prizes, night.path, night.event) or PrizeMoney()
    query = Form(request.query_params)
    asked = money_of(query) or kept if "fee" in request.query_params else kept
    state = await asyncio.to_thread(night.state)
    shown, why = "", ""
    if asked.pot(state.payers):
        known = await night.outlook()
        odds = known.odds if known and known.of is state else None
        try:
            answer = tournament_prizes_answer(state, asked, odds)
            shown = answer_shown(request, replace(answer, heading=say("What each place gets")))
        except InputError as error:  # a table that does not pay so many; another can be asked for
            why = reason(request, error)
    return page(
        request,
        "prizes.html",
        money=money_fields(asked),
        entered={},
        units=UNITS,
        payouts=list(PAYOUTS),
        answer=shown,
        why=why,
        kept=asked == kept,
        tag=event_name(state) if state.beside else "",
    )


async def keep(request: Request) -> Response:
    """Store the prizes with the tournament."""
    form, night = await directors_form(request), night_of(request)
    money = money_of(form) or PrizeMoney()
    state = await asyncio.to_thread(night.state)
    money.amounts(len(state.entrants), state.payers)
    await asyncio.to_thread(night.keep_prizes, money)
    return done(
        request,
        of_event("/prizes", night.event),
        say("The prizes are saved, and shown on tonight's page and on the screen."),
    )


def money_fields(money: PrizeMoney | None) -> dict[str, str]:
    """Return a prize money form's fields as filled in."""
    known = money or PrizeMoney()
    fields: dict[str, Any] = {
        "fee": known.fee,
        "added": known.added,
        "house": known.house * 100.0,
        "unit": known.unit,
    }
    shown = {
        name: f"{value:.10g}" if value or name == "unit" else "" for name, value in fields.items()
    }
    return shown | {"payout": known.payout}


def money_of(form: Form) -> PrizeMoney | None:
    """Return the prize money in a form; None if there is none."""
    fee, added, unit = (_money(form, name) for name in ("fee", "added", "unit"))
    house = _money(form, "house") / 100.0
    payout = form.text("payout", longest=60)
    if house > 0.99:
        raise RefusalError("The house can keep 99% at most.")
    try:
        money = PrizeMoney(fee, added, house, payout.lower().replace(",", "."), unit)
    except InputError:
        raise RefusalError(
            "{value!r} isn't a way to split the prizes. Choose a table from the list, or enter "
            "a percentage for each place, such as 50/30/20, with a total of 100 at most.",
            value=payout,
        ) from None
    return money if fee or added else None


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
