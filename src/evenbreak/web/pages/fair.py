"""The fairest race for two players: by their names tonight, or by two ratings."""

from __future__ import annotations

import asyncio
from typing import Any, NamedTuple

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.errors import InputError
from evenbreak.games.rack import Rack
from evenbreak.handicaps.charts.fair import FairRace, fair_races
from evenbreak.handicaps.charts.gap import Gap
from evenbreak.ratings.scale import NAMES, SCALES, Scale, scale_of, unstated_scale
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.format import LONGEST_RACE
from evenbreak.tournaments.evening.moves import known_player
from evenbreak.web.forms import CHOOSE_IT, Form
from evenbreak.web.league import League
from evenbreak.web.page import page, site_of
from evenbreak.web.refusals import RefusalError

LENGTHS = (3, 4, 5, 7, 9, 11, 13, 15, 21)


class Side(NamedTuple):
    """One of the two players."""

    name: str
    rating: float
    error: float


async def fair(request: Request) -> Response:
    """Show the form and, once both players are named, the fairest race."""
    asked = {name: request.query_params.get(name, "").strip()[:80] for name in ("a", "b")}
    night = site_of(request).night
    state = await asyncio.to_thread(night.state) if night.exists else None
    league = site_of(request).league
    in_league = league.sheet.ratings.players if league.sheet else ()
    stated = _scale(request, state, league)
    # As long as tonight's: everybody may ask, and a race to 1,000 takes seconds to work out.
    length = Form(request.query_params).whole("race", 1, LONGEST_RACE, default=7)
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
        sides = tuple(_side(asked[name], state, league) for name in ("a", "b"))
        scale = stated or unstated_scale(
            [one.rating for one in sides], [one.name for one in sides], CHOOSE_IT
        )
        shown |= {"sides": sides, "races": await asyncio.to_thread(_races, sides, scale, length)}
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


def _side(text: str, state: Evening | None, league: League) -> Side:
    """Return a side by its rating, or by a name: of tonight's players first, then the league's."""
    try:
        return Side(text, float(text.replace(",", ".")), 0.0)
    except ValueError:
        pass
    known = league.known(text)
    tonight = state is not None and any(one.casefold() == text.casefold() for one in state.entrants)
    if known is not None and not tonight:
        return Side(*known)
    if state is None:
        raise RefusalError("{value!r} is not a rating. Enter a number, such as 520.", value=text)
    entrant = state.entrants[known_player(state, text)]
    return Side(entrant.name, entrant.rating, entrant.standard_error)


def _races(sides: tuple[Side, ...], scale: Scale, length: int) -> list[FairRace]:
    one, other = sides
    gap, error = one.rating - other.rating, (one.error**2 + other.error**2) ** 0.5
    if not abs(gap) < 1e6:  # neither too large nor not a number
        raise RefusalError(
            "{value!r} is not a rating. Enter a number, such as 520.", value=format(one.rating, "g")
        )
    if error:
        return Gap(gap, error, scale).nearest_races(race_to=length, top=3)
    return fair_races(Rack(float(scale.win_probability(gap))), race_to=length, top=3)


ROUTES = [Route("/fair", fair)]
