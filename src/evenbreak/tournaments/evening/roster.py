"""Moves about players: check-in, renames, substitutes, and swapping places in the draw."""

from __future__ import annotations

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import (
    CheckedIn,
    Declined,
    Entrant,
    Late,
    Registered,
    Renamed,
    Substituted,
    Swapped,
)
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.known import check_entrant, entered
from evenbreak.tournaments.evening.moves import late


def rename(state: Evening, player: str, to: str) -> Renamed:
    """Rename a player, by full name, at any time."""
    before = state.entrants[entered(state, player)]
    if to == player or not to.strip():
        raise InputError("{player} already has that name. Enter a different one.", player=player)
    check_entrant(state, Entrant(to, before.rating), besides=player)
    return Renamed(player, to)


def substitute(state: Evening, player: str, entrant: Entrant) -> Substituted:
    """Let someone replace a player, by full name, who hasn't played yet.

    If their match has been called, it stays on its table.
    """
    name = entered(state, player)
    check_entrant(state, entrant)
    _refuse_begun(state, name)
    return Substituted(name, entrant)


def swap(state: Evening, one: str, other: str) -> Swapped:
    """Let two players, by full name, trade places in the draw.

    In a Swiss, they trade opponents in the current round.
    """
    if not state.drawn:
        raise InputError("there's no draw yet, so players can't trade places")
    names = entered(state, one), entered(state, other)
    if one == other:
        raise InputError("name two players to trade places")
    for name in names:
        _refuse_begun(state, name, this_round=state.plan.form == "swiss")
        for match, on in state.on_tables.items():
            if name in on.call.players:
                raise InputError(
                    "{player} has been called to table {table}. Take {match} off it first.",
                    player=name,
                    table=state.plan.table_name(on.call.table),
                    match=state.match_words(match),
                )
    return Swapped(one, other)


def _refuse_begun(state: Evening, player: str, *, this_round: bool = False) -> None:
    """Reject what can only be done before a player's first match, or their match in this round."""
    if not state.drawn:
        return
    if state.plan.form == "chips":
        raise InputError(
            "in a chip tournament, the line keeps its order. Drop {player}, and enter their "
            "replacement as a late player.",
            player=player,
        )
    now = f"R{len(state.later)}." if this_round else ""
    for name, played in state.records.items():
        sat = any({*one.result.players} == state.sitting(name) for one in played)
        if sat and player in state.sitting(name) and name.startswith(now):
            raise InputError(
                "{player} has already played {match}",
                player=player,
                match=state.match_words(name),
            )
    for name, live in state.live.items():
        if player in live.what.players and any(live.what.score):
            raise InputError(
                "{player} is playing {match}", player=player, match=state.match_words(name)
            )


def check_in(
    state: Evening, player: str, *, arrived: bool | None = None, paid: bool | None = None
) -> CheckedIn:
    """Record whether a player, by full name, is here and has paid."""
    name = entered(state, player)
    if arrived is None and paid is None:
        raise InputError("say whether {player} is here, or has paid", player=name)
    return CheckedIn(name, arrived, paid)


def register(state: Evening, name: str, rating: float | None = None) -> Registered:
    """Let someone ask to play."""
    check_entrant(state, Entrant(name, state.plan.starter if rating is None else rating))
    if name in state.registered:
        raise InputError("{player} is already on the list", player=name)
    return Registered(name, rating)


def accept(state: Evening, name: str, *, unrated: bool = False) -> Late:
    """Accept someone who asked to play, or was left out of the draw, perhaps unrated."""
    rating = state.registered[_registered(state, name)]
    rating = None if unrated else rating
    return late(state, state.plan.newcomer(name) if rating is None else Entrant(name, rating))


def decline(state: Evening, name: str) -> Declined:
    """Take someone off the list of people who would like to play."""
    return Declined(_registered(state, name))


def _registered(state: Evening, name: str) -> str:
    if name not in state.registered:
        raise InputError("{player} isn't on the list of people who'd like to play", player=name)
    return name
