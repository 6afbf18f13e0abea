"""Who plays: a tournament begun from typed, pasted or uploaded entrants, and late entries."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from datetime import datetime
from typing import Any, NamedTuple

import numpy as np
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.kit.scales import chart_doubts, league_doubts
from evenbreak.answers.league.prior import games_words, unrated_words
from evenbreak.answers.tournament.time import venue_words
from evenbreak.errors import EvenbreakError
from evenbreak.fields.question import declared
from evenbreak.files.charts import find_chart
from evenbreak.files.lists.entrants import read_entrants
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.files.store.desk import back_up
from evenbreak.files.store.tournament import (
    earlier_nights,
    new_tournament,
    read_events,
)
from evenbreak.handicaps.charts.chart import CHARTS, Chart
from evenbreak.questions.tournament import NewTournament
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import NAMES, Scale
from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS
from evenbreak.tournaments.clock.event_pace import EarlierNight
from evenbreak.tournaments.evening.events import Entrant, Event, Plan
from evenbreak.tournaments.evening.format import LONGEST_RACE, MOST_TABLES, Format
from evenbreak.tournaments.evening.plan import FORMATS, opened
from evenbreak.web.defaults import of_league
from evenbreak.web.forms import (
    CHOOSE_IT,
    EVEN,
    FAIR,
    RACES,
    Form,
    asked_in,
    fields_named,
    form_fields,
    form_of,
    list_of,
    read_upload,
    scale_in,
    warnings_of,
)
from evenbreak.web.guard import RefusalError
from evenbreak.web.league import League
from evenbreak.web.page import asked_again, done, page, site_of
from evenbreak.web.sessions import DIRECTORS_PAGE, check_director
from evenbreak.web.site import Site
from evenbreak.words import say

NOT_WITH_FORMAT = {
    "losers_race": say("This format has no losers' side. Leave its race blank."),
    "final_race": say("This format has no final. Leave its race blank."),
    "groups": say("This format has no groups. Leave their number blank."),
    "knockout_size": say("This format has no groups. Leave the number advancing from them blank."),
    "pod_size": say("This format has no pods. Leave their size at 8."),
    "qualifiers": say(
        "In this format nobody qualifies. Leave the number of players advancing blank."
    ),
    "rounds": say("Only a Swiss has a number of rounds. Leave it blank."),
    "final": say("Only a double elimination has a choice of final."),
    "third_place": say("Only a single elimination has a match for third place."),
}
"""Why a field must be left blank in a format that does not have it."""


async def ask(request: Request) -> Response:
    """Show the form that begins a tournament."""
    check_director(request)
    return page(request, "new.html", entered={}, why="", **await _choices(site_of(request)))


async def _choices(site: Site) -> dict[str, Any]:
    """Return what there is to choose from, and the tournament that there is already."""
    return {
        "there": await asyncio.to_thread(_there, site),
        "fields": {one.name: one for one in form_fields(declared(NewTournament))},
        "parts": form_fields(declared(Format)),
        "formats": FORMATS,
        "races": RACES,
        "charts": CHARTS,
        "of_league": of_league(NewTournament, site.rules, charts=CHARTS),
        "scales": NAMES,
        "chip_charts": CHIP_CHARTS,
        "league": site.league.sheet,
        "earlier": any(site.path.parent.glob("*.db")),
    }


async def begin(request: Request) -> Response:
    """Begin a tournament; a form that is refused comes back as it was filled in."""
    form, site = await form_of(request), site_of(request)
    check_director(request)
    try:
        event, warnings = await asyncio.to_thread(_begun, form, site)
        if await asyncio.to_thread(_is_there, site, event):  # the same tap again
            return done(request, "/desk")
        before = await asyncio.to_thread(_put_aside, form, site)
    except (RefusalError, EvenbreakError) as error:
        return asked_again(request, "new.html", form, error, **await _choices(site))
    await asyncio.to_thread(new_tournament, site.path, [event], in_place_of=before)
    site.keep_secrets()
    return done(request, "/desk", *warnings)


class There(NamedTuple):
    """A tournament that is there already: how many events it has, when it was begun, for whom."""

    events: int
    begun: str
    players: int

    @property
    def name(self) -> str:
        """What a form calls it."""
        return f"{self.events} {self.begun}"


def _there(site: Site) -> There | None:
    """Return the tournament that is there already."""
    if not site.night.exists:
        return None
    found = read_events(site.path)
    return There(len(found), found[0].at, len(site.night.state().entrants))


def _is_there(site: Site, event: Event) -> bool:
    """Return whether the tournament that there is has begun just so, and nothing else happened."""
    return site.night.exists and [one.what for one in read_events(site.path)] == [event.what]


def _put_aside(form: Form, site: Site) -> int:
    """Keep a copy of the tournament that is there already; return how many events it has."""
    there = _there(site)
    if there is None:
        return 0
    if form.text("in_place_of") != there.name:
        raise RefusalError(
            "A tournament is already running. Tick the box to archive it, or leave this "
            "page to continue it.",
            status=409,
        )
    back_up(site.path, datetime.now())
    return there.events


def _begun(form: Form, site: Site) -> tuple[Event, list[str]]:
    """Return what a form begins, what its list makes doubtful, and what sets the pace."""
    content = list_of(form, "entrants", "file")
    if not content.strip():
        raise RefusalError("Enter at least one player.")
    file = read_upload(content, read_entrants)
    stated = scale_in(form)
    if file.levels and stated is None:
        raise RefusalError(
            "The list has skill levels, not ratings. Replace them with ratings, or leave them out."
        )
    scale = file.scale or file.scale_by(stated, CHOOSE_IT)
    league = site.league if form.text("league") else None
    if league is not None and league.sheet is not None:
        scale = league.sheet.ratings.scale
        refuse_to_read(file, scale, say("the league"), say("put all ratings on one scale"))
    read = file.roster
    filled = read.with_starters(scale.centre, scale.points_per_doubling, scale)
    earlier = earlier_nights([site.path.parent] if form.text("pace") else [])
    plan, rows = _plan(form, scale, earlier), _entrants(filled, league)
    known_form = 0.0 if league is None or league.sheet is None else league.sheet.ratings.match_form
    plan = replace(plan, match_form=file.form or known_form)
    known = league is not None
    doubts = (
        []
        if known
        else league_doubts(scale, read.rating, say("is it the right scale?"), read.players)
    )
    doubts += chart_doubts(plan.chart, scale)
    unrated = zip(rows, np.isnan(read.rating).tolist(), strict=True)
    new = [
        one.name for one, is_new in unrated if is_new and not (league and league.known(one.name))
    ]
    if new:
        doubts.append(unrated_words(new, plan.starter, plan.starter_error))
    if not known:
        doubts += filter(None, [games_words(read, filled)])
    doubts += filter(None, [venue_words(plan.discipline, plan.earlier)])
    return Event(site.clock(), opened(plan, rows), DIRECTORS_PAGE), [*warnings_of(file), *doubts]


def _plan(form: Form, scale: Scale, earlier: tuple[EarlierNight, ...]) -> Plan:
    """Return what is played, by the fields of the form; those left empty have their defaults."""
    kind = form.one_of("format", FORMATS)
    races = EVEN if kind == "chips" else form.one_of("races", (*RACES, *CHARTS))
    _refuse_of_other_formats(form, kind)
    if form.text("qualifiers") and form.text("final") == "single":
        raise RefusalError(
            "A double elimination that ends with qualifiers has one final. Leave out one "
            "of the two choices."
        )
    if races in CHARTS and (form.text("losers_race") or form.text("final_race")):
        raise RefusalError(
            "The chart sets all races. Leave the races of the losers' side and of the final blank."
        )
    has_race = kind != "chips" and races not in CHARTS
    length = form.whole("race", 1, LONGEST_RACE) if has_race else None
    asked = asked_in(
        NewTournament,
        form,
        [*declared(Format), *fields_named(NewTournament, "form", "seeding", "discipline")],
        entrants="",
        race=length if races == EVEN else None,
        race_to=length if races == FAIR else None,
        chart=races if races in CHARTS else None,
        chips=form.one_of("chips", tuple(CHIP_CHARTS)) if kind == "chips" else None,
        tables=form.whole("tables", 1, MOST_TABLES),
    )
    return Plan(
        asked.form,
        length or 1,
        **asked.of_format,
        handicapped=asked.race_to is not None,
        chart=None if asked.chart is None else _chart(asked.chart),
        seeding=asked.seeded,
        scale=scale.text,
        starter=scale.centre,
        starter_error=scale.points_per_doubling,
        tables=asked.tables,
        discipline=asked.discipline,
        chips=None if asked.chips is None else CHIP_CHARTS[asked.chips],
        earlier=earlier,
    )


def _refuse_of_other_formats(form: Form, kind: str) -> None:
    """Refuse a field that was filled in and that the format does not have."""
    for one in declared(Format):
        is_given = form.text(one.name) not in ("", one.usual)
        if is_given and kind not in one.field.formats and one.name in NOT_WITH_FORMAT:
            raise RefusalError(NOT_WITH_FORMAT[one.name])


def _chart(name: str) -> Chart:
    found = find_chart(name)
    assert isinstance(found, Chart)  # noqa: S101
    return found


def _entrants(filled: Roster, league: League | None) -> tuple[Entrant, ...]:
    """Return the entrants, those of the league with its ratings."""
    errors = np.nan_to_num(filled.standard_error)
    columns = filled.rating.tolist(), errors.tolist(), filled.provisional.tolist()
    rows = zip(filled.players, *columns, strict=True)
    return tuple(Entrant(*((league.known(one[0]) if league else None) or one)) for one in rows)


ROUTES = [
    Route("/new", ask, methods=["GET"]),
    Route("/new", begin, methods=["POST"]),
]
