"""Draws later in an evening: Swiss rounds, and redrawn qualifiers."""

from __future__ import annotations

import numpy as np

from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Source
from evenbreak.tournaments.brackets.double import losers_qualifiers
from evenbreak.tournaments.brackets.swiss import swiss_round
from evenbreak.tournaments.evening.events import LaterDraw
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.plan import KNOCK_OUT, pairings, swiss_of
from evenbreak.words import Command, listed


def stage_to_draw(state: Evening) -> str | None:
    """Return the next stage still to be drawn, or None."""
    plan, later = state.plan, state.later
    if plan.form == "swiss":
        rounds = swiss_of(plan, state.order).rounds
        return f"R{len(later) + 1}" if len(later) < rounds else None
    return KNOCK_OUT if plan.placement == "redraw" and KNOCK_OUT not in later else None


def can_draw(state: Evening) -> bool:
    """Return whether the next stage can be drawn: everything it needs has been played."""
    if stage_to_draw(state) is None:
        return False
    if state.plan.form == "swiss":
        return len(state.counted) == len(state.bracket.matches)
    return all(slot in state.standing.sent for slot in losers_qualifiers(state.whole))


def draw_later(state: Evening, rng: np.random.Generator) -> LaterDraw:
    """Draw the next stage of an evening after its first draw.

    Raises InputError if there is none, or it must wait for matches.
    """
    stage = stage_to_draw(state)
    if stage is None:
        raise InputError(
            "the draw has already been made; to take it back: {undo}",
            undo=Command("tournament undo"),
        )
    if not can_draw(state):
        open_matches = [name for name in state.standing.to_play if name[0] != "K"]
        raise InputError(
            "the next draw must wait; first enter the result of {matches}",
            matches=listed([state.match_words(name) for name in open_matches[:3]]),
        )
    if state.plan.form == "swiss":
        played = pairings(state.later, state.counted)
        event = swiss_of(state.plan, state.order)
        pairs = swiss_round(event, played, without=state.dropped)
        return LaterDraw(stage, tuple(name for p in pairs for name in (p.first, p.second)))
    sources = [slot.match for slot in losers_qualifiers(state.whole) if isinstance(slot, Source)]
    return LaterDraw(stage, tuple(sources[k] for k in rng.permutation(len(sources)).tolist()))
