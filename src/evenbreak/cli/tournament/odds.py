"""`evenbreak tournament odds`: each player's odds of winning tonight's tournament."""

from __future__ import annotations

from dataclasses import replace
from pathlib import PurePath

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.values import refuse
from evenbreak.cli.tournament.evening import moment, outlook_of
from evenbreak.cli.tournament.options import tournament_of
from evenbreak.cli.tournament.prizes import paid_places
from evenbreak.questions.tournament import TournamentOdds


@command_of(TournamentOdds, "odds")
def command(asked: TournamentOdds) -> Answer:
    """Find each player's odds."""
    import numpy as np

    from evenbreak.answers.tournament.odds import tournament_odds_answer

    if asked.entrants is None:
        return _under_way(asked)
    tournament, warnings = tournament_of(asked, before_draw=asked.before_draw)
    if np.isnan(tournament.file.roster.rating).all():
        refuse(f"{tournament.file.source} has no ratings, so everybody's odds are the same")
    if asked.fairest and isinstance(tournament.races.race, int):
        refuse("--fairest is for handicapped races; give --race-to N or --chart NAME, not --race")
    return tournament_odds_answer(
        tournament,
        sure=asked.sure,
        walkovers=asked.walkovers,
        prizes=paid_places(asked.prizes, len(tournament.roster)),
        fairest=asked.fairest,
        seed=asked.seed,
        warnings=warnings,
    )


def _under_way(asked: TournamentOdds) -> Answer:
    """Find each player's odds in the tournament under way."""
    from evenbreak.answers.tournament.under_way import odds_under_way

    file = asked.path
    outlook = replace(outlook_of(file, moment(asked.at, file)), walkovers=asked.walkovers)
    paid = paid_places(asked.prizes, len(outlook.state.order))
    return odds_under_way(outlook, sure=asked.sure, prizes=paid, source=PurePath(file).name)
