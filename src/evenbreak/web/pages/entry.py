"""Starting a tournament, from a list whose doubtful lines are asked about, or like the last one."""

from __future__ import annotations

import asyncio
import re
from collections.abc import Collection
from dataclasses import replace
from datetime import date, datetime
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
from evenbreak.files.lists.entrants import nobody, read_entrants
from evenbreak.files.lists.roster import refuse_to_read
from evenbreak.files.store.desk import back_up
from evenbreak.files.store.prizes import kept_prizes
from evenbreak.files.store.tournament import (
    begin_beside,
    delete_tournament,
    earlier_nights,
    keep_prizes,
    new_tournament,
    read_events,
)
from evenbreak.handicaps.charts.chart import CHARTS, Chart
from evenbreak.questions.tournament import NewTournament
from evenbreak.ratings.roster import Roster
from evenbreak.ratings.scale import NAMES, Scale
from evenbreak.tournaments.chips.chip_charts import CHIP_CHARTS
from evenbreak.tournaments.clock.event_pace import EarlierNight
from evenbreak.tournaments.evening.edition import next_edition, tables_text
from evenbreak.tournaments.evening.events import Entrant, Event, Plan
from evenbreak.tournaments.evening.format import LONGEST_RACE, Format
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.tournaments.evening.plan import FORMATS, entrants_of, opened
from evenbreak.tournaments.money.payouts import PAYOUTS
from evenbreak.web.defaults import of_league
from evenbreak.web.forms import (
    CHOOSE_IT,
    EVEN,
    FAIR,
    RACES,
    Fields,
    Form,
    asked_in,
    directors_form,
    fields_named,
    form_fields,
    list_of,
    read_upload,
    scale_in,
    warnings_of,
)
from evenbreak.web.guard import RefusalError
from evenbreak.web.league import League
from evenbreak.web.page import asked_again, done, in_words, page, site_of
from evenbreak.web.pages.players import UNITS, money_fields, money_of
from evenbreak.web.pasted import Known, ListError, entered_list, lines_of
from evenbreak.web.sessions import DIRECTORS_PAGE, check_director
from evenbreak.web.site import Site, begun
from evenbreak.words import say

CHECK_IN = "/desk/check-in"

NOT_WITH_FORMAT = {
    "losers_race": say("This format has no losers' side. Leave its race blank."),
    "final_race": say("This format has no final. Leave its race blank."),
    "groups": say("This format has no groups. Leave their number blank."),
    "knockout_size": say("This format has no groups. Leave the number advancing from them blank."),
    "pod_size": say("This format has no pods. Leave their size at 8."),
    "qualifiers": say(
        "In this format no one qualifies. Leave the number of players advancing blank."
    ),
    "rounds": say("Only a Swiss tournament has a number of rounds. Leave it blank."),
    "final": say("Only a double elimination has a choice of final."),
    "third_place": say("Only a single elimination has a match for third place."),
}
"""Why a field must be left blank in a format that doesn't have it."""


PACES = (
    ("0.8", say("20% less time than usual")),
    ("1", say("as long as usual")),
    ("1.15", say("a little longer")),
    ("1.3", say("a third longer")),
    ("1.6", say("much longer")),
)
"""The venue's match lengths, and a label for each."""


async def ask(request: Request) -> Response:
    """Show the form that starts a tournament, with the choices made last time."""
    check_director(request)
    return page(request, "new.html", entered={}, why="", **await _choices(site_of(request)))


async def again(request: Request) -> Response:
    """Show the form filled in for the next edition: same people, same options."""
    check_director(request)
    state = await asyncio.to_thread(begun(site_of(request).night).state)
    choices = await _choices(site_of(request))
    _, entrants = next_edition(state)
    plan, known = state.plan, choices["of_league"]
    new = plan.newcomer("")
    lines = [
        one.name if replace(one, name="") == new else f"{one.name}, {one.rating:.10g}"
        for one in entrants
    ]
    entered = {**known, "entrants": "\n".join(lines), "pace": "yes" if plan.earlier else ""}
    entered["scale"] = plan.scale if plan.scale in NAMES else ""
    entered |= {"third_place": "yes"} if plan.third_place else {}
    return page(request, "new.html", entered=entered, why="", **choices)


async def _choices(site: Site) -> dict[str, Any]:
    """Return the choices available, and the existing tournament."""
    there = await asyncio.to_thread(_there, site)
    state = await asyncio.to_thread(site.night.state) if there else None
    kept = await asyncio.to_thread(kept_prizes, site.path) if there else None
    league = of_league(NewTournament, site.rules, charts=CHARTS)
    return {
        "there": there,
        "today": site.clock()[:10],
        "paces": PACES,
        "money": money_fields(kept),
        "units": UNITS,
        "payouts": list(PAYOUTS),
        "fields": {one.name: one for one in form_fields(declared(NewTournament))},
        "parts": form_fields(declared(Format)),
        "formats": FORMATS,
        "races": RACES,
        "charts": CHARTS,
        "of_league": _remembered(state.plan) | league if state else league,
        "scales": NAMES,
        "chip_charts": CHIP_CHARTS,
        "league": site.league.sheet,
        "earlier": any(site.path.parent.glob("*.db")),
    }


def _remembered(plan: Plan) -> dict[str, str]:
    """Return the form's fields as they were for a plan."""
    if plan.form not in FORMATS:
        return {}
    races = FAIR if plan.handicapped else EVEN
    found = {
        one.name: str(value).lower() if isinstance(value, bool) else str(value)
        for one in declared(Format)
        if (value := getattr(plan, one.name)) not in (None, False)
    }
    return found | {
        "name": plan.name,
        "format": plan.form,
        "races": plan.chart.name if plan.chart and plan.chart.name in CHARTS else races,
        "race": str(plan.race),
        "tables": tables_text(plan),
        "discipline": plan.discipline,
        "seeding": plan.seeding,
        "slower": f"{plan.slower:g}",
        "chips": plan.chips.name if plan.chips else "",
    }


async def begin(request: Request) -> Response:
    """Start a tournament; a rejected form comes back as it was filled in.

    If a list can mean more than one thing, its doubtful lines are asked about first.
    """
    form, site = await directors_form(request), site_of(request)
    content = list_of(form, "entrants", "file")
    try:
        listed: Collection[str] = ()
        if content.strip():
            asked = content, form, _league(form, site)
            content, listed = await asyncio.to_thread(entered_list, *asked)
        if form.text("checked"):  # what was answered is not to be asked again
            form = _with_list(form, content, listed)
        money = money_of(form)
        event, warnings = await asyncio.to_thread(_begun, form, site, content, listed)
        if form.text("beside") and site.night.exists:
            key = form.key(request.url.path)
            number = await asyncio.to_thread(begin_beside, site.path, lambda _: [event], form=key)
            if money is not None:
                await asyncio.to_thread(keep_prizes, site.path, money, number)
            return done(request, f"/desk?event={number}", *warnings)
        if await asyncio.to_thread(_is_there, site, event):  # the same tap again
            return done(request, CHECK_IN)
        before = await asyncio.to_thread(_put_aside, form, site)
    except ListError as asked:
        return _ask_about(request, form, asked)
    except (RefusalError, EvenbreakError) as error:
        if form.text("checked"):
            return _ask_about(request, form, ListError(*lines_of(content)), error)
        return asked_again(request, "new.html", form, error, **await _choices(site))
    await asyncio.to_thread(new_tournament, site.path, [event], in_place_of=before)
    if money is not None:
        await asyncio.to_thread(site.night.keep_prizes, money)
    site.keep_secrets()
    return done(request, CHECK_IN, *warnings)


def _league(form: Form, site: Site) -> Known | None:
    """Return how players are looked up in the league, if its ratings are to be used."""
    return site.league.known if form.text("league") and site.league.sheet else None


def _with_list(form: Form, content: bytes, listed: Collection[str]) -> Form:
    """Return a form with the clarified list in place of the answers."""
    rest = [one for one in form.fields.multi_items() if one[0] not in ("entrants", "checked")]
    own = [("stated", name) for name in sorted(listed)]
    return Form(Fields([*rest, ("entrants", content.decode()), *own]))


def _ask_about(
    request: Request, form: Form, asked: ListError, why: Exception | None = None
) -> Response:
    own = ("csrf", "once", "begun", "entrants", "checked", "stated", "event", "file")
    answers = re.compile("(line|other|name|rating)-[0-9]+")
    fields = [(name, text) for name, text in form.fields.multi_items() if isinstance(text, str)]
    kept = [one for one in fields if one[0] not in own and not answers.fullmatch(one[0])]
    kept += [("entrants", asked.content), *(("stated", name) for name in sorted(asked.stated))]
    if why is not None:
        return asked_again(request, "check_list.html", form, why, lines=asked.lines, kept=kept)
    return page(request, "check_list.html", lines=asked.lines, kept=kept, entered={}, why="")


async def delete(request: Request) -> Response:
    """Remove the tournament from the file, after asking for confirmation; keep a copy."""
    form, site = await directors_form(request), site_of(request)
    there = await asyncio.to_thread(_there, site)
    if there is None:
        raise RefusalError("No tournament is running yet.", status=404)
    if not form.text("sure"):
        line = say(
            "The {players}-player tournament that was started on {day} will be deleted. A copy "
            "of its file is kept.",
            players=there.players,
            day=there.begun[:10],
        )
        own = ("csrf", "sure", "named")
        fields = [one for one in form.fields.multi_items() if one[0] not in own]
        lines = [in_words(request, line)]
        return page(request, "sure.html", fields=fields, lines=lines, lost=[], back="/new")
    copy = await asyncio.to_thread(back_up, site.path, datetime.now())
    await asyncio.to_thread(delete_tournament, site.path)
    site.night.forget()
    return done(request, "/new", say("Deleted. A copy was saved as {name}.", name=copy.name))


class There(NamedTuple):
    """An existing tournament: how many events it has, when it was started, for how many."""

    events: int
    begun: str
    players: int
    over: bool

    @property
    def name(self) -> str:
        """The form's name for it."""
        return f"{self.events} {self.begun}"


def _there(site: Site) -> There | None:
    """Return the existing tournament."""
    if not site.night.exists:
        return None
    found, state = read_events(site.path), site.night.state()
    over = state.drawn and not state.standing.to_play and not can_draw(state)
    return There(len(found), found[0].at, len(state.entrants), over)


def _is_there(site: Site, event: Event) -> bool:
    """Return whether the existing tournament was started exactly like this, with nothing since."""
    return site.night.exists and [one.what for one in read_events(site.path)] == [event.what]


def _put_aside(form: Form, site: Site) -> int:
    """Save a copy of the existing tournament; return how many events it has."""
    there = _there(site)
    if there is None:
        return 0
    if form.text("in_place_of") != there.name:
        raise RefusalError(
            "A tournament is already running. Check the box to archive it, or leave this page "
            "to go back to it.",
            status=409,
        )
    back_up(site.path, datetime.now())
    return there.events


def _begun(
    form: Form, site: Site, content: bytes, listed: Collection[str]
) -> tuple[Event, list[str]]:
    """Return what a form starts, what is doubtful about its list, and what sets the pace."""
    league = site.league if form.text("league") else None
    stated = scale_in(form)
    file = read_upload(content, read_entrants) if content.strip() else nobody()
    if not (content.strip() or stated or (league and league.sheet)):
        raise RefusalError(
            "No one has entered yet, so the rating scale can't be detected. Choose it below."
        )
    if file.levels and stated is None:
        raise RefusalError(
            "The list has skill levels, not ratings. Replace them with ratings, or leave them out."
        )
    named = replace(file, source=say("the list"))
    scale = file.scale or named.scale_by(stated, CHOOSE_IT)
    if league is not None and league.sheet is not None:
        scale = league.sheet.ratings.scale
        refuse_to_read(file, scale, say("the league"), say("put all ratings on one scale"))
    read = file.roster
    filled = read.with_starters(scale.center, scale.points_per_doubling, scale)
    earlier = earlier_nights([site.path.parent] if form.text("pace") else [])
    plan, rows = _plan(form, scale, earlier), _entrants(filled, league, listed)
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
    """Return the plan from the form's fields; empty fields get their defaults."""
    kind = form.one_of("format", FORMATS)
    races = EVEN if kind == "chips" else form.one_of("races", (*RACES, *CHARTS))
    _refuse_of_other_formats(form, kind)
    if form.text("qualifiers") and form.text("final") == "single":
        raise RefusalError(
            "A double elimination that ends with qualifiers has one final. Choose only one of "
            "the two."
        )
    if races in CHARTS and (form.text("losers_race") or form.text("final_race")):
        raise RefusalError(
            "The chart sets all races. Leave the races on the losers' side and in the final blank."
        )
    has_race = kind != "chips" and races not in CHARTS
    length = form.whole("race", 1, LONGEST_RACE) if has_race else None
    asked = asked_in(
        NewTournament,
        form,
        [
            *declared(Format),
            *fields_named(NewTournament, "form", "seeding", "discipline", "tables"),
        ],
        entrants="",
        race=length if races == EVEN else None,
        race_to=length if races == FAIR else None,
        chart=races if races in CHARTS else None,
        chips=form.one_of("chips", tuple(CHIP_CHARTS)) if kind == "chips" else None,
    )
    return Plan(
        asked.form,
        length or 1,
        **asked.of_format,
        handicapped=asked.race_to is not None,
        chart=None if asked.chart is None else _chart(asked.chart),
        seeding=asked.seeded,
        scale=scale.text,
        starter=scale.center,
        starter_error=scale.points_per_doubling,
        name=" ".join(form.text("name", longest=60).split()),
        date=_date(form),
        tables=asked.tables.many,
        labels=asked.tables.labels or (),
        slower=float(form.one_of("slower", ("", *dict(PACES))) or 1.0),
        discipline=asked.discipline,
        chips=None if asked.chips is None else CHIP_CHARTS[asked.chips],
        earlier=earlier,
    )


def _date(form: Form) -> str:
    text = form.text("date", longest=20)
    try:
        return date.fromisoformat(text).isoformat() if text else ""
    except ValueError:
        raise RefusalError("{value!r} isn't a date, such as 2025-03-01.", value=text) from None


def _refuse_of_other_formats(form: Form, kind: str) -> None:
    """Reject a field that was filled in although the format doesn't have it."""
    for one in declared(Format):
        is_given = form.text(one.name) not in ("", one.usual)
        if is_given and kind not in one.field.formats and one.name in NOT_WITH_FORMAT:
            raise RefusalError(NOT_WITH_FORMAT[one.name])


def _chart(name: str) -> Chart:
    found = find_chart(name)
    assert isinstance(found, Chart)  # noqa: S101
    return found


def _entrants(
    filled: Roster, league: League | None, listed: Collection[str]
) -> tuple[Entrant, ...]:
    """Return the entrants, using league ratings for league players unless the list's count."""

    def known(one: Entrant) -> Entrant:
        found = league.known(one.name) if league and one.name not in listed else None
        return Entrant(*found) if found else one

    return tuple(map(known, entrants_of(filled)))


ROUTES = [
    Route("/new", ask, methods=["GET"]),
    Route("/new", begin, methods=["POST"]),
    Route("/next", again, methods=["GET"]),
    Route("/desk/delete", delete, methods=["POST"]),
]
