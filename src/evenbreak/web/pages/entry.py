"""Who plays: a tournament begun from typed, pasted or uploaded entrants, and late entries."""

from __future__ import annotations

import asyncio

import numpy as np
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.files.entrants import read_entrants
from evenbreak.files.roster import RosterFile
from evenbreak.files.tournament_store import add_events, new_tournament
from evenbreak.ratings.scale import SCALES, Scale
from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS
from evenbreak.tournaments.evening import moves
from evenbreak.tournaments.evening.events import Entrant, Event, Opened, Plan
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.forms import Form, form_of
from evenbreak.web.league import League
from evenbreak.web.page import done, language, page, site_of
from evenbreak.web.pages.desk import BY
from evenbreak.web.refusals import RefusalError
from evenbreak.web.sessions import check_director
from evenbreak.web.uploads import list_of, read_upload, warnings_of
from evenbreak.web.words import say

FORMATS = (
    "double",
    "single",
    "round-robin",
    "groups",
    "swiss",
    "consolation",
    "king-of-the-hill",
    "chips",
)
WITH_LOSERS = ("double", "consolation")
WITH_FINAL = ("double", "single", "groups", "consolation", "king-of-the-hill")
SEEDINGS = ("blind", "rating", "listed")
DISCIPLINES = ("8-ball", "9-ball", "10-ball")


async def ask(request: Request) -> Response:
    """Show the form that begins a tournament."""
    check_director(request)
    return page(
        request,
        "new.html",
        formats=FORMATS,
        seedings=SEEDINGS,
        disciplines=DISCIPLINES,
        scales=list(SCALES),
        charts=list(CHIP_CHARTS),
        league=site_of(request).league.sheet,
    )


async def begin(request: Request) -> Response:
    """Begin a tournament."""
    async with request.form(max_files=1, max_fields=40) as fields:
        form = Form(fields)
        content = await list_of(form, "entrants", "file")
        await form_of(request)
    check_director(request)
    site = site_of(request)
    if not content.strip():
        raise RefusalError("refused_nobody")
    file = await asyncio.to_thread(read_upload, content, read_entrants)
    scale = file.scale or SCALES[form.one_of("scale", tuple(SCALES))]
    league = site.league if form.text("league") else None
    if league is not None and league.sheet is not None:
        scale = league.sheet.ratings.scale
    plan = _plan(form, scale)
    opened = Opened(plan, _entrants(file, scale, league))
    if plan.chips is not None:
        plan.chips.chips([one.rating for one in opened.entrants])  # refuses those below the chart
    if not 2 <= len(opened.entrants) <= moves.MOST_PLAYERS:
        raise RefusalError("refused_players", players=len(opened.entrants))
    event = Event(site.clock(), opened)
    await asyncio.to_thread(new_tournament, site.path, [event])
    site.keep_secrets()
    return done(request, "/desk", *warnings_of(file))


def _plan(form: Form, scale: Scale) -> Plan:
    """Return what is played, by the fields of the form."""
    kind = form.one_of("format", FORMATS)
    chips = kind == "chips"
    losers, final = (form.whole(name, 0, 100, default=0) for name in ("losers_race", "final_race"))
    if losers and kind not in WITH_LOSERS:
        raise RefusalError("refused_no_losers")
    if final and kind not in WITH_FINAL:
        raise RefusalError("refused_no_final")
    return Plan(
        kind,
        1 if chips else form.whole("race", 1, 100),
        losers_race=losers or None,
        final_race=final or None,
        handicapped=bool(form.text("handicapped")) and not chips,
        seeding=form.one_of("seeding", SEEDINGS),
        scale=scale.text,
        starter=scale.centre,
        starter_error=scale.points_per_doubling,
        tables=form.whole("tables", 1, 1000),
        discipline=form.one_of("discipline", DISCIPLINES),
        chips=CHIP_CHARTS[form.one_of("chips", tuple(CHIP_CHARTS))] if chips else None,
    )


def _entrants(file: RosterFile, scale: Scale, league: League | None) -> tuple[Entrant, ...]:
    """Return the entrants, those of the league with its ratings.

    New players have the rating in the middle, and are very uncertain.
    """
    read = file.roster
    new = np.isnan(read.rating)
    rating = np.where(new, scale.centre, read.rating)
    error = np.where(new, scale.points_per_doubling, np.nan_to_num(read.standard_error))
    rows = zip(read.players, rating.tolist(), error.tolist(), strict=True)
    return tuple(Entrant(*((league.known(one[0]) if league else None) or one)) for one in rows)


async def late(request: Request) -> Response:
    """Let a late player in."""
    form = await form_of(request)
    check_director(request)
    site, name = site_of(request), " ".join(form.text("name", longest=80).split())
    if not name:
        raise RefusalError("refused_nobody")
    stated = form.text("rating").replace(",", ".")
    try:
        rating = float(stated) if stated else None
    except ValueError:
        raise RefusalError("refused_rating", value=stated) from None

    def decide(state: Evening) -> list[Event]:
        plan = state.plan
        entrant = (
            Entrant(name, plan.starter, plan.starter_error)
            if rating is None
            else Entrant(name, rating)
        )
        return [Event(site.clock(), moves.late(state, entrant))]

    await asyncio.to_thread(add_events, site.path, decide, by=BY)
    return done(request, "/desk", say(language(request), "entered", name=name))


ROUTES = [
    Route("/new", ask, methods=["GET"]),
    Route("/new", begin, methods=["POST"]),
    Route("/desk/late", late, methods=["POST"]),
]
