"""`evenbreak fair`: the races that come nearest to a target chance."""

from typing import Any

from evenbreak.answers.kit.answer import Answer
from evenbreak.answers.match.odds import TwoPlayers
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.players import players_of, refuse_uncertain
from evenbreak.cli.kit.values import refuse
from evenbreak.questions.match import Fair


@command_of(Fair, "fair")
def command(asked: Fair) -> Answer:
    """Find the fairest races."""
    from evenbreak.answers.match.odds import fair_answer
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
        if players.scale is None:
            _refuse_without_odds(players)
        races = players.gap.nearest_races(**limits)
    else:
        races = fair_races(
            players.rack,
            breaks=players.break_format,
            first_breaker=players.first_breaker,
            via=asked.via,
            **limits,
        )
    return fair_answer(players, races, target=asked.target, via=asked.via)


def _refuse_without_odds(players: TwoPlayers) -> None:
    """Refuse chances that form of the day cannot change, or about which it says nothing."""
    if players.p_game_a is None:
        refuse("--form knows nothing of the break here; give --p, or two ratings")
    if players.p_game_a in (0.0, 1.0):
        refuse(f"--form changes nothing where --p is {players.p_game_a:g}; leave it out")
