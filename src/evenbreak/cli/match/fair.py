"""`evenbreak fair`: the races that come nearest to a target chance."""

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.players import players_of, refuse_uncertain
from evenbreak.questions.match import Fair


@command_of(Fair, "fair")
def command(asked: Fair) -> Answer:
    """Find the fairest races."""
    from evenbreak.answers.match.odds import fair_answer, races_for

    players = players_of(asked, asked.form)
    if asked.via is not None:
        refuse_uncertain(players)
    return fair_answer(players, races_for(players, asked), target=asked.target, via=asked.via)
