"""The league: its ratings, each player's matches and races, the sheet; uploading new results."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.faces.to_csv import to_csv
from evenbreak.answers.tournament.printed import tournament_matches_answer
from evenbreak.fields.question import declaration
from evenbreak.files.tables.names import KnownNames, clean_name
from evenbreak.files.tables.problems import quoted
from evenbreak.questions.common import USUAL_RACE
from evenbreak.questions.ratings import Report
from evenbreak.ratings.scale import DEFAULT_SCALE, NAMES, SCALES
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.web.forms import directors_form, list_of, value_of
from evenbreak.web.guard import MOST_BYTES, RefusalError
from evenbreak.web.league import League
from evenbreak.web.page import answer_shown, as_file, done, page, site_of
from evenbreak.web.site import Site, begun
from evenbreak.words import joined, say, tally

if TYPE_CHECKING:
    from evenbreak.answers.league.sheet import Sheet

_PATIENCE = 0.5  # seconds that a page waits for what is worked out
_RACE = declaration(Report, "race_to")
"""What a league's report also asks for."""
_MOST_LISTED = 1000
_MOST_MATCHES = 60


class Row(NamedTuple):
    """A player: place (None if the rating is provisional), name, rating and its error, games."""

    place: int | None
    name: str
    rating: float
    error: float
    games: int


class Played(NamedTuple):
    """A match from one player's side."""

    date: str
    other: str
    score: str
    won: bool


async def league(request: Request) -> Response:
    """Show the ratings, or their progress, or why they can't be calculated."""
    found = _league(request)
    if found.paths and not (found.sheet or found.problem or found.progress):
        found.begin()
    rows = await asyncio.to_thread(_rows, found.sheet) if found.sheet else []
    return page(
        request,
        "league.html",
        live=found.progress is not None,
        league=found,
        rows=rows[:_MOST_LISTED],
        scales=NAMES,
        default_scale=DEFAULT_SCALE,
        usual_race=USUAL_RACE,
        quick=found.progress is not None,
    )


async def give(request: Request) -> Response:
    """Accept the league's results, uploaded or pasted."""
    form = await directors_form(request)
    content = list_of(form, "results", "file", longest=MOST_BYTES)
    if not content.strip():
        raise RefusalError("Nothing was sent. Choose a file or paste the results.")
    found = _league(request)
    scale = form.one_of("scale", tuple(SCALES))
    race: int = USUAL_RACE if not form.text("race") else value_of(_RACE, form, "race")
    await asyncio.to_thread(found.keep, content, scale, race)
    found.begin()
    return done(request, "/league", say("Results saved; calculating ratings…"))


async def add_tonight(request: Request) -> Response:
    """Add tonight's tournament results to the league's."""
    await directors_form(request)
    site = site_of(request)
    state = await asyncio.to_thread(tournament_of, site)
    begun = datetime.fromisoformat(state.events[0].at)
    content = matches_csv(state, site.path.stem)
    await asyncio.to_thread(site.league.add_evening, content, begun)
    site.league.begin()
    return done(
        request, "/league", say("Tonight's results are in the league. Calculating its ratings…")
    )


async def results(request: Request) -> Response:
    """Return tonight's matches as a file."""
    site = site_of(request)
    state = await asyncio.to_thread(tournament_of, site)
    return as_file(matches_csv(state, site.path.stem), "results.csv")


def tournament_of(site: Site) -> Evening:
    """Return tonight's tournament, if any of it has been played."""
    state = begun(site.night).state()
    if not state.counted:
        raise RefusalError("No match has been played yet.", status=409)
    return state


def matches_csv(state: Evening, event: str) -> bytes:
    """Return the matches played, in the form read by the commands that rate them."""
    return "".join(to_csv(tournament_matches_answer(state, event))).encode()


async def player(request: Request) -> Response:
    """Show a player's rating and matches and, against another player, the fairest race and why."""
    sheet = _sheet(request)
    name, other = (request.query_params.get(key, "")[:200] for key in ("name", "other"))
    names = [name, other] if other.strip() else [name]
    pair = _places(sheet, names)
    shown: dict[str, Any] = {"working": False, "answer": "", "other": None}
    rows = await asyncio.to_thread(_rows, sheet)
    if len(pair) == 2:
        answer = await _league(request).why((pair[0], pair[1]), _why, _PATIENCE)
        shown["working"] = answer is None
        shown["other"] = sheet.ratings.players[pair[1]]
        if answer is not None:
            shown["answer"] = answer_shown(request, answer)
    return page(
        request,
        "league_player.html",
        live=shown["working"],
        quick=shown["working"],
        one=next(row for row in rows if row.name == sheet.ratings.players[pair[0]]),
        least=sheet.ratings.established_from,
        names=[row.name for row in rows[:_MOST_LISTED]],
        matches=await asyncio.to_thread(_matches, sheet, pair[0]),
        **shown,
    )


def _places(sheet: Sheet, names: list[str]) -> list[int]:
    """Return the league standings, without file names, which mean nothing to the page's readers."""
    known = KnownNames(sheet.ratings.players)
    places = {name: known.place(name) for name in map(clean_name, names)}
    missing = [quoted(name) + known.hint(name) for name, at in places.items() if at is None]
    if missing:
        raise RefusalError("Not in the league: {names}", names=joined(missing, ", "), status=400)
    return list(dict.fromkeys(place for place in places.values() if place is not None))


def _why(sheet: Sheet, pair: tuple[int, int]) -> Any:
    from evenbreak.answers.league.why import why_answer
    from evenbreak.ratings.usual import rated_alike

    again = rated_alike(sheet.ratings, sheet.file.results)
    return why_answer(sheet.file, sheet.ratings, pair, sheet.offered, again, sheet.choice)


def _rows(sheet: Sheet) -> list[Row]:
    table = sheet.rated
    columns = (table[name] for name in ("player", "rating", "standard_error", "games"))
    places = [None if few else k for k, few in enumerate(table["provisional"], 1)]
    return [Row(place, *one) for place, one in zip(places, zip(*columns, strict=True), strict=True)]


def _matches(sheet: Sheet, seat: int) -> list[Played]:
    """Return a player's matches, last first; without a score if only the winner is known."""
    from evenbreak.ratings.results import who_won

    results = sheet.file.results
    played = (results.player_a == seat) | (results.player_b == seat)
    rows = np.flatnonzero(played & results.counted)
    if results.date is not None:
        rows = rows[np.argsort(results.date[rows], kind="stable")]
    winner, found = who_won(results), []
    if results.winner is not None:
        winner = np.where(results.winner > 0, results.winner, winner)
    for row in rows[::-1][:_MOST_MATCHES].tolist():
        first = int(results.player_a[row]) == seat
        scores = int(results.score_a[row]), int(results.score_b[row])
        own, theirs = scores if first else scores[::-1]
        date = "" if results.date is None else str(results.date[row])
        other = results.players[int((results.player_b if first else results.player_a)[row])]
        score = tally((own, theirs)) if any(scores) else ""
        won = int(winner[row]) == (1 if first else 2)
        found.append(Played("" if date == "NaT" else date, other, score, won))
    return found


def _made(name: str) -> Callable[[Sheet], bytes]:
    """Return a function that makes one of the sheet's files."""
    from evenbreak import sheets
    from evenbreak.files.csv_writer import to_csv as frame_csv

    makers: dict[str, Callable[[Sheet], bytes]] = {
        "ratings.csv": lambda sheet: frame_csv(sheet.rated),
        "matchups.csv": lambda sheet: frame_csv(sheet.paired),
        "sheet.pdf": lambda sheet: sheets.sheet_pdf(sheet, sheets.usual_paper()),
        "sheet.html": sheets.sheet_html,
        "sheet.xlsx": lambda sheet: sheets.workbook_bytes(sheets.report_tables(sheet)),
    }
    return makers[name]


async def download(request: Request, name: str) -> Response:
    """Return the sheet, or its tables, as a file."""
    sheet = _sheet(request)
    content = await site_of(request).made.file(name, sheet, partial(_made(name), sheet))
    return as_file(content, name)


def _league(request: Request) -> League:
    return site_of(request).league


def _sheet(request: Request) -> Sheet:
    found = _league(request).sheet
    if found is None:
        raise RefusalError("There are no league ratings yet.", status=404)
    return found


FILES = ("ratings.csv", "matchups.csv", "sheet.pdf", "sheet.html", "sheet.xlsx")

ROUTES = [
    Route("/league", league, methods=["GET"]),
    Route("/league", give, methods=["POST"]),
    Route("/league/tonight", add_tonight, methods=["POST"]),
    Route("/results.csv", results),
    Route("/league/player", player),
    *(Route(f"/league/{name}", partial(download, name=name)) for name in FILES),
]
