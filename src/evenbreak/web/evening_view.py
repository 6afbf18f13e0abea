"""An evening as the pages show it, in plain values: tables, calls, matches, odds, players."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta
from typing import Any, NamedTuple

from evenbreak.answers.tournament.time import time_of_day
from evenbreak.answers.tournament.tournament import races_words, short_place
from evenbreak.tournaments.brackets.bracket import Place
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.tournaments.evening.listed import decided_places
from evenbreak.web.night import Known, score_of

_WALKING = timedelta(minutes=5)  # since the call, that a match without a score counts as called


@dataclass(frozen=True)
class MatchView:
    """A match that can be played or is in play; `table` is None if none is free."""

    name: str
    players: tuple[str, str]
    needs: tuple[int, int]
    score: tuple[int, int] | None
    table: int | None
    since: str = ""


@dataclass(frozen=True)
class EveningView:
    """An evening as the pages show it.

    `calls` can be called now, and `waiting` matches are waiting for a table or a player; `finish`
    is early, middle and late, such as 22:15. `older`: the odds and finish time are from before the
    last entry.
    """

    state: Evening
    races: str
    playing: list[MatchView]
    calls: list[MatchView]
    waiting: list[MatchView]
    free: list[int]
    finish: tuple[str, str, str] | None
    places: list[tuple[str, str]]
    older: bool
    chips: Sequence[Mapping[str, Any]] = ()

    @property
    def provisional(self) -> Collection[str]:
        """The players whose ratings are marked as provisional."""
        return provisional_in(self.state)

    @property
    def over(self) -> bool:
        """Whether everything has been played."""
        return self.state.drawn and not self.state.standing.to_play and not can_draw(self.state)


def provisional_in(state: Evening) -> Collection[str]:
    """Return whose ratings are provisional; no one's if all are, as when no one has a rating."""
    few = {name for name, entrant in state.entrants.items() if entrant.provisional}
    return few if len(few) < len(state.entrants) else ()


def view_of(state: Evening, known: Known | None) -> EveningView:
    """Return an evening as the pages show it; `known` may be for an earlier state."""
    if not state.drawn:
        return EveningView(state, _races(state), [], [], [], [], None, [], False)
    data: dict[str, Any] = known.data if known else {}
    older = known is None or known.of is not state
    called = {name: table for table, name in known.calls} if known and not older else {}
    playing: list[MatchView] = []
    calls: list[MatchView] = []
    waiting: list[MatchView] = []
    for name in state.standing.to_play:
        one = match_view(state, name, called.get(name))
        (playing if one.since else calls if one.table else waiting).append(one)
    finish = None
    if known and "finish_p50" in data:
        early, middle, late = (
            time_of_day(known.start + data[key])
            for key in ("finish_p10", "finish_p50", "finish_p90")
        )
        finish = early, middle, late
    places = [(one["place"], one["name"]) for one in data.get("places", [])]
    return EveningView(
        state,
        _races(state),
        sorted(playing, key=lambda one: one.table or 0),
        sorted(calls, key=lambda one: one.table or 0),
        waiting,
        state.free_tables,
        finish,
        places,
        older,
        [
            one
            for one in data.get("players", [])
            if one["chips"] and one["name"] not in state.dropped
        ],
    )


def _races(state: Evening) -> str:
    return "" if state.plan.form == "chips" else races_words(state.races)


def match_view(state: Evening, name: str, table: int | None = None) -> MatchView:
    """Return a match that can be played now, on its table or the table to call it to."""
    pair, since = state.pair(name), ""
    if name in state.on_tables:
        table = state.on_tables[name].call.table
        since = f"{datetime.fromisoformat(state.on_tables[name].at):%H:%M}"
    return MatchView(name, pair, state.needed(name, pair), score_of(state, name), table, since)


def is_hill(needs: tuple[int, int], won: tuple[int, int]) -> bool:
    """Return whether both players need one more game of several.

    >>> is_hill((5, 4), (4, 3)), is_hill((1, 1), (0, 0))
    (True, False)
    """
    return max(needs) > 1 and all(n - games == 1 for n, games in zip(needs, won, strict=True))


def progress_of(state: Evening, name: str, now: str) -> str:
    """Return how far along a match on a table is: called, playing or hill."""
    won = score_of(state, name) or (0, 0)
    if is_hill(state.needed(name, state.pair(name)), won):
        return "hill"
    since = datetime.fromisoformat(now) - datetime.fromisoformat(state.on_tables[name].at)
    return "playing" if any(won) or since >= _WALKING else "called"


class Favorite(NamedTuple):
    """A player's title odds; for a player without a rating, the range they may be in."""

    name: str
    p: float
    band: tuple[float, float] | None


class PlayerView(NamedTuple):
    """A player as the page shows them; '' and None where something is unknown or over.

    `match` and `other` are their current or next match, and the opponent; `starts` is when: early,
    middle and late, such as 20:40.
    """

    name: str
    rating: float
    error: float
    provisional: bool
    title: Favorite | None
    place: str
    match: str
    other: str
    table: int | None
    called: int | None
    starts: tuple[str, ...] | None


def player_views(state: Evening, known: Known | None) -> list[PlayerView]:
    """Return the players by rating, highest first, provisional ratings last."""
    titles = {one.name: one for one in favorites_of(known)}
    calls = {name: at for at, name in known.calls} if known and known.of is state else {}
    places: Mapping[str, Place] = {}
    playing: dict[str, str] = {}
    if state.drawn:
        places = decided_places(state)
        playing = {name: match for match in state.standing.to_play for name in state.pair(match)}
    views, provisional = [], provisional_in(state)
    for name, entrant in state.entrants.items():
        match = playing.get(name, "")
        other = next((one for one in state.pair(match) if one != name), "") if match else ""
        on_table = state.on_tables.get(match) if match else None
        starts = None
        if known and on_table is None and name in known.next_starts:
            starts = tuple(time_of_day(known.start + at) for at in known.next_starts[name])
        table = on_table.call.table if on_table else None
        views.append(
            PlayerView(
                name,
                entrant.rating,
                entrant.standard_error,
                name in provisional,
                titles.get(name),
                short_place(places[name]) if name in places else "",
                match,
                other,
                table,
                calls.get(match),
                starts,
            )
        )
    return sorted(views, key=lambda one: (one.provisional, -one.rating))


def favorites_of(known: Known | None) -> list[Favorite]:
    """Return who will win; a player without a rating is placed by the low end of their range."""
    rows = known.data.get("odds", []) if known else []
    found = []
    for row in rows:
        band = (row["p_title_low"], row["p_title_high"]) if "p_title_low" in row else None
        if row["p_title"] > 0.0:
            found.append(Favorite(row["name"], row["p_title"], band))
    return sorted(found, key=lambda one: (-(one.band[0] if one.band else one.p), -one.p))
