"""What everybody in the room may read of tonight, for other programs."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from typing import Annotated

from msgspec import Meta

from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.later_draws import can_draw
from evenbreak.web.api.problem import ProblemError
from evenbreak.web.api.resource import Call, Kept, Resource
from evenbreak.web.site import night_of


@dataclass(frozen=True)
class Tonight:
    """A tournament."""

    name: Annotated[str, Meta(description="What it is called; '' if it has no name.")]
    state: Annotated[str, Meta(description="registered (no draw yet), under_way or finished.")]
    format: Annotated[str, Meta(description="How it is played, such as double.")]
    players: Annotated[int, Meta(description="How many play.")]


async def state_of(call: Call) -> Evening:
    """Return the state of the event that is asked about; refuse before any has begun."""
    night = night_of(call.request)
    if not night.exists:
        raise ProblemError("No tournament is running yet.", status=404)
    return await asyncio.to_thread(night.state)


async def tonight(call: Call) -> Kept:
    """Return the tournament."""
    state = await state_of(call)

    def make() -> Tonight:
        going = "registered"
        if state.drawn:
            over = not state.standing.to_play and not can_draw(state)
            going = "finished" if over else "under_way"
        return Tonight(state.plan.name, going, state.plan.form, len(state.entrants))

    return Kept(("api", state), make)


RESOURCES = [Resource("/tonight", "The tournament of tonight.", tonight, Tonight)]
