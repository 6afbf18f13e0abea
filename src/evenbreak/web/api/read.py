"""What everyone may read about tonight, for other programs.

It is based on the same views as the pages, so that a stream's scoreboard and the wall show the same
thing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import MISSING
from typing import Any

import numpy as np

from evenbreak.answers.tournament.bracket_view import title_of
from evenbreak.answers.tournament.night import played_words
from evenbreak.errors import InputError
from evenbreak.fields.kinds import Text
from evenbreak.fields.question import Declared, Field
from evenbreak.teams.evening.fold import EVERYBODY
from evenbreak.tournaments.evening.calling import night_queue, proposed_calls
from evenbreak.tournaments.evening.events import Called
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.known import known_player
from evenbreak.tournaments.evening.listed import group_rows, swiss_ranks
from evenbreak.tournaments.money.payouts import with_prizes
from evenbreak.tournaments.odds.races import games_needed
from evenbreak.web.api import shapes
from evenbreak.web.api.problem import ProblemError
from evenbreak.web.api.resource import EVENT, Call, Resource
from evenbreak.web.api.seen import PLACES, Seen, match_of, times_of, told
from evenbreak.web.evening_view import (
    favorites_of,
    player_views,
)
from evenbreak.web.night import win_chance
from evenbreak.web.team_view import set_views
from evenbreak.words import say


def _event(seen: Seen) -> shapes.Event:
    return shapes.Event(seen.event, seen.name, seen.state.plan.form, seen.stage)


def _tonight(_: Call, seen: Seen, nights: Sequence[Seen]) -> shapes.Tonight:
    plan, view = seen.state.plan, seen.view
    return shapes.Tonight(
        seen.event,
        seen.name,
        plan.form,
        seen.stage,
        seen.state.bracket.format if seen.state.drawn else plan.form,
        played_words(seen.state),
        plan.discipline,
        plan.scale,
        plan.date,
        seen.state.events[0].at,
        view.matches,
        view.played,
        seen.champion,
        [
            shapes.Player(one.name, one.rating, one.provisional, one.name in seen.state.arrived)
            for one in player_views(seen.state, None)
        ],
        [one for one in _matches(seen) if one.state in ("called", "playing")],
        [_event(one) for one in nights],
    )


def _bracket(_: Call, seen: Seen, __: Sequence[Seen]) -> shapes.Bracket:
    return shapes.Bracket(
        seen.event,
        seen.name,
        seen.state.plan.form,
        seen.stage,
        played_words(seen.state),
        seen.champion,
        [
            shapes.Part(
                panel.title,
                panel.linked,
                [one.title for one in panel.rounds],
                [match_of(seen, panel, box) for box in panel.boxes],
            )
            for panel in seen.panels
        ],
    )


def _matches(seen: Seen) -> list[shapes.Match]:
    found = [match_of(seen, panel, box) for panel in seen.panels for box in panel.boxes]
    return sorted(found, key=lambda one: int(one.number))


def _all_matches(_: Call, seen: Seen, __: Sequence[Seen]) -> shapes.Matches:
    return shapes.Matches(seen.event, seen.stage, _matches(seen))


def _named(nights: Sequence[Seen]) -> dict[tuple[int, str], shapes.Match]:
    """Return a night's matches by event and name."""
    return {
        (seen.event, box.match): match_of(seen, panel, box)
        for seen in nights
        for panel in seen.panels
        for box in panel.boxes
    }


def _tables(_: Call, __: Seen, nights: Sequence[Seen]) -> shapes.Tables:
    matches, proposed = _named(nights), _proposed(nights)
    on = {
        one.call.table: matches[seen.event, name]
        for seen in nights
        if seen.state.drawn
        for name, one in seen.state.on_tables.items()
    }
    then = {to.table: matches[event, to.match] for event, to in proposed}
    plan = nights[0].state.plan
    found = []
    for table in range(1, plan.tables + 1):
        match = on.get(table)
        state: Any = "free"
        if match is not None:
            state = "called" if match.state == "called" else "playing"
        found.append(
            shapes.Table(
                plan.table_name(table),
                table,
                state,
                table in plan.reserved,
                table in plan.streamed,
                match,
                then.get(table),
            )
        )
    return shapes.Tables(found)


def _proposed(nights: Sequence[Seen]) -> list[tuple[int, Called]]:
    states = _states(nights)
    return proposed_calls(states, _order(nights)) if states else []


def _states(nights: Sequence[Seen]) -> dict[int, Evening]:
    return {one.event: one.state for one in nights if one.state.drawn}


def _order(nights: Sequence[Seen]) -> Sequence[tuple[int, str]]:
    """Return the night's matches in the order that ends it soonest, as last calculated."""
    known = [one.known for one in nights if one.known and one.known.queue]
    return max(known, key=lambda one: one.at).queue if known else ()


def _queue(call: Call, seen: Seen, every: Sequence[Seen]) -> shapes.Queue:
    nights = every if call.values["event"] is None else [seen]
    plan = every[0].state.plan
    matches = _named(nights)
    to = {(event, one.match): plan.table_name(one.table) for event, one in _proposed(every)}
    queue = night_queue(_states(nights), _order(every))
    return shapes.Queue([shapes.Waiting(matches[one], to.get(one, "")) for one in queue])


def _odds(_: Call, seen: Seen, __: Sequence[Seen]) -> shapes.Odds:
    known, players = seen.known, []
    odds = known.odds if known else None
    if known and odds:
        places = [str(place) for place in odds.bracket.places]
        chances = dict(zip(odds.bracket.players, np.round(odds.p_place, PLACES), strict=True))
        rows = {row["name"]: row for row in known.data["odds"]}
        first = [one.name for one in favorites_of(known)]
        for name in [*first, *(name for name in rows if name not in first)]:
            ends = [rows[name].get(f"p_title{end}") for end in ("", "_low", "_high")]
            title, low, high = (p if p is None else round(p, PLACES) for p in ends)
            reached = zip(places, chances[name].tolist(), strict=True)
            players.append(
                shapes.PlayerOdds(
                    name,
                    title or 0.0,
                    low,
                    high,
                    [shapes.PlaceChance(place, p) for place, p in reached if p > 0.0],
                )
            )
    exact = bool(odds and odds.exact)
    older = seen.view.view.older and bool(players)
    return shapes.Odds(seen.event, bool(players), older, exact, players)


def _finish(_: Call, seen: Seen, __: Sequence[Seen]) -> shapes.Finish:
    data = seen.known.data if seen.known else {}
    at = [data[f"finish_{q}"] for q in ("p10", "p50", "p90")] if "finish_p50" in data else None
    ends = times_of(seen.known, at) if seen.stage == "under_way" else None
    older = seen.view.view.older and ends is not None
    many = seen.view.matches, seen.view.played
    return shapes.Finish(seen.event, seen.stage, ends is not None, older, ends, *many)


def _standings(call: Call, seen: Seen, _: Sequence[Seen]) -> shapes.Standings:
    night = next(one for one in call.site.nights if one.event == seen.event)
    paid = with_prizes(seen.places, seen.view.prizes, night.unit)
    return shapes.Standings(
        seen.event,
        seen.stage,
        [shapes.Placed(*one) for one in paid],
        [
            shapes.Group(_title(seen.state, side), [shapes.Rank(*row) for row in rows])
            for side, rows in group_rows(seen.state).items()
        ],
    )


def _title(state: Evening, side: str) -> str:
    if state.plan.form == "swiss":
        return say("Standings after round {n}", n=swiss_ranks(state)[0])
    return say("Chips") if state.plan.form == "chips" else title_of(side)


def _ratings(_: Call, seen: Seen, __: Sequence[Seen]) -> shapes.Ratings:
    means = seen.known.means if seen.known else {}
    rows = [
        shapes.Rating(
            one.name,
            one.rating,
            one.error,
            one.provisional,
            round(means[one.name], 1) if one.name in means else None,
        )
        for one in player_views(seen.state, seen.known)
    ]
    return shapes.Ratings(seen.event, seen.state.plan.scale, rows)


def _race(call: Call, seen: Seen, _: Sequence[Seen]) -> shapes.Race:
    state = seen.state
    pair = _player(state, call, "a"), _player(state, call, "b")
    if pair[0] == pair[1]:
        raise ProblemError("A player can't race against themselves.", parameter="b")
    needs = 1, 1
    if state.plan.form != "chips":
        one, other = (state.entrants[name].rating for name in pair)
        m, n = games_needed(np.array([one - other]), state.races.race, state.scale)
        needs = int(m[0]), int(n[0])
    means = seen.known.means if seen.known else {}
    chance = round(win_chance(state, pair, needs, (0, 0), means), PLACES)
    a, b = (
        shapes.Racer(
            name, round(means.get(name, state.entrants[name].rating), 1), n, round(p, PLACES)
        )
        for name, n, p in zip(pair, needs, (chance, 1.0 - chance), strict=True)
    )
    return shapes.Race(seen.event, a, b)


async def _team(call: Call) -> shapes.TeamNight:
    night = await call.site.teams.now()
    if night is None:
        raise ProblemError("No team night is running yet.", status=404)
    seen = night.state.seen_by(EVERYBODY)
    chances = await call.site.teams.chances(night)
    both: Any = chances and tuple(round(p, PLACES) for p in chances)
    sets = [shapes.TeamSet(one.number, one.names, one.needs, one.score) for one in set_views(seen)]
    return shapes.TeamNight(seen.teams, sets, both, seen.over)


def _player(state: Evening, call: Call, name: str) -> str:
    try:
        return known_player(state, call.values[name])
    except InputError as error:
        raise ProblemError(error.sentence, status=404, parameter=name) from None


def _asks(name: str, what: str) -> Declared:
    return Declared(name, Field(Text(), what), MISSING)


RESOURCES = [
    Resource(
        "/tonight",
        "The tournament: who plays, and what is under way.",
        told(_tonight),
        shapes.Tonight,
        asks=(EVENT,),
    ),
    Resource(
        "/tonight/bracket",
        "The bracket, with everything needed to draw it.",
        told(_bracket),
        shapes.Bracket,
        asks=(EVENT,),
    ),
    Resource(
        "/tonight/matches",
        "All matches, by number.",
        told(_all_matches),
        shapes.Matches,
        asks=(EVENT,),
    ),
    Resource(
        "/tonight/tables", "What is on each of the house's tables.", told(_tables), shapes.Tables
    ),
    Resource(
        "/tonight/queue",
        "The matches that can be called now, starting with the next one.",
        told(_queue),
        shapes.Queue,
        asks=(EVENT,),
    ),
    Resource(
        "/tonight/odds",
        "Each player's chance of finishing in each place.",
        told(_odds),
        shapes.Odds,
        asks=(EVENT,),
    ),
    Resource(
        "/tonight/finish", "The expected finish time.", told(_finish), shapes.Finish, asks=(EVENT,)
    ),
    Resource(
        "/tonight/standings",
        "Who has finished where, and the standings in each group.",
        told(_standings),
        shapes.Standings,
        asks=(EVENT,),
    ),
    Resource(
        "/tonight/ratings",
        "The ratings, and how tonight's games have moved them.",
        told(_ratings),
        shapes.Ratings,
        asks=(EVENT,),
    ),
    Resource(
        "/tonight/race",
        "Two players' race, and each one's chance of winning it.",
        told(_race),
        shapes.Race,
        asks=(
            _asks("a", "One of tonight's players; the beginning of the name is enough."),
            _asks("b", "The other player."),
            EVENT,
        ),
    ),
    Resource("/tonight/team", "Tonight's team night.", _team, shapes.TeamNight),
]
