"""`evenbreak tournament new`: begin a tournament."""

from __future__ import annotations

from typing import TYPE_CHECKING

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.tournament.evening import moment, night_of
from evenbreak.cli.tournament.options import Entered, drawn_up, entered_in
from evenbreak.questions.tournament import NewTournament

if TYPE_CHECKING:
    from evenbreak.tournaments.evening.fold import Evening


@command_of(NewTournament, "new")
def command(asked: NewTournament) -> Answer:
    """Start a tournament."""
    from dataclasses import replace

    import numpy as np

    from evenbreak.files.store.tournament import new_tournament
    from evenbreak.tournaments.evening.events import Drawn, Entrant, Event
    from evenbreak.tournaments.evening.fold import evening
    from evenbreak.tournaments.evening.opening import opened

    entered, at = entered_in(asked), moment(asked.at)
    plan = replace(entered.plan, tables=asked.tables, discipline=asked.discipline)
    roster, lines = entered.roster, None
    if asked.seeding == "drawn":
        roster, _, lines = drawn_up(roster, asked.seeding, asked.seed)
    errors = np.nan_to_num(roster.standard_error).tolist()
    entrants = tuple(
        Entrant(*one) for one in zip(roster.players, roster.rating.tolist(), errors, strict=True)
    )
    events: list[Event] = [Event(at, opened(plan, entrants))]
    if lines is not None:
        events.append(Event(at, Drawn(roster.players, tuple(lines))))
    state = evening(events)
    answer = night_of(asked.out, state, at, _unrated(entered, state))
    new_tournament(asked.out, events)  # last, so that what cannot be shown is never written
    return replace(answer, warnings=[*entered.file.warnings, *entered.warnings, *answer.warnings])


def _unrated(entered: Entered, state: Evening) -> list[str]:
    """Return what is assumed of players without a rating, as a sentence if there are any."""
    import numpy as np

    from evenbreak.answers.league.prior import games_words, unrated_words

    read = entered.file.roster
    unrated = [read.players[k] for k in np.flatnonzero(np.isnan(read.rating)).tolist()]
    names = [name for name in unrated if name in state.entrants]  # no bye rows
    plan = state.plan
    said = [unrated_words(names, plan.starter, plan.starter_error)] if names else []
    return [*said, *filter(None, [games_words(read, entered.roster)])]
