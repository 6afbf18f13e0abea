"""The option --prizes: the money for each place."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import click

from evenbreak.cli.kit.options import Command
from evenbreak.cli.kit.values import numbers, refuse
from evenbreak.tournaments.evening.format import MOST_PLAYERS


def prizes_option(adds: str) -> Callable[[Command], Command]:
    """Return the option --prizes, which adds something to the answer."""
    return click.option(
        "--prizes",
        metavar="MONEY,...",
        help=f"The money for first place, second, ..., such as 500,300,150: adds {adds}.",
    )


def paid_places(text: str | None, players: int) -> tuple[float, ...]:
    """Return the money for each place that --prizes states."""
    if text is None:
        return ()
    wanted = "give an amount for each paid place, such as 500,300,150"
    read: Any = numbers(",", range(1, MOST_PLAYERS + 1), 0.0, 1e12, wanted)
    try:
        found: tuple[float, ...] = read(text)
    except click.BadParameter as error:
        refuse(f"--prizes is {error.message}")
    if len(found) > players:
        refuse(f"--prizes has {len(found)} places for {players} players; give fewer")
    return found
