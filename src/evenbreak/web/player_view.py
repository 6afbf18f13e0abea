"""The players of an evening as the pages show them: rating, chance, what they play next."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from evenbreak.answers.tournament.time import time_of_day
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.odds.title import PlaceOdds
from evenbreak.web.night import Known


class PlayerView(NamedTuple):
    """A player as the page shows them.

    Parameters
    ----------
    name, rating, error
        the rating and how far off it may be.
    p_title
        the chance of the title; None: not known.
    place
        where they finished; '' if that is open.
    match, other
        the match that they play now or can play next, and whom they meet; '' if not known.
    table, called
        where they play, or will be called to next; None: they do not, or will not.
    starts
        when their next match begins: early, in the middle and late, such as 20:40; None: no match.
    """

    name: str
    rating: float
    error: float
    p_title: float | None
    place: str
    match: str
    other: str
    table: int | None
    called: int | None
    starts: tuple[str, ...] | None


def player_views(state: Evening, known: Known | None) -> list[PlayerView]:
    """Return the players, the highest rating first.

    Parameters
    ----------
    state
        the state of the evening.
    known
        what has been worked out, perhaps for an earlier state.
    """
    listed = (known.data.get("odds") or known.data.get("players", [])) if known else []
    titles = {one["name"]: one["p_title"] for one in listed}
    calls = {name: at for at, name in known.calls} if known and known.of is state else {}
    places = _decided(known.odds) if known and known.odds and known.of is state else {}
    playing: dict[str, str] = {}
    if state.drawn:
        playing = {name: match for match in state.standing.to_play for name in state.pair(match)}
    views = []
    for name, entrant in state.entrants.items():
        match = playing.get(name, "")
        other = next((one for one in state.pair(match) if one != name), "") if match else ""
        on_table = state.on_tables.get(match) if match else None
        starts = None
        if known and on_table is None and name in known.next_starts:
            starts = tuple(time_of_day(known.start + at) for at in known.next_starts[name])
        table = on_table.call.table if on_table else None
        title = titles.get(name)
        views.append(
            PlayerView(
                name,
                entrant.rating,
                entrant.standard_error,
                title,
                places.get(name, ""),
                match,
                other,
                table,
                calls.get(match),
                starts,
            )
        )
    return sorted(views, key=lambda one: -one.rating)


def _decided(odds: PlaceOdds) -> dict[str, str]:
    """Return the places that are decided, by player."""
    seats, places = np.nonzero(odds.p_place > 1.0 - 1e-12)
    names = odds.bracket.players
    both = zip(seats.tolist(), places.tolist(), strict=True)
    return {names[seat]: str(odds.bracket.places[place]) for seat, place in both}
