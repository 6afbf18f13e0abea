"""An evening's matches, players and standings as rows, stored next to its log.

Names and games come from the fold, so a row is right after any entry: an undo, a correction, a
rename. Nothing in a row depends on when it is read.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from evenbreak.tournaments.brackets.bracket import Group, Place, Source
from evenbreak.tournaments.brackets.standing import NOBODY, Standing, ranked
from evenbreak.tournaments.brackets.swiss import SwissRank, swiss_standings
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import stage_to_draw
from evenbreak.tournaments.evening.matches import played_matches
from evenbreak.tournaments.evening.plan import pairings, swiss_of
from evenbreak.tournaments.money.payouts import shared_prize
from evenbreak.tournaments.odds.races import games_needed


class MatchRow(NamedTuple):
    """A match in the bracket, or one on hold because its players no longer belong in it.

    `match` is its number on every screen, None if it isn't in the bracket now; `code`, such as
    W1.2, is its name in the log. Scores include a match in play, and are None for a forfeit. The
    state is waiting (for a player), ready, playing, over, forfeit, not needed, or on hold. `ended`
    is when its result first came in.
    """

    match: int | None
    code: str
    side: str | None
    round: int | None
    player_a: str | None
    player_b: str | None
    race_a: int | None
    race_b: int | None
    score_a: int | None
    score_b: int | None
    state: str
    winner: str | None
    table_name: str | None
    called: str | None
    ended: str | None


class PlayerRow(NamedTuple):
    """A player who has entered; the seed is None before the draw."""

    name: str
    seed: int | None
    rating: float
    standard_error: float
    arrived: bool
    paid: bool
    dropped: bool
    unrated: bool


class StandingRow(NamedTuple):
    """How far a player has come.

    Places are None until decided; players who share places have the first and the last of them. The
    side is the event, such as consolation, or None for the main one. Matches include forfeits, and
    a bye in a Swiss counts as won. `buchholz` is the number of wins by a player's opponents in a
    Swiss.
    """

    place: int | None
    place_to: int | None
    side: str | None
    name: str
    won: int
    lost: int
    games_won: int
    games_lost: int
    buchholz: int | None
    chips: int | None
    prize: float | None


class RankRow(NamedTuple):
    """A player's rank, from 1, in a group, a Swiss or a chip tournament; tied players share it.

    Matches are those in the group, or in a Swiss's finished rounds, where a bye counts as won.
    """

    rank: int
    name: str
    won: int
    lost: int
    buchholz: int | None = None
    chips: int | None = None


def match_rows(state: Evening) -> list[MatchRow]:
    """Return the matches in bracket order, then those on hold.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.events import Result
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> begun = Opened(Plan("single", 5), (Entrant("Ann", 80.0), Entrant("Bo", 70.0)))
    >>> happened = begun, Drawn(("Ann", "Bo"), (0, 1)), Result("F", ("Ann", "Bo"), (5, 3), "Ann")
    >>> (row,) = match_rows(evening([Event("2025-03-01T19:30:00", what) for what in happened]))
    >>> row.match, row.player_a, row.score_a, row.score_b, row.state, row.ended
    (1, 'Ann', 5, 3, 'over', '2025-03-01T19:30:00')
    """
    if not state.drawn:
        return []
    races = _races(state)
    found = []
    for match in state.bracket.matches:
        name, seats = match.name, state.standing.seats[match.name]
        pair = _named(state, seats)
        result, live = state.counted.get(name), state.live.get(name)
        score: tuple[int, int] | None = None
        state_now = "waiting" if None in seats else "ready"
        if NOBODY in seats:
            state_now = "not needed"
        elif result is not None:
            state_now = "forfeit" if result.forfeit else "over"
            if not result.forfeit:
                score = result.score if pair == result.players else result.score[::-1]
        elif live is not None:
            state_now, score = "playing", live.of(pair)
        elif name in state.on_tables:
            state_now = "playing"
        table, called = _call(state, name, pair, over=result is not None)
        found.append(
            MatchRow(
                state.number_of(name) or None,
                name,
                match.side,
                match.round,
                *pair,
                *_both(races.get(name)),
                *_both(score),
                state_now,
                result.winner if result else None,
                table,
                called,
                _ended(state, name, pair) if result else None,
            )
        )
    return [*found, *_on_hold(state)]


_NONE = (None, None)


def _both(games: tuple[int, int] | None) -> tuple[int | None, int | None]:
    return games or _NONE


def _named(state: Evening, seats: tuple[int | None, int | None]) -> tuple[str | None, str | None]:
    one, other = (state.order[k] if k is not None and k != NOBODY else None for k in seats)
    return one, other


def _call(
    state: Evening, match: str, pair: tuple[str | None, ...], *, over: bool
) -> tuple[str | None, str | None]:
    """Return the table that a match is or was on, and when it was called there."""
    if state.plan.form == "chips":
        rack = state.chip_night.racks[match]
        return state.plan.table_name(rack.table), rack.since
    played = match, frozenset(filter(None, pair))
    on = state.calls.get(played) if over else state.on_tables.get(match)
    return (state.plan.table_name(on.call.table), on.at) if on else _NONE


def _ended(state: Evening, match: str, pair: tuple[str | None, ...]) -> str | None:
    """Return when a match's first result came in, ignoring later corrections."""
    played = state.records.get(match, ())
    return next((one.at for one in played if {*one.result.players} == {*pair}), None)


def _races(state: Evening) -> dict[str, tuple[int, int]]:
    """Return the games each player needs, for all matches whose two players are known."""
    found, to_find = dict[str, tuple[int, int]](), dict[int, list[tuple[str, float]]]()
    races = state.races
    for match in state.bracket.matches:
        if {None, NOBODY} & {*state.standing.seats[match.name]}:
            continue
        pair = state.pair(match.name)
        if state.plan.form == "chips" or match.name in state.records:
            found[match.name] = state.needed(match.name, pair)
        else:
            one, other = (state.entrants[name].rating for name in pair)
            to_find.setdefault(id(races.of(match)), []).append((match.name, one - other))
    for these in to_find.values():
        names, differences = zip(*these, strict=True)
        race = races.of(state.bracket.match(names[0]))
        m, n = games_needed(np.array(differences), race, state.scale)
        found |= dict(zip(names, zip(m.tolist(), n.tolist(), strict=True), strict=True))
    return found


def _on_hold(state: Evening) -> Iterator[MatchRow]:
    """Yield the results that don't count, because other players are in the match now."""
    for result, at in played_matches(state.records):
        counted = state.counted.get(result.match)
        if counted is not None and {*counted.players} == {*result.players}:
            continue
        match = state.bracket.by_name.get(result.match)
        race = state.needed(result.match, result.players) if match else result.race
        yield MatchRow(
            state.number_of(result.match) or None,
            result.match,
            match.side if match else None,
            match.round if match else None,
            *result.players,
            *_both(race),
            *_both(None if result.forfeit else result.score),
            "on hold",
            result.winner,
            None,
            None,
            at,
        )


def player_rows(state: Evening) -> list[PlayerRow]:
    """Return the players in the order they entered."""
    seeds = {name: seed for seed, name in enumerate(state.order, 1)}
    return [
        PlayerRow(
            name,
            seeds.get(name),
            one.rating,
            one.standard_error,
            name in state.arrived,
            name in state.paid,
            name in state.dropped,
            name in state.unrated,
        )
        for name, one in state.entrants.items()
    ]


def standing_rows(
    state: Evening, prizes: Sequence[float] | None = None, unit: float = 0.0
) -> list[StandingRow]:
    """Return how far each player has come, in seed order; `prizes` are for the places."""
    if not state.drawn:
        return []
    places = decided_places(state)
    (won, lost), games = _record(state, state.counted), Counter[tuple[str, str]]()
    for result in state.counted.values():
        if not result.forfeit:
            one, other = result.players
            games.update({(one, "won"): result.games[one], (one, "lost"): result.games[other]})
            games.update({(other, "won"): result.games[other], (other, "lost"): result.games[one]})
    if state.plan.form == "swiss":
        byes = [p.first for pairs in pairings(state.later) for p in pairs if p.second is None]
        won.update(byes)
    swiss = {row.player: row.buchholz for row in swiss_ranks(state)[1]}
    chips = state.chip_night.chips if state.plan.form == "chips" else {}
    found = []
    for name in state.order:
        place = places.get(name)
        prize = None
        if place and prizes is not None:
            prize = 0.0 if place.event else shared_prize(prizes, place.first, place.last, unit)
        found.append(
            StandingRow(
                place and place.first,
                place and place.last,
                (place and place.event) or None,
                name,
                won[name],
                lost[name],
                games[name, "won"],
                games[name, "lost"],
                swiss.get(name, 0 if state.plan.form == "swiss" else None),
                chips.get(name),
                prize,
            )
        )
    return found


def group_rows(state: Evening) -> dict[str, list[RankRow]]:
    """Return each group's standings, best player first, by the bracket's name for it.

    In a Swiss or a chip tournament, all players are one group, ''.
    """
    if not state.drawn:
        return {}
    if state.plan.form == "swiss":
        ranks = swiss_ranks(state)[1]
        places = _shared([(one.player, one[1:3]) for one in ranks])
        return {"": [RankRow(places[one.player].first, one.player, one.score, one.lost,
                             one.buchholz) for one in ranks]}  # fmt: skip
    if state.plan.form == "chips":
        night, (won, lost) = state.chip_night, _record(state, state.counted)
        still = sorted(night.order, key=lambda name: -night.chips[name])
        level: list[tuple[str, object]] = [(name, night.chips[name]) for name in still]
        level += [(name, name) for name in reversed(night.gone)]
        return {"": [RankRow(place.first, name, won[name], lost[name], None, night.chips[name])
                     for name, place in _shared(level).items()]}  # fmt: skip
    return {
        state.bracket.match(group.matches[0]).side: _ranks(state, group)
        for group in state.bracket.groups
        if group.matches
    }


def _ranks(state: Evening, group: Group) -> list[RankRow]:
    """Return a group's standings, with ties broken if they have been."""
    won, lost = _record(state, group.matches)
    over = [
        (pair, state.order.index(state.counted[name].winner))
        for name, pair in zip(group.matches, group.pairs, strict=True)
        if name in state.counted
    ]
    ahead = ranked(group.members, [pair for pair, _ in over], [winner for _, winner in over])
    rank = {state.order[k]: first + 1 for k, first in zip(group.members, ahead, strict=True)}
    last = state.results.get(group.name)
    if isinstance(last, tuple):
        rank = {name: k for k, name in enumerate(last, 1)}
    rows = [RankRow(rank[name], name, won[name], lost[name]) for name in rank]
    return sorted(rows, key=lambda one: one.rank)


def _record(state: Evening, matches: Iterable[str]) -> tuple[Counter[str], Counter[str]]:
    """Return how many of some matches each player has won and lost."""
    results = [state.counted[name] for name in matches if name in state.counted]
    return Counter(one.winner for one in results), Counter(one.loser for one in results)


def swiss_ranks(state: Evening) -> tuple[int, list[SwissRank]]:
    """Return how many rounds of a Swiss are over, and the standings after them."""
    if state.plan.form != "swiss":
        return 0, []
    over = [
        pairs
        for pairs in pairings(state.later, state.counted)
        if all(p.winner or p.second is None for p in pairs)
    ]
    ranks = swiss_standings(swiss_of(state.plan, state.order), over) if over else []
    return len(over), ranks


def decided_places(state: Evening) -> dict[str, Place]:
    """Return the places decided, by player; players tied at the end share places.

    >>> from evenbreak.tournaments.evening.events import Drawn, Entrant, Event, Opened, Plan
    >>> from evenbreak.tournaments.evening.events import Result
    >>> from evenbreak.tournaments.evening.fold import evening
    >>> players = tuple(Entrant(name, 80.0) for name in ("Ann", "Bo", "Cy"))
    >>> happened = [Opened(Plan("single", 5), players), Drawn(("Ann", "Bo", "Cy"), (0, None, 1, 2))]
    >>> happened += [Result("W1.2", ("Bo", "Cy"), (5, 3), "Bo")]
    >>> decided_places(evening([Event("2025-03-01T19:30:00", what) for what in happened]))
    {'Cy': Place(first=3, last=3, event='')}
    """
    if state.plan.form == "chips":
        return _of_chips(state)
    if state.plan.form == "swiss":
        over = not state.standing.to_play and stage_to_draw(state) is None
        rows = swiss_ranks(state)[1] if over else []
        return _shared([(row.player, (-row.score, -row.buchholz)) for row in rows])
    found = {**_of_matches(state.standing), **_of_groups(state.standing)}
    return {state.order[player]: place for player, place in sorted(found.items())}


def _of_matches(now: Standing) -> dict[int, Place]:
    """Return the places of players who have no next match after a match."""
    found = {}
    for match in now.bracket.matches:
        goes, winner = now.bracket.going[match.name], now.winners.get(match.name, NOBODY)
        for slot, player in enumerate(now.seats[match.name] if winner != NOBODY else ()):
            won = player == winner
            place = match.winner_place if won else match.loser_place
            if player is not None and place and not (goes.winner if won else goes.loser)[slot]:
                found[player] = place
    found.pop(NOBODY, None)
    return found


def _of_groups(now: Standing) -> dict[int, Place]:
    """Return the places from finished groups, and from runners-up who don't advance."""
    found, bracket = {}, now.bracket
    groups = [(one.name, one.places) for one in bracket.groups]
    runners_up = (
        [(bracket.runners_up.name, bracket.runners_up.places)] if bracket.runners_up else []
    )
    for name, places in groups + runners_up:
        for rank, place in enumerate(places, 1):
            player = now.sent.get(Source(name, rank))
            if place and player is not None:
                found[player] = place
    for group in bracket.groups:
        over = all(name in now.winners for name in group.matches)
        if over and Source(group.name, 1) not in now.sent and None not in group.places:
            ahead = ranked(group.members, group.pairs, [now.winners[n] for n in group.matches])
            for player, first in zip(group.members, ahead, strict=True):
                shared = [p for p in group.places[first : first + ahead.count(first)] if p]
                found[player] = shared[0]._replace(last=shared[-1].last)
    return found


def _of_chips(state: Evening) -> dict[str, Place]:
    night = state.chip_night
    left = night.order
    order = [*(left if len(left) == 1 else []), *reversed(night.gone)]
    first = len(night.chips) - len(order) + 1
    return {name: Place(k, k) for k, name in enumerate(order, first)}


def _shared(rows: Sequence[tuple[str, object]]) -> dict[str, Place]:
    """Return the places of players, best first, with tied players sharing places."""
    keys = [key for _, key in rows]
    found = {}
    for name, key in rows:
        first = keys.index(key) + 1
        found[name] = Place(first, first + keys.count(key) - 1)
    return found
