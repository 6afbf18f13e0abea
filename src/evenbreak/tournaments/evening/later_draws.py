"""What is drawn in the course of an evening: rounds of a Swiss, qualifiers that are redrawn."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from evenbreak.errors import InputError
from evenbreak.tournaments.brackets.bracket import Bracket, Slot, Source
from evenbreak.tournaments.brackets.double import losers_qualifiers, redrawn
from evenbreak.tournaments.brackets.swiss import (
    Pairing,
    Swiss,
    swiss,
    swiss_bracket,
    swiss_round,
)
from evenbreak.tournaments.evening.events import LaterDraw, Plan, Result
from evenbreak.words import Command, listed

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening

KNOCK_OUT = "K1"
"""The stage of the redraw: the first round of the knock-out."""

TO_DRAW = "to draw"
"""In place of a match, the source of a player who is still to be drawn."""

Drawn = Mapping[str, tuple[str | None, ...]]
"""What has been drawn, by stage: the players of a round in pairs, or where qualifiers come from."""


def swiss_of(plan: Plan, order: tuple[str, ...]) -> Swiss:
    """Return the Swiss of a plan: unless given, with as many rounds as a single elimination.

    >>> swiss_of(Plan("swiss", 5), ("Ann", "Bo", "Cy", "Di", "Ed")).rounds
    3
    """
    return swiss(order, plan.rounds or (len(order) - 1).bit_length())


def bracket_now(bracket: Bracket, plan: Plan, drawn: Drawn) -> Bracket:
    """Return the matches of which it is known where their players come from.

    Parameters
    ----------
    bracket
        all matches, as `bracket_of` returns them.
    plan
        what is played.
    drawn
        what has been drawn so far.
    """
    if plan.form == "swiss":
        rounds = pairings(drawn)
        return swiss_bracket(swiss_of(plan, bracket.players), rounds, to_come=False)
    if plan.placement != "redraw":
        return bracket
    slots: list[Slot] = [Source(TO_DRAW, k) for k, _ in enumerate(losers_qualifiers(bracket), 1)]
    if KNOCK_OUT in drawn:
        slots = [Source(str(name), "winner") for name in drawn[KNOCK_OUT]]
    return redrawn(bracket, slots)


def whole_bracket(bracket: Bracket, plan: Plan, drawn: Drawn) -> Bracket:
    """Return all matches, with a stand-in for what is still to be drawn."""
    if plan.form == "swiss":
        return swiss_bracket(swiss_of(plan, bracket.players), pairings(drawn))
    if plan.placement == "redraw" and KNOCK_OUT in drawn:
        return bracket_now(bracket, plan, drawn)
    return bracket


def pairings(drawn: Drawn, counted: Mapping[str, Result] | None = None) -> list[list[Pairing]]:
    """Return the rounds of a Swiss that are drawn, with the winners so far.

    >>> drawn = {"R1": ("Ann", "Bo", "Cy", None)}
    >>> pairings(drawn, {"R1.1": Result("R1.1", ("Ann", "Bo"), (3, 5), "Bo")})
    [[Pairing(first='Ann', second='Bo', winner='Bo'),
      Pairing(first='Cy', second=None, winner=None)]]
    """
    found = []
    for number in range(1, len(drawn) + 1):
        seats = drawn[f"R{number}"]
        pairs = [(str(one), other) for one, other in zip(seats[::2], seats[1::2], strict=True)]
        pairs.sort(key=lambda pair: pair[1] is None)
        names = [f"R{number}.{k}" for k in range(1, len(pairs) + 1)]
        found.append(
            [
                Pairing(one, other, counted[name].winner if counted and name in counted else None)
                for name, (one, other) in zip(names, pairs, strict=True)
            ]
        )
    return found


def stage_to_draw(state: Evening) -> str | None:
    """Return what is still to be drawn later: the next stage, or None."""
    plan, later = state.plan, state.later
    if plan.form == "swiss":
        rounds = swiss_of(plan, state.order).rounds
        return f"R{len(later) + 1}" if len(later) < rounds else None
    return KNOCK_OUT if plan.placement == "redraw" and KNOCK_OUT not in later else None


def can_draw(state: Evening) -> bool:
    """Return whether the next stage can be drawn: all that it needs has been played."""
    if stage_to_draw(state) is None:
        return False
    if state.plan.form == "swiss":
        return len(state.counted) == len(state.bracket.matches)
    return all(slot in state.standing.sent for slot in losers_qualifiers(state.whole))


def draw_later(state: Evening, rng: np.random.Generator) -> LaterDraw:
    """Draw the next stage of an evening whose first draw has been made.

    Raises
    ------
    InputError
        if there is none, or it must wait for matches.
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
            "{stage} can't be drawn yet; first enter the result of {matches}",
            stage=stage,
            matches=listed(open_matches[:3]),
        )
    if state.plan.form == "swiss":
        played = pairings(state.later, state.counted)
        event = swiss_of(state.plan, state.order)
        pairs = swiss_round(event, played, without=state.dropped)
        return LaterDraw(stage, tuple(name for p in pairs for name in (p.first, p.second)))
    sources = [slot.match for slot in losers_qualifiers(state.whole) if isinstance(slot, Source)]
    return LaterDraw(stage, tuple(sources[k] for k in rng.permutation(len(sources)).tolist()))
