"""`evenbreak odds`: the odds of a match, and how long it lasts."""

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.players import refuse_uncertain
from evenbreak.cli.match.what_is_played import MOST_BY_WAY, match_of, refuse_giants
from evenbreak.questions.match import Odds


@command_of(Odds, "odds")
def command(asked: Odds) -> Answer:
    """Give the odds of a match."""
    from evenbreak.answers.match.odds import odds_answer

    players, match = match_of(asked)
    if asked.via is not None:
        refuse_uncertain(players)
    is_plain = getattr(match, "win_by", 0) == 1 and match.rack is players.rack
    if asked.exact or not is_plain:
        refuse_giants(match)
    elif asked.via is not None:
        refuse_giants(match, MOST_BY_WAY)
    return odds_answer(players, match, exact=asked.exact, via=asked.via)
