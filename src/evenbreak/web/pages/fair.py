"""The fairest race for two players: by their names tonight, or by two ratings."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.match.odds import TwoPlayers, races_for
from evenbreak.errors import InputError
from evenbreak.fields.question import declaration
from evenbreak.handicaps.charts.fair import FairRace
from evenbreak.questions.match import FairTonight
from evenbreak.ratings.scale import NAMES, SCALES, Scale, scale_of, unstated_scale
from evenbreak.tournaments.evening.events import Entrant
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.moves import known_player
from evenbreak.web.forms import CHOOSE_IT, Form, value_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.league import League
from evenbreak.web.page import page, site_of

LENGTHS = (3, 4, 5, 7, 9, 11, 13, 15, 21)


async def fair(request: Request) -> Response:
    """Show the form and, once both players are named, the fairest race."""
    asked = {name: request.query_params.get(name, "").strip()[:80] for name in ("a", "b")}
    night = site_of(request).night
    state = await asyncio.to_thread(night.state) if night.exists else None
    league = site_of(request).league
    in_league = league.sheet.ratings.players if league.sheet else ()
    stated = _scale(request, state, league)
    race_to = declaration(FairTonight, "race_to")
    length: int = value_of(race_to, Form(request.query_params), "race")
    shown: dict[str, Any] = {
        "asked": asked,
        "length": length,
        "lengths": LENGTHS,
        "scale": stated.text if stated else "",
        "scales": NAMES,
        "names": list(dict.fromkeys([*(state.entrants if state else ()), *in_league])),
        "races": [],
        "sides": None,
    }
    if asked["a"] and asked["b"]:
        sides = [_side(asked[name], state, league) for name in ("a", "b")]
        shown |= {"sides": sides, "races": await asyncio.to_thread(_races, sides, stated, length)}
    return page(request, "fair.html", **shown)


def _scale(request: Request, state: Evening | None, league: League) -> Scale | None:
    given = request.query_params.get("scale", "")
    if given:
        try:
            return scale_of(given)
        except InputError:
            raise RefusalError(
                "There is no rating scale called {value!r}; choose one of {allowed}.",
                value=given[:20],
                allowed=", ".join(SCALES),
            ) from None
    if state:
        return state.scale
    return league.sheet.ratings.scale if league.sheet else None


def _side(text: str, state: Evening | None, league: League) -> Entrant:
    """Return a side by its rating, or by a name: of tonight's players first, then the league's."""
    try:
        return Entrant(text, float(text.replace(",", ".")), 0.0)
    except ValueError:
        pass
    known = league.known(text)
    tonight = state is not None and any(one.casefold() == text.casefold() for one in state.entrants)
    if known is not None and not tonight:
        return Entrant(*known)
    if state is None:
        raise RefusalError("{value!r} is not a rating. Enter a number, such as 520.", value=text)
    return state.entrants[known_player(state, text)]


def _races(sides: Sequence[Entrant], stated: Scale | None, length: int) -> list[FairRace]:
    a, b = sides
    if not abs(a.rating - b.rating) < 1e6:  # neither too large nor not a number
        raise RefusalError(
            "{value!r} is not a rating. Enter a number, such as 520.", value=format(a.rating, "g")
        )
    ratings, names = (a.rating, b.rating), (a.name, b.name)
    scale = stated or unstated_scale(ratings, names, CHOOSE_IT)
    asked = FairTonight(ratings=(str(a.rating), str(b.rating)), scale=scale, race_to=length)
    errors = (a.standard_error, b.standard_error)
    return races_for(TwoPlayers.rated(*ratings, scale, names, errors), asked)


ROUTES = [Route("/fair", fair)]
