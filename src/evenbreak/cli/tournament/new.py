"""`evenbreak tournament new`: begin a tournament."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.faces import faces
from evenbreak.cli.kit.paces import DISCIPLINES
from evenbreak.cli.kit.values import Whole, refuse
from evenbreak.cli.tournament.evening import answer_of, at_option
from evenbreak.cli.tournament.options import Entered, drawn_up, entry_options
from evenbreak.tournaments.evening.opening import MOST_TABLES

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening

EXAMPLES = """\b
Examples:
  evenbreak tournament new entrants.csv --race 7 --losers-race 5 --tables 4 --seeding blind
  evenbreak tournament new entrants.csv --format single --race-to 5 --out saturday.db
  evenbreak tournament new entrants.csv --format chips --chips hoboken --tables 4
"""


@click.command("new", epilog=EXAMPLES)
@entry_options
@click.option(
    "--tables", type=Whole(1, MOST_TABLES), metavar="T", required=True, help="The number of tables."
)
@click.option(
    "--discipline",
    type=click.Choice(DISCIPLINES),
    default="9-ball",
    help="The game, for how long matches take.",
)
@click.option(
    "--out",
    metavar="FILE.db",
    default="tonight.db",
    show_default=True,
    help="The file of the tournament, which must not exist yet.",
)
@at_option
@faces()
def command(*, entered: Entered, tables: int, discipline: str, out: str, at: str) -> Answer:
    """Begin a tournament: write its entrants and what is played to a new file.

    Then make the draw, with evenbreak tournament draw. Players may enter until then, and later in
    place of a bye, or in a chip tournament at the end of the line. The other commands read and
    write tonight.db unless --file or the environment variable EVENBREAK_TOURNAMENT names another
    file.
    """
    from dataclasses import replace

    import numpy as np

    from evenbreak.files.store.tournament import new_tournament
    from evenbreak.tournaments.evening.events import Drawn, Entrant, Event
    from evenbreak.tournaments.evening.fold import ELIMINATIONS, evening
    from evenbreak.tournaments.evening.opening import opened

    plan = replace(entered.plan, tables=tables, discipline=discipline)
    roster, _, lines = entered.roster, "", None
    if plan.seeding == "drawn":
        if plan.form not in ELIMINATIONS:
            refuse(f"--seeding drawn is for eliminations, not {plan.form}")
        roster, _, lines = drawn_up(roster, plan.seeding, entered.seed)
    errors = np.nan_to_num(roster.standard_error).tolist()
    entrants = tuple(
        Entrant(*one) for one in zip(roster.players, roster.rating.tolist(), errors, strict=True)
    )
    events: list[Event] = [Event(at, opened(plan, entrants))]
    if lines is not None:
        events.append(Event(at, Drawn(roster.players, tuple(lines))))
    state = evening(events)
    answer = answer_of(out, state, at, _unrated(entered, state))
    new_tournament(out, events)  # last, so that what cannot be shown is never written
    return replace(answer, warnings=[*entered.file.warnings, *entered.warnings, *answer.warnings])


def _unrated(entered: Entered, state: Evening) -> list[str]:
    """Return what is assumed of players without a rating, as a sentence if there are any."""
    import numpy as np

    from evenbreak.answers.league.players import games_words
    from evenbreak.answers.tournament.tournament import unrated_words

    read = entered.file.roster
    unrated = [read.players[k] for k in np.flatnonzero(np.isnan(read.rating)).tolist()]
    names = [name for name in unrated if name in state.entrants]  # no bye rows
    plan = state.plan
    said = [unrated_words(names, plan.starter, plan.starter_error)] if names else []
    return [*said, *filter(None, [games_words(read, entered.roster)])]
