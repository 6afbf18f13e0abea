"""What a correction can do to matches played on the corrected result, in words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from evenbreak.answers.tournament.moves import and_words, open_words
from evenbreak.answers.tournament.short_names import first_name
from evenbreak.answers.tournament.tournament import against
from evenbreak.tournaments.evening.events import race_words
from evenbreak.tournaments.evening.fold import Evening
from evenbreak.tournaments.evening.undoing import Loss, losses
from evenbreak.words import Sentence, joined, say, say_count, tally


class Choice(NamedTuple):
    """What can happen to matches played on a result that is being corrected.

    `follow` is the option's value, stop or keep; `details` has a line per table, and one for what
    stays in the history.
    """

    follow: str
    headline: Sentence
    details: list[Sentence]
    button: Sentence


def correction_choices(before: Evening, stop: Evening, match: str) -> list[Choice]:
    """Return what can happen to matches played on a result; [] if there are none.

    `stop` is the state after the correction if matches in play are stopped.
    """
    lost = losses(before, stop)
    if not lost:
        return []
    number, many = before.match_words(match), len(lost)
    in_play = all(one.result is None for one in lost)
    traded = say(
        "{players} trade places.",
        players=and_words(_first_names(before, before.counted[match].players)),
    )
    if not in_play:
        stopped = say_count("Reopen {n} match.", "Reopen {n} matches.", many)
        stop_button = say("Change it and reopen what follows")
        kept, keep_button = say("Let everything stand."), say("Change it and let everything stand")
    elif many == 1:
        stopped, stop_button = say("Stop it."), say("Change it and stop the match")
        kept, keep_button = (
            say("Let it finish as it is."),
            say("Change it and let the match finish"),
        )
    elif many == 2:
        stopped, stop_button = say("Stop both."), say("Change it and stop both")
        kept = say("Let both finish as they are.")
        keep_button = say("Change it and let both finish")
    else:
        stopped = say("Stop all {n}.", n=many)
        stop_button = say("Change it and stop all {n}", n=many)
        kept = say("Let all {n} finish as they are.", n=many)
        keep_button = say("Change it and let all {n} finish", n=many)
    bracket = say("The bracket stays; only the record of {match} changes.", match=number)
    return [
        Choice("stop", joined([stopped, traded]), _stop_details(stop, lost), stop_button),
        Choice("keep", kept, [bracket], keep_button),
    ]


def _stop_details(stop: Evening, lost: Sequence[Loss]) -> list[Sentence]:
    """Return what happens to each match that stops or opens, and what stays in the history."""
    said = []
    for one in lost:
        number = stop.match_words(one.match)
        if one.match in stop.on_tables:
            said.append(
                say(
                    "Table {table}: {pair}, {race}, starting at {none}.",
                    table=stop.plan.table_name(stop.on_tables[one.match].call.table),
                    pair=against(_first_names(stop, stop.pair(one.match))),
                    none=tally((0, 0)),
                    race=race_words(stop.needed(one.match, stop.pair(one.match))),
                )
            )
        elif one.table is not None:
            table = stop.plan.table_name(one.table)
            said.append(
                say(
                    "Table {table} is free; {match}.",
                    table=table,
                    match=open_words(stop, one.match),
                )
            )
        else:
            said.append(say("Reopened: {match}.", match=open_words(stop, one.match)))
        if one.result is not None:
            said[-1] = say("{open} {result} no longer counts.", open=said[-1], result=number)
    scores = [tally(one.score) for one in lost if one.score and any(one.score)]
    if len(scores) == 1:
        said.append(say("{score} stays in the history.", score=scores[0]))
    elif scores:
        said.append(say("{scores} stay in the history.", scores=and_words(scores)))
    return said


def _first_names(state: Evening, names: Sequence[str]) -> list[str]:
    """Return players' short names."""
    return [first_name(name, state.entrants) for name in names]
