"""`evenbreak tournament edit`: correct a name or a rating before the draw."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.starters import POINTS
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.events import Edited
    from evenbreak.tournaments.evening.fold import Evening


@click.command("edit")
@click.argument("player")
@click.option("--name", metavar="NAME", default="", help="The right name.")
@click.option("--rating", type=POINTS, metavar="R", help="The right rating.")
@file_option
@at_option
@faces()
def command(*, player: str, name: str, rating: float | None, file: str, at: str) -> Answer:
    """Correct PLAYER's name or rating before the draw; they keep their place in the list."""
    from evenbreak.files.tables.names import NAME, clean_name, is_name
    from evenbreak.tournaments.evening import moves

    right = clean_name(name)
    if name and not is_name(right):
        refuse(f"--name: {name!r} is not {NAME}")

    def decide(state: Evening) -> list[Edited]:
        known = moves.known_player(state, player)
        return [moves.edit(state, known, name=right, rating=rating)]

    before, state = add(file, at, decide)
    (now,) = set(state.entrants.values()) - set(before.entrants.values())
    return answer_of(file, state, at, [f"{now.name} is entered with a rating of {now.rating:g}."])
