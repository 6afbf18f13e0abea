"""The players: ratings, chances, when each plays next; and what the places are paid."""

from __future__ import annotations

import asyncio
from typing import NamedTuple

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.times_of_day import time_of_day
from evenbreak.answers.tournament_prizes import tournament_prizes_answer
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.money.payouts import PAYOUTS, payout_table
from evenbreak.web.forms import Form
from evenbreak.web.night import Known
from evenbreak.web.page import answer_shown, page, site_of
from evenbreak.web.refusals import RefusalError

MOST_MONEY = 1_000_000


class PlayerView(NamedTuple):
    """A player as the page shows them.

    Parameters
    ----------
    name, rating, error
        the rating and how far off it may be.
    p_title
        the chance of the title; None: not known.
    match, other
        the match that they play now or can play next, and whom they meet; '' if not known.
    table, called
        where they play, or will be called to next; None: they do not, or will not.
    starts
        when their next match begins: early, in the middle and late, such as 20:40; None: no match.
    """

    name: str
    rating: float
    error: float
    p_title: float | None
    match: str
    other: str
    table: int | None
    called: int | None
    starts: tuple[str, ...] | None


async def players(request: Request) -> Response:
    """Show the players, the highest rating first."""
    night = site_of(request).night
    if not night.exists:
        raise RefusalError("refused_no_tournament", status=404)
    known = await night.outlook()
    state = await asyncio.to_thread(night.state)
    return page(request, "players.html", live=True, players=_views(state, known))


def _views(state: Evening, known: Known | None) -> list[PlayerView]:
    listed = (known.data.get("odds") or known.data.get("players", [])) if known else []
    titles = {one["name"]: one["p_title"] for one in listed}
    calls = {name: at for at, name in known.calls} if known and known.of is state else {}
    playing: dict[str, str] = {}
    if state.drawn:
        playing = {name: match for match in state.standing.to_play for name in state.pair(match)}
    views = []
    for name, entrant in state.entrants.items():
        match = playing.get(name, "")
        other = next((one for one in state.pair(match) if one != name), "") if match else ""
        on_table = state.on_tables.get(match) if match else None
        starts = None
        if known and on_table is None and name in known.next_starts:
            starts = tuple(time_of_day(known.start + at) for at in known.next_starts[name])
        table = on_table.call.table if on_table else None
        title = titles.get(name)
        views.append(
            PlayerView(
                name,
                entrant.rating,
                entrant.standard_error,
                title,
                match,
                other,
                table,
                calls.get(match),
                starts,
            )
        )
    return sorted(views, key=lambda one: -one.rating)


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
        answer = tournament_prizes_answer(
            state, payout_table(payout), float(pot), odds, source=site_of(request).path.stem
        )
        shown = answer_shown(request, answer)
    asked = {"fee": fee, "added": added, "payout": payout}
    return page(request, "prizes.html", asked=asked, payouts=list(PAYOUTS), answer=shown)


ROUTES = [Route("/players", players), Route("/prizes", prizes)]
