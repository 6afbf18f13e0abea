"""What the director enters: a form for each move, submitted to /desk/ plus its name."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from dataclasses import replace
from http import HTTPStatus
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.tournament.corrections import correction_choices
from evenbreak.answers.tournament.move_table import MOVES
from evenbreak.answers.tournament.moves import event_name
from evenbreak.evenings.move import Move
from evenbreak.fields.question import AskedError, Declared, declared
from evenbreak.files.store.tournament import begin_beside
from evenbreak.questions.moves import Correct
from evenbreak.tournaments.evening import beside
from evenbreak.tournaments.evening.events import Event, What
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.format import LONGEST_RACE
from evenbreak.tournaments.evening.moves import known_match
from evenbreak.web.desk_view import corrected
from evenbreak.web.entering import Entered, SureError, asked_of, enter, other_events
from evenbreak.web.forms import (
    Fields,
    Form,
    directors_form,
    entered_rating,
    form_of,
    name_of,
    value_of,
)
from evenbreak.web.guard import RefusalError
from evenbreak.web.night import Night
from evenbreak.web.page import can_be_opened, done, in_words, page, site_of
from evenbreak.web.sessions import DIRECTORS_PAGE, check_director
from evenbreak.web.site import event_of, night_of, of_event
from evenbreak.words import Parameter

OF_COMMANDS = ("file", "at", "yes", "seed")
"""A question's fields that no form has."""
_DESK = "/desk"


STAYS = [MOVES[name] for name in ("result", "correct", "call", "uncall", "wait", "forfeit", "drop")]
"""The moves whose effects the desk itself shows until they are read."""


def asked_in(question: type, form: Form) -> list[Any]:
    """Return what a move's form asks: several moves, if its fields are repeated.

    A score may come as each player's games, in the fields a and b.
    """
    fields = [one for one in declared(question) if one.name not in OF_COMMANDS]
    names = [name_of(one) for one in fields if not one.field.many]
    texts = [(name, form.texts(name)) for name in names if name in form.fields]
    count = max((len(each) for _, each in texts), default=1)
    if count == 1:
        return [_asked(question, fields, form)]
    if any(len(each) not in (1, count) for _, each in texts):
        raise RefusalError("A match has no table, or a table has no match. Open the page again.")
    rows = [[(name, each[k % len(each)]) for name, each in texts] for k in range(count)]
    return [_asked(question, fields, Form(Fields(one))) for one in rows]


def _asked(question: type, fields: Sequence[Declared], form: Form) -> Any:
    values = {one.name: _value(one, form) for one in fields if form.text(name_of(one))}
    if form.text("a") or form.text("b"):
        values["score"] = form.whole("a", 0, 999), form.whole("b", 0, 999)
    missing = [one.name for one in fields if one.required and one.name not in values]
    if missing:
        raise RefusalError("{field} is blank.", field=Parameter(missing[0]))
    try:
        return asked_of(question, values)
    except AskedError as error:
        raise RefusalError(error.sentence) from None


def _value(one: Declared, form: Form) -> Any:
    name = name_of(one)
    if one.field.many:
        return tuple(one.kind.read(text) for text in form.texts(name))
    if one.name == "rating":
        return entered_rating(form)
    return value_of(one, form)


def _route(name: str, move: Move[Evening, What]) -> Route:
    async def enter(request: Request) -> Response:
        form = await form_of(request)
        if move.by == "director":
            check_director(request)
        for night, part in _by_event(request, form):
            answer = await _enter(request, night, part, move)
            if answer.status_code != HTTPStatus.SEE_OTHER:
                break
        return answer

    return Route(f"{_DESK}/{name}", enter, methods=["POST"])


def _by_event(request: Request, form: Form) -> list[tuple[Night, Form]]:
    """Return what a form enters in each event: one form may have all of a night's calls.

    Raises RefusalError if there is no such event, or the numbers of events, matches and tables
    differ.
    """
    rows = list(zip(form.texts("of"), form.texts("match"), form.texts("table"), strict=False))
    if not rows:
        return [(night_of(request), form)]
    nights = {str(night.event): night for night in site_of(request).nights}
    if not {of for of, _, _ in rows} <= {*nights}:
        raise RefusalError("There is no such page.", status=404)
    found = []
    for event in dict.fromkeys(of for of, _, _ in rows):
        mine = [(match, table) for of, match, table in rows if of == event]
        others = [one for one in form.fields.multi_items() if one[0] not in ("match", "table")]
        fields = [
            *others,
            *(
                (name, text)
                for row in mine
                for name, text in zip(("match", "table"), row, strict=True)
            ),
        ]
        found.append((nights[event], Form(Fields(fields))))
    return found


async def _enter(request: Request, night: Night, form: Form, move: Move[Evening, What]) -> Response:
    """Enter what a form asks; if it removes something, ask for confirmation first, naming it.

    The answer applies to what was named: if that has changed by then, it must be confirmed again.
    """
    asked = asked_in(move.question, form)
    try:
        entered = await enter(
            site_of(request),
            night,
            move,
            asked,
            by=DIRECTORS_PAGE,
            key=form.key(request.url.path),
            sure=bool(form.text("sure")),
            named=form.text("named"),
            everywhere=move is MOVES["drop"] and bool(form.text("everywhere")),
        )
    except SureError as error:
        if move is MOVES["correct"]:
            return _ask_what(request, form, asked[0], error.would.before)
        return _ask(request, form, error.would)
    stays = not form.text("back") and move in STAYS
    return done(request, _back(request, form), *entered.said(brief=stays))


def _back(request: Request, form: Form) -> str:
    """Return the page that a form leads back to: the one it names, or else the desk."""
    back = form.text("back")
    is_page = back.startswith("/") and can_be_opened(request, back.partition("?")[0])
    event = event_of(request)
    desk = of_event(_DESK, event)
    return back if is_page and not back.startswith("//") else desk


def _ask(request: Request, form: Form, would: Entered) -> Response:
    """Ask for confirmation, and whether it applies to the night's other events too."""
    drops = would.move is MOVES["drop"]
    others = other_events(would.before, would.asked[0].player) if drops else []
    only = event_name(would.before) if others else ""
    lines = [in_words(request, one) for one in would.would]
    fields, back = _asked_about(form, would), _back(request, form)
    lost = would.lost
    return page(request, "sure.html", fields=fields, lines=lines, lost=lost, back=back, only=only)


def _ask_what(request: Request, form: Form, asked: Correct, before: Evening) -> Response:
    """Ask what happens to the matches played on a result that is being corrected."""
    at, stop = site_of(request).clock(), replace(asked, follow="stop")
    whats = MOVES["correct"].decide(before, stop, at)
    after = before.then(*(Event(at, what) for what in whats))
    match = known_match(before, asked.match, over=True)
    return page(
        request,
        "correct.html",
        one=corrected(before, after, match),
        plan=before.plan,
        choices=correction_choices(before, after, match),
        fields=_asked_about(form, Entered(MOVES["correct"], [asked], before, after)),
        back=_back(request, form),
    )


def _asked_about(form: Form, would: Entered) -> list[tuple[str, Any]]:
    """Return the fields of a form to confirm, with its number, so that it counts once."""
    own = ("csrf", "sure", "named", "follow", "way", "everywhere")
    fields = [(name, value) for name, value in form.fields.multi_items() if name not in own]
    return [*fields, ("named", would.name)]


async def second_chance(request: Request) -> Response:
    """Start a second event for players who are out by now."""
    form = await directors_form(request)
    at, race = site_of(request).clock(), form.whole("race", 1, LONGEST_RACE, default=0)

    def begin(state: Evening) -> list[Event]:
        found = beside.second_chance(state, race=race or None, name=form.text("name"))
        return [Event(at, found, DIRECTORS_PAGE)]

    key = form.key(request.url.path)
    number = await asyncio.to_thread(begin_beside, night_of(request).path, begin, form=key)
    return done(request, of_event(_DESK, number))


ROUTES = [
    *(_route(name, move) for name, move in MOVES.items()),
    Route(f"{_DESK}/second-chance", second_chance, methods=["POST"]),
]
