"""Moves about tables: matches that trade them, or wait for a player."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from evenbreak.errors import InputError
from evenbreak.tournaments.evening.events import Called, Waits
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.known import refuse_stranger, undecided


def swap_tables(state: Evening, one: str, other: str) -> list[Called]:
    """Let two called matches trade tables."""
    names = undecided(state, one), undecided(state, other)
    for name in names:
        if name not in state.on_tables:
            raise InputError("{match} isn't on a table", match=state.match_words(name))
    if names[0] == names[1]:
        raise InputError("name two matches to trade tables")
    calls = [state.on_tables[name].call for name in names]
    return [
        replace(calls[0], table=calls[1].table),
        replace(calls[1], table=calls[0].table),
    ]


def wait(
    state: Evening,
    match: str,
    *,
    absent: Sequence[str] = (),
    until: str = "",
    reason: str = "",
) -> Waits:
    """Let a match wait, off its table; without a reason, it no longer waits.

    `absent` players forfeit it at the time `until`, such as 2025-03-01T20:15:00.
    """
    name = undecided(state, match)
    if state.plan.form == "chips":
        raise InputError(
            "a chip tournament has no calls: the players at the tables just keep playing"
        )
    pair = state.pair(name)
    for player in absent:
        refuse_stranger(state, player, name, pair)
    found = Waits(name, pair, tuple(dict.fromkeys(absent)), until, reason)
    if not found and name not in state.waiting_for:
        raise InputError(
            "{match} isn't waiting. Say who is absent, or why it should wait.",
            match=state.match_words(name),
        )
    return found
