"""`evenbreak tournament next`: who plays next, and on which table."""

from __future__ import annotations

from pathlib import PurePath

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.evening import at_option, file_option
from evenbreak.cli.tournament.prize_money import paid_places, prizes_option

EXAMPLES = """\b
Examples:
  evenbreak tournament next
  evenbreak tournament next --prizes 500,300,150
"""


@click.command("next", epilog=EXAMPLES)
@prizes_option("what each match decides in money")
@file_option
@at_option
@faces()
def command(*, prizes: str | None, file: str, at: str) -> Answer:
    """Show what is on the tables and which match to call next, so that it ends soonest.

    Each match that can be played is listed with what it decides: the title odds that its result
    moves from some players to others, and how much later the tournament would end if it were
    called first. In a chip tournament it shows who is at which table and who is next in the line.
    """
    from evenbreak.answers.tournament.night import night_answer
    from evenbreak.files.store.tournament import read_tournament
    from evenbreak.tournaments.evening.outlook import Outlook

    state = read_tournament(file)
    if prizes is not None and state.plan.form == "chips":
        refuse("--prizes is for matches; in a chip tournament no single rack decides them")
    paid = paid_places(prizes, len(state.entrants))
    name = PurePath(file).name
    return night_answer(Outlook(state, at), decides=True, prizes=paid, source=name)
