"""`evenbreak tournament time`: when tonight's tournament ends, and when each match starts."""

from __future__ import annotations

from pathlib import PurePath

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.paces import stated_pace
from evenbreak.cli.tournament.evening import moment, outlook_of
from evenbreak.cli.tournament.options import tournament_of
from evenbreak.questions.tournament import TournamentTime


@command_of(TournamentTime, "time")
def command(asked: TournamentTime) -> Answer:
    """Find when the tournament ends."""
    from evenbreak.answers.tournament.time import tournament_time_answer
    from evenbreak.matches import Turnover

    if asked.entrants is None:
        return _under_way(asked)
    tournament, warnings = tournament_of(asked)
    pace = stated_pace(asked.discipline, asked.minutes_per_game) or ""
    return tournament_time_answer(
        tournament,
        tables=asked.tables or 1,
        pace=pace,
        turnover=None if asked.turnover is None else Turnover(asked.turnover),
        start=asked.start,
        seed=asked.seed,
        warnings=warnings,
    )


def _under_way(asked: TournamentTime) -> Answer:
    """Find when the tournament under way ends."""
    from evenbreak.answers.tournament.under_way import time_under_way
    from evenbreak.matches import Turnover

    file = asked.path
    return time_under_way(
        outlook_of(file, moment(asked.at, file)),
        tables=asked.tables,
        turnover=None if asked.turnover is None else Turnover(asked.turnover),
        source=PurePath(file).name,
    )
