"""How fast matches are played, by --discipline or --minutes-per-game."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.cli.kit.values import refuse

if TYPE_CHECKING:
    from evenbreak.matches.pace import Pace


def stated_pace(discipline: str | None, minutes_per_game: float | None) -> Pace | str | None:
    """Return the discipline or the pace that the options state, None if they state none."""
    from evenbreak.matches.pace import own_pace

    if discipline is not None and minutes_per_game is not None:
        refuse("--discipline and --minutes-per-game cannot be combined; leave one out")
    return discipline if minutes_per_game is None else own_pace(minutes_per_game)
