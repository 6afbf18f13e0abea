"""`evenbreak fair`: the races that come nearest to a target chance."""

import math
from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.two_players import TwoPlayers
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.players import players_of, refuse_uncertain
from evenbreak.cli.kit.values import refuse
from evenbreak.questions.match import Fair
from evenbreak.ratings.scale import Scale


@command_of(Fair, "fair")
def command(asked: Fair) -> Answer:
    """Find the fairest races."""
    from evenbreak.answers.match.fair import fair_answer
    from evenbreak.handicaps.charts.fair import fair_races

    players = players_of(asked, asked.form)
    limits: Any = {
        "games": asked.games,
        "race_to": asked.race_to,
        "target": asked.target,
        "top": asked.top,
    }
    if asked.via is not None:
        refuse_uncertain(players)
    if players.error or players.form:
        from evenbreak.handicaps.charts.given_ratings import nearest_races_given_ratings

        races = nearest_races_given_ratings(
            _difference(players), players.error, scale=_scale(players), form=players.form, **limits
        )
    else:
        races = fair_races(
            players.rack,
            breaks=players.break_format,
            first_breaker=players.first_breaker,
            via=asked.via,
            **limits,
        )
    return fair_answer(players, races, target=asked.target, via=asked.via)


def _scale(players: TwoPlayers) -> Scale:
    """Return the scale of the ratings; without any, one of natural log-odds."""
    return players.scale or Scale("log-odds", math.log(2.0))


def _difference(players: TwoPlayers) -> float:
    if players.scale is not None:
        return players.difference
    p = players.p_game_a
    if p is None:
        refuse("--form knows nothing of the break here; give --p, or two ratings")
    if p in (0.0, 1.0):
        refuse(f"--form changes nothing where --p is {p:g}; leave it out")
    return math.log(p) - math.log1p(-p)
