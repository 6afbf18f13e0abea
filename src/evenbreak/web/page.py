"""A page: a template filled in, in the reader's language.

In sentences, parameters appear as the page's fields, commands as its forms, and files without their
folder.
"""

from __future__ import annotations

import base64
import hashlib
import json
import os
import re
import secrets
import urllib.parse
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache, partial
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import PurePath
from typing import Any

import jinja2
from markupsafe import Markup, escape
from starlette.requests import Request
from starlette.responses import HTMLResponse, RedirectResponse, Response
from starlette.routing import Match

from evenbreak.answers.faces.in_face import answer_in_face, brief
from evenbreak.answers.faces.to_html import to_html
from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.kit.wording import share, share_at_a_glance
from evenbreak.errors import DataError, EvenbreakError
from evenbreak.files.catalogs import face_in, language_of, languages
from evenbreak.sheets.story_drawing import story_style
from evenbreak.site.look import accent
from evenbreak.web.forms import LONGEST, Form
from evenbreak.web.sessions import form_token, is_director
from evenbreak.web.site import Site, event_of, of_event
from evenbreak.words import (
    Face,
    Figure,
    Sentence,
    capital_in_face,
    in_face,
    joined,
    race,
    say,
    say_as,
    say_count,
    tally,
)

_LANGUAGE = "language"
_SAID = "said"
_CSRF, _ONCE = (f"mark-{secrets.token_hex(12)}" for _ in range(2))
"""Placeholders in a rendered page for its reader's form tokens."""
_SCREENS = "wall", "overlay"
_MOST_RENDERED = 100
_MOST_SAID = 1500  # letters as JSON writes them: a cookie holds 4 KB

FIELDS = {
    "race": say("the race"),
    "losers_race": say("the race on the losers' side"),
    "final_race": say("the race in the final"),
    "groups": say("the number of groups"),
    "qualifiers": say("the number of players advancing"),
    "rounds": say("the number of rounds"),
    "tables": say("the number of tables"),
    "fee": say("the entry fee"),
    "added": say("the added money"),
    "a": say("the first score"),
    "b": say("the second score"),
    "sets": say("the number of sets"),
    "times": say("how often each player may play"),
    "table": say("the table"),
    "player": say("the name"),
    "games": say("the loser's games"),
    "payout": say("the payout"),
    "cap": say("the cap"),
    "doubling": say("the points that double the odds"),
}
"""The pages' names for parameters."""

FORMS = {
    "tournament correct": say("Correct a result"),
    "tournament draw": say("Make the draw"),
    "tournament new": say("New tournament"),
    "tournament next": say("Tonight"),
    "tournament rename": say("Correct a name"),
    "tournament result": say("Enter result"),
    "tournament stand": say("Let it stand"),
    "tournament swap-tables": say("Trade"),
    "tournament tiebreak": say("Break the ties"),
    "tournament undo": say("Undo"),
}
"""The pages' equivalents of commands."""

_TYPES = {
    "csv": "text/csv; charset=utf-8",
    "pdf": "application/pdf",
    "png": "image/png",
    "xlsx": "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    "html": "text/html; charset=utf-8",
}


@cache
def _templates() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.PackageLoader("evenbreak.web"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
        finalize=_said,
    )


def _of_plain(how: Callable[..., Sentence]) -> Callable[..., Sentence]:
    """Return say, or say_count, for templates: text escaped by a macro isn't escaped again."""

    def sentence(*given: Any, **values: Any) -> Sentence:
        plain = {k: v.unescape() if isinstance(v, Markup) else v for k, v in values.items()}
        return how(*given, **plain)

    return sentence


@jinja2.pass_context
def _said(context: jinja2.runtime.Context, value: Any) -> Any:
    """Return what a template prints, with sentences as the reader's page phrases them."""
    return in_face(value, context["face"])


@cache
def own_file(name: str) -> str:
    """Return the text of a file in the templates folder."""
    return files("evenbreak.web").joinpath("templates", name).read_text(encoding="utf-8")


@cache
def style(color: str | None = None, whose: str = "director") -> str:
    """Return the stylesheet for all pages: what published sites share, parts, and screens.

    Guests don't get the desk's styles, so that their first page loads at once. Neither do the wall
    ("wall") and the overlays ("overlay"), which have their own.
    """
    common = files("evenbreak.site").joinpath("templates", "common.css")
    own = files("evenbreak.web").joinpath("templates", "css")
    drawn = files("evenbreak.sheets").joinpath("templates", "bracket.css")
    sheets = sorted((one for one in own.iterdir() if one.name.endswith(".css")), key=_style_order)
    if whose in _SCREENS:
        sheets = [one for one in sheets if one.name in ("parts.css", "tonight.css", f"{whose}.css")]
    without = {f"{one}.css" for one in (*_SCREENS, "desk")} - {f"{whose}.css"}
    if whose == "director":
        without -= {"desk.css"}
    sheets = [one for one in sheets if one.name not in without]
    text = "".join(one.read_text(encoding="utf-8") for one in (common, *sheets, drawn))
    text += story_style() if whose == "wall" else ""
    return _short(text) + (accent(color).style() if color else "")


def _short(text: str) -> str:
    """Return a stylesheet without comments and extra spaces."""
    plain = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    bare = re.sub(r"\s*([{};,])\s*|\s*\n\s*|(:) ", lambda at: at[1] or at[2] or " ", plain)
    return bare.replace(";}", "}")


@cache
def style_address(color: str | None, whose: str = "director") -> str:
    """Return the stylesheet's address, which changes with its content so phones may cache it."""
    return f"/evenbreak.css?{whose}={hashlib.sha256(style(color, whose).encode()).hexdigest()[:8]}"


def _style_order(sheet: Traversable) -> tuple[bool, bool, str]:
    """Return a stylesheet's sort key: first what all pages share, then each page's by name."""
    return sheet.name != "parts.css", sheet.name != "forms.css", sheet.name


@cache
def script_hash() -> str:
    """Return the hash of the only script, which pages use to allow it."""
    digest = hashlib.sha256(own_file("live.js").encode()).digest()
    return base64.b64encode(digest).decode()


def site_of(request: Request) -> Site:
    """Return a request's site."""
    site: Site = request.app.state.site
    return site


def language(request: Request) -> str:
    """Return the reader's language: from the address, as chosen, or as the browser asks."""
    chosen = request.query_params.get(_LANGUAGE) or request.session.get(_LANGUAGE)
    if chosen in languages():
        return str(chosen)
    return language_of(request.headers.get("accept-language", ""))


def in_words(request: Request, text: str) -> str:
    """Return a message in the wording of the reader's page."""
    said: str = in_face(text, page_face(language(request)))
    return without_folder(request, said)


def choose_language(request: Request, code: str) -> None:
    """Store the language chosen by the reader."""
    if code in languages():
        request.session[_LANGUAGE] = code


def page(
    request: Request,
    template: str,
    *,
    live: bool = False,
    quick: bool = False,
    status: int = 200,
    of: Sequence[object] = (),
    **values: Any,
) -> Response:
    """Return a page.

    A `live` page follows the tournament; a `quick` page reloads after a second or two, to get what
    is being calculated. While the objects in `of` stay the same (or are equal strings), a hundred
    phones get what was rendered for the first.
    """
    code = language(request)
    face = page_face(code)
    said = request.session.pop(_SAID, [])
    site = site_of(request)
    nights = [one.event for one in site.nights]
    event = values.pop("event", event_of(request))
    event = event if event in nights else 1
    own = {_CSRF: form_token(request), _ONCE: secrets.token_urlsafe(9)}
    asked = f"{request.url.path}?{request.url.query}"
    key = (template, asked, code, is_director(request), live, quick, site.clock()[:16])
    rendered = site.rendered_of(of) if of and not said else {}
    if key in rendered:
        return HTMLResponse(_with(rendered[key], own), status_code=status)

    whose = "director" if is_director(request) else "guest"
    whose = "wall" if request.url.path == "/screen" else whose
    whose = "overlay" if request.url.path.startswith("/overlay/") else whose

    def capital(text: str) -> str:
        return without_folder(request, capital_in_face(text, face))

    shown = (
        _templates()
        .get_template(template)
        .render(
            face=face,
            say=_of_plain(say),
            say_as=say_as,
            say_count=_of_plain(say_count),
            joined=joined,
            tally=tally,
            race_of=race,
            whole=_whole,
            percent=share_at_a_glance,
            share=share,
            number=_number,
            rating=_rating,
            capital=capital,
            language=code,
            languages=languages(),
            here=request.url.path,
            style=style_address(site.color, whose),
            opens=partial(can_be_opened, request),
            return_to=_return_to(request),
            site=site,
            director=is_director(request),
            csrf=_CSRF,
            once=_ONCE,
            of_league=values.pop("of_league", {}),
            begun=begun_at(request),
            event=event,
            nights=nights,
            of_event=partial(of_event, event=event),
            said=said,
            live=live,
            quick=quick,
            script=own_file("live.js"),
            **values,
        )
    )
    if len(rendered) < _MOST_RENDERED:  # addresses may be made up without end
        rendered[key] = shown
    return HTMLResponse(_with(shown, own), status_code=status)


def _with(shown: str, own: Mapping[str, str]) -> str:
    """Return a page with its reader's form tokens filled in."""
    for mark, text in own.items():
        shown = shown.replace(mark, text)
    return shown


def begun_at(request: Request) -> str:
    """Return when tonight's tournament was started, which identifies its forms; '' if none.

    A file that can't be read has none: its pages say why.
    """
    try:
        return site_of(request).night.begun_at
    except DataError:
        return ""


def asked_again(
    request: Request, template: str, form: Form, why: Exception, status: int = 400, **values: Any
) -> Response:
    """Return a rejected form as it was filled in, with the reason above it."""
    entered = {name: text for name, text in form.fields.items() if isinstance(text, str)}
    words = reason(request, why)
    return page(request, template, status=status, entered=entered, why=words, **values)


def refused(request: Request, why: Exception, status: int) -> Response:
    """Return why a request is rejected, with a link back to the page it came from."""
    words = reason(request, why)
    back = _came_from(request) or ("/desk" if is_director(request) else "/")
    return page(request, "refused.html", status=status, why=words, back=back)


def _came_from(request: Request) -> str:
    """Return our page that a request came from; '' if it came from elsewhere."""
    try:
        came = urllib.parse.urlsplit(request.headers.get("referer", ""))
    except ValueError:
        return ""
    own = came.netloc == request.headers.get("host") and not came.path.startswith("//")
    if own and can_be_opened(request, came.path):
        return came._replace(scheme="", netloc="").geturl()
    return ""


def can_be_opened(request: Request, path: str) -> bool:
    """Return whether a path is a page's, and not only a form's."""
    asked = {"type": "http", "path": path, "method": "GET"}
    return any(route.matches(asked)[0] is Match.FULL for route in request.app.routes)


def reason(request: Request, why: Exception) -> str:
    """Return why something is rejected, in the reader's language, one reason per line."""
    text = why.sentence if isinstance(why, EvenbreakError) else str(why)
    return without_folder(request, capital_in_face(text, page_face(language(request))))


def without_folder(request: Request, text: str) -> str:
    """Return a sentence without the file's folder, which guests don't need to know."""
    folder = site_of(request).path.parent
    for part in {f"{folder.absolute()}{os.sep}", f"{folder}{os.sep}"} - {f".{os.sep}", os.sep}:
        text = text.replace(part, "")
    return text


def answer_shown(request: Request, answer: Answer) -> Markup:
    """Return an answer in the reader's language, as a piece of a page.

    Its tables may be wider than a phone, so they can be scrolled, even with the keyboard.
    """
    shown = to_html(answer_in_face(brief(answer), page_face(language(request))))
    # Every text in it is escaped there.
    return Markup(shown.replace("<table>", '<table tabindex="0">'))  # noqa: S704


def _return_to(request: Request) -> str:
    """Return the page to go back to after choosing a language."""
    if request.method != "GET":
        return "/"
    asked = request.url.path + (f"?{request.url.query}" if request.url.query else "")
    return asked if len(asked) <= LONGEST else request.url.path


def _number(value: float, places: int = 0) -> Figure:
    return Figure(value, f".{places}f")


def _rating(value: float) -> Figure:
    return Figure(round(value, 1), "g")


def as_file(content: bytes, name: str, how: str = "attachment") -> Response:
    """Return a file, to be saved ("attachment") or displayed ("inline")."""
    head = {"content-disposition": f'{how}; filename="{name}"'}
    return Response(content, media_type=_TYPES[name.rpartition(".")[2]], headers=head)


def done(request: Request, to: str, *said: str) -> Response:
    """Redirect to a page after accepting a form, and say there what happened."""
    kept: list[str] = []
    for line in (in_words(request, one) for one in said):
        if len(json.dumps([*kept, line])) <= _MOST_SAID:
            kept.append(line)
    if kept:
        request.session[_SAID] = kept
    return RedirectResponse(to, status_code=303)


def page_face(language: str) -> Face:
    """Return how the pages phrase a sentence in a language.

    >>> from evenbreak.words import Parameter
    >>> say("{field} is blank", field=Parameter("tables")).said(page_face("en"))
    'the number of tables is blank'
    """
    plain = face_in(language)

    def parameter(name: str) -> str:
        return str(in_face(FIELDS.get(name, name), plain))

    def command(name: str, _: Sequence[str]) -> str:
        return say("“{form}”", form=FORMS.get(name, name)).said(plain)

    return replace(
        plain, parameter=parameter, command=command, file=lambda path: PurePath(path).name
    )


def _whole(text: str) -> Markup:
    """Return text in which scores such as 5-1 aren't broken across lines."""
    shown = re.sub(r"\d+[-:]\d+", r"<b class=whole>\g<0></b>", str(escape(text)))
    return Markup(f"<span>{shown}</span>")  # noqa: S704
