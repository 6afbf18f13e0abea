"""`evenbreak live`: a match under way, game by game."""

from dataclasses import replace

from evenbreak.answers.kit.answer import Answer
from evenbreak.cli.kit.asked import command_of
from evenbreak.cli.kit.plot import write_plot
from evenbreak.cli.match.what_is_played import match_of, refuse_giants
from evenbreak.questions.match import Live


@command_of(Live, "live")
def command(asked: Live) -> Answer:
    """Follow a match under way."""
    from evenbreak.answers.match.live import live_answer
    from evenbreak.matches.live import live_odds, order_is_free

    players, match = match_of(asked)
    refuse_giants(match)
    if players.form and not order_is_free(match):
        if asked.form is not None:
            asked.refuse(
                "{form} is for races of games in which the break does not matter; leave it out here"
            )
        players = replace(players, form=0.0)
    odds = live_odds(match, asked.racks, set_score=asked.set_score, form=players.form)
    answer = live_answer(players, match, odds, comebacks=asked.comebacks)
    if asked.plot is not None:
        from evenbreak.plots.matches import course_figure

        write_plot(course_figure(odds, title=answer.heading, names=players.names), asked.plot)
    return answer
