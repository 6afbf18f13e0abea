"""The fairest race for two players, given tonight's names, two ratings, or two skill levels."""

from __future__ import annotations

import asyncio
from collections.abc import Sequence
from typing import Any

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Route

from evenbreak.answers.match.odds import TwoPlayers, races_for
from evenbreak.answers.match.points import points_answer
from evenbreak.errors import InputError
from evenbreak.fields.question import declaration
from evenbreak.games.race import Race
from evenbreak.handicaps.charts.fair import FairRace
from evenbreak.handicaps.charts.level_chart import (
    LEVEL_CHARTS,
    POINTS_CHARTS,
    level_chart,
    points_chart,
)
from evenbreak.handicaps.charts.level_skills import level_skills
from evenbreak.questions.match import FairTonight
from evenbreak.ratings.scale import NAMES, SCALES, Scale, scale_of, unstated_scale
from evenbreak.tournaments.evening.events import Entrant
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.moves import known_player
from evenbreak.web.forms import CHOOSE_IT, Form, value_of
from evenbreak.web.guard import RefusalError
from evenbreak.web.league import League
from evenbreak.web.page import page, site_of
from evenbreak.words import say

CHARTS_OF_LEVELS = {**LEVEL_CHARTS, **POINTS_CHARTS}
LENGTHS = (3, 4, 5, 7, 9, 11, 13, 15, 21)


async def fair(request: Request) -> Response:
    """Show the form and, once both players are given, the fairest race."""
    asked = {name: request.query_params.get(name, "").strip()[:80] for name in ("a", "b")}
    night = site_of(request).night
    state = await asyncio.to_thread(night.state) if night.exists else None
    league = site_of(request).league
    in_league = league.sheet.ratings.players if league.sheet else ()
    chart = request.query_params.get("scale", "")
    by_level = chart in CHARTS_OF_LEVELS
    stated = None if by_level else _scale(request, state, league)
    race_to = declaration(FairTonight, "race_to")
    length: int = value_of(race_to, Form(request.query_params), "race")
    shown: dict[str, Any] = {
        "asked": asked,
        "length": length,
        "lengths": LENGTHS,
        "scale": chart if by_level else stated.text if stated else "",
        "scales": NAMES,
        "charts": CHARTS_OF_LEVELS,
        "needs": None,
        "odds": None,
        "texts": [],
        "names": list(dict.fromkeys([*(state.entrants if state else ()), *in_league])),
        "races": [],
        "sides": None,
    }
    if asked["a"] and asked["b"] and by_level:
        shown |= await asyncio.to_thread(_by_level, chart, asked, length)
    elif asked["a"] and asked["b"]:
        sides = [_side(asked[name], state, league) for name in ("a", "b")]
        shown |= {"sides": sides, "races": await asyncio.to_thread(_races, sides, stated, length)}
    return page(request, "fair.html", **shown)


def _by_level(chart: str, typed: dict[str, str], length: int) -> dict[str, Any]:
    """Return a chart's race for two skill levels, and the fairest races."""
    a, b = (_level(typed[name], chart) for name in ("a", "b"))
    names = say("Level {level}", level=a), say("Level {level}", level=b)
    sides = [Entrant(name, 0.0, 0.0) for name in names]
    if chart in POINTS_CHARTS:
        answer = points_answer(points_chart(chart), (a, b), names)
        return {"sides": sides, "needs": points_chart(chart).race(a, b), "texts": answer.sentences}
    skills = level_skills(chart)
    players = TwoPlayers.of_levels((a, b), skills, names)
    asked = FairTonight(ratings=(str(a), str(b)), chart=chart, race_to=length)
    needs = level_chart(chart).race(a, b)
    odds = players.gap.odds(Race(*needs, players.rack))
    return {
        "sides": sides,
        "needs": needs,
        "odds": odds,
        "races": races_for(players, asked),
        "texts": [skills.why],
    }


def _level(text: str, chart: str) -> int:
    levels = (points_chart(chart) if chart in POINTS_CHARTS else level_chart(chart)).levels
    if text not in map(str, levels):
        raise RefusalError(
            "{value!r} isn't a skill level of {chart}. Enter one of {levels}.",
            value=text[:20],
            chart=CHARTS_OF_LEVELS[chart],
            levels=", ".join(map(str, levels)),
        )
    return int(text)


def _scale(request: Request, state: Evening | None, league: League) -> Scale | None:
    given = request.query_params.get("scale", "")
    if given:
        try:
            return scale_of(given)
        except InputError:
            raise RefusalError(
                "There is no rating scale called {value!r}. Choose one of {allowed}.",
                value=given[:20],
                allowed=", ".join(SCALES),
            ) from None
    if state:
        return state.scale
    return league.sheet.ratings.scale if league.sheet else None


def _side(text: str, state: Evening | None, league: League) -> Entrant:
    """Return a side from its rating or its name: tonight's players first, then the league's."""
    try:
        return Entrant(text, float(text.replace(",", ".")), 0.0)
    except ValueError:
        pass
    known = league.known(text)
    tonight = state is not None and any(one.casefold() == text.casefold() for one in state.entrants)
    if known is not None and not tonight:
        return Entrant(*known)
    if state is None:
        raise RefusalError("{value!r} isn't a rating. Enter a number, such as 520.", value=text)
    return state.entrants[known_player(state, text)]


def _races(sides: Sequence[Entrant], stated: Scale | None, length: int) -> list[FairRace]:
    a, b = sides
    if not abs(a.rating - b.rating) < 1e6:  # neither too large nor not a number
        raise RefusalError(
            "{value!r} isn't a rating. Enter a number, such as 520.", value=format(a.rating, "g")
        )
    ratings, names = (a.rating, b.rating), (a.name, b.name)
    scale = stated or unstated_scale(ratings, names, CHOOSE_IT)
    asked = FairTonight(ratings=(str(a.rating), str(b.rating)), scale=scale, race_to=length)
    errors = (a.standard_error, b.standard_error)
    return races_for(TwoPlayers.rated(*ratings, scale, names, errors), asked)


ROUTES = [Route("/fair", fair)]
