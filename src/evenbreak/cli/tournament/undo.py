"""`evenbreak tournament undo`: take back an entry."""

from __future__ import annotations

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.values import Whole
from evenbreak.cli.tournament.evening import add, answer_of, at_option, file_option, yes_option


@click.command("undo")
@click.option(
    "--entry",
    type=Whole(2, 10**7),
    metavar="N",
    help="A result that both players entered, by its number in the history.  "
    "[default: the director's last entry]",
)
@file_option
@at_option
@yes_option
@faces()
def command(*, entry: int | None, file: str, at: str, yes: bool) -> Answer:
    """Take back the director's last entry; once more takes back the one before that.

    Scores that players tap on their phones stay. A result that both players entered is taken back
    only if --entry names it, or corrected.
    """
    from evenbreak.answers.tournament.moves import reopened, undone_words
    from evenbreak.tournaments.evening.undoing import undo

    before, state = add(file, at, lambda state: [undo(state, entry)], yes=yes)
    events = dict(zip(before.numbers, before.events, strict=True))
    (gone,) = events.keys() - set(state.numbers)
    said = [undone_words(events[gone].what), *reopened(before, state)]
    return answer_of(file, state, at, said)
